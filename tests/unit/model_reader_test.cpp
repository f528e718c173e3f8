// Models read back from what the generator itself writes, and the normals they are given.
#include "assets/generator/model_reader.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "assets/generator/glb_writer.hpp"
#include "assets/generator/model_scenes.hpp"

namespace assets {
namespace {

// A box of glass and a ball of metal, the latter moved by its node.
SceneModel box_and_ball() {
  SceneModel scene;
  const MaterialId glass = scene.add(Material{.name = "glass", .base_colour = {0.2, 0.4, 0.6}, .opacity = 0.25});
  const MaterialId metal = scene.add(Material{.name = "METAL_chrome", .base_colour = glm::dvec3(0.8)});
  Node box{.name = "box"};
  add_box(box.in(glass), {{-1.0, 0.0, -2.0}, {1.0, 0.5, 2.0}});
  scene.nodes.push_back(std::move(box));
  Node ball{.name = "ball", .translation = {0.0, 3.0, 0.0}};
  add_sphere(ball.in(metal), {0.0, 0.0, 0.0}, 0.5, 64);
  scene.nodes.push_back(std::move(ball));
  return scene;
}

// A file that goes with its owner.
struct TemporaryFile {
  explicit TemporaryFile(std::span<const std::uint8_t> bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  std::string path = testing::TempDir() + "vergence-model-" + std::to_string(::getpid()) + ".glb";
};

Model read_back(const SceneModel& scene) {
  const TemporaryFile file(glb_bytes(scene));
  return read_model(file.path);
}

TEST(ModelReader, KeepsTrianglesPlacesAndMaterials) {
  const SceneModel scene = box_and_ball();
  const Model model = read_back(scene);
  EXPECT_EQ(model.triangle_count(), scene.triangle_count());
  EXPECT_LT(glm::length(model.bounds.low - glm::dvec3(-1.0, 0.0, -2.0)), 1e-6);
  EXPECT_LT(glm::length(model.bounds.high - glm::dvec3(1.0, 3.5, 2.0)), 1e-6);
  ASSERT_EQ(model.materials.size(), 2U);
  EXPECT_DOUBLE_EQ(model.materials[0].opacity, 0.25);
  EXPECT_DOUBLE_EQ(model.materials[0].metallic, 0.0);
  EXPECT_DOUBLE_EQ(model.materials[1].metallic, 1.0);
}

TEST(ModelReader, RefusesWhatIsNoModel) {
  EXPECT_THROW(static_cast<void>(read_model("/nonexistent/none.glb")), std::runtime_error);
  const std::vector<std::uint8_t> bytes = glb_bytes(box_and_ball());
  for (const std::size_t length : {std::size_t{0}, std::size_t{10}, std::size_t{100}, bytes.size() - 100}) {
    const TemporaryFile cut{std::span<const std::uint8_t>(bytes).first(length)};
    EXPECT_THROW(static_cast<void>(read_model(cut.path)), std::runtime_error) << length;
  }
}

// A box keeps its edges; a ball of 64 segments is smooth, its normals off the radius by less than a facet's 5.6 deg.
TEST(ModelReader, NormalsFollowCreases) {
  const Model model = read_back(box_and_ball());
  for (const ModelPart& part : model.parts) {
    const Mesh mesh = with_normals(part, glm::radians(40.0));
    EXPECT_EQ(mesh.indices.size(), part.indices.size());
    if (part.material == 0) {
      EXPECT_EQ(mesh.positions.size(), 24U) << "eight corners, three faces each";
      continue;
    }
    EXPECT_LT(mesh.positions.size(), mesh.indices.size() / 3) << "corners are shared";
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const glm::dvec3 radius = glm::normalize(mesh.positions[i] - glm::dvec3(0.0, 3.0, 0.0));
      EXPECT_GT(glm::dot(radius, mesh.normals[i]), std::cos(glm::radians(5.6)));
    }
  }
}

TEST(ModelScenes, AModelIsScaledAndStandsOnItsPlace) {
  SceneModel scene;
  add_model(scene, read_back(box_and_ball()), "thing", 8.0, {5.0, 0.75, -1.0}, 0.0);
  EXPECT_EQ(model_triangle_count(scene), box_and_ball().triangle_count());
  const Model placed = read_back(scene);
  // 4 m deep becomes 8 m; the foot's middle lies on the place.
  EXPECT_LT(glm::length(placed.bounds.low - glm::dvec3(3.0, 0.75, -5.0)), 1e-5);
  EXPECT_LT(glm::length(placed.bounds.high - glm::dvec3(7.0, 7.75, 3.0)), 1e-5);
}

}  // namespace
}  // namespace assets
