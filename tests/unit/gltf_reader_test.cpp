// What read_gltf reads: each feature on a hand-made file.
#include "render/scene/framing.hpp"
#include "tests/unit/gltf_fixture.hpp"

namespace {

using namespace gltf_fixture;  // NOLINT(google-build-using-namespace)

TEST(GltfReader, a_square) {
  const Scene scene = read(square());
  ASSERT_EQ(scene.triangles.size(), 2U);
  EXPECT_EQ(scene.triangle_material, (std::vector<std::uint32_t>{0, 0}));
  expect_near(corner(scene, 0, 2), {1, 1, 0});
  expect_near(corner(scene, 1, 2), {0, 1, 0});
  for (const auto& vertex : scene.vertices) expect_near(vertex.normal, {0, 0, 1});
  EXPECT_EQ(scene.materials.at(0).name, "paint");
  EXPECT_FALSE(scene.start_pose());
  EXPECT_EQ(scene.lights.size(), 1U) << "the sun of a file without any";
}

TEST(GltfReader, the_binary_container_reads_the_same) {
  const Gltf g = textured();
  const Bytes glb = g.glb();
  const Folder folder;
  const Scene binary = render::read_gltf(folder.write("scene.glb", glb.data(), glb.size()));
  const Scene text = read(g);
  ASSERT_EQ(binary.vertices.size(), text.vertices.size());
  for (std::size_t i = 0; i < text.vertices.size(); ++i) {
    EXPECT_EQ(binary.vertices[i].position, text.vertices[i].position);
    EXPECT_EQ(binary.vertices[i].uv, text.vertices[i].uv);
  }
  EXPECT_EQ(binary.triangles, text.triangles);
  EXPECT_EQ(binary.textures.at(0).rgba, text.textures.at(0).rgba);
}

TEST(GltfReader, external_files_of_its_own_folder) {
  Gltf g = square();
  const Folder folder;
  fs::create_directory(folder.path() / "my parts");
  g.root["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", "my%20parts/./square.bin"}}};
  (void)folder.write("my parts/square.bin", g.bin.data(), g.bin.size());
  EXPECT_EQ(render::read_gltf(folder.write("scene.gltf", g.text())).triangles.size(), 2U);
}

TEST(GltfReader, indices_of_every_type_and_none) {
  for (const int type : {kU8, kU16, kU32}) {
    Gltf g = square();
    if (type == kU8) primitive(g)["indices"] = g.accessor(std::vector<std::uint8_t>{0, 1, 2}, "SCALAR", type, 3);
    if (type == kU16) primitive(g)["indices"] = g.accessor(std::vector<std::uint16_t>{0, 1, 2}, "SCALAR", type, 3);
    if (type == kU32) primitive(g)["indices"] = g.accessor(std::vector<std::uint32_t>{0, 1, 2}, "SCALAR", type, 3);
    const Scene scene = read(g);
    ASSERT_EQ(scene.triangles.size(), 1U);
    expect_near(corner(scene, 0, 1), {1, 0, 0});
  }
  Gltf g = square();
  primitive(g).erase("indices");
  g.root["accessors"][0]["count"] = 3;
  const Scene scene = read(g);
  ASSERT_EQ(scene.triangles.size(), 1U);
  expect_near(corner(scene, 0, 2), {1, 1, 0});
}

TEST(GltfReader, strips_and_fans_keep_their_winding) {
  Gltf strip = square();
  primitive(strip)["mode"] = 5;
  primitive(strip)["indices"] = strip.accessor(std::vector<std::uint16_t>{0, 1, 3, 2}, "SCALAR", kU16, 4);
  Gltf fan = square();
  primitive(fan)["mode"] = 6;
  primitive(fan)["indices"] = fan.accessor(std::vector<std::uint16_t>{0, 1, 2, 3}, "SCALAR", kU16, 4);
  for (const Gltf& g : {strip, fan}) {
    const Scene scene = read(g);
    ASSERT_EQ(scene.triangles.size(), 2U);
    for (std::size_t t = 0; t < 2; ++t) expect_near(face(scene, t), {0, 0, 1});
  }
}

TEST(GltfReader, points_and_lines_are_passed_over) {
  Gltf g = square();
  json line = primitive(g);
  line["mode"] = 1;
  g.root["meshes"][0]["primitives"].push_back(line);
  EXPECT_EQ(read(g).triangles.size(), 2U);
}

