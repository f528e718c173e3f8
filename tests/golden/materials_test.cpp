// What materials look like: closed forms and conservation where they exist, shadows and layers where they must fall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "render/image/png.hpp"
#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using render::Material;
using render::Scene;
using support::Look;
using support::Seen;

class Materials : public ::testing::Test {
 protected:
  static render::vk::Device& device() {
    static render::vk::Device device;
    return device;
  }
  static Seen see(const Scene& scene, const Look& how = {}) {
    render::Renderer renderer(device(), scene);
    return support::look(renderer, how);
  }
};

Material glossy(const glm::vec3& colour, float metallic, float roughness) {
  Material material = support::matte(colour);
  material.metallic = metallic;
  material.roughness = roughness;
  return material;
}

void expect_colour(const glm::vec3& seen, const glm::vec3& wanted, float tolerance) {
  EXPECT_NEAR(seen.r, wanted.r, tolerance);
  EXPECT_NEAR(seen.g, wanted.g, tolerance);
  EXPECT_NEAR(seen.b, wanted.b, tolerance);
}

// In even white light a white body of any smoothness, metal or not, cannot be told from its background. Half floats
// carry 0.1 %.
TEST_F(Materials, WhiteInWhiteLightStaysWhite) {
  for (const float metallic : {0.0F, 0.5F, 1.0F}) {
    for (const float roughness : {0.0F, 0.3F, 0.7F, 1.0F}) {
      Scene scene = support::dark_scene();
      scene.environment = {glm::vec3(1), glm::vec3(1), glm::vec3(1)};
      support::add_ball(scene, support::add_material(scene, glossy(glm::vec3(1), metallic, roughness)), {0, 0, -5},
                        1.0F, 24);
      const Seen seen = see(scene);
      float low = 9.0F, high = 0.0F;
      for (const float v : seen.view.radiance) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
      EXPECT_GT(low, 0.98F) << metallic << ' ' << roughness;
      EXPECT_LT(high, 1.02F) << metallic << ' ' << roughness;
    }
  }
}

// The same light from a thousand directional lights: here the lobes themselves must give back what arrives. The fits of
// their shares are good to a few per cent.
TEST_F(Materials, LobesGiveBackWhatArrives) {
  for (const float metallic : {0.0F, 1.0F}) {
    for (const float roughness : {0.4F, 0.7F, 0.95F}) {
      for (const float tilt : {0.0F, 0.9F}) {
        Scene scene = support::dark_scene();
        const std::uint32_t white = support::add_material(scene, glossy(glm::vec3(1), metallic, roughness));
        const glm::vec3 normal(std::sin(tilt), 0, std::cos(tilt)), side(std::cos(tilt), 0, -std::sin(tilt));
        support::add_square(scene, white, glm::vec3(0, -4, -5) - 4.0F * side, 8.0F * side, {0, 8, 0});
        constexpr int kLights = 1024;
        for (int i = 0; i < kLights; ++i) {  // even over the hemisphere: a spiral of equal steps in height
          const float h = (static_cast<float>(i) + 0.5F) / kLights, r = std::sqrt(1.0F - h * h);
          const float turn = 2.39996323F * static_cast<float>(i);
          const glm::vec3 towards = h * normal + r * (std::cos(turn) * side + std::sin(turn) * glm::vec3(0, 1, 0));
          support::add_sun(scene, -towards, 2.0F * 3.14159265F / kLights);
        }
        const Seen seen = see(scene, {.width = 8, .height = 8, .half_tangent = 0.02});
        const float given_back = seen.at(4, 4).g;
        EXPECT_GT(given_back, 0.90F) << metallic << ' ' << roughness << ' ' << tilt;
        EXPECT_LT(given_back, 1.05F) << metallic << ' ' << roughness << ' ' << tilt;
      }
    }
  }
}

