#include "render/lens_forms/corner_grid.hpp"

#include <iterator>
#include <span>

namespace render {
namespace {

template <class T>
void append(std::vector<std::byte>& key, const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  key.insert(key.end(), bytes.begin(), bytes.end());
}

}  // namespace

CornerGrid corner_grid(const LensAccuracy& lens, int width, int height) {
  if (lens.form == LensForm::field) {
    const int side = lens.field_side;
    return {glm::dvec2(width, height) / static_cast<double>(side - 1), {side, side}};
  }
  if (lens.form == LensForm::exact && lens.spacing > 1) {
    const int s = lens.spacing;
    return {glm::dvec2(s), {(width + s - 1) / s + 1, (height + s - 1) / s + 1}};
  }
  return {};
}

CornerGrid tile_corner_grid(int width, int height) {
  const auto along = [](int pixels) { return 3 * ((pixels + 7) / 8) + 1; };
  return {glm::dvec2(8.0 / 3.0), {along(width), along(height)}};
}

std::vector<std::byte> corner_key(const LensAccuracy& lens, const CornerGrid& grid,
                                  const std::vector<gpu::ViewData>& views, const std::vector<glm::vec4>& table) {
  std::vector<std::byte> key;
  append(key, lens.iterations);
  append(key, grid.spacing);
  append(key, grid.count);
  for (const gpu::ViewData& view : views) {
    // Not where the eye stands in the world, what it accommodates to, or how much light the lens lets through.
    append(key, view.lens);
    append(key, view.eye.pupil.y);
    for (const glm::vec4& part :
         {view.picture_x, view.picture_y, view.picture_z, view.tangents, view.gaze, view.virtual_image}) {
      append(key, part);
    }
  }
  const auto bytes = std::as_bytes(std::span(table));
  key.insert(key.end(), bytes.begin(), bytes.end());
  return key;
}

}  // namespace render