TEST(GltfReader, interleaved_attributes) {
  Gltf g = square();
  std::vector<float> interleaved;
  for (std::size_t i = 0; i < 4; ++i) {
    interleaved.insert(interleaved.end(), {kSquare[3 * i], kSquare[3 * i + 1], kSquare[3 * i + 2], 0, 0, 2});
  }
  const int view = g.view(bytes_of(interleaved), 24);
  primitive(g)["attributes"]["POSITION"] =
      g.add("accessors", {{"bufferView", view}, {"componentType", kF32}, {"count", 4}, {"type", "VEC3"}});
  primitive(g)["attributes"]["NORMAL"] = g.add(
      "accessors", {{"bufferView", view}, {"byteOffset", 12}, {"componentType", kF32}, {"count", 4}, {"type", "VEC3"}});
  const Scene scene = read(g);
  EXPECT_EQ(scene.vertices.size(), 4U) << "corners with normals share their vertices";
  expect_near(corner(scene, 1, 2), {0, 1, 0});
  expect_near(scene.vertices[0].normal, {0, 0, 1});
}

TEST(GltfReader, normals_are_made_unit_and_zero_ones_replaced_by_the_faces) {
  Gltf g = square();
  primitive(g)["attributes"]["NORMAL"] =
      g.accessor(std::vector<float>{0, 3, 4, 0, 0, 0, 0, 0, -5, 0, 0, 1}, "VEC3", kF32, 4);
  const Scene scene = read(g);
  const glm::uvec3 first = scene.triangles[0];
  expect_near(scene.vertices[first[0]].normal, {0, 0.6F, 0.8F});
  expect_near(scene.vertices[first[1]].normal, {0, 0, 1});
  expect_near(scene.vertices[first[2]].normal, {0, 0, -1});
}

