#include "render/scene_buffers.hpp"

#include <algorithm>
#include <bit>
#include <glm/packing.hpp>
#include <string>
#include <utility>

#include "render/frame_types.hpp"
#include "render/scene/gpu/bvh_layout.h"
#include "render/scene/texture_texels.hpp"

namespace render {
namespace {

// Numbers that cross to the shaders.
static_assert(gpu::kLightDirectional == static_cast<int>(Light::Type::directional) &&
              gpu::kLightPoint == static_cast<int>(Light::Type::point) &&
              gpu::kLightSpot == static_cast<int>(Light::Type::spot));

// The shaders read them as texels of four words.
static_assert(sizeof(gpu::MaterialData) == gpu::kMaterialTexels * sizeof(glm::vec4) &&
              sizeof(gpu::TextureData) == 2 * sizeof(glm::vec4) && sizeof(gpu::LightData) == 4 * sizeof(glm::vec4));

struct Packed {
  std::vector<gpu::MaterialData> materials;
  std::vector<gpu::TextureData> textures;
  std::uint32_t features = 0;
};

bool is_matte(const Material& material) {
  return material.metallic == 0.0F && material.roughness == 1.0F && material.surface_texture.index < 0;
}

bool is_transformed(const TextureUse& use) {
  return use.index >= 0 && (use.linear != glm::mat2(1.0F) || use.offset != glm::vec2(0.0F));
}

std::uint32_t features_of(const Material& material) {
  std::uint32_t features = 0;
  const auto add = [&](bool has, int feature) { features |= has ? static_cast<std::uint32_t>(feature) : 0U; };
  add(!material.double_sided, gpu::kFeatureCull);
  add(material.alpha == Material::Alpha::mask, gpu::kFeatureMask);
  add(material.alpha == Material::Alpha::blend, gpu::kFeatureBlend);
  add(!is_matte(material) && !material.unlit, gpu::kFeatureShiny);
  add(material.unlit, gpu::kFeatureUnlit);
  add(material.emission_texture.index >= 0, gpu::kFeatureEmission);
  add(material.surface_texture.index >= 0 || material.normal_texture.index >= 0 ||
          material.occlusion_texture.index >= 0,
      gpu::kFeatureMaps);
  for (const TextureUse* use : {&material.base_colour_texture, &material.emission_texture, &material.surface_texture,
                                &material.normal_texture, &material.occlusion_texture}) {
    add(use->index >= 0, gpu::kFeatureTexture);
    add(is_transformed(*use), gpu::kFeatureTransform);
    add(use->index >= 0 && use->second_uv != 0, gpu::kFeatureSecondUv);
  }
  return features;
}

gpu::MaterialData material_data(const Material& material, TextureTexels& texels) {
  const bool has_alpha = material.alpha != Material::Alpha::opaque;
  const std::int32_t base = material.base_colour_texture.index;
  gpu::MaterialData data{};
  data.base_colour = material.base_colour;
  data.emission = glm::vec4(material.emission, 0.0F);
  data.textures = {texels.place(base, has_alpha ? TexelUse::cut_out : TexelUse::colour),
                   texels.place(material.emission_texture.index, TexelUse::colour),
                   texels.place(material.surface_texture.index, TexelUse::data),
                   texels.place(material.normal_texture.index, TexelUse::data)};
  data.flags.x = (is_matte(material) ? gpu::kMaterialMatte : 0) |
                 (material.alpha == Material::Alpha::blend ? gpu::kMaterialBlends : 0) |
                 (material.unlit ? gpu::kMaterialUnlit : 0);
  data.flags.z = has_alpha ? texels.place(base, TexelUse::alpha) : -1;
  data.flags.w = texels.place(material.occlusion_texture.index, TexelUse::data);
  data.surface = {material.metallic, material.roughness, 0.0F, material.alpha_cutoff};
  data.maps = {material.normal_scale, material.occlusion_strength, 0.0F, 0.0F};
  const TextureUse* slots[gpu::kTextureSlots] = {&material.base_colour_texture, &material.emission_texture,
                                                 &material.surface_texture, &material.normal_texture,
                                                 &material.occlusion_texture};
  for (int slot = 0; slot < gpu::kTextureSlots; ++slot) {
    const TextureUse& use = *slots[slot];
    data.flags.y |= use.second_uv << slot;
    data.uv_linear[slot] = {use.linear[0], use.linear[1]};
    data.uv_offset[slot] = {use.offset, 0.0F, 0.0F};
  }
  return data;
}

// Materials that no triangle shows ask for nothing.
Packed pack_materials(const Scene& scene, TextureTexels& texels) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::uint32_t material : scene.triangle_material) used.at(material) = true;
  Packed packed;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material material = used[i] ? scene.materials[i] : Material{};
    packed.materials.push_back(material_data(material, texels));
    packed.features |= used[i] ? features_of(material) : 0U;
  }
  if (!scene.colours.empty()) packed.features |= static_cast<std::uint32_t>(gpu::kFeatureColours);
  for (const PlacedTexture& t : texels.textures()) {
    packed.textures.push_back({glm::ivec4(t.first_word, t.width, t.height, t.wrap | (t.format << 16)),
                               glm::ivec4(static_cast<int>(t.levels), 0, 0, 0)});
  }
  return packed;
}