// Five balls in a row from mirror to matte, gold above and plastic below, one light: written as a picture to be looked
// at, and held to what it must show.
TEST_F(Materials, BallsUnderOneLight) {
  Scene scene = support::dark_scene();
  scene.environment = {{0.25F, 0.4F, 0.7F}, {0.7F, 0.78F, 0.85F}, glm::vec3(0.25F)};
  support::add_square(scene, support::add_material(scene, support::matte(glm::vec3(0.4F))), {-20, -2.2F, -2},
                      {40, 0, 0}, {0, 0, -40});
  constexpr float kRoughness[] = {0.05F, 0.25F, 0.5F, 0.75F, 1.0F};
  for (int i = 0; i < 5; ++i) {
    const float x = 2.2F * static_cast<float>(i - 2);
    support::add_ball(scene, support::add_material(scene, glossy({1.0F, 0.77F, 0.34F}, 1.0F, kRoughness[i])),
                      {x, 1.1F, -12}, 1.0F, 64);
    support::add_ball(scene, support::add_material(scene, glossy({0.5F, 0.05F, 0.05F}, 0.0F, kRoughness[i])),
                      {x, -1.1F, -12}, 1.0F, 64);
  }
  support::add_sun(scene, {1, -1, -1}, 3.0F);
  const Seen seen = see(scene, {.width = 512, .height = 512, .half_tangent = 0.5});
  render::write_png("materials_balls.png", seen.view.display);
  const auto brightest = [&](int ball, float y) {
    float best = 0.0F;
    for (int i = 0; i < 128; ++i) {
      for (int j = 0; j < 128; ++j) {
        const float u = static_cast<float>(i) / 64.0F - 1.0F, v = static_cast<float>(j) / 64.0F - 1.0F;
        if (u * u + v * v < 0.8F) {
          best = std::max(best, seen.at({2.2F * static_cast<float>(ball - 2) + u, y + v, -12.0F}).r);
        }
      }
    }
    return best;
  };
  for (const float y : {1.1F, -1.1F}) {
    for (int ball = 1; ball + 1 < 5; ++ball) {  // the first highlight is smaller than a pixel
      EXPECT_GT(brightest(ball, y), brightest(ball + 1, y)) << "a smoother ball has the brighter highlight";
    }
  }
  for (int ball = 0; ball < 5; ++ball) {
    const float x = 2.2F * static_cast<float>(ball - 2);
    const glm::vec3 shade = seen.at({x + 0.4F, 0.8F, -11.1F});
    EXPECT_GT(shade.r, 0.04F) << "no metal is black where the light does not reach";
    EXPECT_GT(shade.r, shade.b) << "gold's reflection is golden";
  }
}

// Lambert's law on the matte floor of the same light, as before metals came: base (ambient + E cos / pi).
TEST_F(Materials, AMatteSurfaceIsLambertian) {
  Scene scene = support::dark_scene();
  scene.environment.ambient = glm::vec3(0.2F);
  support::add_wall(scene, support::add_material(scene, support::matte({0.5F, 0.25F, 1.0F})), 0, 0, 4, 4);
  support::add_sun(scene, {1, 0, -1}, 2.0F);
  const float light = 0.2F + 2.0F * std::sqrt(0.5F) / 3.14159265F;
  expect_colour(see(scene).at(32, 32), light * glm::vec3(0.5F, 0.25F, 1.0F), 1e-3F);
}

// A leaf whose left half is cut away: through the hole the wall is seen and the light falls.
TEST_F(Materials, CutOutLeafAndItsShadow) {
  Scene scene = support::dark_scene();
  support::add_wall(scene, support::add_material(scene, support::matte(glm::vec3(0.5F))), 0, 0, 4, 4);
  Material leaf = support::unlit({0, 1, 0, 1});
  leaf.alpha = Material::Alpha::mask;
  leaf.base_colour_texture.index =
      support::add_texture(scene, 8, 8, [](auto x, auto) { return glm::uvec4(255, 255, 255, x < 4 ? 0 : 255); });
  support::add_wall(scene, support::add_material(scene, leaf), -0.6F, 0, 3, 0.4F);  // x from -1 to -0.2
  support::add_sun(scene, {1, 0, -1}, 2.0F);  // its shadow falls 1 m to the right of it
  const Seen seen = see(scene, {.width = 256, .height = 256, .half_tangent = 0.5});
  const float lit = 0.5F * 2.0F * std::sqrt(0.5F) / 3.14159265F;
  expect_colour(seen.at({-0.8F, 0, -3}), glm::vec3(lit), 1e-3F);
  expect_colour(seen.at({-0.4F, 0, -3}), {0, 1, 0}, 1e-3F);
  expect_colour(seen.at({0.2F, 0, -4}), glm::vec3(lit), 1e-3F);
  expect_colour(seen.at({0.6F, 0, -4}), glm::vec3(0), 1e-3F);
}