TEST(GltfReader, texture_coordinates_of_three_types) {
  Gltf g = textured();
  EXPECT_EQ(read(g).vertices[1].uv, glm::vec2(1, 0));
  const auto use = [](Gltf& file, int accessor) {
    file.root["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
    primitive(file)["attributes"]["TEXCOORD_0"] = accessor;
  };
  Gltf bytes = textured();
  use(bytes,
      bytes.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 255, 51, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC2", kU8, 4, 4));
  EXPECT_FLOAT_EQ(read(bytes).vertices[1].uv.y, 0.2F);
  Gltf words = textured();
  use(words, words.accessor(std::vector<std::uint16_t>{0, 0, 65535, 13107, 0, 0, 0, 0}, "VEC2", kU16, 4));
  EXPECT_FLOAT_EQ(read(words).vertices[1].uv.y, 0.2F);
  EXPECT_FLOAT_EQ(read(words).vertices[1].uv.x, 1.0F);
}

TEST(GltfReader, quantised_positions_with_the_extension) {
  Gltf g = square();
  const int quantised =
      g.accessor(std::vector<std::int16_t>{0, 0, 0, 0, 16384, 0, 0, 0, -32768, 32767, 0, 0}, "VEC3", kI16, 3, 8);
  g.root["accessors"][static_cast<std::size_t>(quantised)]["normalized"] = true;
  primitive(g)["attributes"]["POSITION"] = quantised;
  primitive(g).erase("indices");
  expect_refused(g, "meshes[0].primitives[0].attributes.POSITION", "KHR_mesh_quantization");
  g.root["extensionsUsed"] = {"KHR_mesh_quantization"};
  g.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Scene scene = read(g);
  expect_near(corner(scene, 0, 1), {16384.0F / 32767.0F, 0, 0});
  expect_near(corner(scene, 0, 2), {-1, 1, 0});
  g.root["accessors"][static_cast<std::size_t>(quantised)]["normalized"] = false;
  expect_near(corner(read(g), 0, 1), {16384, 0, 0});
}

TEST(GltfReader, sparse_accessors_replace_elements) {
  const Scene scene = read(sparse_square());
  expect_near(corner(scene, 0, 2), {5, 6, 7});
  expect_near(corner(scene, 0, 1), {1, 0, 0});
  Gltf zeros = sparse_square();
  zeros.root["accessors"][0].erase("bufferView");
  const Scene flat = read(zeros);
  expect_near(corner(flat, 0, 2), {5, 6, 7});
  expect_near(corner(flat, 0, 1), {0, 0, 0});
}

TEST(GltfReader, node_transforms_compose_as_translation_rotation_scale) {
  Gltf g = square();
  const double h = std::sqrt(0.5);
  g.root["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}, {"rotation", {0, 0, h, h}}},
                     {{"mesh", 0}, {"translation", {0, 0, 3}}, {"scale", {2, 4, 1}}}};
  const Scene scene = read(g);
  // (1, 1, 0) -> scaled (2, 4, 0) -> (2, 4, 3) -> a quarter turn about z (-4, 2, 3) -> (6, 2, 3)
  expect_near(corner(scene, 0, 2), {6, 2, 3}, 1e-5F);
}

TEST(GltfReader, a_matrix_is_column_major) {
  Gltf g = square();
  g.root["nodes"][0]["matrix"] = {0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1};
  expect_near(corner(read(g), 0, 1), {7, 10, 9});
}

TEST(GltfReader, normals_go_with_the_inverse_transpose) {
  Gltf g = square();
  primitive(g)["attributes"]["NORMAL"] =
      g.accessor(std::vector<float>{1, 1, 0, 1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3", kF32, 4);
  g.root["nodes"][0]["scale"] = {2, 1, 1};
  expect_near(read(g).vertices[0].normal, glm::normalize(glm::vec3(0.5F, 1, 0)));
}

TEST(GltfReader, a_mirroring_transform_keeps_the_front_in_front) {
  Gltf g = square();
  primitive(g)["attributes"]["NORMAL"] =
      g.accessor(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", kF32, 4);
  g.root["nodes"][0]["scale"] = {-1, 1, 1};
  const Scene scene = read(g);
  for (std::size_t t = 0; t < 2; ++t) expect_near(face(scene, t), {0, 0, 1});
  expect_near(scene.vertices[0].normal, {0, 0, 1});
  g.root["nodes"][0]["scale"] = {1, 1, -1};
  expect_near(face(read(g), 0), {0, 0, -1});
  expect_near(read(g).vertices[0].normal, {0, 0, -1});
}

TEST(GltfReader, scenes_default_then_first_then_all_roots) {
  Gltf g = square();
  g.root["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"children", {2}}}, {{"mesh", 0}}};
  g.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  g.root["scene"] = 1;
  EXPECT_EQ(read(g).triangles.size(), 4U);
  g.root.erase("scene");
  EXPECT_EQ(read(g).triangles.size(), 2U);
  g.root.erase("scenes");
  EXPECT_EQ(read(g).triangles.size(), 6U);
}

TEST(GltfReader, materials) {
  Gltf g = textured();
  g.root["materials"][0]["doubleSided"] = true;
  g.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 0.4};
  g.root["materials"][0]["emissiveFactor"] = {0.5, 0.25, 1};
  g.root["materials"][0]["emissiveTexture"] = {{"index", 0}};
  g.root["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 8;
  const render::Material material = read(g).materials.at(0);
  EXPECT_EQ(material.base_colour, glm::vec4(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(material.emission, glm::vec3(4, 2, 8));
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.base_colour_texture.index, 0);
  EXPECT_EQ(material.emission_texture.index, 0) << "one texture decoded once";
}

TEST(GltfReader, a_primitive_without_material_is_white_and_dark) {
  Gltf g = square();
  primitive(g).erase("material");
  const Scene scene = read(g);
  const render::Material& material = scene.materials.at(scene.triangle_material[0]);
  EXPECT_EQ(material.base_colour, glm::vec4(1));
  EXPECT_EQ(material.emission, glm::vec3(0));
  EXPECT_EQ(material.name, "");
}

TEST(GltfReader, textures_from_a_view_a_file_and_a_data_uri) {
  const Bytes image = png(2, 1, kTwoPixels);
  Gltf g = textured();
  const Folder folder;
  (void)folder.write("pixels.png", image.data(), image.size());
  for (const json& source :
       {g.root["images"][0], json{{"uri", "pixels.png"}}, json{{"uri", "data:image/png;base64," + base64(image)}}}) {
    g.root["images"][0] = source;
    const Scene scene = render::read_gltf(folder.write("scene.gltf", g.text()));
    ASSERT_EQ(scene.textures.size(), 1U);
    EXPECT_EQ(scene.textures[0].width, 2U);
    EXPECT_EQ(scene.textures[0].height, 1U);
    EXPECT_EQ(scene.textures[0].rgba, kTwoPixels);
  }
}

TEST(GltfReader, sampler_wrap_modes) {
  using Wrap = render::Texture::Wrap;
  Gltf g = textured();
  EXPECT_EQ(read(g).textures[0].wrap_u, Wrap::repeat);
  g.root["textures"][0]["sampler"] = 0;
  g.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  EXPECT_EQ(read(g).textures[0].wrap_u, Wrap::clamp);
  EXPECT_EQ(read(g).textures[0].wrap_v, Wrap::mirror);
}

// glTF 2.0, section 3.9.2: what is not said is metallic 1 and roughness 1.
TEST(GltfReader, metallic_roughness_with_its_textures_and_defaults) {
  Gltf g = textured();
  EXPECT_EQ(read(g).materials[0].metallic, 1.0F);
  EXPECT_EQ(read(g).materials[0].roughness, 1.0F);
  json& material = g.root["materials"][0];
  material["pbrMetallicRoughness"]["metallicFactor"] = 0.25;
  material["pbrMetallicRoughness"]["roughnessFactor"] = 0.5;
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
  material["normalTexture"] = {{"index", 0}, {"scale", 0.75}};
  material["occlusionTexture"] = {{"index", 0}, {"strength", 0.5}};
  const render::Material m = read(g).materials[0];
  EXPECT_EQ(m.metallic, 0.25F);
  EXPECT_EQ(m.roughness, 0.5F);
  EXPECT_EQ(m.surface_texture.index, 0);
  EXPECT_EQ(m.normal_texture.index, 0);
  EXPECT_EQ(m.normal_scale, 0.75F);
  EXPECT_EQ(m.occlusion_texture.index, 0);
  EXPECT_EQ(m.occlusion_strength, 0.5F);
  material["pbrMetallicRoughness"]["roughnessFactor"] = 1.5;
  expect_refused(g, "materials[0].pbrMetallicRoughness.roughnessFactor", "0 to 1");
}

TEST(GltfReader, alpha_modes_and_unlit) {
  using Alpha = render::Material::Alpha;
  Gltf g = square();
  json& material = g.root["materials"][0];
  EXPECT_EQ(read(g).materials[0].alpha, Alpha::opaque);
  material["alphaMode"] = "MASK";
  EXPECT_EQ(read(g).materials[0].alpha, Alpha::mask);
  EXPECT_EQ(read(g).materials[0].alpha_cutoff, 0.5F);
  material["alphaCutoff"] = 0.25;
  EXPECT_EQ(read(g).materials[0].alpha_cutoff, 0.25F);
  material["alphaMode"] = "BLEND";
  EXPECT_EQ(read(g).materials[0].alpha, Alpha::blend);
  EXPECT_FALSE(read(g).materials[0].unlit);
  material["extensions"]["KHR_materials_unlit"] = json::object();
  g.root["extensionsRequired"] = {"KHR_materials_unlit"};
  EXPECT_TRUE(read(g).materials[0].unlit);
  material["alphaMode"] = "DITHER";
  expect_refused(g, "materials[0].alphaMode", "MASK");
}

TEST(GltfReader, vertex_colours) {
  Gltf g = square();
  EXPECT_TRUE(read(g).colours.empty());
  const int colours =
      g.accessor(std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0, 51, 51, 51, 0}, "VEC3", kU8, 4, 4);
  g.root["accessors"][static_cast<std::size_t>(colours)]["normalized"] = true;
  primitive(g)["attributes"]["COLOR_0"] = colours;
  const Scene scene = read(g);
  ASSERT_EQ(scene.colours.size(), scene.vertices.size());
  EXPECT_EQ(scene.colours[scene.triangles[0].x], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.colours[scene.triangles[0].y], glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(scene.colours[scene.triangles[1].z], glm::vec4(0.2F, 0.2F, 0.2F, 1));
  g.root["accessors"][static_cast<std::size_t>(colours)].erase("normalized");
  expect_refused(g, "meshes[0].primitives[0].attributes.COLOR_0", "normalised");
}

TEST(GltfReader, texture_transform_scales_turns_and_shifts) {
  Gltf g = textured();
  json& info = g.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"rotation", std::acos(0.0)}};
  const render::TextureUse use = read(g).materials[0].base_colour_texture;
  const auto moved = [](const render::TextureUse& u, const glm::vec2& uv) { return u.linear * uv + u.offset; };
  // (1, 0) -> (2, 0) -> a quarter turn, counter-clockwise with v downwards: (0, -2) -> (0.25, -1.5)
  EXPECT_NEAR(moved(use, {1, 0}).x, 0.25F, 1e-6F);
  EXPECT_NEAR(moved(use, {1, 0}).y, -1.5F, 1e-6F);
  // The extension's own example: the lower left quadrant, turned.
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"scale", {0.5, 0.5}}, {"rotation", std::acos(0.0)}};
  const render::TextureUse quadrant = read(g).materials[0].base_colour_texture;
  for (const glm::vec2& corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    const glm::vec2 at = moved(quadrant, corner);
    EXPECT_TRUE(at.x > -1e-6F && at.x < 0.5F + 1e-6F && at.y > 0.5F - 1e-6F && at.y < 1.0F + 1e-6F)
        << at.x << ' ' << at.y;
  }
}

TEST(GltfReader, two_sets_of_texture_coordinates_a_material) {
  Gltf g = textured();
  primitive(g)["attributes"]["TEXCOORD_3"] = g.accessor(std::vector<float>{5, 0, 6, 0, 6, 1, 5, 1}, "VEC2", kF32, 4);
  json& material = g.root["materials"][0];
  material["emissiveTexture"] = {{"index", 0}, {"texCoord", 3}};
  const Scene scene = read(g);
  EXPECT_EQ(scene.materials[0].base_colour_texture.second_uv, 0);
  EXPECT_EQ(scene.materials[0].emission_texture.second_uv, 1);
  ASSERT_EQ(scene.second_uvs.size(), scene.vertices.size());
  EXPECT_EQ(scene.vertices[scene.triangles[0].y].uv, glm::vec2(1, 0));
  EXPECT_EQ(scene.second_uvs[scene.triangles[0].y], glm::vec2(6, 0));
  material["normalTexture"] = {{"index", 0}, {"texCoord", 1}};
  expect_refused(g, "materials[0].normalTexture.texCoord", "two are allowed");
}

TEST(GltfReader, lights) {
  const double h = std::sqrt(0.5);
  const json turned = {{"translation", {1, 2, 3}}, {"rotation", {-h, 0, 0, h}}, {"scale", {2, 2, 2}}};  // -z to -y
  const Scene sun = read(with_light({{"type", "directional"}, {"color", {1, 0.5, 0}}, {"intensity", 4}}, turned));
  ASSERT_EQ(sun.lights.size(), 1U);
  EXPECT_EQ(sun.lights[0].type, render::Light::Type::directional);
  EXPECT_EQ(sun.lights[0].colour, glm::vec3(4, 2, 0));
  expect_near(sun.lights[0].direction, {0, -1, 0});

  const Scene bulb = read(with_light({{"type", "point"}, {"range", 5}}, turned));
  EXPECT_EQ(bulb.lights[0].type, render::Light::Type::point);
  EXPECT_EQ(bulb.lights[0].colour, glm::vec3(1));
  EXPECT_EQ(bulb.lights[0].range, 5.0F);
  expect_near(bulb.lights[0].position, {1, 2, 3});

  const Scene spot =
      read(with_light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 1.0}}}}, turned));
  EXPECT_EQ(spot.lights[0].type, render::Light::Type::spot);
  EXPECT_FLOAT_EQ(spot.lights[0].cos_inner, std::cos(0.5F));
  EXPECT_FLOAT_EQ(spot.lights[0].cos_outer, std::cos(1.0F));
  EXPECT_EQ(spot.lights[0].range, 0.0F);
}

