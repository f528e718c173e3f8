// Converged pictures kept between runs: found under what they depend on, and under nothing else.
#include "app/tradeoff/reference_store.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/support/lit_scene.hpp"
#include "tests/support/run_program.hpp"

namespace {

class References : public testing::Test {
 protected:
  support::TemporaryFolder folder_;
  app::ReferenceStore store_{folder_.path() / "deeper" / "references"};
  render::Image8 picture_{2, 2, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, '\n'}};
};

TEST_F(References, AreFoundAgainUnderTheirKeyAlone) {
  EXPECT_FALSE(store_.find("a key"));
  store_.keep("a key", picture_);
  const auto found = store_.find("a key");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rgb, picture_.rgb);
  EXPECT_EQ(found->width, 2);
  EXPECT_FALSE(store_.find("another key"));
  std::filesystem::copy(store_.file_of("a key"), store_.file_of("another key"));
  EXPECT_FALSE(store_.find("another key")) << "a file of the right name but another's key";
}

TEST_F(References, DamageOfAnyKindIsSilence) {
  store_.keep("a key", picture_);
  std::ifstream in(store_.file_of("a key"), std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    std::ofstream(store_.file_of("a key"), std::ios::binary) << damaged;
    EXPECT_FALSE(store_.find("a key")) << "byte " << i;
    std::ofstream(store_.file_of("a key"), std::ios::binary) << whole.substr(0, i);
    EXPECT_FALSE(store_.find("a key")) << "cut at " << i;
  }
  std::ofstream(store_.file_of("a key"), std::ios::binary) << whole << "x";
  EXPECT_FALSE(store_.find("a key"));
}

TEST_F(References, TheOldestGo) {
  for (int i = 0; i < 40; ++i) {
    store_.keep("key " + std::to_string(i), picture_);
  }
  EXPECT_TRUE(store_.find("key 39"));
  const auto files = std::filesystem::directory_iterator(store_.file_of("x").parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 32);
}

TEST_F(References, NoPlaceKeepsNothing) {
  const app::ReferenceStore nowhere({}), impossible("/proc/no/such/place");
  EXPECT_NO_THROW(nowhere.keep("k", picture_));
  EXPECT_NO_THROW(impossible.keep("k", picture_));
  EXPECT_FALSE(nowhere.find("k"));
  EXPECT_FALSE(impossible.find("k"));
}

// Whatever the picture depends on is in its key.
TEST_F(References, TheKeyFollowsWhatIsSeen) {
  render::Scene scene = support::dark_scene();
  support::add_wall(scene, support::add_material(scene, support::unlit(glm::vec4(1.0F))), 0.0F, 0.0F, 1.0F, 1.0F);
  const support::WornPair pair = support::wear({}, nullptr, {});
  render::ViewSetup view =
      support::view_along(pair, 0, render::Viewing::fixed, {0, 0, -1}, tracking::FieldOfView{0.3, 0.3, 0.3, 0.3});
  render::FrameConfig config;
  const auto key = [&](const std::string& device = "gpu", const std::string& program = "1") {
    return app::reference_key(scene, pair.model, {view}, config, device, program);
  };
  const std::string first = key();
  EXPECT_EQ(key(), first);
  std::set<std::string> keys{first, key("other"), key("gpu", "2")};
  scene.vertices[2].position.x += 1e-6F;
  keys.insert(key());
  scene.materials.back().base_colour.g = 0.5F;
  keys.insert(key());
  scene.materials.back().name = "renamed";
  EXPECT_TRUE(keys.contains(key())) << "a name is not seen";
  support::add_sun(scene, {0, -1, 0}, 1.0F);
  keys.insert(key());
  view.view.gaze = glm::normalize(glm::dvec3(0.01, 0.0, -1.0));
  keys.insert(key());
  view.view.fov.tan_up = 0.31;
  keys.insert(key());
  view.eye.pupil.x *= 1.01;
  keys.insert(key());
  config.samples += 1;
  keys.insert(key());
  config.seed += 1;
  keys.insert(key());
  config.exposure = 0.5;
  keys.insert(key());
  config.accuracy.lens.in_double = true;
  keys.insert(key());
  EXPECT_EQ(keys.size(), 13U);
}

}  // namespace
