// Pictures to files and back, the transfer function, the comparison, and what is drawn into pictures.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "render/image/colour_bar.hpp"
#include "render/image/exr.hpp"
#include "render/image/output_error.hpp"
#include "render/image/output_file.hpp"
#include "render/image/png.hpp"
#include "render/image/srgb.hpp"
#include "tracking/input_error.hpp"

namespace render {
namespace {

class ImageFiles : public testing::Test {
 protected:
  ImageFiles() { std::filesystem::create_directory(folder); }
  ~ImageFiles() override { std::filesystem::remove_all(folder); }

  [[nodiscard]] std::ptrdiff_t files() const { return std::distance(std::filesystem::directory_iterator(folder), {}); }

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("vergence-images-" + std::to_string(::getpid()));
};

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Image8 noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image8 image = black_image(width, height);
  for (auto& value : image.rgb) value = static_cast<std::uint8_t>(random() & 0xffU);
  return image;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

struct Chunk {
  std::string type, data;
  std::uint32_t crc;
};

std::vector<Chunk> chunks_of(const std::string& png) {
  std::vector<Chunk> chunks;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t length = big_endian(png, at);
    chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, length), big_endian(png, at + 8 + length)});
    at += length + 12;
  }
  return chunks;
}

TEST(Srgb, KnownValues) {
  EXPECT_EQ(srgb_encode(0.5F), 188);
  EXPECT_EQ(srgb_encode(0.0F), 0);
  EXPECT_EQ(srgb_encode(1.0F), 255);
  EXPECT_EQ(srgb_encode(-1.0F), 0);
  EXPECT_EQ(srgb_encode(1e9F), 255);
  EXPECT_EQ(srgb_encode(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(srgb_encode(0.002F), 7);  // 12.92 * 0.002 * 255 = 6.59, on the straight part
}

TEST(Srgb, DecodingIsTheInverse) {
  for (int value = 0; value <= 255; ++value) {
    EXPECT_EQ(srgb_encode(srgb_decode(static_cast<std::uint8_t>(value))), value);
  }
}

TEST_F(ImageFiles, PngComesBackAsItWas) {
  const Image8 image = noise(37, 23, 1);
  write_png(folder / "a.png", image);
  const Image8 back = read_png(folder / "a.png");
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 23);
  EXPECT_EQ(back.rgb, image.rgb);
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFiles, PngIsMarkedAsSrgbOnce) {
  write_png(folder / "a.png", noise(64, 64, 2));
  const auto chunks = chunks_of(contents(folder / "a.png"));
  std::size_t marks = 0, mark = 0, data = 0;
  for (std::size_t i = chunks.size(); i-- > 0;) {
    if (chunks[i].type == "sRGB") {
      ++marks;
      mark = i;
    }
    if (chunks[i].type == "IDAT") data = i;
  }
  EXPECT_EQ(chunks.front().type, "IHDR");
  EXPECT_EQ(chunks.back().type, "IEND");
  ASSERT_EQ(marks, 1U);
  EXPECT_LT(mark, data);
  EXPECT_EQ(chunks[mark].data, std::string(1, '\0'));  // perceptual
  // CRC-32 of "sRGB" and a zero byte, as every PNG marked so carries it.
  EXPECT_EQ(chunks[mark].crc, 0xaece1ce9U);
}

TEST_F(ImageFiles, WritingOverAnOldFileReplacesIt) {
  write_png(folder / "a.png", noise(64, 64, 3));
  write_png(folder / "a.png", noise(8, 8, 4));
  EXPECT_EQ(read_png(folder / "a.png").width, 8);
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFiles, PlacesThatCannotBeWrittenAreNamed) {
  const auto missing = folder / "missing" / "a.png";
  try {
    write_png(missing, noise(4, 4, 5));
    FAIL() << "wrote into a folder that is not there";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.file(), missing.string());
    EXPECT_EQ(error.reason(), "cannot be written: No such file or directory");
  }
  EXPECT_THROW(write_exr(folder / "missing" / "a.exr", {1, 1, {"R"}, {{1.0F}}}), OutputError);
  EXPECT_THROW(write_png(folder, noise(4, 4, 5)), OutputError);
  EXPECT_EQ(files(), 0);
}

TEST_F(ImageFiles, AFailedWriteLeavesTheOldFile) {
  write_png(folder / "a.png", noise(8, 8, 6));
  const std::string before = contents(folder / "a.png");
  EXPECT_THROW(replace_file(folder / "a.png",
                            [](const std::filesystem::path& temporary) {
                              std::ofstream(temporary) << "half of it";
                              throw std::runtime_error("the disk is full");
                            }),
               OutputError);
  EXPECT_EQ(contents(folder / "a.png"), before);
  EXPECT_EQ(files(), 1);
}

