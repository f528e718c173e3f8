#include "render/scene/gltf_material.hpp"

#include <cmath>
#include <map>

namespace render {
namespace {

float number_in(const tinygltf::Value& object, const char* name, float otherwise) {
  return object.Has(name) ? static_cast<float>(object.Get(name).GetNumberAsDouble()) : otherwise;
}

glm::vec2 pair_in(const tinygltf::Value& object, const char* name, const glm::vec2& otherwise) {
  if (!object.Has(name)) return otherwise;
  const tinygltf::Value& pair = object.Get(name);
  return {static_cast<float>(pair.Get(0).GetNumberAsDouble()), static_cast<float>(pair.Get(1).GetNumberAsDouble())};
}

// KHR_texture_transform: scale first, then a turn that is counter-clockwise as seen with v downwards, then the offset.
UvSource uv_source(const tinygltf::TextureInfo& info) {
  UvSource source{.set = info.texCoord};
  const auto found = info.extensions.find("KHR_texture_transform");
  if (found == info.extensions.end()) return source;
  const tinygltf::Value& transform = found->second;
  if (transform.Has("texCoord")) source.set = transform.Get("texCoord").GetNumberAsInt();
  const float angle = number_in(transform, "rotation", 0.0F), c = std::cos(angle), s = std::sin(angle);
  const glm::vec2 scale = pair_in(transform, "scale", glm::vec2(1.0F));
  source.linear = glm::mat2(c * scale.x, -s * scale.x, s * scale.y, c * scale.y);
  source.offset = pair_in(transform, "offset", glm::vec2(0.0F));
  return source;
}

class MaterialReader {
 public:
  MaterialReader(const GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

  UvSource read(std::size_t index) {
    const tinygltf::Material& source = document_.model.materials[index];
    const std::string field = "materials[" + std::to_string(index) + "]";
    Material material;
    material.name = source.name;
    material.double_sided = source.doubleSided;
    const auto& pbr = source.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i) {
      material.base_colour[i] = factor(pbr.baseColorFactor, i, 1.0, field + ".pbrMetallicRoughness.baseColorFactor");
    }
    const float strength = emissive_strength(source, field);
    for (int i = 0; i < 3; ++i) {
      material.emission[i] = strength * factor(source.emissiveFactor, i, 0.0, field + ".emissiveFactor");
    }
    material.base_colour_texture = texture(pbr.baseColorTexture.index);
    material.emission_texture = texture(source.emissiveTexture.index);
    scene_.materials.push_back(material);
    return shared_source(pbr.baseColorTexture, source.emissiveTexture, field);
  }

 private:
  [[nodiscard]] float factor(const std::vector<double>& values, int i, double otherwise,
                             const std::string& field) const {
    const double value = values.empty() ? otherwise : values.at(static_cast<std::size_t>(i));
    if (!(value >= 0.0 && value <= 1.0)) {
      document_.fail(field + "[" + std::to_string(i) + "]", "is " + std::to_string(value) + "; 0 to 1 is allowed");
    }
    return static_cast<float>(value);
  }

  [[nodiscard]] float emissive_strength(const tinygltf::Material& source, const std::string& field) const {
    const auto found = source.extensions.find("KHR_materials_emissive_strength");
    if (found == source.extensions.end()) return 1.0F;
    const float strength = number_in(found->second, "emissiveStrength", 1.0F);
    if (!(strength >= 0.0F)) {
      document_.fail(field + ".extensions.KHR_materials_emissive_strength.emissiveStrength",
                     "is " + std::to_string(strength) + "; 0 or more is allowed");
    }
    return strength;
  }

  // A vertex carries one pair of coordinates, so two textures of a material must agree on theirs.
  [[nodiscard]] UvSource shared_source(const tinygltf::TextureInfo& base, const tinygltf::TextureInfo& emissive,
                                       const std::string& field) const {
    if (base.index < 0) return uv_source(emissive);
    if (emissive.index >= 0 && !(uv_source(base) == uv_source(emissive))) {
      document_.fail(field + ".emissiveTexture",
                     "has another texCoord or KHR_texture_transform than the base colour "
                     "texture; the two must agree");
    }
    return uv_source(base);
  }

  // The scene's index of a glTF texture, decoded at its first use; -1 for none.
  std::int32_t texture(int index) {
    if (index < 0) return -1;
    const auto [place, is_new] = textures_.try_emplace(index, static_cast<std::int32_t>(scene_.textures.size()));
    if (is_new) scene_.textures.push_back(read_texture(document_, index));
    return place->second;
  }

  const GltfDocument& document_;
  Scene& scene_;
  std::map<int, std::int32_t> textures_;
};

}  // namespace

std::vector<UvSource> read_materials(const GltfDocument& document, Scene& scene) {
  MaterialReader reader(document, scene);
  std::vector<UvSource> sources;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) sources.push_back(reader.read(i));
  scene.materials.emplace_back();
  sources.emplace_back();
  return sources;
}

}  // namespace render
