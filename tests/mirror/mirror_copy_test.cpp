// The small copy of what the eyes are shown holds the picture's own bytes, each eye's in its place.
#include "render/mirror_copy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <thread>

namespace render {
namespace {

constexpr int kWidth = 24, kHeight = 10, kGuard = 3;  // of an eye's picture, and pixels around it that nobody sees
constexpr std::uint32_t kOpaque = 0xff000000U;

std::uint32_t colour(int red, int green, int blue) {
  return kOpaque | static_cast<std::uint32_t>(red | (green << 8) | (blue << 16));
}

// Two eyes one after the other in a buffer, as running pictures lie there.
class TwoEyes {
 public:
  template <class F>
  TwoEyes(const vk::Device& device, F&& pixel) : buffer_(device, 8 * kRow * kRows, vk::Memory::upload) {
    std::vector<std::uint32_t> words;
    for (int eye = 0; eye < 2; ++eye) {
      for (int y = -kGuard; y < kHeight + kGuard; ++y) {
        for (int x = -kGuard; x < kWidth + kGuard; ++x) {
          const bool seen = x >= 0 && y >= 0 && x < kWidth && y < kHeight;
          words.push_back(seen ? pixel(eye, x, y) : colour(255, 0, 255));
        }
      }
    }
    buffer_.write(words);
  }

  [[nodiscard]] vk::PixelBlock columns(int eye, int from, int to) const {
    return {.from = &buffer_,
            .offset = 4 * static_cast<std::size_t>((eye * kRows + kGuard) * kRow + kGuard + from),
            .row_pixels = kRow,
            .x = from,
            .width = to - from,
            .height = kHeight};
  }
  [[nodiscard]] ShownPictures shown() const {
    return {.eyes = {{columns(0, 0, kWidth)}, {columns(1, 0, kWidth)}}, .width = kWidth, .height = kHeight};
  }

 private:
  static constexpr int kRow = kWidth + 2 * kGuard, kRows = kHeight + 2 * kGuard;
  vk::Buffer buffer_;
};

class MirrorCopyOnDevice : public testing::Test {
 protected:
  MirrorPicture copied(const ShownPictures& shown, const std::array<int, 2>& size) {
    copy.start(shown, size);
    MirrorPicture picture;
    while (!copy.take(picture)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(picture.width, size[0]);
    EXPECT_EQ(picture.height, size[1]);
    return picture;
  }
  void TearDown() override {
    for (const std::string& message : device.validation_messages()) {
      ADD_FAILURE() << message;
    }
  }

  vk::Device device{vk::DeviceConfig{.validation = true}};
  MirrorCopy copy{device};
};

TEST_F(MirrorCopyOnDevice, HoldsTheSameBytesAtTheSameSize) {
  const auto pixel = [](int eye, int x, int y) { return colour(10 * x, 20 * y, 100 * eye + 55); };
  const TwoEyes eyes(device, pixel);
  const MirrorPicture picture = copied(eyes.shown(), {2 * kWidth, kHeight});
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < 2 * kWidth; ++x) {
      ASSERT_EQ(picture.pixels[static_cast<std::size_t>(y * 2 * kWidth + x)], pixel(x / kWidth, x % kWidth, y))
          << x << ',' << y;
    }
  }
}

// Whatever the size, no pixel of one eye is in the other's half, none of the guard band in either, and none is left
// out.
TEST_F(MirrorCopyOnDevice, KeepsFlatColoursAtEverySize) {
  const TwoEyes eyes(device, [](int eye, int, int) { return eye == 0 ? colour(0, 188, 0) : colour(188, 0, 1); });
  for (int width = 1; width <= kWidth; ++width) {
    for (const int height : {1, 3, 7, kHeight}) {
      const MirrorPicture picture = copied(eyes.shown(), {2 * width, height});
      for (int i = 0; i < 2 * width * height; ++i) {
        ASSERT_EQ(picture.pixels[static_cast<std::size_t>(i)],
                  i % (2 * width) < width ? colour(0, 188, 0) : colour(188, 0, 1))
            << "pixel " << i << " of " << 2 * width << 'x' << height;
      }
    }
  }
}

TEST_F(MirrorCopyOnDevice, AveragesWhatAPixelStandsFor) {
  const TwoEyes eyes(device, [](int, int x, int y) { return colour(100 * (x % 2), 40 * (y % 2), 7 * (x / 2)); });
  const MirrorPicture picture = copied(eyes.shown(), {kWidth, kHeight / 2});
  for (int y = 0; y < kHeight / 2; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(picture.pixels[static_cast<std::size_t>(y * kWidth + x)], colour(50, 20, 7 * (x % (kWidth / 2))));
    }
  }
}

// As with two pairs: columns of one view, columns of another, and something of its own between them.
TEST_F(MirrorCopyOnDevice, PutsBlocksTogether) {
  const TwoEyes a(device, [](int, int x, int) { return colour(x, 1, 0); });
  const TwoEyes b(device, [](int, int x, int) { return colour(x, 2, 0); });
  ShownPictures shown{.eyes = {{a.columns(0, 0, 11), b.columns(0, 13, kWidth), a.columns(1, 11, 13)}},
                      .width = kWidth,
                      .height = kHeight,
                      .blue_first = true};
  const MirrorPicture picture = copied(shown, {kWidth, kHeight});
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const int x = i % kWidth;
    ASSERT_EQ(picture.pixels[static_cast<std::size_t>(i)], colour(0, x < 13 ? 1 : 2, x)) << i;
  }
}

TEST(MirrorCopySize, FitsTheRoomAndIsNeverEnlarged) {
  const ShownPictures shown{.eyes = {{}, {}}, .width = 100, .height = 80};
  EXPECT_EQ(MirrorCopy::size_in(shown, {4000, 4000}), (std::array{200, 80}));
  EXPECT_EQ(MirrorCopy::size_in(shown, {100, 4000}), (std::array{100, 40}));
  EXPECT_EQ(MirrorCopy::size_in(shown, {4000, 8}), (std::array{20, 8}));
  EXPECT_EQ(MirrorCopy::size_in(shown, {101, 1000}), (std::array{100, 40})) << "each eye the same";
  EXPECT_EQ(MirrorCopy::size_in(shown, {0, 0}), (std::array{0, 0}));
  EXPECT_EQ(MirrorCopy::size_in(shown, {1, 50}), (std::array{0, 0}));
}

}  // namespace
}  // namespace render
