// Textures are averaged over what a pixel's beam covers, and through a lens the beam is the lens's: a picture cannot be
// told from one of the same footprint without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"

namespace {

using render::Material;
using render::Scene;
using support::Look;
using support::Seen;

constexpr float kDistance = 4.0F;  // m, of the wall
constexpr float kHalf = 4.0F;

Seen see(const Scene& scene, const Look& how) {
  static render::vk::Device device;
  render::Renderer renderer(device, scene);
  return support::look(renderer, how);
}

lenses::Spectacles spectacles(double power) {
  lenses::Lens lens;
  lens.index = 1.6;
  lens.centre_thickness = 0.004;
  lens.front = lenses::Sphere{8.0};
  lens.back = lenses::Sphere{8.0 - power / 0.6};
  return {"", {lens, lens}, glm::dvec3(1.0)};
}

// A wall with a 256 x 256 texture, `repeats` of it across.
template <class Texel>
Scene wall_of(Texel&& texel, float repeats, float turn = 0.0F) {
  Scene scene = support::dark_scene();
  Material material = support::unlit(glm::vec4(1));
  material.base_colour_texture.index = support::add_texture(scene, 256, 256, texel);
  material.base_colour_texture.linear = glm::mat2(repeats, 0, 0, repeats);
  const glm::vec3 side(std::cos(turn), 0, -std::sin(turn));
  support::add_square(scene, support::add_material(scene, material), glm::vec3(0, -kHalf, -kDistance) - kHalf * side,
                      2.0F * kHalf * side, {0, 2 * kHalf, 0});
  return scene;
}

glm::uvec4 grey(bool white) {
  return glm::uvec4(glm::uvec3(white ? 255 : 0), 255);
}

TEST(TextureFootprint, AFineCheckerAveragesToGrey) {
  const auto checker = [](auto x, auto y) { return grey((x + y) % 2 == 0); };
  for (const double power : {0.0, -4.0, 4.0}) {
    for (const float turn : {0.0F, 1.1F}) {
      // 8 to 60 texels a pixel.
      const lenses::Spectacles worn = spectacles(power);
      const Seen seen = see(wall_of(checker, 32.0F, turn), {.spectacles = power == 0.0 ? nullptr : &worn});
      for (int y = 16; y < 48; ++y) {
        for (int x = 16; x < 48; ++x) {
          ASSERT_NEAR(seen.at(x, y).g, 0.5F, 0.01F) << power << ' ' << turn << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

// How far apart the reference rays of two neighbouring pixels meet the wall, in texels.
double footprint_texels(const Seen& seen, float repeats) {
  const auto meets = [&](int x) {
    const auto p = support::reference_pixel(
        seen.pair, seen.setup,
        support::pixel_direction(seen.setup, x, seen.look.height / 2, seen.look.width, seen.look.height));
    return p.start.x + p.direction.x / p.direction.z * (-static_cast<double>(kDistance) - p.start.z);
  };
  const double metres = meets(seen.look.width / 2) - meets(seen.look.width / 2 - 1);
  return metres * static_cast<double>(repeats) * 256.0 / (2.0 * static_cast<double>(kHalf));
}

// Stripes two texels wide keep their full contrast down to level 1 and have none at level 2, so between the two the
// contrast is the level. Sixty-four columns meet the stripes at many phases; what the best misses of a stripe's middle
// and the growth of the footprint towards the sides cost a few hundredths of a level.
TEST(TextureFootprint, ALensChangesTheLevelAsItChangesTheBeam) {
  const auto stripes = [](auto x, auto) { return grey(x % 4 < 2); };
  double levels[5];
  int at = 0;
  for (const double power : {-8.0, -4.0, 0.0, 4.0, 8.0}) {
    const float repeats = 5.657F;
    const lenses::Spectacles worn = spectacles(power);
    const Seen seen = see(wall_of(stripes, repeats),
                          {.width = 128, .height = 128, .spectacles = power == 0.0 ? nullptr : &worn, .bare = true});
    float low = 9.0F, high = -9.0F;
    for (int y = 56; y < 72; ++y) {
      for (int x = 32; x < 96; ++x) {
        low = std::min(low, seen.at(x, y).g);
        high = std::max(high, seen.at(x, y).g);
      }
    }
    const double expected = std::log2(footprint_texels(seen, repeats));
    levels[at] = 2.0 - static_cast<double>(high - low);
    std::cout << power << " D: level " << levels[at] << ", " << expected << " expected\n";
    EXPECT_NEAR(levels[at++], expected, 0.06) << power << " D";
  }
  // A minus lens makes things smaller, so that a pixel covers more of them.
  for (int i = 0; i + 1 < 5; ++i) EXPECT_GT(levels[i], levels[i + 1] + 0.05);
}

TEST(TextureFootprint, BlurredModeInFocusIsThePinholeBitForBit) {
  const auto checker = [](auto x, auto y) { return grey((x / 16 + y / 16) % 2 == 0); };
  const Scene scene = wall_of(checker, 1.7F, 0.6F);
  for (const double power : {0.0, -2.0}) {
    const lenses::Spectacles worn = spectacles(power);
    const auto* pair = power == 0.0 ? nullptr : &worn;
    const Seen sharp = see(scene, {.mode = render::Mode::pinhole, .spectacles = pair});
    const Seen blurred = see(scene, {.mode = render::Mode::adof, .spectacles = pair});
    EXPECT_EQ(sharp.view.radiance, blurred.view.radiance) << power;
    EXPECT_GT(*std::ranges::max_element(sharp.view.radiance), 0.9F);
  }
}

}  // namespace
