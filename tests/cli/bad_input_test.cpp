// Whatever is wrong with a file, an option, the GPU or the disk: one line on standard error that names it, the right
// exit status, nothing on standard output, no file left behind, no crash and no hang.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/support/run_program.hpp"
#include "tests/support/tiny_scene.hpp"

namespace {

using nlohmann::json;
using support::ProgramCall;
using support::ProgramResult;
using support::run_program;
using support::TemporaryFolder;
using Words = std::vector<std::string>;

constexpr int kFailed = 1, kBadInput = 2;
// Neither name of the variable may find a driver, so that the loader has none.
const std::vector<std::pair<std::string, std::string>> kNoGpu{{"VK_ICD_FILENAMES", "/nonexistent"},
                                                              {"VK_DRIVER_FILES", "/nonexistent"}};

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) {
    text += " '" + word.substr(0, 80) + "'";
  }
  return text;
}

// One line: "vergence: WHAT: ... WORD ..."; where WHAT ends in a field, its element may follow: "WHAT[3]: ...".
void expect_one_line(const std::string& err, const std::string& what, const std::string& word) {
  const std::string start = "vergence: " + what;
  EXPECT_TRUE(err.starts_with(start + ": ") || err.starts_with(start + "["))
      << "wanted '" << start << "', got: " << err;
  EXPECT_NE(err.find(word), std::string::npos) << "wanted '" << word << "' in: " << err;
  EXPECT_EQ(std::ranges::count(err, '\n'), 1) << err;
  EXPECT_TRUE(err.ends_with('\n'));
  EXPECT_LT(err.size(), 600U) << "too long to be read";
}

void expect_refused(const ProgramCall& call, int status, const std::string& what, const std::string& word = "") {
  SCOPED_TRACE(joined(call.arguments));
  const ProgramResult result = run_program(call);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  EXPECT_EQ(result.exit_status, status) << result.err;
  EXPECT_EQ(result.out, "");
  expect_one_line(result.err, what, word);
}

// A folder with a small scene, where `render` works until something is spoilt.
class RenderRefuses : public testing::Test {
 protected:
  RenderRefuses() {
    scene_ = folder_.write(
        "scene.gltf", support::patch_gltf({support::wall(2.0F, 3.0F, 0.5F)}, {{"spot", {0.0F, 0.0F, -2.0F}}}).text());
    std::filesystem::create_directory(folder_.path() / "a_folder");
    before_ = folder_.names();
  }

  [[nodiscard]] Words render(const Words& more) const {
    Words words{"render", "--scene", scene_, "--size", "8x8", "--output", output()};
    // An option of the call replaces the one above.
    for (const std::string option : {"--scene", "--size", "--output"}) {
      if (const auto place = std::ranges::find(words, option); std::ranges::find(more, option) != more.end()) {
        words.erase(place, place + 2);
      }
    }
    return words + more;
  }
  [[nodiscard]] std::string output() const { return (folder_.path() / "out.png").string(); }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  void expect(const Words& more, int status, const std::string& what, const std::string& word = "") {
    expect_refused({.arguments = render(more)}, status, what, word);
    EXPECT_EQ(folder_.names(), before_) << joined(more) << " left something behind";
  }

  // A file of the test's own, which must still be there, as it was, afterwards.
  std::string file(const std::string& name, const std::string& text) {
    const std::string made = folder_.write(name, text);
    before_ = folder_.names();
    return made;
  }

  TemporaryFolder folder_;
  std::string scene_;
  std::vector<std::string> before_;
};

TEST_F(RenderRefuses, NothingThatIsRight) {
  const ProgramResult result = run_program({.arguments = render({"--look-at", "spot"})});
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_NE(result.out, "");
  EXPECT_TRUE(std::filesystem::exists(output()));
}

TEST_F(RenderRefuses, Sizes) {
  for (const std::string size : {"0x0", "0x5", "5x0", "100000x100000", "-1x3", "12", "x", "8x", "x8", "8x8x8", "8X8",
                                 "1e1x4", "8.5x8", " 8x8", "99999999999999999999x5"}) {
    expect({"--size", size}, kBadInput, "--size", "WxH");
  }
}

