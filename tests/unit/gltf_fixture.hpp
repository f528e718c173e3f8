// Hand-made glTF files for the reader's tests.
#pragma once

#include <gtest/gtest.h>
#include <stb/stb_image_write.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/scene/scene.hpp"
#include "tracking/input_error.hpp"

namespace gltf_fixture {

namespace fs = std::filesystem;
using nlohmann::json;
using render::Scene;
using tracking::InputError;
using Bytes = std::vector<std::uint8_t>;

inline constexpr int kU8 = 5121, kI16 = 5122, kU16 = 5123, kU32 = 5125, kF32 = 5126;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "vergence-gltf-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string write(const std::string& name, const void* data, std::size_t size) const {
    std::ofstream out(path_ / name, std::ios::binary);
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    return (path_ / name).string();
  }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    return write(name, text.data(), text.size());
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

template <typename T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string base64(const Bytes& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (i + j < bytes.size() ? bytes[i + j] : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? digits[(group >> (18 - 6 * j)) & 63U] : '=';
  }
  return text;
}

// A glTF under construction: the JSON, and the bytes of buffer 0.
struct Gltf {
  json root = {{"asset", {{"version", "2.0"}}}};
  Bytes bin;

  int view(const Bytes& bytes, int stride = 0) {
    while (bin.size() % 4 != 0) bin.push_back(0);
    json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    bin.insert(bin.end(), bytes.begin(), bytes.end());
    return add("bufferViews", view);
  }
  int add(const char* list, const json& item) {
    root[list].push_back(item);
    return static_cast<int>(root[list].size()) - 1;
  }
  template <typename T>
  int accessor(const std::vector<T>& values, const char* type, int component, std::size_t count, int stride = 0) {
    return add("accessors", {{"bufferView", view(bytes_of(values), stride)},
                             {"componentType", component},
                             {"count", count},
                             {"type", type}});
  }

  [[nodiscard]] std::string text() const {
    json whole = root;
    if (!whole.contains("buffers") && !bin.empty()) {
      whole["buffers"] = {{{"byteLength", bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(bin)}}};
    }
    return whole.dump();
  }
  [[nodiscard]] Bytes glb() const {
    json whole = root;
    whole["buffers"] = {{{"byteLength", bin.size()}}};
    std::string text = whole.dump();
    while (text.size() % 4 != 0) text += ' ';
    Bytes data = bin;
    while (data.size() % 4 != 0) data.push_back(0);
    Bytes out;
    const auto word = [&](std::size_t value) {
      for (std::size_t i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    };
    for (const std::size_t value : {std::size_t{0x46546C67}, std::size_t{2}, 28 + text.size() + data.size(),
                                    text.size(), std::size_t{0x4E4F534A}}) {
      word(value);
    }
    out.insert(out.end(), text.begin(), text.end());
    word(data.size());
    word(0x004E4942);
    out.insert(out.end(), data.begin(), data.end());
    return out;
  }
};

inline const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

// One mesh with one primitive (a unit square in the xy plane), one node, one scene, one material. Accessors: 0
// POSITION, 1 indices.
inline Gltf square() {
  Gltf g;
  const int positions = g.accessor(kSquare, "VEC3", kF32, 4);
  const int indices = g.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", kU16, 6);
  g.root["materials"] = {{{"name", "paint"}}};
  g.root["meshes"] = {
      {{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}}}}}};
  g.root["nodes"] = {{{"mesh", 0}}};
  g.root["scenes"] = {{{"nodes", {0}}}};
  g.root["scene"] = 0;
  return g;
}

inline json& primitive(Gltf& g) {
  return g.root["meshes"][0]["primitives"][0];
}

inline Scene read(const Gltf& g) {
  const Folder folder;
  return render::read_gltf(folder.write("scene.gltf", g.text()));
}

// The error's field and a word of its reason; the file must be the one read, the message one line.
inline void expect_refused(const std::string& path, const std::string& field, const std::string& word) {
  try {
    (void)render::read_gltf(path);
    ADD_FAILURE() << "accepted; expected an error at '" << field << "'";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), path);
    EXPECT_EQ(error.field(), field) << error.reason();
    EXPECT_NE(error.reason().find(word), std::string::npos) << error.reason();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

inline void expect_refused(const Gltf& g, const std::string& field, const std::string& word) {
  SCOPED_TRACE(field + " / " + word);
  const Folder folder;
  expect_refused(folder.write("scene.gltf", g.text()), field, word);
}

inline glm::vec3 corner(const Scene& scene, std::size_t triangle, int i) {
  return scene.vertices[scene.triangles[triangle][i]].position;
}

inline glm::vec3 face(const Scene& scene, std::size_t t) {
  return glm::normalize(
      glm::cross(corner(scene, t, 1) - corner(scene, t, 0), corner(scene, t, 2) - corner(scene, t, 0)));
}

inline void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-6F) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

inline Bytes png(int width, int height, const Bytes& rgba) {
  Bytes out;
  stbi_write_png_to_func(
      [](void* to, void* data, int size) {
        const auto* p = static_cast<const std::uint8_t*>(data);
        static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), p, p + size);
      },
      &out, width, height, 4, rgba.data(), width * 4);
  return out;
}

inline const Bytes kTwoPixels = {255, 0, 0, 255, 0, 128, 64, 255};

// The square with TEXCOORD_0 and a 2 x 1 base colour texture; image 0, texture 0.
inline Gltf textured() {
  Gltf g = square();
  primitive(g)["attributes"]["TEXCOORD_0"] = g.accessor(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", kF32, 4);
  g.root["images"] = {{{"bufferView", g.view(png(2, 1, kTwoPixels))}, {"mimeType", "image/png"}}};
  g.root["textures"] = {{{"source", 0}}};
  g.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return g;
}

inline Gltf sparse_square() {
  Gltf g = square();
  const int places = g.view(bytes_of(std::vector<std::uint8_t>{2}));
  const int values = g.view(bytes_of(std::vector<float>{5, 6, 7}));
  g.root["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", places}, {"componentType", kU8}}},
                                      {"values", {{"bufferView", values}}}};
  return g;
}

inline Gltf with_light(const json& light, const json& node) {
  Gltf g = square();
  g.root["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  json placed = node;
  placed["extensions"]["KHR_lights_punctual"]["light"] = 0;
  g.root["nodes"].push_back(placed);
  g.root["scenes"][0]["nodes"] = {0, 1};
  return g;
}

}  // namespace gltf_fixture
