// OpenXR's numbers as the vocabulary of tracking/ and back.
#pragma once

#include "tracking/stereo_view.hpp"
#include "xr/openxr_compat.hpp"

namespace xr {

// A runtime's orientation is of unit length to float precision only.
[[nodiscard]] tracking::Pose pose_of(const XrPosef& pose);
[[nodiscard]] XrPosef to_xr(const tracking::Pose& pose);
[[nodiscard]] tracking::FieldOfView fov_of(const XrFovf& fov);

// OpenXR's views of PRIMARY_STEREO: 0 is the left eye's.
[[nodiscard]] constexpr std::uint32_t view_index(tracking::Side side) {
  return side == tracking::Side::left ? 0 : 1;
}

inline constexpr XrPosef kIdentityPose{{0.0F, 0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 0.0F}};

}  // namespace xr