// The largest size the option allows: more than a device may hold, which is no crash.
TEST_F(RenderRefuses, SizesBeyondTheDevice) {
  const ProgramResult result = run_program({.arguments = render({"--size", "16384x16384"})});
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  if (result.exit_status != 0) {
    EXPECT_EQ(result.exit_status, kFailed);
    expect_one_line(result.err, "--device", "16384x16384");
    EXPECT_EQ(folder_.names(), before_);
  }
}

TEST_F(RenderRefuses, NumbersOutOfRange) {
  for (const std::string fov : {"0", "nan", "inf", "-inf", "200", "-60", "1e999"}) {
    expect({"--fov", fov}, kBadInput, "--fov", "from 1 to 170");
  }
  for (const std::string samples : {"0", "-1", "65537"}) {
    expect({"--mode", "dof", "--samples", samples}, kBadInput, "--samples", "from 1 to 65536");
  }
  for (const std::string error : {"0", "nan", "-1", "inf"}) {
    expect({"--mode", "dof", "--target-error", error}, kBadInput, "--target-error", "from 1e-06 to 1");
  }
  for (const std::string exposure : {"nan", "inf", "-33", "1000"}) {
    expect({"--exposure", exposure}, kBadInput, "--exposure", "from -32 to 32");
  }
  for (const std::string threshold : {"-1", "nan", "inf", "-0.001"}) {
    expect({"--threshold", threshold}, kBadInput, "--threshold", "from 0 to 1000");
  }
  for (const std::string repeat : {"0", "-1", "1001"}) {
    expect({"--repeat", repeat}, kBadInput, "--repeat", "from 1 to 1000");
  }
}

TEST_F(RenderRefuses, WhatIsNoNumber) {
  for (const std::string option :
       {"--fov", "--samples", "--target-error", "--exposure", "--threshold", "--repeat", "--seed"}) {
    expect({option, "x"}, kBadInput, option, "'x' is not a");
  }
  for (const std::string option : {"--samples", "--repeat", "--seed"}) {
    expect({option, "99999999999999999999"}, kBadInput, option, "whole number");
    expect({option, "1.5"}, kBadInput, option, "whole number");
  }
  expect({"--seed", "-1"}, kBadInput, "--seed", "whole number");
}

TEST_F(RenderRefuses, Directions) {
  for (const std::string gaze : {"50,0", "0,-46", "45.001,0"}) {
    expect({"--gaze", gaze}, kBadInput, "--gaze", "from -45 to 45");
  }
  for (const std::string gaze : {"nan,0", "0,inf", "a,b", "3", ",", "1,2,3", "1;2", "1, 2", "1,2,"}) {
    expect({"--gaze", gaze}, kBadInput, "--gaze", "YAW,PITCH");
  }
  for (const std::string pose : {"nan,0,0,0,0", "0,inf,0,0,0", "0,0,0,0,nan", "1,2,3,4", "1,2,3,4,5,6", "here"}) {
    expect({"--pose", pose}, kBadInput, "--pose", "X,Y,Z,YAW,PITCH");
  }
  expect({"--pose", "here"}, kBadInput, "--pose", "it has origin");
  expect({"--pose", "1e9,0,0,0,0"}, kBadInput, "--pose", "100000 m");
  expect({"--pose", "0,0,0,400,0"}, kBadInput, "--pose", "deg of yaw");
  expect({"--pose", "0,0,0,0,91"}, kBadInput, "--pose", "deg of pitch");
  expect({"--look-at", "nowhere"}, kBadInput, "--look-at", "it has spot");
  expect({"--look-at", "nowhere", "--gaze", "1,2"}, kBadInput, "--gaze", "together with --look-at");
  expect({"--mode", "dof", "--samples", "4", "--target-error", "0.1"}, kBadInput, "--samples",
         "together with --target-error");
}

TEST_F(RenderRefuses, Ranges) {
  for (const std::string range : {"3,0", "1,1"}) {
    expect({"--mode", "power", "--range", range}, kBadInput, "--range", "LO below HI");
  }
  for (const std::string range : {"nan,1", "0,nan", "0,inf", "1", "a,b", "0,1,2"}) {
    expect({"--mode", "power", "--range", range}, kBadInput, "--range", "LO,HI");
  }
}

