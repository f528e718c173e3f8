// A million random rays through absurd lenses on both engines: every number finite, every status one of the six. And
// the two engines side by side on lenses that could be worn.
#include <gtest/gtest.h>

#include <iostream>

#include "lenses/trace.hpp"
#include "render/gpu_tracer.hpp"
#include "render/vk/device.hpp"
#include "tests/support/absurd_lens.hpp"

namespace {

using lenses::TraceRequest;
using support::Random;

constexpr std::size_t kLensBatches = 20;
constexpr std::size_t kLensesABatch = 100;
constexpr std::size_t kRaysALens = 500;

// The lens parameters need not be printed: a seed and two indices make them again.
lenses::TraceBatch absurd_batch(std::uint64_t seed) {
  Random random(seed);
  lenses::TraceBatch batch;
  for (std::size_t i = 0; i < kLensesABatch; ++i) {
    TraceRequest request;
    if (!random.chance(0.02)) {
      request.lens = support::absurd_lens(random);
    }
    request.side = random.chance(0.5) ? lenses::Side::right : lenses::Side::left;
    request.eye.entrance_pupil_depth = random.uniform(0.0, 0.01);
    request.eye.centre_of_rotation_depth = random.uniform(0.0, 0.03);
    request.eye.power = lenses::RelaxedPower{random.uniform(0.0, 200.0), random.uniform(0.0, 200.0), 1.0};
    lenses::append_request(batch, request);
    const lenses::f64::TraceInput first = batch.rays.back();
    batch.rays.pop_back();
    for (std::size_t k = 0; k < kRaysALens; ++k) {
      lenses::f64::TraceInput ray = first;
      const double q = random.chance(0.2) ? 0.0 : 1.0 / support::absurd_distance(random);
      glm::dvec3 direction = support::absurd_direction(random);
      if (request.lens && random.chance(0.5)) {  // at the lens
        const double reach = 0.6 * request.lens->diameter;
        const glm::dvec3 point = lenses::f64::from_lens_point(
            batch.model.lens.back(), {random.uniform(-reach, reach), random.uniform(-reach, reach), 0.0});
        direction = glm::length(point) > 0.0 ? glm::normalize(point) : direction;
      }
      ray.direction = glm::dvec4(direction, q);
      ray.gaze = glm::dvec4(support::absurd_direction(random), 0.0);
      ray.which.z = static_cast<int>(random.pick(3));
      batch.rays.push_back(ray);
    }
  }
  return batch;
}

template <class Record>
bool is_finite(const Record& r) {
  bool finite = true;
  for (const auto& v : {r.vergence, r.residual, r.blur, r.back_hit, r.front_hit, r.object_direction}) {
    finite = finite && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
  }
  return finite;
}

struct Tally {
  std::array<std::size_t, 6> status{};
  std::size_t bad = 0;
};

template <class Record>
void count(const std::vector<Record>& records, const lenses::TraceBatch& batch, std::uint64_t seed, const char* engine,
           Tally& tally) {
  ASSERT_EQ(records.size(), batch.rays.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const int status = records[i].status.x;
    const bool good = status >= 0 && status < 6 && is_finite(records[i]);
    if (status >= 0 && status < 6) {
      ++tally.status[static_cast<std::size_t>(status)];
    }
    if (!good && ++tally.bad <= 10) {
      const auto& lens = batch.model.lens[static_cast<std::size_t>(batch.rays[i].which.x)];
      ADD_FAILURE() << engine << ", seed " << seed << ", ray " << i << ": status " << status << ", back kind "
                    << lens.back.kind.x << ", front kind " << lens.front.kind.x << ", V " << records[i].vergence.x
                    << " " << records[i].vergence.y << " " << records[i].vergence.z << ", R " << records[i].residual.x
                    << " " << records[i].residual.w << ", blur " << records[i].blur.x << " " << records[i].blur.y << " "
                    << records[i].blur.z << ", back " << records[i].back_hit.z << ", front " << records[i].front_hit.z
                    << ", direction " << records[i].object_direction.z;
    }
  }
}

TEST(RandomRays, GiveFiniteOutputsWhateverTheLens) {
  render::vk::Device device;
  render::GpuTracer tracer(device);
  Tally reference;
  Tally gpu;
  for (std::uint64_t seed = 1; seed <= kLensBatches; ++seed) {
    const lenses::TraceBatch batch = absurd_batch(seed);
    count(lenses::trace_reference(batch), batch, seed, "reference", reference);
    count(tracer.trace(batch), batch, seed, "gpu", gpu);
  }
  EXPECT_EQ(reference.bad, 0U);
  EXPECT_EQ(gpu.bad, 0U);
  for (std::size_t s = 0; s < 6; ++s) {
    // Every outcome is met, or the rays test nothing (singular takes an exact image in the pupil).
    if (s != lenses::f64::kStatusSingular) {
      EXPECT_GE(reference.status[s], 1000U);
      EXPECT_GE(gpu.status[s], 1000U);
    }
    std::cout << lenses::name(static_cast<lenses::RayStatus>(s)) << ": reference " << reference.status[s] << ", gpu "
              << gpu.status[s] << "\n";
  }
}

// 1e-3 D where |V| < 30 D is what a float engine is held to (a twentieth of the least visible blur).
TEST(RandomRays, AgreeOnLensesThatCouldBeWorn) {
  constexpr std::uint64_t kSeed = 77;
  Random random(kSeed);
  lenses::TraceBatch batch;
  for (int i = 0; i < 300; ++i) {
    const lenses::Lens lens = support::ordinary_lens(random);
    for (int k = 0; k < 200; ++k) {
      lenses::append_request(batch, support::ordinary_request(random, lens, 65.0 * support::kRadians));
    }
  }
  render::vk::Device device;
  const auto reference = lenses::trace_reference(batch);
  const auto gpu = render::GpuTracer(device).trace(batch);
  std::size_t compared = 0;
  std::size_t status_differs = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    if (reference[i].status.x != gpu[i].status.x) {
      ++status_differs;
      continue;
    }
    const glm::dvec3 v(reference[i].vergence);
    if (reference[i].status.x != lenses::f64::kStatusOk ||
        std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) >= 30.0) {
      continue;
    }
    ++compared;
    const glm::dvec3 difference = glm::dvec3(gpu[i].vergence) - v;
    const double error = std::max({std::abs(difference.x), std::abs(difference.y), std::abs(difference.z)});
    worst = std::max(worst, error);
    EXPECT_LE(error, 1e-3) << "seed " << kSeed << ", ray " << i;
    EXPECT_LE(glm::length(glm::dvec3(gpu[i].front_hit) - glm::dvec3(reference[i].front_hit)), 1e-7)
        << "seed " << kSeed << ", ray " << i;
  }
  std::cout << compared << " rays compared, largest difference " << worst << " D, " << status_differs
            << " statuses differ\n";
  EXPECT_GE(compared, reference.size() / 3);
  // Rays within rounding of a rim.
  EXPECT_LE(status_differs, reference.size() / 1000);
}

}  // namespace