TEST(GltfReader, a_file_that_says_nothing_of_light_gets_a_sun) {
  Gltf g = square();
  ASSERT_EQ(read(g).lights.size(), 1U);
  EXPECT_EQ(read(g).lights[0].type, render::Light::Type::directional);
  g.root["asset"]["extras"]["vergence"] = {{"ambient", {1, 1, 1}}};
  EXPECT_TRUE(read(g).lights.empty());
}

TEST(GltfReader, the_first_camera_gives_the_start_pose_without_scale) {
  const double h = std::sqrt(0.5);
  Gltf g = square();
  g.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  g.root["nodes"] = {{{"mesh", 0}},
                     {{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, -h, 0, h}}, {"scale", {3, 5, 2}}},
                     {{"camera", 0}}};
  g.root["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = read(g);
  ASSERT_TRUE(scene.start_pose());
  expect_near(glm::vec3(scene.start_pose()->position), {1, 2, 3});
  expect_near(glm::vec3(scene.start_pose()->direction({0, 0, -1})), {1, 0, 0});  // turned to the right
  expect_near(glm::vec3(scene.start_pose()->direction({0, 1, 0})), {0, 1, 0});
  EXPECT_NEAR(glm::length(scene.start_pose()->orientation), 1.0, 1e-12);
}