TEST_F(RenderRefuses, WordsThatAreNoChoice) {
  const std::vector<std::pair<std::string, std::string>> choices{
      {"--mode", "adof"},        {"--viewing", "scanning"}, {"--eye", "both"},           {"--accuracy", "standard"},
      {"--colormap", "viridis"}, {"--channels", "all"},     {"--output-space", "retina"}};
  for (const auto& [option, allowed] : choices) {
    expect({option, "nonsense"}, kBadInput, option, allowed);
    expect({option, ""}, kBadInput, option, allowed);
  }
  expect({"--channels", "all"}, kBadInput, "--channels", ".exr");
}

// As from an unset variable of a shell: silence would render something that nobody asked for.
TEST_F(RenderRefuses, EmptyValues) {
  for (const std::string option :
       {"--scene",    "--wearer",    "--spectacles", "--compare",      "--headset", "--gaze",   "--look-at",
        "--pose",     "--fov",       "--size",       "--output",       "--range",   "--device", "--timings",
        "--exposure", "--threshold", "--samples",    "--target-error", "--repeat",  "--seed"}) {
    expect({option, ""}, kBadInput, option, "is empty");
  }
}

TEST_F(RenderRefuses, OptionsThatAreNone) {
  expect({"--nonsense"}, kBadInput, "--nonsense", "not an option of vergence render");
  expect({"-x"}, kBadInput, "-x", "not an option of vergence render");
  expect({"--nonsense=3"}, kBadInput, "--nonsense=3", "not an option");
  expect({"extra"}, kBadInput, "extra", "takes options only");
  expect({"trace"}, kBadInput, "trace", "takes options only");
  expect({"--fov"}, kBadInput, "--fov", "missing");
  expect({"--fov="}, kBadInput, "--fov", "missing");
  expect({"--fov", "30", "--fov", "40"}, kBadInput, "--fov", "1 required but received 2");
}

// A terminal folds longer lines anywhere; what an option may be is listed in lines of its own.
TEST(Help, HasNoEndlessLines) {
  constexpr std::size_t kLongest = 132;
  for (const Words& command : {Words{"render"},
                               {"bench"},
                               {"vr"},
                               {"tradeoff"},
                               {"trace"},
                               {"measure"},
                               {"lens", "check"},
                               {"lens", "from-prescription"},
                               {"lens", "progressive"}}) {
    Words words = command;
    words.push_back("--help");
    const ProgramResult result = run_program({.arguments = words});
    EXPECT_EQ(result.exit_status, 0);
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(line.size(), kLongest) << command.front() << ": " << line;
  }
  const ProgramResult refused = run_program({.arguments = {"render", "--accuracy", "no rung"}});
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_NE(refused.err.find("foveated-10-2"), std::string::npos) << "what is allowed: " << refused.err;
}

TEST_F(RenderRefuses, PlacesThatCannotBeWritten) {
  for (const std::string name : {"out.jpg", "out", "out.PNG", ".png", "out.png.txt"}) {
    expect({"--output", path(name)}, kBadInput, "--output", ".png or .exr");
  }
  std::filesystem::create_directory(folder_.path() / "folder.png");
  before_ = folder_.names();
  expect({"--output", path("missing/out.png")}, kFailed, path("missing/out.png"), "no folder");
  expect({"--output", path("scene.gltf/out.png")}, kFailed, path("scene.gltf/out.png"), "no folder");
  expect({"--output", path("folder.png")}, kFailed, path("folder.png"), "cannot be written");
  expect({"--output", "/proc/out.png"}, kFailed, "/proc/out.png", "cannot be written");
  expect({"--output", "/proc/out.exr"}, kFailed, "/proc/out.exr", "cannot be written");
  expect({"--timings", path("missing/t.csv")}, kFailed, path("missing/t.csv"), "no folder");
  expect({"--timings", path("a_folder")}, kFailed, path("a_folder"), "cannot be written");
  // Not the picture, and not the table, of a run whose table turns out to be somebody else's file.
  expect({"--timings", scene_}, kBadInput, scene_, "not a timing table");
}

