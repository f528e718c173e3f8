// The columns of a trace by name, for its reader and its writer.
#pragma once

#include <array>
#include <string_view>

namespace tracking {

inline constexpr std::array<std::string_view, 15> kTraceColumns{
    "time_s",  "head_px", "head_py", "head_pz",  "head_qx",  "head_qy",  "head_qz",   "head_qw",
    "left_gx", "left_gy", "left_gz", "right_gx", "right_gy", "right_gz", "gaze_valid"};
inline constexpr std::array<std::string_view, 4> kEyeColumns{"left_pupil_m", "right_pupil_m", "left_accommodation_D",
                                                             "right_accommodation_D"};
inline constexpr std::string_view kSourceColumn = "gaze_source";
inline constexpr std::array<std::string_view, 8> kSecondColumns{"b_left_gx",
                                                                "b_left_gy",
                                                                "b_left_gz",
                                                                "b_right_gx",
                                                                "b_right_gy",
                                                                "b_right_gz",
                                                                "b_left_accommodation_D",
                                                                "b_right_accommodation_D"};

inline constexpr double kFarthestHead = 1e5;        // m from the origin
inline constexpr double kLargestPupil = 0.02;       // m
inline constexpr double kMostAccommodation = 50.0;  // D
inline constexpr double kUnitExactly = 1e-6;        // off unit length: the rounding of float32, left as it is
inline constexpr double kUnitRoughly = 1e-3;        // of a few decimals

}  // namespace tracking
