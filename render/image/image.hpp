// Pictures in memory, and the distance between two of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace render {

// Display-encoded sRGB, 3 bytes a pixel, top row first.
struct Image8 {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb = {};
};

// Linear values in named planes of width * height, top row first. R, G and B have the primaries of sRGB.
struct FloatImage {
  int width = 0, height = 0;
  std::vector<std::string> channels = {};
  std::vector<std::vector<float>> planes = {};
};

// Of the encoded values as fractions of full scale.
struct Comparison {
  double psnr_db = 0.0;  // infinite for equal images
  double rmse = 0.0;
  double max_abs = 0.0;
};

[[nodiscard]] Image8 black_image(int width, int height);

// Throw std::invalid_argument unless the sizes are positive and the values as many as they say.
void check_image(const Image8& image);
void check_image(const FloatImage& image);

// Images of one size; anything else throws std::invalid_argument.
[[nodiscard]] Comparison compare(const Image8& image, const Image8& reference);

}  // namespace render