// The file that was there before is still the old one.
TEST_F(RenderRefuses, KeepsTheOldPicture) {
  file("out.png", "an older picture");
  expect({"--fov", "0"}, kBadInput, "--fov");
  expect({"--device", "nonsense"}, kFailed, "--device", "nonsense");
  std::ifstream kept(output());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), "an older picture");
}

TEST_F(RenderRefuses, FilesThatAreNoJson) {
  std::string bytes;
  for (int i = 0; i < 2560; ++i) {
    bytes += static_cast<char>(i * 7);
  }
  const std::vector<std::pair<std::string, std::string>> files{
      {file("empty.json", ""), ""},
      {file("blank.json", " \n"), ""},
      {file("cut.json", "{\"version\": 1, \"name\": \"ha"), ""},
      {file("bytes.json", bytes), ""},
      {file("array.json", "[1, 2]"), "object"},
      {file("word.json", "\"spectacles\""), "object"},
      {file("nan.json", "{\"version\": NaN}"), ""},
      {file("deep.json", std::string(300000, '[')), "64"},
      {file("twice.json", "{\"version\": 1} {}"), ""},
      {path("missing.json"), "cannot be read"},
      {path("a_folder"), "cannot be read"},
      {"/dev/null", ""}};
  for (const std::string option : {"--scene", "--wearer", "--spectacles", "--compare", "--headset"}) {
    for (const auto& [name, word] : files) {
      expect({option, name}, kBadInput, name, word);
    }
  }
}

TEST_F(RenderRefuses, FilesOfAnotherKind) {
  const std::string wearer = VERGENCE_ASSETS "/wearers/presbyopia.json";
  const std::string spectacles = VERGENCE_ASSETS "/spectacles/myopia.json";
  expect({"--spectacles", wearer}, kBadInput, wearer, "allowed");
  expect({"--wearer", spectacles}, kBadInput, spectacles);
  expect({"--headset", wearer}, kBadInput, wearer);
  expect({"--scene", spectacles}, kBadInput, spectacles);
  expect({"--wearer", scene_}, kBadInput, scene_);
  const std::string newer = file("newer.json", R"({"version": 2})");
  for (const std::string option : {"--wearer", "--spectacles", "--headset"}) {
    expect({option, newer}, kBadInput, newer + ": version", "2");
  }
}

// Spoils one field of a good file and expects its dotted path in the message.
struct Damage {
  std::string pointer;  // where (JSON pointer)
  std::string value;    // JSON text; empty: the field is taken away
  std::string field;    // as the message names it
};

json good_file(const std::string& name) {
  std::ifstream in(VERGENCE_ASSETS "/" + name);
  return json::parse(in);
}

std::string spoil(json good, const Damage& damage) {
  const json::json_pointer at(damage.pointer);
  if (damage.value.empty()) {
    good.at(at.parent_pointer()).erase(at.back());
  } else {
    good[at] = json::parse(damage.value);
  }
  return good.dump();
}

TEST_F(RenderRefuses, SpectaclesWithABadField) {
  const std::vector<Damage> damages{
      {"/right", "", "right"},
      {"/left", "3", "left"},
      {"/colour", "\"red\"", "colour"},
      {"/right/index", "", "right.index"},
      {"/right/index", "0.5", "right.index"},
      {"/right/index", "\"1.5\"", "right.index"},
      {"/left/centre_thickness_mm", "-2", "left.centre_thickness_mm"},
      {"/left/diameter_mm", "0", "left.diameter_mm"},
      {"/right/front/type", "\"cube\"", "right.front.type"},
      {"/right/front/type", "", "right.front.type"},
      {"/right/front/radius_mm", "0", "right.front.radius_mm"},
      {"/right/front/radius_mm", "\"flat\"", "right.front.radius_mm"},
      {"/right/fit/vertex_distance_mm", "1e6", "right.fit.vertex_distance_mm"},
      {"/right/fit/decentration_mm", "[1]", "right.fit.decentration_mm"},
      {"/right/attached_to", "\"wall\"", "right.attached_to"},
  };
  for (const Damage& damage : damages) {
    const std::string name = file("spoilt.json", spoil(good_file("spectacles/myopia.json"), damage));
    expect({"--spectacles", name}, kBadInput, name + ": " + damage.field);
    expect({"--compare", name}, kBadInput, name + ": " + damage.field);
  }
}

