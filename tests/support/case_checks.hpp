// Holds an engine's result against an optics case.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lenses/trace_result.hpp"
#include "tests/support/optics_cases.hpp"

namespace support {

struct CaseTolerance {
  double dioptres;      // absolute
  bool relative;        // beyond |V| = 100 D the dioptres are relative to |V|/100
  double metres;        // positions
  double radians;       // directions
  double axis_degrees;  // where the astigmatism is 0.05 D or more
};

inline void expect_case(const OpticsCase& c, const lenses::TraceResult& r, const CaseTolerance& tolerance) {
  SCOPED_TRACE(c.id);
  const std::string status = c.expected.at("status");
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(std::isfinite(r.vergence[i]) && std::isfinite(r.residual[i]) && std::isfinite(r.front_hit[i]));
  }
  if (c.borderline && status != lenses::name(r.status)) {
    return;  // either status is right for a ray on the border
  }
  ASSERT_EQ(status, lenses::name(r.status));
  if (status != "ok") {
    return;
  }
  const auto number = [&](const char* key) { return c.expected.at(key).get<double>(); };
  double largest = 100.0;
  for (const auto& v : c.expected.at("vergence_D")) {
    largest = std::max(largest, std::abs(v.get<double>()));
  }
  const double dioptres = tolerance.relative ? tolerance.dioptres * largest / 100.0 : tolerance.dioptres;
  // At grazing exit a rounding of the sine turns the ray by 1/cos as much: n sin phi = 0.9999 leaves cos = 0.014.
  const double radians = tolerance.radians * (c.id.find("near_tir") != std::string::npos ? 10.0 : 1.0);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(r.vergence[i], c.expected.at("vergence_D")[k].get<double>(), dioptres) << "vergence " << i;
    EXPECT_NEAR(r.residual[i], c.expected.at("residual_D")[k].get<double>(), dioptres) << "residual " << i;
    EXPECT_NEAR(r.object_direction[i], c.expected.at("object_direction")[k].get<double>(), radians);
    if (c.expected.contains("back_hit_m")) {
      EXPECT_NEAR(r.back_hit[i], c.expected.at("back_hit_m")[k].get<double>(), tolerance.metres) << "back hit " << i;
      EXPECT_NEAR(r.front_hit[i], c.expected.at("front_hit_m")[k].get<double>(), tolerance.metres) << "front hit " << i;
    }
  }
  EXPECT_NEAR(r.power, number("power_D"), dioptres);
  EXPECT_NEAR(r.astigmatism, number("astigmatism_D"), 2.0 * dioptres);
  EXPECT_NEAR(r.accommodation, number("accommodation_D"), dioptres);
  EXPECT_NEAR(r.deviation, number("deviation_rad"), 2.0 * radians);
  if (number("astigmatism_D") >= 0.05) {
    ASSERT_TRUE(r.axis_deg.has_value());
    const double turn = std::remainder(*r.axis_deg - number("axis_deg"), 180.0);
    // An error of dV turns the axis by up to dV / A radians.
    EXPECT_NEAR(turn, 0.0, tolerance.axis_degrees + 57.3 * dioptres / number("astigmatism_D"));
  } else if (c.expected.at("axis_deg").is_null() && tolerance.dioptres < 1e-6) {
    EXPECT_FALSE(r.axis_deg.has_value());
  }
  if (c.expected.contains("blur_rad")) {
    const double half_pupil = 0.5 * c.request.eye.pupil_diameter.value_or(0.0035);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(r.blur[i], c.expected.at("blur_rad")[static_cast<std::size_t>(i)].get<double>(),
                  half_pupil * 2.0 * dioptres);
    }
    const auto& axis = c.expected.at("blur_axis_deg");
    const double difference = c.expected.at("blur_rad")[0].get<double>() - c.expected.at("blur_rad")[1].get<double>();
    if (axis.is_null()) {
      EXPECT_FALSE(r.blur_axis_deg.has_value()) << "a round blur has no axis";
    } else if (difference > half_pupil * 0.05) {
      ASSERT_TRUE(r.blur_axis_deg.has_value());
      // As for the wavefront's axis; the difference of the semi-axes is what the error is measured against.
      EXPECT_NEAR(std::remainder(*r.blur_axis_deg - axis.get<double>(), 180.0), 0.0,
                  tolerance.axis_degrees + 57.3 * 2.0 * dioptres * half_pupil / difference);
    }
  }
}

}  // namespace support
