#include "render/scene_buffers.hpp"

#include <algorithm>
#include <array>
#include <glm/gtc/packing.hpp>

#include "render/frame_types.hpp"
#include "render/image/srgb.hpp"

namespace render {
namespace {

// Textures in linear light, packed to four bytes: filtering is linear only on linear values.
std::vector<std::uint32_t> pack_texels(const Scene& scene) {
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    linear[i] = srgb_decode(static_cast<std::uint8_t>(i));
  }
  std::vector<std::uint32_t> texels;
  for (const Texture& texture : scene.textures) {
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4) {
      texels.push_back(glm::packF3x9_E1x5(
          glm::vec3(linear[texture.rgba[i]], linear[texture.rgba[i + 1]], linear[texture.rgba[i + 2]])));
    }
  }
  return texels;
}

std::vector<gpu::TextureData> texture_data(const Scene& scene) {
  std::vector<gpu::TextureData> data;
  int first = 0;
  for (const Texture& texture : scene.textures) {
    const int wrap = static_cast<int>(texture.wrap_u) | (static_cast<int>(texture.wrap_v) << 8);
    data.push_back({glm::ivec4(first, static_cast<int>(texture.width), static_cast<int>(texture.height), wrap)});
    first += static_cast<int>(texture.width * texture.height);
  }
  return data;
}

std::vector<gpu::MaterialData> material_data(const Scene& scene) {
  std::vector<gpu::MaterialData> data;
  for (const Material& material : scene.materials) {
    data.push_back({material.base_colour, glm::vec4(material.emission, material.double_sided ? 1.0F : 0.0F),
                    glm::ivec4(material.base_colour_texture, material.emission_texture, 0, 0)});
  }
  return data;
}

std::vector<gpu::LightData> light_data(const Scene& scene) {
  std::vector<gpu::LightData> data;
  for (const Light& light : scene.lights) {
    data.push_back({glm::vec4(light.colour, static_cast<float>(light.type)), glm::vec4(light.position, light.range),
                    glm::vec4(light.direction, 0.0F), glm::vec4(light.cos_inner, light.cos_outer, 0.0F, 0.0F)});
  }
  return data;
}

std::vector<gpu::EnvironmentData> environment_data(const Scene& scene) {
  const Environment& e = scene.environment;
  return {{glm::vec4(e.sky_zenith, 0.0F), glm::vec4(e.sky_horizon, 0.0F), glm::vec4(e.ambient, 0.0F),
           glm::ivec4(static_cast<int>(scene.lights.size()), 0, 0, 0)}};
}

}  // namespace

SceneBuffers::SceneBuffers(vk::Device& device, const Scene& scene)
    : SceneBuffers(device, scene, build_scene_bvh(scene)) {}

SceneBuffers::SceneBuffers(vk::Device& device, const Scene& scene, const SceneBvh& bvh)
    : bvh_nodes(filled_buffer(device, bvh.four.nodes)),
      wide_nodes(filled_buffer(device, bvh.eight.nodes)),
      bvh_triangles(filled_buffer(device, bvh.four.triangles)),
      shading_triangles(filled_buffer(device, render::shading_triangles(scene, bvh.four))),
      texels(filled_buffer(device, pack_texels(scene))),
      environment(filled_buffer(device, environment_data(scene))),
      lights(filled_buffer(device, light_data(scene))),
      materials(filled_buffer(device, material_data(scene))),
      textures(filled_buffer(device, texture_data(scene))),
      triangle_count(scene.triangles.size()) {}

}  // namespace render
