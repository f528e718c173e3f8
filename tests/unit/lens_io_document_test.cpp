// What holds for every JSON file: syntax, repeated keys, nesting, size, damage.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "lens_io_fixtures.hpp"

namespace {

using namespace lens_io_fixtures;

TEST(JsonDocument, GivesLineAndColumnOfSyntaxErrors) {
  expect_refused(kLens, "{\n  \"index\": 1.5,\n  oops\n}", "", "line 3, column 3: not valid JSON");
  expect_refused(kLens, "", "", "line 1, column 1: not valid JSON");
  expect_refused(kLens, "{} {}", "", "line 1, column 4: not valid JSON");
  expect_refused(kLens, "{\"index\": NaN}", "", "line 1, column 11: not valid JSON");
  expect_refused(kLens, "{\"index\": Infinity}", "", "not valid JSON");
  expect_refused(kLens, "{\"name\": \"\xff\xfe\"}", "", "not valid JSON");
  expect_refused(kLens, "{\"name\": \"" + std::string(100000, 'a'), "", "not valid JSON");
  expect_refused(kLens, std::string("{\0}", 3), "", "not valid JSON");
  expect_refused(kLens, "[]", "", "is an array of 0; must be an object");
  expect_refused(kLens, "null", "", "is null; must be an object");
}

TEST(JsonDocument, RefusesNumbersBeyondDoublePrecision) {
  expect_refused(kLens, R"({"front": {"radius_mm": 1e999}})", "front.radius_mm", "not a finite number");
  expect_refused(kLens, R"({"a": [0, [1, -1e400]]})", "a[1][1]", "not a finite number");
}

TEST(JsonDocument, RefusesRepeatedKeys) {
  expect_refused(kLens, R"({"index": 1.5, "index": 1.6})", "index", "is given twice");
  expect_refused(kSpectacles, R"({"right": {"fit": {}, "front": {"type": "plane", "type": "plane"}}})",
                 "right.front.type", "is given twice");
  expect_refused(kLens, R"({"x": [{"a": 1}, {"a": 1, "b": [], "a": 2}]})", "x[1].a", "is given twice");
}

TEST(JsonDocument, RefusesDeepNesting) {
  for (const std::size_t depth : {std::size_t{65}, std::size_t{10000}, std::size_t{1000000}}) {
    expect_refused(kLens, std::string(depth, '['), "", "nested too deeply; at most 64 levels");
    std::string objects;
    for (std::size_t i = 0; i < depth; ++i) objects += "{\"a\":";
    expect_refused(kLens, objects, "", "nested too deeply");
  }
  expect_refused(kLens, std::string(64, '[') + std::string(64, ']'), "", "must be an object");
}

TEST(JsonDocument, NamesFilesThatCannotBeRead) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "vergence_lens_io_test";
  std::filesystem::create_directories(folder);
  const auto refusal = [](const std::string& path) {
    try {
      (void)lenses::read_lens(path);
    } catch (const InputError& error) {
      EXPECT_EQ(error.file(), path);
      EXPECT_EQ(error.field(), "");
      return error.reason();
    }
    return std::string("was read");
  };
  EXPECT_EQ(refusal((folder / "absent.json").string()).rfind("cannot be read: No such file", 0), 0u);
  EXPECT_NE(refusal(folder.string()).find("cannot be read: it is a folder"), std::string::npos);
  const std::filesystem::path large = folder / "large.json";
  std::ofstream(large) << " ";
  std::filesystem::resize_file(large, (std::uintmax_t{64} << 20) + 1);  // sparse
  EXPECT_NE(refusal(large.string()).find("64 MiB"), std::string::npos);
  const std::filesystem::path good = folder / "good.json";
  std::ofstream(good) << good_lens();
  EXPECT_EQ(lenses::read_lens(good.string()).index, 1.6);
  std::filesystem::remove_all(folder);
}

// Bytes flipped, removed, repeated or replaced by JSON's own signs: a reader reads or throws InputError, nothing else.
TEST(Readers, SurviveDamage) {
  const unsigned seed = 4711;
  std::mt19937 random(seed);
  const std::string signs = "{}[],:\"-+.eE0123456789 \\ntruefalsenull\n";
  const std::vector<std::pair<Parse, std::string>> good{{kLens, good_lens().dump()},
                                                        {kLens, lens_with_back(bspline_surface()).dump()},
                                                        {kSpectacles, good_spectacles().dump(1)},
                                                        {kWearer, good_wearer().dump(2)},
                                                        {kHeadset, good_headset().dump()}};
  int refused = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto& [parse, original] = good[static_cast<std::size_t>(i) % good.size()];
    std::string text = original;
    for (auto n = 1 + random() % 3; n > 0 && !text.empty(); --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(text[at] ^ (1 << random() % 8));
          break;
        case 1:
          text.erase(at, 1 + random() % 8);
          break;
        case 2:
          text.insert(at, text.substr(random() % text.size(), random() % 12));
          break;
        default:
          text[at] = signs[random() % signs.size()];
      }
    }
    try {
      parse(text);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "seed " << seed << ": " << error.what();
    } catch (const std::exception& error) {
      FAIL() << "seed " << seed << ", round " << i << ": " << error.what() << "\n" << text;
    }
  }
  EXPECT_GT(refused, 2500) << "most damage must be noticed";
}

}  // namespace
