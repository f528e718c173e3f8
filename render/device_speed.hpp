// What a device can do at best, roughly: the yardstick beside which times of different machines are read.
#pragma once

#include "render/vk/device.hpp"

namespace render {

struct DeviceSpeed {
  double gflops = 0.0;           // independent float multiply-adds, two operations each; the best of a few runs
  double gigabytes_per_s = 0.0;  // a copy of 64 MiB between two buffers, bytes read and written
};

// Zeroes on a device without timestamps.
[[nodiscard]] DeviceSpeed measure_speed(vk::Device& device);

}  // namespace render
