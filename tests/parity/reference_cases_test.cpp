// The double-precision reference on every traced case of tests/data.
#include <gtest/gtest.h>

#include "lenses/trace.hpp"
#include "tests/support/case_checks.hpp"

namespace {

TEST(ReferenceEngine, ReproducesEveryTracedCase) {
  const auto cases = support::read_optics_cases();
  ASSERT_EQ(cases.size(), 140U);
  lenses::TraceBatch batch;
  for (const auto& c : cases) {
    lenses::append_request(batch, c.request);
  }
  const auto records = lenses::trace_reference(batch);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    support::expect_case(cases[i], lenses::to_result(records[i], batch.rays[i], cases[i].request.lens.has_value()),
                         {.dioptres = 1e-7, .relative = true, .metres = 1e-9, .radians = 1e-9, .axis_degrees = 1e-6});
  }
}

// The same text compiled for float: what a shader computes, held to the tolerance of a float engine.
TEST(FloatEngine, ReproducesEveryTracedCase) {
  const auto cases = support::read_optics_cases();
  lenses::TraceBatch batch;
  for (const auto& c : cases) {
    lenses::append_request(batch, c.request);
  }
  const auto records = lenses::trace_reference_float(batch);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    support::expect_case(
        cases[i], lenses::to_result(records[i], batch.rays[i], cases[i].request.lens.has_value()),
        {.dioptres = cases[i].gpu_tolerance, .relative = false, .metres = 1e-7, .radians = 1e-5, .axis_degrees = 1e-3});
  }
}

}  // namespace