TEST_F(RenderRefuses, SplinesThatCannotBe) {
  const json good = good_file("spectacles/presbyopia_bspline_sphere.json");
  const std::vector<Damage> damages{
      {"/right/front/knots_x_mm", "[0, 1, 2]", "right.front.knots_x_mm"},
      {"/right/front/knots_x_mm/7", "-500", "right.front.knots_x_mm"},
      {"/right/front/knots_y_mm/3", "null", "right.front.knots_y_mm"},
      {"/right/front/control_z_mm", "[]", "right.front.control_z_mm"},
      {"/right/front/control_z_mm/3", "[1, 2]", "right.front.control_z_mm"},
      {"/right/front/control_z_mm/3/4", "\"deep\"", "right.front.control_z_mm"},
  };
  for (const Damage& damage : damages) {
    const std::string name = file("spoilt.json", spoil(good, damage));
    expect({"--spectacles", name}, kBadInput, name + ": " + damage.field);
  }
}

TEST_F(RenderRefuses, WearersAndHeadsetsWithABadField) {
  const std::vector<Damage> wearers{
      {"/age", "-1", "age"},
      {"/age", "\"old\"", "age"},
      {"/pupillary_distance_mm", "[31.5]", "pupillary_distance_mm"},
      {"/pupillary_distance_mm", "[0, 0]", "pupillary_distance_mm"},
      {"/right", "[]", "right"},
      {"/right/axial_length_mm", "0", "right.axial_length_mm"},
      {"/left/pupil_diameter_mm", "-3", "left.pupil_diameter_mm"},
      {"/left/refraction", "{\"sphere\": 900}", "left.refraction.sphere"},
      {"/left/refraction", "{\"sphere\": 1, \"cylinder\": -1}", "left.refraction.axis"},
      {"/hair", "\"grey\"", "hair"},
  };
  for (const Damage& damage : wearers) {
    const std::string name = file("spoilt.json", spoil(good_file("wearers/presbyopia.json"), damage));
    expect({"--wearer", name}, kBadInput, name + ": " + damage.field);
  }
  const std::vector<Damage> headsets{
      {"/focal_distance_m", "0", "focal_distance_m"},        {"/focal_distance_m", "null", "focal_distance_m"},
      {"/pixels_per_degree", "\"22\"", "pixels_per_degree"}, {"/luminance_cd_m2", "-1", "luminance_cd_m2"},
      {"/view_origin", "\"nose\"", "view_origin"},           {"/brand", "\"x\"", "brand"},
  };
  for (const Damage& damage : headsets) {
    const std::string name = file("spoilt.json", spoil(good_file("headsets/example.json"), damage));
    expect({"--headset", name}, kBadInput, name + ": " + damage.field);
  }
}

TEST_F(RenderRefuses, ScenesWithDamage) {
  const json good = json::parse(support::patch_gltf({support::wall(2.0F, 3.0F, 0.5F)}).text());
  const std::vector<Damage> damages{
      {"/accessors/0/count", "400000", "meshes[0].primitives[0].attributes.POSITION"},
      {"/accessors/0/bufferView", "7", "accessors[0]"},
      {"/meshes/0/primitives/0/indices", "9", "meshes[0].primitives[0].indices"},
      {"/meshes/0/primitives/0/material", "-5", "meshes[0].primitives[0].material"},
      {"/nodes/0/mesh", "3", "nodes[0].mesh"},
      {"/nodes/0/children", "[0]", "nodes[0]"},
      {"/buffers/0/byteLength", "5", ""},
      {"/buffers/0/uri", "\"missing.bin\"", ""},
      {"/materials/0/emissiveFactor", "[1, 2, 3]", "materials[0].emissiveFactor"},
      {"/asset", "", ""},
  };
  for (const Damage& damage : damages) {
    const std::string name = file("spoilt.gltf", spoil(good, damage));
    expect({"--scene", name}, kBadInput, name, damage.field);
  }
  const auto whole = support::patch_gltf({support::wall(2.0F, 3.0F, 0.5F)}).glb();
  const std::string glb(whole.begin(), whole.end());
  for (const std::size_t length : {3U, 11U, 20U, 60U, static_cast<unsigned>(glb.size() - 8)}) {
    const std::string name = file("cut.glb", glb.substr(0, length));
    expect({"--scene", name}, kBadInput, name);
  }
}

