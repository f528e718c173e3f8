// One line of sight of a request in double precision, with its ray-transfer matrix, and the real rays beside it.
#pragma once

#include <gtest/gtest.h>

#include <glm/mat4x4.hpp>

#include "lenses/trace.hpp"

namespace support {

namespace f64 = lenses::f64;

class Sight {
 public:
  explicit Sight(const lenses::TraceRequest& request) {
    lenses::append_request(batch_, request);
    record = lenses::trace_reference(batch_).front();
    result = lenses::to_result(record, ray(), request.lens.has_value());
    line = beside(glm::dvec2(0.0), glm::dvec2(0.0));
    if (line.status == f64::kStatusOk) {
      transfer = f64::sight_line_transfer(lens(), line);
    }
  }

  // The real ray through another point of the pupil: offset (m) and change of direction in the basis e_h, e_v.
  [[nodiscard]] f64::SightLine beside(const glm::dvec2& offset, const glm::dvec2& momentum) const {
    const glm::dvec3 direction(ray().direction);
    const glm::dmat3 turn = f64::eye_turn(ray().which.z, glm::dvec3(ray().gaze), direction);
    return f64::trace_sight_line(table(), lens(), eye(), turn, direction, offset, momentum);
  }

  [[nodiscard]] bool ok() const { return result.status == lenses::RayStatus::ok; }
  [[nodiscard]] const f64::TraceInput& ray() const { return batch_.rays.front(); }
  [[nodiscard]] const f64::LensData& lens() const { return batch_.model.lens.front(); }
  [[nodiscard]] const f64::EyeData& eye() const { return batch_.eyes.front(); }
  [[nodiscard]] f64::Table table() const { return f64::Table{batch_.model.table}; }
  [[nodiscard]] double inverse_distance() const { return ray().direction.w; }
  [[nodiscard]] double largest() const {
    return std::max({std::abs(result.vergence.x), std::abs(result.vergence.y), std::abs(result.vergence.z)});
  }

  f64::SightLine line;
  f64::RayTransfer transfer{};
  f64::TraceOutput record{};
  lenses::TraceResult result;

 private:
  lenses::TraceBatch batch_;
};

inline void expect_same_vergence(const glm::dvec3& a, const glm::dvec3& b, double dioptres) {
  EXPECT_NEAR(a.x, b.x, dioptres) << "hh";
  EXPECT_NEAR(a.y, b.y, dioptres) << "hv";
  EXPECT_NEAR(a.z, b.z, dioptres) << "vv";
}

}  // namespace support
