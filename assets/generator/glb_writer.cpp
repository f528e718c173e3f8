#include "assets/generator/glb_writer.hpp"

#include <stb/stb_image_write.h>

#include <bit>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace assets {
namespace {

using Json = nlohmann::ordered_json;
static_assert(std::endian::native == std::endian::little, "glTF buffers are little endian");

constexpr int kFloat = 5126, kUnsigned = 5125;              // accessor component types
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;  // buffer view targets

Json vector_json(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

class Writer {
 public:
  explicit Writer(const SceneModel& scene) : scene_(scene) {}

  std::vector<std::uint8_t> write() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "Vergence make_assets"}};
    json_["asset"]["extras"]["vergence"] = {{"sky_zenith", vector_json(scene_.environment.sky_zenith)},
                                            {"sky_horizon", vector_json(scene_.environment.sky_horizon)},
                                            {"ambient", vector_json(scene_.environment.ambient)}};
    json_["extensionsUsed"] = {"KHR_lights_punctual"};
    for (const Picture& picture : scene_.pictures) add_picture(picture);
    for (const Material& material : scene_.materials) add_material(material);
    for (const Node& node : scene_.nodes) add_node(node);
    json_["scene"] = 0;
    json_["scenes"] = Json::array({{{"nodes", Json::array()}}});
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) json_["scenes"][0]["nodes"].push_back(i);
    json_["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
    return file();
  }

 private:
  std::size_t add_view(const void* data, std::size_t size, int target) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);  // accessors and chunks are aligned to 4 bytes
    Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}};
    if (target != 0) view["target"] = target;
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    buffer_.insert(buffer_.end(), bytes, bytes + size);
    json_["bufferViews"].push_back(std::move(view));
    return json_["bufferViews"].size() - 1;
  }

  template <typename Vector>
  std::size_t add_vectors(const std::vector<Vector>& vectors, bool with_bounds) {
    constexpr int kSize = Vector::length();
    std::vector<float> data;
    data.reserve(vectors.size() * kSize);
    std::array<float, kSize> low, high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (const Vector& v : vectors) {
      for (int i = 0; i < kSize; ++i) {
        const auto value = static_cast<float>(v[i]);
        const auto slot = static_cast<std::size_t>(i);
        data.push_back(value);
        low[slot] = std::min(low[slot], value);
        high[slot] = std::max(high[slot], value);
      }
    }
    Json accessor{{"bufferView", add_view(data.data(), data.size() * sizeof(float), kVertexBuffer)},
                  {"componentType", kFloat},
                  {"count", vectors.size()},
                  {"type", kSize == 3 ? "VEC3" : "VEC2"}};
    if (with_bounds) {
      accessor["min"] = low;
      accessor["max"] = high;
    }
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].size() - 1;
  }

  void add_picture(const Picture& picture) {
    std::vector<std::uint8_t> png;
    const auto collect = [](void* context, void* data, int size) {
      const auto* bytes = static_cast<const std::uint8_t*>(data);
      auto& out = *static_cast<std::vector<std::uint8_t>*>(context);
      out.insert(out.end(), bytes, bytes + size);
    };
    if (stbi_write_png_to_func(collect, &png, picture.width, picture.height, 3, picture.rgb.data(),
                               3 * picture.width) == 0) {
      throw std::runtime_error("the picture " + picture.name + " cannot be encoded");
    }
    json_["images"].push_back(
        {{"name", picture.name}, {"mimeType", "image/png"}, {"bufferView", add_view(png.data(), png.size(), 0)}});
    json_["textures"].push_back({{"source", json_["images"].size() - 1}, {"sampler", 0}});
    // Trilinear, repeating.
    if (!json_.contains("samplers"))
      json_["samplers"] = Json::array({{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}}});
  }

  void add_material(const Material& material) {
    Json pbr{
        {"baseColorFactor", {material.base_colour.r, material.base_colour.g, material.base_colour.b, material.opacity}},
        {"metallicFactor", material.metallic},
        {"roughnessFactor", material.roughness}};
    if (material.picture) pbr["baseColorTexture"] = {{"index", *material.picture}};
    Json json{{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    const double brightest = std::max({material.emission.r, material.emission.g, material.emission.b});
    if (brightest > 0.0) {
      // The factor is limited to 1; what is brighter needs the strength.
      const double strength = std::max(1.0, brightest);
      json["emissiveFactor"] = vector_json(material.emission / strength);
      if (strength > 1.0) {
        json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
        json_["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength"};
      }
    }
    if (material.double_sided) json["doubleSided"] = true;
    if (material.opacity < 1.0) json["alphaMode"] = "BLEND";
    json_["materials"].push_back(std::move(json));
  }

  std::size_t add_mesh(const Node& node) {
    Json mesh{{"name", node.name}, {"primitives", Json::array()}};
    for (const auto& [material, part] : node.parts) {
      Json primitive;
      primitive["attributes"]["POSITION"] = add_vectors(part.positions, true);
      primitive["attributes"]["NORMAL"] = add_vectors(part.normals, false);
      if (scene_.materials[material].picture) primitive["attributes"]["TEXCOORD_0"] = add_vectors(part.uvs, false);
      json_["accessors"].push_back(
          {{"bufferView", add_view(part.indices.data(), part.indices.size() * sizeof(std::uint32_t), kIndexBuffer)},
           {"componentType", kUnsigned},
           {"count", part.indices.size()},
           {"type", "SCALAR"}});
      primitive["indices"] = json_["accessors"].size() - 1;
      primitive["material"] = material;
      mesh["primitives"].push_back(std::move(primitive));
    }
    json_["meshes"].push_back(std::move(mesh));
    return json_["meshes"].size() - 1;
  }

  void add_node(const Node& node) {
    Json json{{"name", node.name}};
    if (node.translation != glm::dvec3(0.0)) json["translation"] = vector_json(node.translation);
    const glm::dquat& q = node.rotation;
    if (q.w != 1.0) json["rotation"] = {q.x, q.y, q.z, q.w};
    if (!node.parts.empty()) json["mesh"] = add_mesh(node);
    if (node.camera) {
      json_["cameras"].push_back({{"type", "perspective"},
                                  {"perspective", {{"yfov", 1.0471975511965976}, {"znear", 0.02}, {"zfar", 40000.0}}}});
      json["camera"] = json_["cameras"].size() - 1;
    }
    if (node.light) {
      Json& lights = json_["extensions"]["KHR_lights_punctual"]["lights"];
      lights.push_back({{"name", node.name},
                        {"type", node.light->type == Light::Type::point ? "point" : "directional"},
                        {"color", vector_json(node.light->colour)},
                        {"intensity", node.light->intensity}});
      json["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    }
    if (node.target) json["extras"]["target"] = true;
    json_["nodes"].push_back(std::move(json));
  }

  // The container (glTF 2.0 section 4.4): header, JSON chunk padded with spaces, binary chunk padded with zeros.
  std::vector<std::uint8_t> file() {
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    std::vector<std::uint8_t> bytes;
    const auto word = [&](std::size_t value) {
      const auto v = static_cast<std::uint32_t>(value);
      for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(v >> shift));
    };
    word(0x46546C67);  // "glTF"
    word(2);
    word(12 + 8 + text.size() + 8 + buffer_.size());
    word(text.size());
    word(0x4E4F534A);  // "JSON"
    bytes.insert(bytes.end(), text.begin(), text.end());
    word(buffer_.size());
    word(0x004E4942);  // "BIN"
    bytes.insert(bytes.end(), buffer_.begin(), buffer_.end());
    return bytes;
  }

  const SceneModel& scene_;
  Json json_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace

std::vector<std::uint8_t> glb_bytes(const SceneModel& scene) {
  return Writer(scene).write();
}

}  // namespace assets
