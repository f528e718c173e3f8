// The yardstick of the benchmark gives a plausible speed for whatever device there is.
#include "render/device_speed.hpp"

#include <gtest/gtest.h>

#include "render/vk/device.hpp"

namespace {

// From far below the slowest CPU in use to far above the fastest GPU: a wrong unit or a missed operation count shows.
TEST(DeviceSpeed, LiesBetweenAnyMachines) {
  render::vk::Device device({.validation = true});
  const render::DeviceSpeed speed = render::measure_speed(device);
  EXPECT_GT(speed.gflops, 0.5);
  EXPECT_LT(speed.gflops, 5e5);
  EXPECT_GT(speed.gigabytes_per_s, 0.05);
  EXPECT_LT(speed.gigabytes_per_s, 5e4);
  for (const std::string& message : device.validation_messages()) {
    ADD_FAILURE() << message;
  }
}

}  // namespace
