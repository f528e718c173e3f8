// Small lamps before dark walls, each seen out of focus: the image's second moments, and what geometry says they are.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat2x2.hpp>

#include "render/vk/device.hpp"
#include "tests/support/lit_scene.hpp"

namespace support {

// The residual of power `first` along `axis`, `second` across it (D), as the eye's matrix hh, hv, vv.
struct Residual {
  double first = 0.0, second = 0.0, axis_deg = 0.0;

  [[nodiscard]] glm::dvec3 matrix() const {
    const double c = std::cos(axis_deg * kDegree), s = std::sin(axis_deg * kDegree);
    return {first * c * c + second * s * s, (first - second) * s * c, first * s * s + second * c * c};
  }
};

// Each lamp is for residuals of one size: from its blur follow the field of view and the lamp's own size.
inline constexpr double kLampDioptres[] = {0.25, 0.5, 1.0, 2.0, 2.5, 5.0};

// |first| is one of kLampDioptres and the larger.
inline std::vector<Residual> point_light_residuals() {
  std::vector<Residual> r{{0.25, 0.25, 0.0}, {-1.0, -1.0, 0.0}, {2.5, 2.5, 0.0}, {-5.0, -5.0, 0.0}};
  for (const double axis : {0.0, 30.0, 45.0, 90.0, 135.0, 160.0}) {
    r.push_back({0.5, 0.25, axis});
    r.push_back({-2.0, 1.0, axis});  // a focal line on each side of the retina
    r.push_back({5.0, 2.0, axis});
  }
  return r;
}

struct PointLight {
  static constexpr int kSize = 64;          // pixels of the picture
  static constexpr double kMajor = 20.0;    // the blur's major semi-axis, pixels
  static constexpr double kHalfLamp = 4.0;  // pixels
  static constexpr double kDistance = 2.0;  // m
  static constexpr double kPupil = 0.004;   // m
  static constexpr double kApart = 0.5;     // of two lamps, rad, as the eye sees them

  static double pixel(double dioptres) { return 0.5 * kPupil * dioptres / kMajor; }  // rad
  static glm::dquat toward_lamp(std::size_t lamp) {
    return glm::angleAxis(kApart * static_cast<double>(lamp), glm::dvec3(0.0, 1.0, 0.0));
  }

  // The right eye at the origin, with this residual for the lamp of its size, behind a lens or none; `vergence` is that
  // of the lamp's light at the pupil.
  static render::ViewSetup view(const WornPair& pair, const Residual& residual, const glm::dvec3& vergence) {
    const double dioptres = std::abs(residual.first);
    const auto lamp = static_cast<std::size_t>(std::ranges::find(kLampDioptres, dioptres) - std::begin(kLampDioptres));
    const double half = 0.5 * kSize * pixel(dioptres);
    render::ViewSetup setup = view_along(pair, 0, Viewing::fixed, {0, 0, -1}, {half, half, half, half});
    setup.world_from_eye = tracking::Pose{toward_lamp(lamp), glm::dvec3(0.0)};
    setup.eye.excess = glm::dvec4(residual.matrix() - vergence, 0.0);
    setup.eye.pupil.x = kPupil;
    setup.accommodation = 0.0;
    return setup;
  }
  // walls: just behind the lamps, in as good a focus; else there is nothing but black sky.
  static render::Scene scene(bool walls) {
    render::Scene scene = dark_scene();
    const auto bright = add_material(scene, unlit(glm::vec4(1.0F)));
    const auto dark = add_material(scene, unlit(glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)));
    const auto square = [&](std::uint32_t material, std::size_t lamp, double distance, double half) {
      const glm::dquat turn = toward_lamp(lamp);
      add_square(scene, material, turn * glm::dvec3(-half, -half, -distance), turn * glm::dvec3(2.0 * half, 0.0, 0.0),
                 turn * glm::dvec3(0.0, 2.0 * half, 0.0));
    };
    for (std::size_t i = 0; i < std::size(kLampDioptres); ++i) {
      const double across = pixel(kLampDioptres[i]) * kDistance;
      square(bright, i, kDistance, kHalfLamp * across);
      if (walls) square(dark, i, 1.0001 * kDistance, 2.0 * kSize * across);
    }
    return scene;
  }
};

struct Moments {
  double light = 0.0;  // sum over the pixels
  glm::dvec2 centre{0.0};
  glm::dmat2 spread{0.0};  // pixels squared, x right, y up
};

inline Moments moments_of(const render::RenderedView& view, int size) {
  Moments m;
  glm::dvec3 squares(0.0);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double light = view.radiance[3 * static_cast<std::size_t>(y * size + x) + 1];
      const glm::dvec2 p(x + 0.5 - 0.5 * size, 0.5 * size - y - 0.5);
      m.light += light;
      m.centre += light * p;
      squares += light * glm::dvec3(p.x * p.x, p.x * p.y, p.y * p.y);
    }
  }
  m.centre /= m.light;
  squares = squares / m.light - glm::dvec3(m.centre.x * m.centre.x, m.centre.x * m.centre.y, m.centre.y * m.centre.y);
  m.spread = glm::dmat2(squares.x, squares.y, squares.y, squares.z);
  return m;
}

// The least and the largest ratio of the blur's variance to that of (a/4)^2 R R^T, over all directions in the picture.
// own: the variance that the sharp lamp has, the pixel's square included, pixels squared.
inline glm::dvec2 spread_ratios(const Moments& moments, const Residual& residual, const glm::dmat2& own) {
  const glm::dvec3 r = residual.matrix();
  const glm::dmat2 root = 0.5 * PointLight::kMajor / std::abs(residual.first) * glm::dmat2(r.x, r.y, r.y, r.z);
  // Eigenvalues of expected^-1 blur, real and positive.
  const glm::dmat2 ratio = glm::inverse(root * glm::transpose(root)) * (moments.spread - own);
  const double mean = 0.5 * (ratio[0][0] + ratio[1][1]);
  const double apart = std::sqrt(std::max(mean * mean - glm::determinant(ratio), 0.0));
  return {mean - apart, mean + apart};
}

// Of the square lamp seen by the bare eye through square pixels.
inline glm::dmat2 sharp_spread() {
  return (PointLight::kHalfLamp * PointLight::kHalfLamp / 3.0 + 1.0 / 12.0) * glm::dmat2(1.0);
}

inline WornPair bare_pair() {
  return wear(lenses::Wearer{}, nullptr, tracking::Pose{});
}

// One device for all tests of a suite.
class PointLightSuite : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    device_ = new render::vk::Device();
    renderer_ = new render::Renderer(*device_, PointLight::scene(true));
  }
  static void TearDownTestSuite() {
    delete renderer_;
    delete device_;
  }

  inline static render::vk::Device* device_ = nullptr;
  inline static render::Renderer* renderer_ = nullptr;
};

}  // namespace support
