// The shaders on every traced case of tests/data, and against the reference ray by ray.
#include <gtest/gtest.h>

#include "lenses/trace.hpp"
#include "render/gpu_tracer.hpp"
#include "render/vk/device.hpp"
#include "tests/support/case_checks.hpp"

namespace {

TEST(GpuEngine, ReproducesEveryTracedCase) {
  const auto cases = support::read_optics_cases();
  lenses::TraceBatch batch;
  for (const auto& c : cases) {
    lenses::append_request(batch, c.request);
  }
  render::vk::Device device;
  const auto records = render::GpuTracer(device).trace(batch);
  ASSERT_EQ(records.size(), cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    support::expect_case(
        cases[i], lenses::to_result(records[i], batch.rays[i], cases[i].request.lens.has_value()),
        {.dioptres = cases[i].gpu_tolerance, .relative = false, .metres = 1e-7, .radians = 1e-5, .axis_degrees = 1e-3});
  }
}

}  // namespace