std::vector<gpu::LightData> light_data(const Scene& scene) {
  std::vector<gpu::LightData> data;
  for (const Light& light : scene.lights) {
    data.push_back({glm::vec4(light.colour, static_cast<float>(light.type)), glm::vec4(light.position, light.range),
                    glm::vec4(light.direction, 0.0F), glm::vec4(light.cos_inner, light.cos_outer, 0.0F, 0.0F)});
  }
  return data;
}

bool has_more(std::uint32_t features) {
  return (features & static_cast<std::uint32_t>(gpu::kFeatureColours | gpu::kFeatureSecondUv)) != 0;
}

// The second coordinates and the colours of every triangle of the BVH (gpu/bvh_layout.h).
void append_more(const Scene& scene, const Bvh4& bvh, std::vector<ShadingTriangle>& shading) {
  std::vector<glm::vec4> more;
  const auto word = [](const glm::vec2& pair) { return std::bit_cast<float>(glm::packHalf2x16(pair)); };
  for (std::size_t i = 0; i < bvh.triangles.size() / kBvhTriangleTexels; ++i) {
    const auto triangle = std::bit_cast<std::uint32_t>(bvh.triangles[i * kBvhTriangleTexels + 1].w);
    glm::vec2 uv[3];
    glm::vec4 colour[3];
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = scene.triangles[triangle][corner];
      uv[corner] = vertex < scene.second_uvs.size() ? scene.second_uvs[vertex] : glm::vec2(0.0F);
      colour[corner] = vertex < scene.colours.size() ? scene.colours[vertex] : glm::vec4(1.0F);
    }
    const auto halves = [&](int corner, int from) { return word({colour[corner][from], colour[corner][from + 1]}); };
    more.emplace_back(uv[0], uv[1]);
    more.emplace_back(uv[2].x, uv[2].y, halves(0, 0), halves(0, 2));
    more.emplace_back(halves(1, 0), halves(1, 2), halves(2, 0), halves(2, 2));
  }
  more.resize((more.size() + kBvhShadingTexels - 1) / kBvhShadingTexels * kBvhShadingTexels);
  for (std::size_t i = 0; i < more.size(); i += kBvhShadingTexels) {
    shading.push_back({{more[i], more[i + 1], more[i + 2]}, more[i + 3]});
  }
}