TEST_F(RenderRefuses, MachinesWithoutAGpu) {
  for (const std::string mode : {"adof", "dof", "power"}) {
    expect_refused({.arguments = render({"--mode", mode}), .environment = kNoGpu}, kFailed, "--device", "Vulkan");
    EXPECT_EQ(folder_.names(), before_);
  }
  for (const std::string device : {"nonsense", "99", "-1"}) {
    expect({"--device", device}, kFailed, "--device", "no device '" + device + "'");
  }
}

TEST_F(RenderRefuses, AStandardOutputThatTakesNothing) {
  expect_refused({.arguments = render({}), .standard_output = "/dev/full"}, kFailed, "standard output",
                 "cannot be written");
  expect_refused({.arguments = render({"--json"}), .standard_output = "/dev/full"}, kFailed, "standard output");
  // What is there is the whole picture, and no temporary file.
  Words left = before_;
  left.emplace_back("out.png");
  std::ranges::sort(left);
  EXPECT_EQ(folder_.names(), left);
}

// Bytes in a file's name that are no text must not break the report about it.
TEST_F(RenderRefuses, NoNameOfAFile) {
  expect({"--wearer", path("two\nlines.json")}, kBadInput, path("two lines.json"), "cannot be read");
  const ProgramResult result = run_program({.arguments = render({"--json", "--output", path("\xff\xfe.png")})});
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_TRUE(json::accept(result.out));
}

TEST(Program, RefusesWhatIsNoCommand) {
  expect_refused({.arguments = {}}, kBadInput, "COMMAND", "missing");
  expect_refused({.arguments = {"paint"}}, kBadInput, "paint", "not a command");
  expect_refused({.arguments = {""}}, kBadInput, "''", "not a command");
  expect_refused({.arguments = {"--nonsense"}}, kBadInput, "--nonsense", "not an option of vergence");
  expect_refused({.arguments = {"--nonsense", "render"}}, kBadInput, "--nonsense", "not an option");
}

TEST(Program, HelpsOnEveryCommand) {
  const ProgramResult main_help = run_program({.arguments = {"--help"}});
  EXPECT_EQ(main_help.exit_status, 0);
  EXPECT_EQ(main_help.err, "");
  EXPECT_NE(main_help.out.find("Example"), std::string::npos);
  std::size_t commands = 0;
  std::istringstream lines(main_help.out.substr(main_help.out.find("Subcommands:")));
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("  ");) {
    const std::string command = line.substr(2, line.find(' ', 2) - 2);
    SCOPED_TRACE(command);
    const ProgramResult help = run_program({.arguments = {command, "--help"}});
    EXPECT_EQ(help.exit_status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find("vergence " + command), std::string::npos) << "no example";
    EXPECT_NE(help.out.find("Example"), std::string::npos);
    ++commands;
  }
  EXPECT_GE(commands, 2U);
}

TEST(Program, SaysItsVersion) {
  const ProgramResult result = run_program({.arguments = {"--version"}});
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(std::regex_match(result.out, std::regex("[0-9]+\\.[0-9]+\\.[0-9]+\n"))) << result.out;
}

TEST(Program, FailsWhenNobodyCanReadItsHelp) {
  for (const Words& words : {Words{"--help"}, Words{"--version"}, Words{"render", "--help"}}) {
    expect_refused({.arguments = words, .standard_output = "/dev/full"}, kFailed, "standard output");
  }
}

}  // namespace
