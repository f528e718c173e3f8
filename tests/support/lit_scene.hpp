// Scenes made of a few squares and spheres, and one eye at the origin that looks at them along -z.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "render/renderer.hpp"
#include "render/scene/scene.hpp"
#include "tests/support/worn_views.hpp"

namespace support {

// Black all around: what is seen is what the test put there.
inline render::Scene dark_scene() {
  render::Scene scene;
  scene.source = "test";
  scene.environment = {glm::vec3(0), glm::vec3(0), glm::vec3(0)};
  return scene;
}

inline std::uint32_t add_material(render::Scene& scene, const render::Material& material) {
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

inline render::Material matte(const glm::vec3& colour) {
  render::Material material;
  material.base_colour = glm::vec4(colour, 1.0F);
  material.metallic = 0.0F;
  material.double_sided = true;
  return material;
}

inline render::Material unlit(const glm::vec4& colour) {
  render::Material material = matte(glm::vec3(colour));
  material.base_colour = colour;
  material.unlit = true;
  return material;
}

// Texture coordinates as on a picture hung there: u along side, v down.
inline void add_square(render::Scene& scene, std::uint32_t material, const glm::vec3& corner, const glm::vec3& side,
                       const glm::vec3& up) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec3 normal = glm::normalize(glm::cross(side, up));
  scene.vertices.push_back({corner, normal, {0, 1}});
  scene.vertices.push_back({corner + side, normal, {1, 1}});
  scene.vertices.push_back({corner + side + up, normal, {1, 0}});
  scene.vertices.push_back({corner + up, normal, {0, 0}});
  scene.triangles.emplace_back(first, first + 1, first + 2);
  scene.triangles.emplace_back(first, first + 2, first + 3);
  scene.triangle_material.insert(scene.triangle_material.end(), 2, material);
}

// Facing the eye, centred on (x, y).
inline void add_wall(render::Scene& scene, std::uint32_t material, float x, float y, float distance, float half) {
  add_square(scene, material, {x - half, y - half, -distance}, {2 * half, 0, 0}, {0, 2 * half, 0});
}

inline void add_ball(render::Scene& scene, std::uint32_t material, const glm::vec3& centre, float radius, int rings) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const int sectors = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j <= sectors; ++j) {
      const double a = 3.14159265358979 * i / rings, b = 2 * 3.14159265358979 * j / sectors;
      const glm::vec3 n(std::sin(a) * std::sin(b), std::cos(a), std::sin(a) * std::cos(b));
      scene.vertices.push_back({centre + radius * n, n, {static_cast<float>(j), static_cast<float>(i)}});
    }
  }
  const auto at = [&](int i, int j) { return first + static_cast<std::uint32_t>(i * (sectors + 1) + j); };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      scene.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      scene.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      scene.triangle_material.insert(scene.triangle_material.end(), 2, material);
    }
  }
}

inline void add_sun(render::Scene& scene, const glm::vec3& direction, float irradiance) {
  render::Light light;
  light.type = render::Light::Type::directional;
  light.direction = glm::normalize(direction);
  light.colour = glm::vec3(irradiance);
  scene.lights.push_back(light);
}

// texel(x, y) gives r, g, b, a.
template <class Texel>
std::int32_t add_texture(render::Scene& scene, std::uint32_t width, std::uint32_t height, Texel&& texel) {
  render::Texture texture;
  texture.width = width;
  texture.height = height;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const glm::uvec4 t = texel(x, y);
      for (int i = 0; i < 4; ++i) texture.rgba.push_back(static_cast<std::uint8_t>(t[i]));
    }
  }
  scene.textures.push_back(std::move(texture));
  return static_cast<std::int32_t>(scene.textures.size() - 1);
}

struct Look {
  int width = 64, height = 64;
  double half_tangent = 0.25;  // of the half field of view, both ways
  render::Mode mode = render::Mode::pinhole;
  const lenses::Spectacles* spectacles = nullptr;
  bool bare = false;  // one ray a pixel, whatever the edges
};

struct Seen {
  WornPair pair;
  render::ViewSetup setup;
  render::RenderedView view;
  Look look;

  [[nodiscard]] glm::vec3 at(int x, int y) const {
    const auto i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(look.width) + static_cast<std::size_t>(x));
    return {view.radiance[i], view.radiance[i + 1], view.radiance[i + 2]};
  }
  [[nodiscard]] float depth(int x, int y) const {
    return view.wavefront
        .depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(look.width) + static_cast<std::size_t>(x)];
  }
  // The pixel in which a point straight ahead of the bare eye lies.
  [[nodiscard]] glm::ivec2 pixel_of(const glm::vec3& p) const {
    const double x = p.x / -p.z / look.half_tangent, y = p.y / -p.z / look.half_tangent;
    return {static_cast<int>((0.5 + 0.5 * x) * look.width), static_cast<int>((0.5 - 0.5 * y) * look.height)};
  }
  [[nodiscard]] glm::vec3 at(const glm::vec3& p) const {
    const glm::ivec2 pixel = pixel_of(p);
    return at(pixel.x, pixel.y);
  }
};

inline Seen look(render::Renderer& renderer, const Look& look) {
  lenses::Wearer wearer;
  wearer.age = 20.0;
  tracking::Pose head;
  head.position = {-wearer.pupillary_distance[0], 0.0, 0.0};  // the right eye at the origin
  Seen seen{wear(wearer, look.spectacles, head), {}, {}, look};
  const tracking::FieldOfView fov{look.half_tangent, look.half_tangent, look.half_tangent, look.half_tangent};
  seen.setup = view_along(seen.pair, 0, Viewing::fixed, {0, 0, -1}, fov);
  render::FrameConfig config;
  config.width = look.width;
  config.height = look.height;
  config.mode = look.mode;
  config.bare = look.bare;
  config.keep_radiance = true;
  config.keep_wavefront = true;
  seen.view = std::move(renderer.render(seen.pair.model, {seen.setup}, config).views.at(0));
  return seen;
}

}  // namespace support