TEST_F(Materials, PanesMixWithWhatLiesBehindAndDimItsLight) {
  for (const bool red_first : {true, false}) {
    Scene scene = support::dark_scene();
    const std::uint32_t white = support::add_material(scene, support::unlit(glm::vec4(1)));
    const std::uint32_t black = support::add_material(scene, support::unlit({0, 0, 0, 1}));
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        support::add_wall(scene, (i + j) % 2 == 0 ? white : black, -1.75F + 0.5F * static_cast<float>(i),
                          -1.75F + 0.5F * static_cast<float>(j), 4, 0.25F);
      }
    }
    Material red = support::unlit({1, 0, 0, 0.25F}), blue = support::unlit({0, 0, 1, 0.5F});
    red.alpha = blue.alpha = Material::Alpha::blend;
    support::add_wall(scene, support::add_material(scene, red), 0, 0, red_first ? 2.0F : 3.0F, 0.6F);
    support::add_wall(scene, support::add_material(scene, blue), 0, 0, red_first ? 3.0F : 2.0F, 0.6F);
    const Seen seen = see(scene, {.width = 256, .height = 256, .half_tangent = 0.5});
    const glm::vec3 panes = red_first ? glm::vec3(0.25F, 0, 0.75F * 0.5F) : glm::vec3(0.5F * 0.25F, 0, 0.5F);
    expect_colour(seen.at({0.25F, 0.25F, -4}), panes + 0.375F, 1e-3F);  // a white square
    expect_colour(seen.at({-0.25F, 0.25F, -4}), panes, 1e-3F);          // a black one
    const glm::ivec2 p = seen.pixel_of({0.25F, 0.25F, -4});
    // Red takes a quarter, blue then half of the rest: the eye sees most of what lies before the half.
    EXPECT_NEAR(seen.depth(p.x, p.y), red_first ? 3.0F : 2.0F, 0.2F);
  }
  Scene scene = support::dark_scene();
  support::add_wall(scene, support::add_material(scene, support::matte(glm::vec3(0.5F))), 0, 0, 4, 4);
  Material pane = support::unlit({1, 1, 1, 0.25F});
  pane.alpha = Material::Alpha::blend;
  support::add_wall(scene, support::add_material(scene, pane), -0.6F, 0, 3, 0.4F);
  support::add_sun(scene, {1, 0, -1}, 2.0F);
  const Seen seen = see(scene, {.width = 256, .height = 256, .half_tangent = 0.5});
  const float lit = 0.5F * 2.0F * std::sqrt(0.5F) / 3.14159265F;
  expect_colour(seen.at({0.4F, 0, -4}), glm::vec3(0.75F * lit), 1e-3F);
  expect_colour(seen.at({1.2F, 0, -4}), glm::vec3(lit), 1e-3F);
}

TEST_F(Materials, BacksOfSingleSidedFacesAreNotSeenButCastShadows) {
  for (const bool double_sided : {false, true}) {
    Scene scene = support::dark_scene();
    support::add_wall(scene, support::add_material(scene, support::matte(glm::vec3(0.5F))), 0, 0, 4, 4);
    Material leaf = support::unlit({0, 1, 0, 1});
    leaf.double_sided = double_sided;
    // Its front looks away from the eye.
    support::add_square(scene, support::add_material(scene, leaf), {-0.2F, -0.4F, -3}, {-0.8F, 0, 0}, {0, 0.8F, 0});
    support::add_sun(scene, {1, 0, -1}, 2.0F);
    const Seen seen = see(scene, {.width = 256, .height = 256, .half_tangent = 0.5});
    const float lit = 0.5F * 2.0F * std::sqrt(0.5F) / 3.14159265F;
    expect_colour(seen.at({-0.6F, 0, -3}), double_sided ? glm::vec3(0, 1, 0) : glm::vec3(lit), 1e-3F);
    expect_colour(seen.at({0.4F, 0, -4}), glm::vec3(0), 1e-3F);
  }
}

