// Contact lenses: the shaders within 1e-3 D of the double-precision reference at every vertex distance from 0 to
// 0.5 mm; the lens's power as it is made; and on the turning eye the lens goes with it.
#include "tests/support/hard_case.hpp"

namespace {

using lenses::RayStatus;
using lenses::TraceRequest;
using support::kRadians;
using support::Random;
using Viewing = TraceRequest::Viewing;

struct Make {
  const char* name;
  double index, back_radius, thickness, diameter;  // m
};
constexpr Make kSoft{"soft", 1.43, 8.6e-3, 0.08e-3, 14.2e-3};
constexpr Make kRigid{"rigid", 1.45, 7.8e-3, 0.14e-3, 9.6e-3};
constexpr double kPowers[] = {-20.0, -8.0, -3.0, -0.5, 0.0, 2.0, 6.0, 15.0};

// Of a back vertex power. A plus lens is as much thicker in the middle as its front is steeper at the rim.
TraceRequest contact_lens(const Make& make, double power, double vertex_distance) {
  TraceRequest request;
  request.lens.emplace();
  lenses::Lens& lens = *request.lens;
  lens.index = make.index;
  lens.diameter = make.diameter;
  lens.centre_thickness = make.thickness + std::max(0.0, power) * 2.5e-5;
  lens.back = lenses::Sphere{1.0 / make.back_radius};
  const double needed = power + (make.index - 1.0) / make.back_radius;
  const double front = needed / (1.0 + lens.centre_thickness / make.index * needed);
  lens.front = lenses::Sphere{front / (make.index - 1.0)};
  lens.fit.vertex_distance = vertex_distance;
  lens.attached_to = lenses::Lens::AttachedTo::eye;
  return request;
}

class ContactLens : public support::HardCase {};

TEST_P(ContactLens, HasThePowerItIsMadeFor) {
  for (const Make& make : {kSoft, kRigid}) {
    for (const double power : kPowers) {
      SCOPED_TRACE(testing::Message() << make.name << " " << power);
      const auto request = contact_lens(make, power, 0.0);
      const double v = power / (1.0 - request.eye.entrance_pupil_depth * power);
      expect_vergence(trace(request), {v, 0.0, v});
    }
  }
}

// Gaze and ray turned together, and the wearer's own axes with them: all that the eye sees is what it saw.
TEST_P(ContactLens, TurnsWithTheEye) {
  for (const Make& make : {kSoft, kRigid}) {
    std::vector<TraceRequest> requests;
    for (const double right : {0.0, -40.0, 15.0, 30.0}) {
      for (const double up : {0.0, 25.0, -35.0}) {
        auto request = contact_lens(make, -6.0, 0.0);
        request.lens->back = lenses::Torus{1.0 / make.back_radius, 0.97 / make.back_radius, 0.5};
        request.lens->fit.decentration = {0.0005, -0.0003};
        request.viewing = Viewing::gaze;
        request.gaze = tracking::direction_from_yaw_pitch(right * kRadians, up * kRadians);
        // 5 degrees beside the gaze, in the turned eye's axes.
        request.direction = tracking::listing_rotation(request.gaze) *
                            tracking::direction_from_yaw_pitch(5.0 * kRadians, 3.0 * kRadians);
        requests.push_back(request);
      }
    }
    const auto results = trace(requests);
    ASSERT_EQ(results[0].status, RayStatus::ok);
    for (std::size_t i = 1; i < results.size(); ++i) {
      SCOPED_TRACE(testing::Message() << make.name << ", gaze " << i);
      expect_vergence(results[i], results[0].vergence);
      const glm::dmat3 turn = tracking::listing_rotation(requests[i].gaze);
      const glm::dvec3 centre(0.0, 0.0, 0.0135 - 0.00305);
      EXPECT_LE(glm::length(results[i].back_hit - (centre + turn * (results[0].back_hit - centre))), metres());
      EXPECT_LE(glm::length(results[i].object_direction - turn * results[0].object_direction),
                is_reference() ? 1e-13 : 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, ContactLens, testing::Values(support::Engine::reference, support::Engine::gpu),
                         support::engine_name);

// 30 D and more arise only near the rims of the strongest; there, as everywhere, a float engine is held to 1e-4 of V.
TEST(ContactLensesOnBothEngines, AgreeAtEveryVertexDistance) {
  constexpr std::uint64_t kSeed = 1887;
  Random random(kSeed);
  lenses::TraceBatch batch;
  for (const Make& make : {kSoft, kRigid}) {
    for (int hundredth = 0; hundredth <= 50; ++hundredth) {
      for (const double power : kPowers) {
        const auto lens = contact_lens(make, power, hundredth * 1e-5);
        for (int k = 0; k < 12; ++k) {
          auto request = lens;
          request.viewing = std::array{Viewing::fixed, Viewing::scanning, Viewing::gaze}[random.pick(3)];
          request.gaze = random.direction_ahead(40.0 * kRadians);
          // Up to 40 degrees off the eye's axis, which is at the rim of the rigid lens.
          const glm::dvec3 beside = random.direction_ahead(40.0 * kRadians);
          request.direction =
              request.viewing == Viewing::gaze ? tracking::listing_rotation(request.gaze) * beside : beside;
          request.object_distance = k % 3 == 0 ? std::nullopt : std::optional(random.log_uniform(0.2, 10.0));
          lenses::append_request(batch, request);
        }
      }
    }
  }
  render::vk::Device device;
  const auto gpu = render::GpuTracer(device).trace(batch);
  const auto reference = lenses::trace_reference(batch);
  double worst = 0.0;
  std::size_t passed = 0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    ASSERT_EQ(reference[i].status.x, gpu[i].status.x) << "seed " << kSeed << ", ray " << i;
    if (reference[i].status.x != lenses::f64::kStatusOk) {
      continue;
    }
    ++passed;
    const glm::dvec3 v(reference[i].vergence);
    const glm::dvec3 difference = glm::abs(glm::dvec3(gpu[i].vergence) - v);
    const double error = std::max({difference.x, difference.y, difference.z});
    const double size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    EXPECT_LE(error, std::max(1e-3, 1e-4 * size)) << "seed " << kSeed << ", ray " << i << ", V " << v.x;
    worst = size < 30.0 ? std::max(worst, error) : worst;
  }
  std::cout << passed << " of " << reference.size() << " rays pass, largest difference " << worst << " D\n";
  EXPECT_GE(passed, reference.size() * 3 / 4);
}

}  // namespace