TEST_F(ImageFiles, FilesThatCannotBeReadAreInputErrors) {
  EXPECT_THROW((void)read_png(folder / "none.png"), tracking::InputError);
  EXPECT_THROW((void)read_exr(folder / "none.exr"), tracking::InputError);
  std::ofstream(folder / "a.png") << "not a picture";
  EXPECT_THROW((void)read_png(folder / "a.png"), tracking::InputError);
  EXPECT_THROW((void)read_exr(folder / "a.png"), tracking::InputError);
}

TEST_F(ImageFiles, WrongSizesAreRefused) {
  EXPECT_THROW(write_png(folder / "a.png", {2, 2, {0, 0, 0}}), std::invalid_argument);
  EXPECT_THROW(write_png(folder / "a.png", {0, 0, {}}), std::invalid_argument);
  EXPECT_THROW(write_exr(folder / "a.exr", {2, 1, {"R"}, {{1.0F}}}), std::invalid_argument);
  EXPECT_THROW(write_exr(folder / "a.exr", {1, 1, {"R", "G"}, {{1.0F}}}), std::invalid_argument);
}

TEST_F(ImageFiles, ExrComesBackWithItsChannels) {
  constexpr int kWidth = 19, kHeight = 7;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-30.0F, 30.0F);
  FloatImage image{kWidth, kHeight, {"R", "G", "B", "depth", "V.hh"}, {}};
  for (std::size_t i = 0; i < image.channels.size(); ++i) {
    auto& plane = image.planes.emplace_back(std::size_t{kWidth * kHeight});
    for (float& value : plane) value = any(random);
  }
  image.planes[0][0] = 1e6F;   // beyond the largest half, 65504
  image.planes[3][0] = -1.0F;  // no scene there
  image.planes[3][1] = 1e6F;
  write_exr(folder / "a.exr", image);
  const FloatImage back = read_exr(folder / "a.exr");
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(back.width, kWidth);
  EXPECT_EQ(back.height, kHeight);
  ASSERT_EQ(back.channels, (std::vector<std::string>{"B", "G", "R", "V.hh", "depth"}));
  EXPECT_EQ(back.planes[4], image.planes[3]);
  EXPECT_EQ(back.planes[3], image.planes[4]);
  EXPECT_EQ(back.planes[2][0], 65504.0F);
  for (std::size_t i = 1; i < back.planes[2].size(); ++i) {
    // A half has 11 bits of precision; the absolute part is for values below its normal range, 6e-5.
    const float bound = std::abs(image.planes[0][i]) / 2048.0F + 6e-8F;
    EXPECT_NEAR(back.planes[2][i], image.planes[0][i], bound);
  }
}

TEST(Compare, KnownDistances) {
  const Image8 black = black_image(10, 10);
  Image8 other = black;
  EXPECT_EQ(compare(black, other).max_abs, 0.0);
  EXPECT_EQ(compare(black, other).psnr_db, std::numeric_limits<double>::infinity());
  for (auto& value : other.rgb) value = 51;  // a fifth of full scale: 20 log10 5 = 13.979 dB
  const Comparison distance = compare(other, black);
  EXPECT_NEAR(distance.rmse, 0.2, 1e-12);
  EXPECT_NEAR(distance.max_abs, 0.2, 1e-12);
  EXPECT_NEAR(distance.psnr_db, 13.9794, 1e-4);
  EXPECT_THROW((void)compare(black, black_image(5, 20)), std::invalid_argument);
}

