// The built-in scene: where everything stands, and the whole of it.
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "assets/generator/scene_model.hpp"

namespace assets {

// The seated wearer's midpoint between the pupils, level, looking along -z.
inline constexpr glm::dvec3 kEyes{0.0, 1.2, 0.0};

// A place by its distance from the midpoint between the pupils and its direction from there, and the orientation that
// turns a sheet's +z to the eyes with its x level.
struct Placement {
  double distance;  // m
  double right_deg, up_deg;

  [[nodiscard]] glm::dvec3 position() const;
  [[nodiscard]] glm::dquat facing() const;
};

inline constexpr Placement kNearCard{0.40, 0.0, -30.0};
inline constexpr Placement kPhone{0.30, 26.0, -37.0};
inline constexpr Placement kScreen{0.70, 0.0, -10.5};
inline constexpr Placement kEtdrsChart{4.0, 0.0, 5.0};
inline constexpr Placement kClockDial{4.0, 9.5, 5.0};
inline constexpr Placement kSign{10.0, -25.4, -0.8};
inline constexpr Placement kHouse{50.0, -19.2, 1.5};
inline constexpr Placement kHorizon{16000.0, -32.5, 1.2};

// font_path: an outline font with serifs (Liberation Serif).
[[nodiscard]] SceneModel make_reading_room(const std::string& font_path);

}  // namespace assets
