#include "render/scene/gltf_material.hpp"

#include <cmath>
#include <map>

namespace render {
namespace {

constexpr std::size_t kMostPixels = std::size_t{1} << 27;  // of all textures, 512 MiB as decoded

float number_in(const tinygltf::Value& object, const char* name, float otherwise) {
  return object.Has(name) ? static_cast<float>(object.Get(name).GetNumberAsDouble()) : otherwise;
}

glm::vec2 pair_in(const tinygltf::Value& object, const char* name, const glm::vec2& otherwise) {
  if (!object.Has(name)) return otherwise;
  const tinygltf::Value& pair = object.Get(name);
  return {static_cast<float>(pair.Get(0).GetNumberAsDouble()), static_cast<float>(pair.Get(1).GetNumberAsDouble())};
}

// A texture of a material before its set of coordinates has found its place: KHR_texture_transform scales first, then
// turns counter-clockwise as seen with v downwards, then shifts. That is the extension's table, its worked example (the
// lower left quadrant) and its viewers; the GLSL lines in its text turn the other way.
struct Source {
  int set = 0;
  glm::mat2 linear{1.0F};
  glm::vec2 offset{0.0F};
};

Source source_of(int set, const tinygltf::ExtensionMap& extensions) {
  Source source{.set = set};
  const auto found = extensions.find("KHR_texture_transform");
  if (found == extensions.end()) return source;
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

  UvSets read(std::size_t index) {
    const tinygltf::Material& source = document_.model.materials[index];
    field_ = "materials[" + std::to_string(index) + "]";
    sets_.reset();
    Material material;
    material.name = source.name;
    material.double_sided = source.doubleSided;
    material.unlit = source.extensions.contains("KHR_materials_unlit");
    const std::string pbr_field = field_ + ".pbrMetallicRoughness";
    const auto& pbr = source.pbrMetallicRoughness;
    for (int i = 0; i < 4; ++i) {
      material.base_colour[i] = factor(pbr.baseColorFactor, i, 1.0, pbr_field + ".baseColorFactor");
    }
    material.metallic = unit_number(pbr.metallicFactor, pbr_field + ".metallicFactor");
    material.roughness = unit_number(pbr.roughnessFactor, pbr_field + ".roughnessFactor");
    const float strength = emissive_strength(source);
    for (int i = 0; i < 3; ++i) {
      material.emission[i] = strength * factor(source.emissiveFactor, i, 0.0, field_ + ".emissiveFactor");
    }
    material.normal_scale = static_cast<float>(source.normalTexture.scale);
    material.occlusion_strength = unit_number(source.occlusionTexture.strength, field_ + ".occlusionTexture.strength");
    read_alpha(source, material);
    read_textures(source, material);
    scene_.materials.push_back(material);
    return sets_.value_or(UvSets{});
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

  [[nodiscard]] float unit_number(double value, const std::string& field) const {
    if (!(value >= 0.0 && value <= 1.0)) {
      document_.fail(field, "is " + std::to_string(value) + "; 0 to 1 is allowed");
    }
    return static_cast<float>(value);
  }

  void read_alpha(const tinygltf::Material& source, Material& material) const {
    if (source.alphaMode == "MASK") {
      material.alpha = Material::Alpha::mask;
    } else if (source.alphaMode == "BLEND") {
      material.alpha = Material::Alpha::blend;
    } else if (!source.alphaMode.empty() && source.alphaMode != "OPAQUE") {
      document_.fail(field_ + ".alphaMode", "is another word; OPAQUE, MASK and BLEND are allowed");
    }
    if (!(source.alphaCutoff >= 0.0)) {
      document_.fail(field_ + ".alphaCutoff", "is " + std::to_string(source.alphaCutoff) + "; 0 or more is allowed");
    }
    material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
  }

  void read_textures(const tinygltf::Material& source, Material& material) {
    const auto& pbr = source.pbrMetallicRoughness;
    material.base_colour_texture = use(pbr.baseColorTexture, "pbrMetallicRoughness.baseColorTexture");
    material.emission_texture = use(source.emissiveTexture, "emissiveTexture");
    material.surface_texture = use(pbr.metallicRoughnessTexture, "pbrMetallicRoughness.metallicRoughnessTexture");
    material.normal_texture = use(source.normalTexture, "normalTexture");
    material.occlusion_texture = use(source.occlusionTexture, "occlusionTexture");
  }

  [[nodiscard]] float emissive_strength(const tinygltf::Material& source) const {
    const auto found = source.extensions.find("KHR_materials_emissive_strength");
    if (found == source.extensions.end()) return 1.0F;
    const float strength = number_in(found->second, "emissiveStrength", 1.0F);
    if (!(strength >= 0.0F)) {
      document_.fail(field_ + ".extensions.KHR_materials_emissive_strength.emissiveStrength",
                     "is " + std::to_string(strength) + "; 0 or more is allowed");
    }
    return strength;
  }

  // info: one of tinygltf's three kinds of texture reference.
  template <class Info>
  TextureUse use(const Info& info, const char* name) {
    TextureUse use;
    if (info.index < 0) return use;
    const Source source = source_of(info.texCoord, info.extensions);
    if (!sets_) sets_ = UvSets{.first = source.set, .second = {}};
    if (source.set != sets_->first) {
      if (sets_->second.value_or(source.set) != source.set) {
        document_.fail(field_ + "." + name + ".texCoord",
                       "is the material's third set of texture coordinates; two are allowed");
      }
      sets_->second = source.set;
      use.second_uv = 1;
    }
    use.linear = source.linear;
    use.offset = source.offset;
    use.index = texture(info.index);
    return use;
  }

  // The scene's index of a glTF texture, decoded at its first use; -1 for none.
  std::int32_t texture(int index) {
    if (index < 0) return -1;
    const auto [place, is_new] = textures_.try_emplace(index, static_cast<std::int32_t>(scene_.textures.size()));
    if (is_new) {
      scene_.textures.push_back(read_texture(document_, index));
      pixels_ += std::size_t{scene_.textures.back().width} * scene_.textures.back().height;
      if (pixels_ > kMostPixels) {
        document_.fail("textures[" + std::to_string(index) + "]",
                       "brings the scene's textures to " + std::to_string(pixels_) + " pixels; 134217728 are allowed");
      }
    }
    return place->second;
  }

  const GltfDocument& document_;
  Scene& scene_;
  std::map<int, std::int32_t> textures_;
  std::size_t pixels_ = 0;
  std::string field_;           // of the material being read
  std::optional<UvSets> sets_;  // that its textures have asked for so far
};

}  // namespace

std::vector<UvSets> read_materials(const GltfDocument& document, Scene& scene) {
  MaterialReader reader(document, scene);
  std::vector<UvSets> sets;
  for (std::size_t i = 0; i < document.model.materials.size(); ++i) sets.push_back(reader.read(i));
  scene.materials.emplace_back();
  sets.emplace_back();
  return sets;
}

}  // namespace render
