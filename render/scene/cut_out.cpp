#include "render/scene/cut_out.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>

namespace render {
namespace {

int wrapped(int i, int n, Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::clamp) return std::clamp(i, 0, n - 1);
  const int period = wrap == Texture::Wrap::mirror ? 2 * n : n;
  const int j = ((i % period) + period) % period;
  return j < n ? j : period - 1 - j;
}

}  // namespace

float CutOuts::Plane::sample(const glm::vec2& uv) const {
  const glm::vec2 p = uv * glm::vec2(width, height) - 0.5F;
  const glm::vec2 corner = glm::floor(p), w = p - corner;
  // Absurd coordinates must still fit an int, and their neighbour too.
  const glm::ivec2 low(glm::clamp(corner, glm::vec2(-1e8F), glm::vec2(1e8F)));
  const auto at = [&](int x, int y) {
    const auto row = static_cast<std::size_t>(wrapped(y, height, wrap_v)) * static_cast<std::size_t>(width);
    return static_cast<float>(alpha[row + static_cast<std::size_t>(wrapped(x, width, wrap_u))]) / 255.0F;
  };
  const float top = glm::mix(at(low.x, low.y), at(low.x + 1, low.y), w.x);
  const float bottom = glm::mix(at(low.x, low.y + 1), at(low.x + 1, low.y + 1), w.x);
  return glm::mix(top, bottom, w.y);
}

CutOuts::CutOuts(const Scene& scene, const std::vector<std::uint32_t>& triangles) {
  std::map<std::int32_t, std::int32_t> planes;  // of textures
  const auto plane_of = [&](std::int32_t index) {
    if (index < 0) return -1;
    const auto [found, is_new] = planes.try_emplace(index, static_cast<std::int32_t>(planes_.size()));
    if (is_new) {
      const Texture& t = scene.textures.at(static_cast<std::size_t>(index));
      Plane plane{static_cast<int>(t.width), static_cast<int>(t.height), t.wrap_u, t.wrap_v, {}};
      for (std::size_t i = 3; i < t.rgba.size(); i += 4) plane.alpha.push_back(t.rgba[i]);
      planes_.push_back(std::move(plane));
    }
    return found->second;
  };
  for (const std::uint32_t index : triangles) {
    const Material& material = scene.materials.at(scene.triangle_material[index]);
    const TextureUse& use = material.base_colour_texture;
    Triangle triangle{{}, plane_of(use.index), material.alpha_cutoff};
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t vertex = scene.triangles[index][i];
      const glm::vec2 uv =
          use.second_uv != 0 && vertex < scene.second_uvs.size() ? scene.second_uvs[vertex] : scene.vertices[vertex].uv;
      triangle.corners[static_cast<std::size_t>(i)] = {
          use.linear * uv + use.offset,
          material.base_colour.a * (vertex < scene.colours.size() ? scene.colours[vertex].a : 1.0F)};
    }
    triangles_.push_back(triangle);
  }
}

bool CutOuts::is_hole(std::uint32_t place, float u, float v) const {
  const Triangle& t = triangles_[place];
  const float w = 1.0F - u - v;
  float alpha = w * t.corners[0].alpha + u * t.corners[1].alpha + v * t.corners[2].alpha;
  if (t.plane >= 0) {
    const glm::vec2 uv = w * t.corners[0].uv + u * t.corners[1].uv + v * t.corners[2].uv;
    alpha *= planes_[static_cast<std::size_t>(t.plane)].sample(uv);
  }
  // A hole also where alpha is no number.
  return !(alpha >= t.cutoff);
}

}  // namespace render