TEST(GltfReader, cameras_go_by_their_nodes_names_else_by_their_own) {
  Gltf g = square();
  g.root["cameras"] = {{{"type", "perspective"}, {"name", "own"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  g.root["nodes"] = {{{"mesh", 0}}, {{"camera", 0}}, {{"camera", 0}, {"name", "door"}, {"translation", {0, 0, 3}}}};
  g.root["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene scene = read(g);
  ASSERT_EQ(scene.cameras.size(), 2U);
  EXPECT_EQ(scene.cameras[0].name, "own");
  EXPECT_EQ(scene.cameras[1].name, "door");
  expect_near(glm::vec3(scene.cameras[1].pose.position), {0, 0, 3});
}

// Whatever a scene's size and place, it lies ahead, inside a view of 60 degrees, and no nearer than the eye can focus.
TEST(GltfReader, without_a_camera_the_whole_scene_is_seen) {
  for (const double scale : {0.001, 1.0, 500.0}) {
    Gltf g = square();
    g.root["nodes"][0].update({{"translation", {7.0 * scale, -3.0 * scale, 11.0}}, {"scale", {scale, scale, scale}}});
    const Scene scene = read(g);
    const tracking::Pose head = render::framing_pose(scene);
    EXPECT_EQ(head.direction({0, 0, -1}), glm::dvec3(0, 0, -1));
    for (const render::Vertex& vertex : scene.vertices) {
      const glm::dvec3 there = glm::dvec3(vertex.position) - head.position;
      EXPECT_LE(there.z, -0.4 + 1e-6);  // float corners
      EXPECT_LE(std::abs(there.x), -there.z * std::tan(glm::radians(30.0)));
      EXPECT_LE(std::abs(there.y), -there.z * std::tan(glm::radians(30.0)));
    }
  }
}

TEST(GltfReader, targets_are_the_named_nodes_that_say_so) {
  Gltf g = square();
  g.root["nodes"][0]["translation"] = {0, 0, -2};
  g.root["nodes"][0]["children"] = {1, 2, 3};
  g.root["nodes"].push_back({{"name", "chart"}, {"translation", {0.5, 0, 0}}, {"extras", {{"target", true}}}});
  g.root["nodes"].push_back({{"name", "lamp"}, {"extras", {{"target", false}}}});
  g.root["nodes"].push_back({{"name", "desk"}, {"extras", {{"colour", "red"}}}});
  const Scene scene = read(g);
  ASSERT_EQ(scene.targets.size(), 1U);
  EXPECT_EQ(scene.targets[0].name, "chart");
  EXPECT_EQ(scene.targets[0].position, glm::dvec3(0.5, 0, -2));
}

// In a time that grows as their number; as its square it would be an hour.
TEST(GltfReader, a_hundred_thousand_targets) {
  Gltf g = square();
  constexpr std::size_t kMany = 100'000;
  for (std::size_t i = 0; i < kMany; ++i) {
    g.root["nodes"].push_back({{"name", "target " + std::to_string(i)}, {"extras", {{"target", true}}}});
    g.root["scenes"][0]["nodes"].push_back(i + 1);
  }
  EXPECT_EQ(read(g).targets.size(), kMany);
}

TEST(GltfReader, the_environment_of_the_assets_extras) {
  Gltf g = square();
  EXPECT_EQ(read(g).environment.ambient, render::Environment{}.ambient);
  g.root["asset"]["extras"]["vergence"] = {{"sky_zenith", {0.5, 1, 2}}, {"ambient", {0, 0, 0.25}}};
  const render::Environment environment = read(g).environment;
  EXPECT_EQ(environment.sky_zenith, glm::vec3(0.5F, 1, 2));
  EXPECT_EQ(environment.ambient, glm::vec3(0, 0, 0.25F));
  EXPECT_EQ(environment.sky_horizon, render::Environment{}.sky_horizon);
}

}  // namespace
