// What read_gltf refuses: each kind of damage, with the field that the error must name.
#include <functional>
#include <limits>

#include "tests/unit/gltf_fixture.hpp"

namespace {

using namespace gltf_fixture;  // NOLINT(google-build-using-namespace)

TEST(GltfReaderDamage, files) {
  const Folder folder;
  expect_refused((folder.path() / "absent.gltf").string(), "", "cannot be read: No such file or directory");
  expect_refused(folder.path().string(), "", "cannot be read: Is a directory");
  expect_refused(folder.write("empty.gltf", ""), "", "is empty");
  expect_refused(folder.write("words.gltf", "not a scene"), "", "not valid JSON");
  expect_refused(folder.write("list.gltf", "[1, 2]"), "", "an object");
  const std::string text = square().text();
  expect_refused(folder.write("half.gltf", text.substr(0, text.size() / 2)), "", "not valid JSON");
  expect_refused(folder.write("infinite.gltf", R"({"asset": {"version": "2.0", "x": 1e999}})"), "", "not valid JSON");
  const std::string nested = R"({"asset": {"version": "2.0", "extras": )" + std::string(100000, '[');
  expect_refused(folder.write("nested.gltf", nested), "", "64");
}

// Small files, or files that take no room on the disk, that would take gigabytes of memory or hours.
TEST(GltfReaderDamage, more_than_a_scene_may_hold) {
  const Folder folder;
  const std::string big = folder.write("big.gltf", "{");
  fs::resize_file(big, (std::uintmax_t{1} << 29) + 1);
  expect_refused(big, "", "512 MiB");

  Gltf g = square();
  constexpr std::size_t kHalf = 300'000'000;
  fs::resize_file(folder.write("zeros.bin", ""), kHalf);
  for (int i = 0; i < 2; ++i) g.root["buffers"].push_back({{"byteLength", kHalf}, {"uri", "zeros.bin"}});
  const std::string own = std::to_string(g.text().size() + 2 * kHalf);
  expect_refused(folder.write("twice.gltf", g.text()), "buffers[1].byteLength", ("to " + own + " bytes").c_str());

  std::string values = R"({"asset": {"version": "2.0"}, "extras": [0)";
  for (int i = 0; i < 1 << 22; ++i) values += ",0";
  expect_refused(folder.write("values.gltf", values + "]}"), "", "4194304 are allowed");

  g = square();
  g.root["materials"] = json(400'000, json::object());
  expect_refused(g, "materials", "400000 elements");

  g = with_light({{"type", "point"}}, json::object());
  const json lit = g.root["nodes"][1];
  for (std::size_t i = 2; i < 1026; ++i) {
    g.root["nodes"].push_back(lit);
    g.root["scenes"][0]["nodes"].push_back(i);
  }
  expect_refused(g, "nodes[1025].extensions.KHR_lights_punctual", "1024 are allowed");
}

TEST(GltfReaderDamage, other_versions) {
  Gltf g = square();
  for (const char* other : {"1.0", "3.0", "20.0", "two"}) {
    g.root["asset"]["version"] = other;
    expect_refused(g, "asset.version", "glTF 2.0 is allowed");
  }
  // As the files of version 1 are, whose collections have names: their shape is not what is wrong with them.
  g.root["asset"]["version"] = "1.0";
  g.root["buffers"] = {{"square", {{"byteLength", 60}, {"uri", "square.bin"}}}};
  expect_refused(g, "asset.version", "is 1.0");
  g = square();
  g.root["asset"]["version"] = "2.1";
  EXPECT_EQ(read(g).triangles.size(), 2U) << "what a minor version adds may be passed over";
  g.root["asset"]["minVersion"] = "2.0";
  EXPECT_EQ(read(g).triangles.size(), 2U);
  g.root["asset"]["minVersion"] = "2.1";
  expect_refused(g, "asset.minVersion", "is 2.1");
}

TEST(GltfReaderDamage, binary_containers) {
  const Folder folder;
  const Bytes good = square().glb();
  const auto refused = [&](std::size_t at, std::uint32_t word, const char* reason) {
    Bytes bytes = good;
    std::memcpy(&bytes[at], &word, 4);
    expect_refused(folder.write("scene.glb", bytes.data(), bytes.size()), "", reason);
  };
  refused(4, 1, "version 2");
  refused(8, 0xFFFFFFF0U, "truncated");
  refused(12, 0xFFFFFFF0U, "chunk");
  refused(16, 0x004E4942, "JSON chunk");
  // tinygltf lets the last chunk reach 8 bytes beyond the end.
  std::uint32_t json_size = 0;
  std::memcpy(&json_size, &good[12], 4);
  const std::size_t chunk = 20 + json_size;
  std::uint32_t bin_size = 0;
  std::memcpy(&bin_size, &good[chunk], 4);
  refused(chunk, bin_size + 8, "chunk");
}

// A square with enough of everything to be cut anywhere: more than 20 kB.
Gltf large() {
  Gltf g = textured();
  Bytes noise(std::size_t{64} * 64 * 4);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : noise) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  g.root["images"][0]["bufferView"] = g.view(png(64, 64, noise));
  return g;
}

TEST(GltfReaderDamage, every_truncation_of_a_binary_file_is_refused) {
  const Folder folder;
  const Bytes good = large().glb();
  ASSERT_GT(good.size(), 10000U);
  for (std::size_t size = 0; size < good.size(); size += 97) {
    const std::string path = folder.write("scene.glb", good.data(), size);
    expect_refused(path, "", size == 0 ? "is empty" : size < 4 ? "JSON" : "truncated");
  }
}

// The same with a header that admits the new length: it either reads or throws InputError.
TEST(GltfReaderDamage, every_truncation_with_an_honest_header_reads_or_is_refused) {
  const Folder folder;
  const Bytes good = large().glb();
  std::size_t refused = 0, tried = 0;
  for (std::size_t size = 20; size < good.size(); size += 97) {
    ++tried;
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    std::memcpy(&bytes[8], &size, 4);
    try {
      (void)render::read_gltf(folder.write("scene.glb", bytes.data(), bytes.size()));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_EQ(refused, tried) << "the last chunk always reaches beyond the end";
}

// Every byte of the JSON and of the data damaged in turn: nothing but InputError may come out.
TEST(GltfReaderDamage, any_changed_byte_reads_or_is_refused) {
  const Folder folder;
  const Bytes good = textured().glb();
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    Bytes bytes = good;
    bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (i % 2 == 0 ? 0x10U : 0x01U));
    try {
      (void)render::read_gltf(folder.write("scene.glb", bytes.data(), bytes.size()));
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, good.size() / 4);
}

struct Damage {
  std::function<void(json&)> change;
  const char* field;
  const char* word;
};

void expect_each_refused(const Gltf& good, const std::vector<Damage>& damages) {
  ASSERT_NO_THROW((void)read(good));
  for (const Damage& damage : damages) {
    Gltf g = good;
    damage.change(g.root);
    expect_refused(g, damage.field, damage.word);
  }
}

TEST(GltfReaderDamage, indices_that_lead_nowhere) {
  expect_each_refused(
      textured(), {{[](json& r) { r["scene"] = 1; }, "scene", "1 scenes"},
                   {[](json& r) {
                      r["scenes"][0]["nodes"] = {0, 9};
                    },
                    "scenes[0].nodes[1]", "1 nodes"},
                   {[](json& r) { r["nodes"][0]["mesh"] = 3; }, "nodes[0].mesh", "1 meshes"},
                   {[](json& r) { r["nodes"][0]["mesh"] = -1; }, "nodes[0].mesh", "whole number"},
                   {[](json& r) { r["nodes"][0]["mesh"] = 4294967296; }, "nodes[0].mesh", "whole number"},
                   {[](json& r) { r["nodes"][0]["camera"] = 0; }, "nodes[0].camera", "0 cameras"},
                   {[](json& r) { r["nodes"][0]["children"] = {5}; }, "nodes[0].children[0]", "1 nodes"},
                   {[](json& r) { r["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0; },
                    "nodes[0].extensions.KHR_lights_punctual.light", "0 lights"},
                   {[](json& r) { r["meshes"][0]["primitives"][0]["indices"] = 99; }, "meshes[0].primitives[0].indices",
                    "accessors"},
                   {[](json& r) { r["meshes"][0]["primitives"][0]["material"] = 1; },
                    "meshes[0].primitives[0].material", "1 materials"},
                   {[](json& r) { r["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 77; },
                    "meshes[0].primitives[0].attributes.POSITION", "accessors"},
                   {[](json& r) { r["accessors"][0]["bufferView"] = 50; }, "accessors[0].bufferView", "bufferViews"},
                   {[](json& r) { r["bufferViews"][0]["buffer"] = 1; }, "bufferViews[0].buffer", "buffers"},
                   {[](json& r) { r["textures"][0]["source"] = 4; }, "textures[0].source", "1 images"},
                   {[](json& r) { r["textures"][0]["sampler"] = 0; }, "textures[0].sampler", "0 samplers"},
                   {[](json& r) { r["images"][0]["bufferView"] = 44; }, "images[0].bufferView", "bufferViews"},
                   {[](json& r) { r["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 2; },
                    "materials[0].pbrMetallicRoughness.baseColorTexture.index", "1 textures"}});
}

TEST(GltfReaderDamage, values_of_the_wrong_type_or_length) {
  expect_each_refused(
      square(),
      {{[](json& r) { r.erase("asset"); }, "asset", "missing"},
       {[](json& r) { r["asset"].erase("version"); }, "asset.version", "missing"},
       {[](json& r) { r["meshes"] = 4; }, "meshes", "an array"},
       {[](json& r) { r["meshes"][0] = "m"; }, "meshes[0]", "an object"},
       {[](json& r) { r["meshes"][0].erase("primitives"); }, "meshes[0].primitives", "missing"},
       {[](json& r) { r["meshes"][0]["primitives"][0].erase("attributes"); }, "meshes[0].primitives[0].attributes",
        "missing"},
       {[](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 7; }, "meshes[0].primitives[0].mode", "0 to 6"},
       {[](json& r) { r["nodes"][0]["mesh"] = "0"; }, "nodes[0].mesh", "whole number"},
       {[](json& r) { r["nodes"][0]["mesh"] = 0.5; }, "nodes[0].mesh", "whole number"},
       {[](json& r) {
          r["nodes"][0]["translation"] = {1, 2};
        },
        "nodes[0].translation", "3 are required"},
       {[](json& r) {
          r["nodes"][0]["translation"] = {1, "2", 3};
        },
        "nodes[0].translation[1]", "a number"},
       {[](json& r) {
          r["nodes"][0]["matrix"] = {1, 2, 3};
        },
        "nodes[0].matrix", "16 are required"},
       {[](json& r) { r["accessors"][0]["normalized"] = 1; }, "accessors[0].normalized", "true or false"},
       {[](json& r) { r["accessors"][0].erase("count"); }, "accessors[0].count", "missing"},
       {[](json& r) { r["accessors"][0]["count"] = -4; }, "accessors[0].count", "whole number"},
       {[](json& r) { r["materials"][0]["name"] = 5; }, "materials[0].name", "a string"},
       {[](json& r) { r["materials"][0]["doubleSided"] = "yes"; }, "materials[0].doubleSided", "true or false"},
       {[](json& r) { r["bufferViews"][0]["byteOffset"] = "0"; }, "bufferViews[0].byteOffset", "whole number"},
       {[](json& r) { r["asset"]["extras"]["vergence"] = 3; }, "asset.extras.vergence", "an object"},
       {[](json& r) {
          r["asset"]["extras"]["vergence"]["ambient"] = {1, 1};
        },
        "asset.extras.vergence.ambient", "3"},
       {[](json& r) {
          r["asset"]["extras"]["vergence"]["ambient"] = {1, 1, -1};
        },
        "asset.extras.vergence.ambient[2]", "0 or more"}});
}

TEST(GltfReaderDamage, ranges_of_views_and_accessors) {
  const char* position = "meshes[0].primitives[0].attributes.POSITION";
  const char* indices = "meshes[0].primitives[0].indices";
  expect_each_refused(
      square(),
      {{[](json& r) { r["bufferViews"][0]["byteLength"] = 4000; }, "bufferViews[0].byteLength", "60 bytes"},
       {[](json& r) { r["bufferViews"][0]["byteOffset"] = 2147483647; }, "bufferViews[0].byteLength", "60 bytes"},
       {[](json& r) { r["accessors"][0]["count"] = 5; }, position, "need 60 bytes"},
       {[](json& r) { r["accessors"][0]["count"] = 2147483647; }, position, "bytes"},
       {[](json& r) { r["accessors"][0]["count"] = 0; }, position, "at least 1"},
       {[](json& r) { r["accessors"][0]["byteOffset"] = 4; }, position, "need 52 bytes"},
       {[](json& r) { r["bufferViews"][0]["byteStride"] = 16; }, position, "need 60 bytes"},
       {[](json& r) { r["bufferViews"][0]["byteStride"] = 8; }, position, "overlap"},
       {[](json& r) { r["accessors"][1]["count"] = 9; }, indices, "bytes"},
       {[](json& r) { r["accessors"][1]["count"] = 5; }, indices, "multiple of 3"},
       {[](json& r) { r["accessors"][1]["componentType"] = kI16; }, indices, "5125"},
       {[](json& r) { r["accessors"][1]["componentType"] = kF32, r["accessors"][1]["count"] = 3; }, indices, "5125"},
       {[](json& r) { r["accessors"][1]["type"] = "VEC2"; }, indices, "SCALAR"},
       {[](json& r) { r["accessors"][0]["type"] = "VEC4"; }, position, "VEC3"},
       {[](json& r) { r["accessors"][0]["componentType"] = kU32; }, position, "5126"},
       {[](json& r) { r["accessors"][0].erase("bufferView"), r["accessors"][0]["count"] = 2000000000; }, position,
        "16777216"},
       {[](json& r) { r["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }, position, "missing"},
       {[](json& r) { r["accessors"][0]["count"] = 3; }, indices, "index 3 at element 5"},
       {[](json& r) { r["meshes"][0]["primitives"][0]["mode"] = 5, r["accessors"][1]["count"] = 2; }, indices,
        "at least 3"}});
}

TEST(GltfReaderDamage, sparse_parts) {
  const char* position = "meshes[0].primitives[0].attributes.POSITION";
  expect_each_refused(
      sparse_square(),
      {{[](json& r) { r["accessors"][0]["sparse"]["count"] = 5; }, position, "sparse.count"},
       {[](json& r) { r["accessors"][0]["sparse"]["count"] = 0; }, position, "sparse.count"},
       {[](json& r) { r["accessors"][0]["sparse"]["count"] = 2; }, position, "bytes"},
       {[](json& r) { r["accessors"][0]["sparse"]["indices"]["componentType"] = kF32; }, position, "componentType"},
       {[](json& r) { r["accessors"][0]["sparse"]["indices"]["bufferView"] = 9; },
        "accessors[0].sparse.indices.bufferView", "bufferViews"},
       {[](json& r) { r["accessors"][0]["sparse"].erase("values"); }, "accessors[0].sparse.values", "missing"}});
  Gltf g = square();
  g.root["accessors"][0]["sparse"] = {{"count", 1},
                                      {"indices", {{"bufferView", g.view({4})}, {"componentType", kU8}}},
                                      {"values", {{"bufferView", g.view(bytes_of(std::vector<float>{5, 6, 7}))}}}};
  expect_refused(g, position, "sparse index 4");
}

TEST(GltfReaderDamage, numbers_that_are_not_finite_or_too_far) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (const float bad : {inf, -inf, nan, 2e9F}) {
    std::vector<float> values = kSquare;
    values[7] = bad;
    const bool far = std::isfinite(bad);
    Gltf g = square();
    primitive(g)["attributes"]["POSITION"] = g.accessor(values, "VEC3", kF32, 4);
    expect_refused(g, "meshes[0].primitives[0].attributes.POSITION", far ? "1e9" : "element 2 is not finite");
    if (far) continue;
    Gltf n = square();
    primitive(n)["attributes"]["NORMAL"] = n.accessor(values, "VEC3", kF32, 4);
    expect_refused(n, "meshes[0].primitives[0].attributes.NORMAL", "element 2 is not finite");
    Gltf t = square();
    primitive(t)["attributes"]["TEXCOORD_0"] =
        t.accessor(std::vector<float>{0, 0, 0, bad, 0, 0, 0, 0}, "VEC2", kF32, 4);
    expect_refused(t, "meshes[0].primitives[0].attributes.TEXCOORD_0", "element 1 is not finite");
  }
  Gltf g = square();
  primitive(g)["attributes"]["NORMAL"] = g.accessor(std::vector<float>{0, 0, 1}, "VEC3", kF32, 1);
  expect_refused(g, "meshes[0].primitives[0].attributes.NORMAL", "POSITION has 4");
}

TEST(GltfReaderDamage, node_trees) {
  Gltf good = square();
  good.root["nodes"] = {{{"children", {1}}}, {{"children", {2}}}, {{"mesh", 0}}};
  expect_each_refused(good, {{[](json& r) { r["nodes"][2]["children"] = {0}; }, "nodes[0]", "own descendant"},
                             {[](json& r) { r["nodes"][0]["children"] = {0}; }, "nodes[0]", "own descendant"},
                             {[](json& r) {
                                r["nodes"][0]["children"] = {1, 2};
                              },
                              "nodes[1].children[0]", "one parent"},
                             {[](json& r) {
                                r["scenes"][0]["nodes"] = {0, 2};
                              },
                              "scenes[0].nodes[1]", "has a parent"},
                             {[](json& r) {
                                r["scenes"][0]["nodes"] = {0, 0};
                              },
                              "scenes[0].nodes[1]", "twice"},
                             {[](json& r) {
                                for (int i = 3; i < 400; ++i) r["nodes"].push_back({{"children", {i + 1}}});
                                r["nodes"].push_back(json::object());
                              },
                              "nodes[259]", "256 levels"},
                             {[](json& r) { r["nodes"][2].erase("mesh"); }, "meshes", "no triangles"}});
}

TEST(GltfReaderDamage, transforms) {
  expect_each_refused(square(),
                      {{[](json& r) {
                          r["nodes"][0]["rotation"] = {0, 0, 0, 0};
                        },
                        "nodes[0].rotation", "unit quaternion"},
                       {[](json& r) {
                          r["nodes"][0]["rotation"] = {0, 0, 0, 2};
                        },
                        "nodes[0].rotation", "unit quaternion"},
                       {[](json& r) {
                          r["nodes"][0]["scale"] = {1e300, 1, 1};
                        },
                        "nodes[0].scale[0]", "1e30"},
                       {[](json& r) {
                          r["nodes"][0]["translation"] = {1e10, 0, 0};
                        },
                        "nodes[0]", "outside the world"},
                       {[](json& r) {
                          r["nodes"][0]["scale"] = {1e10, 1, 1};
                        },
                        "meshes[0].primitives[0].attributes.POSITION", "1e9"},
                       {[](json& r) { r["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
                        "nodes[0].matrix", "affine"}});
}

TEST(GltfReaderDamage, lights_cameras_and_targets) {
  const Gltf spot =
      with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}}, json::object());
  const std::string light = "extensions.KHR_lights_punctual.lights[0]";
  const auto of = [](json& r) -> json& { return r["extensions"]["KHR_lights_punctual"]["lights"][0]; };
  const std::string type = light + ".type", intensity = light + ".intensity", colour = light + ".color";
  const std::string colour_0 = colour + "[0]", range = light + ".range", inner = light + ".spot.innerConeAngle";
  const std::string outer = light + ".spot.outerConeAngle";
  expect_each_refused(
      spot, {{[&](json& r) { of(r)["type"] = "laser"; }, type.c_str(), "directional, point and spot"},
             {[&](json& r) { of(r).erase("type"); }, type.c_str(), "missing"},
             {[&](json& r) { of(r)["intensity"] = -1; }, intensity.c_str(), "0 or more"},
             {[&](json& r) { of(r)["intensity"] = "bright"; }, intensity.c_str(), "a number"},
             {[&](json& r) {
                of(r)["color"] = {1, 1};
              },
              colour.c_str(), "3 are required"},
             {[&](json& r) {
                of(r)["color"] = {-1, 1, 1};
              },
              colour_0.c_str(), "0 or more"},
             {[&](json& r) { of(r)["range"] = -2; }, range.c_str(), "more than 0"},
             {[&](json& r) { of(r)["spot"]["innerConeAngle"] = 0.2; }, inner.c_str(), "less than outerConeAngle"},
             {[&](json& r) { of(r)["spot"]["outerConeAngle"] = 2; }, outer.c_str(), "pi/2"},
             {[](json& r) {
                r["nodes"][1]["scale"] = {1, 1, 0};
              },
              "nodes[1]", "direction"},
             {[](json& r) { r["nodes"][1]["extras"]["target"] = true; }, "nodes[1].name", "missing"},
             {[](json& r) {
                r["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
                r["nodes"][0]["camera"] = 0;
                r["nodes"][0]["scale"] = {1, 0, 1};
              },
              "nodes[0]", "upright"},
             {[](json& r) {
                for (std::size_t i = 0; i < 2; ++i)
                  r["nodes"][i].update({{"name", "a"}, {"extras", {{"target", true}}}});
              },
              "nodes[1].name", "another target"}});
}

TEST(GltfReaderDamage, materials_and_images) {
  Gltf good = textured();
  good.root["textures"][0]["sampler"] = 0;
  good.root["samplers"] = {{{"wrapS", 10497}}};
  const char* emissive = "materials[0].extensions.KHR_materials_emissive_strength.emissiveStrength";
  expect_each_refused(
      good,
      {{[](json& r) {
          r["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1.5, 1};
        },
        "materials[0].pbrMetallicRoughness.baseColorFactor[2]", "0 to 1"},
       {[](json& r) {
          r["materials"][0]["emissiveFactor"] = {-0.5, 0, 0};
        },
        "materials[0].emissiveFactor[0]", "0 to 1"},
       {[](json& r) { r["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = -1; },
        emissive, "0 or more"},
       {[](json& r) { r["samplers"][0]["wrapS"] = 5; }, "samplers[0].wrapS", "33648"},
       {[](json& r) { r["textures"][0].erase("source"); }, "textures[0].source", "missing"},
       {[](json& r) {
          r["images"][0] = {{"bufferView", 0}};
        },
        "images[0].bufferView", "neither PNG nor JPEG"},
       {[](json& r) {
          r["images"][0] = {{"uri", "absent.png"}};
        },
        "images[0].uri", "No such file"},
       {[](json& r) { r["bufferViews"][3]["byteLength"] = 40; }, "images[0].bufferView", "cannot be decoded"}});
  Gltf wide = textured();
  wide.root["images"][0]["bufferView"] = wide.view(png(16385, 1, Bytes(std::size_t{16385} * 4)));
  expect_refused(wide, "images[0].bufferView", "16384");
}

TEST(GltfReaderDamage, files_outside_the_folder) {
  const Folder outer;
  fs::create_directory(outer.path() / "inner");
  Gltf g = square();
  (void)outer.write("square.bin", g.bin.data(), g.bin.size());
  fs::create_symlink(outer.path() / "square.bin", outer.path() / "inner" / "link.bin");
  const std::string absolute = (outer.path() / "square.bin").string();
  for (const std::string& uri :
       {std::string("../square.bin"), std::string("%2e%2e/square.bin"), std::string("x/../../square.bin"), absolute,
        "file://" + absolute, std::string("http://example.org/square.bin"), std::string("..\\square.bin"),
        std::string("link.bin")}) {
    SCOPED_TRACE(uri);
    g.root["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    expect_refused(outer.write("inner/scene.gltf", g.text()), "buffers[0].uri", "own folder");
    Gltf image = textured();
    image.root["images"][0] = {{"uri", uri}};
    expect_refused(outer.write("inner/scene.gltf", image.text()), "images[0].uri", "own folder");
  }
}

TEST(GltfReaderDamage, buffers) {
  const Folder folder;
  Gltf g = square();
  (void)folder.write("square.bin", g.bin.data(), g.bin.size() - 1);
  const auto refused = [&](const json& buffer, const char* field, const char* word) {
    g.root["buffers"] = {buffer};
    expect_refused(folder.write("scene.gltf", g.text()), field, word);
  };
  refused({{"byteLength", 60}, {"uri", "absent.bin"}}, "buffers[0].uri", "No such file");
  refused({{"byteLength", 60}, {"uri", "."}}, "buffers[0].uri", "regular file");
  refused({{"byteLength", 60}, {"uri", "square.bin"}}, "buffers[0].byteLength", "59 bytes");
  refused({{"byteLength", 60}}, "buffers[0].uri", "missing");
  refused({{"byteLength", 0}, {"uri", "square.bin"}}, "buffers[0].byteLength", "at least 1");
  refused({{"byteLength", 60}, {"uri", "data:application/octet-stream;base64,AAAA"}}, "", "not a valid glTF");
}

TEST(GltfReaderDamage, unknown_required_extensions_are_named) {
  Gltf g = square();
  g.root["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(read(g).triangles.size(), 2U) << "used, but not required";
  g.root["extensionsRequired"] = {"KHR_lights_punctual", "KHR_draco_mesh_compression"};
  expect_refused(g, "extensionsRequired[1]", "KHR_draco_mesh_compression");
}

}  // namespace