// A map that says "level" changes nothing; red tilts along u, green up in the image.
TEST_F(Materials, NormalMaps) {
  const auto wall = [&](glm::uvec4 texel, glm::vec3 sun) {
    Scene scene = support::dark_scene();
    Material material = support::matte(glm::vec3(1));
    material.normal_texture.index = support::add_texture(scene, 2, 2, [&](auto, auto) { return texel; });
    support::add_wall(scene, support::add_material(scene, material), 0, 0, 4, 4);
    support::add_sun(scene, sun, 3.14159265F);
    return see(scene, {.width = 16, .height = 16}).at(8, 8).g;
  };
  // 8-bit normals are good to half a per cent.
  EXPECT_NEAR(wall({128, 128, 255, 255}, {0, 0, -1}), 1.0F, 5e-3F);
  const float s = std::sqrt(0.5F);
  for (const float sign : {1.0F, -1.0F}) {  // light from 45 degrees to one side and the other
    const float with = sign > 0 ? 1.0F : 0.0F;
    const auto texel = static_cast<std::uint32_t>(std::lround(127.5F * (1.0F + s)));
    EXPECT_NEAR(wall({texel, 128, texel, 255}, {-sign, 0, -1}), with, 1e-2F);
    EXPECT_NEAR(wall({128, texel, texel, 255}, {0, -sign, -1}), with, 1e-2F);
  }
}

TEST_F(Materials, OcclusionDimsOnlyTheLightFromEverywhere) {
  Scene scene = support::dark_scene();
  scene.environment.ambient = glm::vec3(0.4F);
  Material material = support::matte(glm::vec3(1));
  material.occlusion_texture.index = support::add_texture(scene, 2, 2, [](auto, auto) { return glm::uvec4(51); });
  material.occlusion_strength = 0.5F;  // 1 + 0.5 (0.2 - 1) = 0.6
  support::add_wall(scene, support::add_material(scene, material), 0, 0, 4, 4);
  support::add_sun(scene, {0, 0, -1}, 3.14159265F);
  EXPECT_NEAR(see(scene, {.width = 16, .height = 16}).at(8, 8).g, 0.6F * 0.4F + 1.0F, 2e-3F);
}

TEST_F(Materials, VertexColoursSecondCoordinatesAndTransforms) {
  Scene scene = support::dark_scene();
  // Left half red, right half green.
  const auto two = [](auto x, auto) { return x < 4 ? glm::uvec4(255, 0, 0, 255) : glm::uvec4(0, 255, 0, 255); };
  Material material = support::unlit(glm::vec4(1));
  material.base_colour_texture.index = support::add_texture(scene, 8, 8, two);
  material.base_colour_texture.second_uv = 1;
  support::add_wall(scene, support::add_material(scene, material), -1, 0, 4, 0.9F);
  material.base_colour_texture.second_uv = 0;
  material.base_colour_texture.linear = glm::mat2(-1, 0, 0, 1);  // mirrored about u = 1/2
  material.base_colour_texture.offset = {1, 0};
  support::add_wall(scene, support::add_material(scene, material), 1, 0, 4, 0.9F);
  scene.second_uvs.assign(8, glm::vec2(0.25F, 0.5F));  // red everywhere
  scene.colours.assign(8, glm::vec4(1));
  for (std::size_t i = 4; i < 8; ++i)
    scene.colours[i] = {0.5F, i % 4 < 2 ? 0.0F : 1.0F, 1, 1};  // green fades downwards
  const Seen seen = see(scene, {.width = 256, .height = 256, .half_tangent = 0.5});
  expect_colour(seen.at({-1.4F, 0, -4}), {1, 0, 0}, 2e-3F);
  expect_colour(seen.at({-0.6F, 0, -4}), {1, 0, 0}, 2e-3F);
  expect_colour(seen.at({0.6F, 0.0F, -4}), {0, 0.5F, 0}, 0.01F);
  expect_colour(seen.at({1.4F, 0.45F, -4}), {0.5F, 0, 0}, 2e-3F);
}

// Nothing but what the device can hold is built; the message says both numbers.
TEST_F(Materials, ATooLargeSceneIsRefusedWithItsNumbers) {
  const std::size_t limit = device().limits().max_storage_buffer_bytes;
  const std::size_t count = limit / 64 + 1;
  if (count > 8'000'000) GTEST_SKIP() << "this device holds more than the test should allocate";
  Scene scene = support::dark_scene();
  support::add_wall(scene, support::add_material(scene, support::matte(glm::vec3(1))), 0, 0, 4, 4);
  scene.triangles.resize(count, scene.triangles[0]);
  scene.triangle_material.resize(count, 0);
  try {
    render::Renderer renderer(device(), scene);
    ADD_FAILURE() << "accepted";
  } catch (const render::vk::DeviceError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(std::to_string(count)), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(64 * count)), std::string::npos) << message;
    EXPECT_NE(message.find(std::to_string(limit)), std::string::npos) << message;
  }
}

}  // namespace
