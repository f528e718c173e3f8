#include "assets/generator/model_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace assets {
namespace {

using Json = nlohmann::json;

std::vector<char> file_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::uint32_t word_at(std::span<const char> bytes, std::size_t at) {
  std::uint32_t word = 0;
  if (at + sizeof word > bytes.size()) throw std::runtime_error("ends too early");
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

glm::dmat4 transform_of(const Json& node) {
  if (node.contains("matrix")) return glm::make_mat4(node["matrix"].get<std::vector<double>>().data());
  const auto list = [&](const char* name, std::vector<double> otherwise) { return node.value(name, otherwise); };
  const auto t = list("translation", {0, 0, 0}), r = list("rotation", {0, 0, 0, 1}), s = list("scale", {1, 1, 1});
  glm::dmat4 m = glm::mat4_cast(glm::dquat(r.at(3), r.at(0), r.at(1), r.at(2)));
  for (int i = 0; i < 3; ++i) m[i] *= s.at(static_cast<std::size_t>(i));
  m[3] = glm::dvec4(t.at(0), t.at(1), t.at(2), 1.0);
  return m;
}

// OBJ materials give a Phong exponent, of which assimp keeps a thousandth as glossiness (1 is left out). Its own
// conversion to roughness can leave 0 to 1; this is the usual one, alpha^2 = 2 / (Ns + 2).
Material material_of(const Json& json) {
  const Json pbr = json.value("pbrMetallicRoughness", Json::object());
  const auto colour = pbr.value("baseColorFactor", std::vector<double>{1, 1, 1, 1});
  Material material{.name = json.value("name", ""),
                    .base_colour = {colour.at(0), colour.at(1), colour.at(2)},
                    .double_sided = true,
                    .opacity = colour.at(3),
                    .roughness = 0.5};
  const Json phong = json.value("extensions", Json::object()).value("KHR_materials_pbrSpecularGlossiness", Json());
  if (phong.is_object()) {
    material.roughness = std::pow(2.0 / (1000.0 * phong.value("glossinessFactor", 1.0) + 2.0), 0.25);
  }
  const bool metal = material.name.starts_with("METAL") || material.name.find("chrome") != std::string::npos;
  material.metallic = metal ? 1.0 : 0.0;
  return material;
}

class Reader {
 public:
  explicit Reader(const std::string& path) : bytes_(file_bytes(path)) {
    constexpr std::size_t kHeader = 12, kChunk = 8;
    const std::size_t json_bytes = word_at(bytes_, kHeader), begin = kHeader + kChunk;
    if (word_at(bytes_, 0) != 0x46546C67 || begin + json_bytes > bytes_.size()) {
      throw std::runtime_error("is no binary glTF file");
    }
    json_ = Json::parse(bytes_.begin() + begin, bytes_.begin() + static_cast<std::ptrdiff_t>(begin + json_bytes));
    data_ = std::span<const char>(bytes_).subspan(std::min(begin + json_bytes + kChunk, bytes_.size()));
  }

  Model read() {
    for (const Json& material : json_.at("materials")) model_.materials.push_back(material_of(material));
    for (const Json& root : json_.at("scenes").at(json_.value("scene", 0)).at("nodes")) add_node(root, glm::dmat4(1.0));
    Box& b = model_.bounds;
    b = {glm::dvec3(std::numeric_limits<double>::max()), glm::dvec3(std::numeric_limits<double>::lowest())};
    for (const ModelPart& part : model_.parts) {
      for (const glm::dvec3& p : part.positions) b = {glm::min(b.low, p), glm::max(b.high, p)};
    }
    return std::move(model_);
  }

 private:
  void add_node(const Json& index, const glm::dmat4& parent) {
    const Json& node = json_.at("nodes").at(index.get<std::size_t>());
    const glm::dmat4 world = parent * transform_of(node);
    if (node.contains("mesh")) {
      const Json& mesh = json_.at("meshes").at(node["mesh"].get<std::size_t>());
      for (const Json& primitive : mesh.at("primitives")) add_primitive(primitive, node.value("name", ""), world);
    }
    for (const Json& child : node.value("children", Json::array())) add_node(child, world);
  }

  void add_primitive(const Json& primitive, const std::string& name, const glm::dmat4& world) {
    constexpr int kTriangles = 4;
    if (primitive.value("mode", kTriangles) != kTriangles) return;
    ModelPart part{.name = name, .material = primitive.at("material").get<std::size_t>()};
    const Json& positions = accessor(primitive.at("attributes").at("POSITION"));
    for (std::size_t i = 0; i < positions.at("count"); ++i) {
      std::array<float, 3> p{};
      std::memcpy(p.data(), element(positions, i, sizeof p), sizeof p);
      part.positions.emplace_back(world * glm::dvec4(p[0], p[1], p[2], 1.0));
    }
    const Json& indices = accessor(primitive.at("indices"));
    const std::size_t size = indices.at("componentType") == 5125 ? 4 : indices.at("componentType") == 5123 ? 2 : 1;
    for (std::size_t i = 0; i < indices.at("count"); ++i) {
      std::uint32_t vertex = 0;
      std::memcpy(&vertex, element(indices, i, size), size);
      if (vertex >= part.positions.size()) throw std::runtime_error("names a vertex that it has not");
      part.indices.push_back(vertex);
    }
    model_.parts.push_back(std::move(part));
  }

  const Json& accessor(const Json& index) const { return json_.at("accessors").at(index.get<std::size_t>()); }

  const char* element(const Json& accessor, std::size_t i, std::size_t size) const {
    const Json& view = json_.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::size_t at = view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0}) +
                           i * view.value("byteStride", size);
    if (at + size > data_.size()) throw std::runtime_error("ends before its vertices do");
    return data_.data() + at;
  }

  std::vector<char> bytes_;
  Json json_;
  std::span<const char> data_;
  Model model_;
};

}  // namespace

std::size_t Model::triangle_count() const {
  std::size_t count = 0;
  for (const ModelPart& part : parts) count += part.indices.size() / 3;
  return count;
}

Model read_model(const std::string& path) {
  try {
    return Reader(path).read();
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

}  // namespace assets
