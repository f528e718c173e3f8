#include "render/image/image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace render {
namespace {

std::size_t pixels_of(int width, int height) {
  if (width <= 0 || height <= 0) throw std::invalid_argument("an image has at least one pixel each way");
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace

Image8 black_image(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(3 * pixels_of(width, height))};
}

void check_image(const Image8& image) {
  if (image.rgb.size() != 3 * pixels_of(image.width, image.height)) {
    throw std::invalid_argument("an 8-bit image needs 3 values a pixel");
  }
}

void check_image(const FloatImage& image) {
  const std::size_t pixels = pixels_of(image.width, image.height);
  if (image.channels.size() != image.planes.size() || image.channels.empty()) {
    throw std::invalid_argument("an image needs a name for each plane and at least one");
  }
  for (const auto& plane : image.planes) {
    if (plane.size() != pixels) throw std::invalid_argument("a plane needs one value a pixel");
  }
}

Comparison compare(const Image8& image, const Image8& reference) {
  check_image(image);
  check_image(reference);
  if (image.width != reference.width || image.height != reference.height) {
    throw std::invalid_argument("only images of one size can be compared");
  }
  double squares = 0.0;
  int largest = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const int difference = int{image.rgb[i]} - int{reference.rgb[i]};
    squares += double(difference) * difference;
    largest = std::max(largest, std::abs(difference));
  }
  Comparison result;
  result.rmse = std::sqrt(squares / static_cast<double>(image.rgb.size())) / 255.0;
  result.max_abs = largest / 255.0;
  result.psnr_db = -20.0 * std::log10(result.rmse);
  return result;
}

}  // namespace render