TEST(RoundTicks, AreRoundAndWithinTheRange) {
  const auto labels = [](double lo, double hi, int at_most) {
    std::vector<std::string> result;
    for (const Tick& tick : round_ticks(lo, hi, at_most)) result.push_back(tick.label);
    return result;
  };
  EXPECT_EQ(labels(0.0, 1.0, 6), (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(labels(-2.3, 3.1, 7), (std::vector<std::string>{"-2", "-1", "0", "1", "2", "3"}));
  EXPECT_EQ(labels(0.0, 0.02, 3), (std::vector<std::string>{"0.00", "0.01", "0.02"}));
  EXPECT_EQ(labels(0.0, 5000.0, 6), (std::vector<std::string>{"0", "1000", "2000", "3000", "4000", "5000"}));
  EXPECT_TRUE(labels(1.0, 1.0, 6).empty());
  EXPECT_TRUE(labels(2.0, 1.0, 6).empty());
  EXPECT_TRUE(labels(0.0, std::numeric_limits<double>::infinity(), 6).empty());
  EXPECT_TRUE(labels(std::numeric_limits<double>::quiet_NaN(), 1.0, 6).empty());
}

TEST(RoundTicks, AreNeverTooMany) {
  const unsigned seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-100.0, 100.0), power(-5.0, 4.0);
  for (int i = 0; i < 2000; ++i) {
    const double lo = place(random), hi = lo + std::pow(10.0, power(random));
    const auto ticks = round_ticks(lo, hi, 8);
    EXPECT_LE(ticks.size(), 8U);
    EXPECT_GE(ticks.size(), 2U) << lo << " " << hi;
    for (const Tick& tick : ticks) {
      EXPECT_GE(tick.value, lo - 1e-8 * (hi - lo));
      EXPECT_LE(tick.value, hi + 1e-8 * (hi - lo));
    }
  }
}

int differing_pixels(const Image8& a, const Image8& b, const Rect& where) {
  int count = 0;
  for (int y = where.y; y < where.y + where.height; ++y) {
    for (int x = where.x; x < where.x + where.width; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * a.width + x));
      count += std::memcmp(&a.rgb[at], &b.rgb[at], 3) != 0 ? 1 : 0;
    }
  }
  return count;
}

TEST(Draw, StaysInsideThePicture) {
  Image8 image = black_image(20, 10);
  fill_rect(image, {-5, -5, 10, 100}, {255, 0, 0});
  draw_text(image, -3, 5, 3, "cut \xc2\xb0 off\nM", {255, 255, 255});
  draw_hline(image, -5, 9, 100, 1, {0, 255, 0});
  draw_vline(image, 19, -5, 100, 1, {0, 0, 255});
  draw_text(image, 1000, 1000, 1, "", {255, 255, 255});
  EXPECT_EQ(image.rgb.size(), 600U);
  EXPECT_EQ(image.rgb[0], 255);
}

TEST(Draw, TextHasTheWidthItSays) {
  Image8 image = black_image(400, 40);
  const Image8 before = image;
  draw_text(image, 10, 10, 2, "Power 1.25 D", {255, 255, 255});
  const int width = text_width("Power 1.25 D", 2);
  EXPECT_GT(differing_pixels(image, before, {10, 10, width, 2 * 10}), 200);
  EXPECT_EQ(differing_pixels(image, before, {10 + width, 0, 390 - width, 40}), 0);
  EXPECT_EQ(differing_pixels(image, before, {0, 0, 10, 40}), 0);
}

TEST(ColourBar, ShowsTheMapItsLabelsAndTitle) {
  for (const int height : {160, 512, 1024}) {
    Image8 image = black_image(height, height);
    for (auto& value : image.rgb) value = 120;
    const Image8 before = image;
    const Rect where = colour_bar_place(image);
    draw_colour_bar(image, where, 1, -2.0, 3.0, "D", "Astigmatism");
    // The ground covers the place and nothing else.
    EXPECT_EQ(differing_pixels(image, before, where), where.width * where.height);
    EXPECT_EQ(differing_pixels(image, before, {0, 0, where.x, height}), 0);

    // Another range changes the labels only, another title the title only.
    Image8 other_range = before, other_title = before;
    draw_colour_bar(other_range, where, 1, 10.0, 70.0, "D", "Astigmatism");
    draw_colour_bar(other_title, where, 1, -2.0, 3.0, "D", "Accommodating");
    const int scale = std::max(1, height / 480);
    const Rect right_half{where.x + 21 * scale, where.y, where.width - 21 * scale, where.height};
    EXPECT_GT(differing_pixels(image, other_range, right_half), 20 * scale * scale);
    EXPECT_EQ(differing_pixels(image, other_range, {where.x, where.y, 21 * scale, where.height}), 0);
    EXPECT_GT(differing_pixels(image, other_title, {where.x, where.y, where.width, 24 * scale}), 20 * scale * scale);
  }
}

TEST(ColourBar, IsLeftOutOfLowPictures) {
  Image8 image = black_image(400, 159);
  const Image8 before = image;
  draw_colour_bar(image, colour_bar_place(image), 0, 0.0, 1.0, "D", "Power");
  EXPECT_EQ(image.rgb, before.rgb);
}

}  // namespace
}  // namespace render
