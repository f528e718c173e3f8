// Three good files cut off at every 997th byte: each is refused with one line, and none takes long or much memory.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <random>

#include "tests/unit/gltf_fixture.hpp"

namespace {

using gltf_fixture::Bytes;
using gltf_fixture::Folder;
using gltf_fixture::Gltf;
namespace fs = std::filesystem;

constexpr std::size_t kStep = 997;

// Cuts the file from its end on, so that it is written once; returns how many were tried.
template <class Read>
std::size_t cut(const std::string& path, std::size_t step, Read&& read) {
  std::size_t tried = 0;
  const std::size_t size = fs::file_size(path);
  for (std::size_t i = (size - 1) / step + 1; i-- > 0; ++tried) {
    fs::resize_file(path, i * step);
    read(i * step);
  }
  return tried;
}

void expect_refused(const std::string& scene, std::size_t size) {
  try {
    (void)render::read_gltf(scene);
    ADD_FAILURE() << scene << " accepted with " << size << " bytes";
  } catch (const tracking::InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_LT(what.size(), 1000U) << what;
  }
}

Bytes noise(std::size_t count) {
  std::mt19937 random(5);
  Bytes bytes(count);
  std::ranges::generate(bytes, [&] { return static_cast<std::uint8_t>(random() & 255U); });
  return bytes;
}

// A square many times over, with a picture that does not compress.
Gltf rich() {
  Gltf g = gltf_fixture::square();
  gltf_fixture::primitive(g)["attributes"]["TEXCOORD_0"] =
      g.accessor(std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", gltf_fixture::kF32, 4);
  g.root["textures"] = {{{"source", 0}}};
  g.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  for (int i = 0; i < 100; ++i) {
    g.root["scenes"][0]["nodes"].push_back(g.add("nodes", {{"mesh", 0}, {"name", "square " + std::to_string(i)}}));
  }
  return g;
}

class GltfTruncation : public ::testing::Test {
 protected:
  void TearDown() override {
#ifndef __SANITIZE_ADDRESS__  // which keeps freed memory for a while
    rusage usage{};
    ASSERT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
    EXPECT_LT(usage.ru_maxrss, 2L << 20) << "KiB";
#endif
  }
};

TEST_F(GltfTruncation, TheReadingRoom) {
  const Folder folder;
  const std::string path = (folder.path() / "room.glb").string();
  fs::copy_file(VERGENCE_BUILT_ASSETS "/reading_room.glb", path);
  const std::size_t tried = cut(path, kStep, [&](std::size_t size) { expect_refused(path, size); });
  EXPECT_GT(tried, 5000U);
}

// The same with a header and a last chunk that admit the new length, so that what they hold is what is missing.
TEST_F(GltfTruncation, TheReadingRoomWithAnHonestHeader) {
  const Folder folder;
  const std::string path = (folder.path() / "room.glb").string();
  fs::copy_file(VERGENCE_BUILT_ASSETS "/reading_room.glb", path);
  std::uint32_t json = 0;
  {
    std::ifstream in(path, std::ios::binary);
    in.seekg(12);
    in.read(reinterpret_cast<char*>(&json), 4);
  }
  (void)cut(path, kStep * 401, [&](std::size_t size) {
    const auto put = [&](std::size_t at, std::size_t value) {
      std::fstream out(path, std::ios::binary | std::ios::in | std::ios::out);
      const auto word = static_cast<std::uint32_t>(value);
      out.seekp(static_cast<std::streamoff>(at));
      out.write(reinterpret_cast<const char*>(&word), 4);
    };
    if (size > json + 28) {
      put(8, size);
      put(20 + json, size - 28 - json);
    }
    expect_refused(path, size);
  });
}

TEST_F(GltfTruncation, ATextFileWithExternalFiles) {
  Gltf g = rich();
  const Bytes image = gltf_fixture::png(64, 64, noise(64 * 64 * 4));
  const Bytes bin = [&] {
    Bytes bytes = g.bin;
    bytes.resize(20000, 0);
    return bytes;
  }();
  g.root["buffers"] = {{{"byteLength", bin.size()}, {"uri", "scene.bin"}}};
  g.root["images"] = {{{"uri", "picture.png"}}};
  const Folder folder;
  const auto write_all = [&] {
    (void)folder.write("scene.bin", bin.data(), bin.size());
    (void)folder.write("picture.png", image.data(), image.size());
    return folder.write("scene.gltf", g.text());
  };
  std::size_t tried = 0;
  for (const char* victim : {"scene.gltf", "scene.bin", "picture.png"}) {
    const std::string scene = write_all();
    EXPECT_EQ(render::read_gltf(scene).triangles.size(), 202U);
    tried += cut((folder.path() / victim).string(), kStep, [&](std::size_t size) { expect_refused(scene, size); });
  }
  EXPECT_GT(tried, 40U);
}

TEST_F(GltfTruncation, ASmallBinaryFile) {
  Gltf g = rich();
  g.root["images"] = {
      {{"bufferView", g.view(gltf_fixture::png(64, 64, noise(64 * 64 * 4)))}, {"mimeType", "image/png"}}};
  const Bytes good = g.glb();
  const Folder folder;
  const std::string path = folder.write("scene.glb", good.data(), good.size());
  EXPECT_EQ(render::read_gltf(path).triangles.size(), 202U);
  EXPECT_GT(cut(path, kStep, [&](std::size_t size) { expect_refused(path, size); }), 15U);
}

// A small file may name the same mesh often and the same numbers often; memory and time stay bounded.
TEST_F(GltfTruncation, SmallFilesThatAskForMuch) {
  Gltf many = gltf_fixture::square();
  gltf_fixture::primitive(many)["indices"] =
      many.accessor(std::vector<std::uint16_t>(300000, 1), "SCALAR", gltf_fixture::kU16, 300000);
  many.root["nodes"] = gltf_fixture::json::array();
  many.root["scenes"][0]["nodes"] = gltf_fixture::json::array();
  for (int i = 0; i < 3000; ++i) {
    many.root["nodes"].push_back({{"mesh", 0}});
    many.root["scenes"][0]["nodes"].push_back(i);
  }
  gltf_fixture::expect_refused(many, "meshes[0].primitives[0]", "1073741824 are allowed");

  Gltf zeros = gltf_fixture::square();
  const int none = zeros.add("accessors", {{"componentType", 5126}, {"count", 1 << 24}, {"type", "VEC3"}});
  gltf_fixture::json& primitives = zeros.root["meshes"][0]["primitives"];
  primitives[0]["attributes"]["POSITION"] = none;
  for (int i = 0; i < 200; ++i) primitives.push_back(primitives[0]);
  gltf_fixture::expect_refused(zeros, "meshes[0].primitives[15].attributes.POSITION", "268435456 are allowed");
}

}  // namespace