// Refuses with the numbers what cannot fit, before anything is built or allocated.
void check_fits(const vk::Device& device, const Scene& scene, std::size_t texel_words, std::uint32_t features) {
  const vk::DeviceLimits& limits = device.limits();
  const std::size_t bytes = std::min(limits.max_storage_buffer_bytes, limits.max_texel_elements * sizeof(glm::vec4));
  const std::size_t a_triangle =
      sizeof(glm::vec4) * (kBvhShadingTexels + (has_more(features) ? std::size_t{kBvhMoreTexels} : 0));
  const std::size_t needed = a_triangle * scene.triangles.size();
  if (needed > bytes) {
    throw vk::DeviceError(scene.source + ": " + std::to_string(scene.triangles.size()) + " triangles need " +
                          std::to_string(needed) + " bytes in one buffer; " + device.name() + " allows " +
                          std::to_string(bytes) + ", " + std::to_string(bytes / a_triangle) + " triangles");
  }
  const std::size_t texel_bytes =
      std::min(limits.max_storage_buffer_bytes, limits.max_texel_elements * sizeof(std::uint32_t));
  if (sizeof(std::uint32_t) * texel_words > texel_bytes) {
    throw vk::DeviceError(scene.source + ": its textures with their smaller levels need " +
                          std::to_string(sizeof(std::uint32_t) * texel_words) + " bytes in one buffer; " +
                          device.name() + " allows " + std::to_string(texel_bytes));
  }
}

}  // namespace

struct SceneBuffers::Parts {
  SceneBvh bvh;
  std::vector<ShadingTriangle> shading;
  std::vector<std::uint32_t> texels;
  Packed packed;
  gpu::EnvironmentData environment{};

  Parts(const vk::Device& device, const Scene& scene) {
    TextureTexels placed(scene);
    packed = pack_materials(scene, placed);
    check_fits(device, scene, placed.word_count(), packed.features);
    bvh = build_scene_bvh(scene);
    shading = render::shading_triangles(scene, bvh.four);
    const auto more = static_cast<int>(shading.size() * kBvhShadingTexels);
    if (has_more(packed.features)) append_more(scene, bvh.four, shading);
    texels = placed.pack();
    const Environment& e = scene.environment;
    environment = {glm::vec4(e.sky_zenith, 0.0F),
                   glm::vec4(e.sky_horizon, 0.0F),
                   glm::vec4(e.ambient, 0.0F),
                   glm::ivec4(0, more, 0, 0),
                   {scene.lights.empty() ? gpu::LightData{} : light_data(scene).front()}};
  }
};

SceneBuffers::SceneBuffers(vk::Device& device, const Scene& scene)
    : SceneBuffers(device, scene, Parts(device, scene)) {}

SceneBuffers::SceneBuffers(vk::Device& device, const Scene& scene, Parts&& parts)
    : bvh_nodes(filled_buffer(device, std::move(parts.bvh.four.nodes))),
      wide_nodes(filled_buffer(device, std::move(parts.bvh.eight.nodes))),
      bvh_triangles(filled_buffer(device, std::move(parts.bvh.four.triangles))),
      shading_triangles(filled_buffer(device, std::move(parts.shading))),
      texels(filled_buffer(device, std::move(parts.texels))),
      environment(filled_buffer(device, std::vector{parts.environment})),
      lights(filled_buffer(device, light_data(scene))),
      materials(filled_buffer(device, parts.packed.materials)),
      textures(filled_buffer(device, parts.packed.textures)),
      triangle_count(scene.triangles.size()),
      features(parts.packed.features) {}

// From what the other traversals test, so that all meet the same corners but for the rounding of an edge's end.
const vk::Acceleration& SceneBuffers::acceleration(const vk::Device& device) const {
  if (!acceleration_) {
    const auto triangles = bvh_triangles.read<glm::vec4>(bvh_triangles.bytes() / sizeof(glm::vec4));
    std::vector<float> corners;
    corners.reserve(9 * triangles.size() / kBvhTriangleTexels);
    for (std::size_t i = 0; i < triangles.size(); i += kBvhTriangleTexels) {
      const glm::vec3 a(triangles[i]);
      for (const glm::vec3& corner : {a, a + glm::vec3(triangles[i + 1]), a + glm::vec3(triangles[i + 2])}) {
        corners.insert(corners.end(), {corner.x, corner.y, corner.z});
      }
    }
    acceleration_ = vk::build_acceleration(device, corners);
  }
  return *acceleration_;
}

}  // namespace render
