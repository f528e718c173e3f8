// One line of a pose and gaze trace, as a file has it and as a sender writes it to the socket.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "xr/layer/recorded_gaze.hpp"

namespace xr::layer {

inline constexpr std::string_view kGazeHeader =
    "time_s,head_px,head_py,head_pz,head_qx,head_qy,head_qz,head_qw,left_gx,left_gy,left_gz,right_gx,right_gy,right_gz,"
    "gaze_valid";

// The row, or what is wrong with the line and what is allowed. Further columns are passed over; the head's pose is the
// runtime's affair and only has to be made of numbers.
[[nodiscard]] std::variant<GazeRow, std::string> parse_gaze_line(std::string_view line);

}  // namespace xr::layer
