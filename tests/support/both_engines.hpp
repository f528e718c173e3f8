// Tests that run once on the double-precision reference and once on the shaders.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "lenses/trace.hpp"
#include "render/gpu_tracer.hpp"
#include "render/vk/device.hpp"

namespace support {

enum class Engine { reference, gpu };

class BothEngines : public testing::TestWithParam<Engine> {
 protected:
  static void SetUpTestSuite() {
    device_ = std::make_unique<render::vk::Device>();
    tracer_ = std::make_unique<render::GpuTracer>(*device_);
  }
  static void TearDownTestSuite() {
    tracer_.reset();
    device_.reset();
  }

  [[nodiscard]] static std::vector<lenses::TraceResult> trace(const std::vector<lenses::TraceRequest>& requests) {
    lenses::TraceBatch batch;
    for (const auto& request : requests) {
      lenses::append_request(batch, request);
    }
    std::vector<lenses::TraceResult> results;
    const auto collect = [&](const auto& records) {
      for (std::size_t i = 0; i < records.size(); ++i) {
        results.push_back(lenses::to_result(records[i], batch.rays[i], requests[i].lens.has_value()));
      }
    };
    if (is_reference()) {
      collect(lenses::trace_reference(batch));
    } else {
      collect(tracer_->trace(batch));
    }
    return results;
  }
  [[nodiscard]] static lenses::TraceResult trace(const lenses::TraceRequest& request) {
    return trace(std::vector{request}).front();
  }

  [[nodiscard]] static bool is_reference() { return GetParam() == Engine::reference; }
  // Of a vergence of this size: a float engine is held to 1e-3 D below 30 D and to 1e-4 of what is larger.
  [[nodiscard]] static double dioptres(double vergence) {
    return is_reference() ? 1e-9 * (1.0 + std::abs(vergence)) : std::max(1e-3, 1e-4 * std::abs(vergence));
  }
  [[nodiscard]] static double metres() { return is_reference() ? 1e-12 : 1e-7; }

  static void expect_vergence(const lenses::TraceResult& result, const glm::dvec3& expected) {
    ASSERT_EQ(result.status, lenses::RayStatus::ok) << lenses::name(result.status);
    const double largest = std::max({std::abs(expected.x), std::abs(expected.y), std::abs(expected.z)});
    EXPECT_NEAR(result.vergence.x, expected.x, dioptres(largest)) << "hh";
    EXPECT_NEAR(result.vergence.y, expected.y, dioptres(largest)) << "hv";
    EXPECT_NEAR(result.vergence.z, expected.z, dioptres(largest)) << "vv";
  }
  static void expect_same(const lenses::TraceResult& a, const lenses::TraceResult& b) {
    ASSERT_EQ(a.status, b.status) << lenses::name(a.status) << " and " << lenses::name(b.status);
    if (a.status == lenses::RayStatus::ok) {
      expect_vergence(a, b.vergence);
      EXPECT_LE(glm::length(a.back_hit - b.back_hit), metres());
      EXPECT_LE(glm::length(a.front_hit - b.front_hit), metres());
    }
  }

  // Pairs of requests that must give the same; in one batch, as every batch compiles its kernel.
  static void expect_same(const std::vector<std::pair<lenses::TraceRequest, lenses::TraceRequest>>& pairs) {
    std::vector<lenses::TraceRequest> requests;
    for (const auto& [one, other] : pairs) {
      requests.push_back(one);
      requests.push_back(other);
    }
    const auto results = trace(requests);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "pair " << i);
      expect_same(results[2 * i], results[2 * i + 1]);
    }
  }

 private:
  static inline std::unique_ptr<render::vk::Device> device_;
  static inline std::unique_ptr<render::GpuTracer> tracer_;
};

inline std::string engine_name(const testing::TestParamInfo<Engine>& instance) {
  return instance.param == Engine::reference ? "reference" : "gpu";
}

}  // namespace support
