#include "lenses/trace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lenses {
namespace {

// Numbers that cross to the shaders.
static_assert(f64::kStatusOk == static_cast<int>(RayStatus::ok) &&
              f64::kStatusMissBack == static_cast<int>(RayStatus::miss_back) &&
              f64::kStatusMissFront == static_cast<int>(RayStatus::miss_front) &&
              f64::kStatusTirFront == static_cast<int>(RayStatus::tir_front) &&
              f64::kStatusInverted == static_cast<int>(RayStatus::inverted) &&
              f64::kStatusSingular == static_cast<int>(RayStatus::singular));
static_assert(f64::kViewingFixed == static_cast<int>(tracking::Viewing::fixed) &&
              f64::kViewingScanning == static_cast<int>(tracking::Viewing::scanning) &&
              f64::kViewingGaze == static_cast<int>(tracking::Viewing::gaze));

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kRound = 1e-9;         // D; below this a wavefront or a blur has no axis
constexpr double kRoundInFloat = 1e-5;  // of the vergence; two semi-axes as close as that are equal to a float engine

std::optional<double> axis_degrees(double axis, double difference) {
  if (!(difference >= kRound)) {
    return std::nullopt;
  }
  double degrees = std::fmod(axis * kDegrees, 180.0);
  if (degrees < 0.0) {
    degrees += 180.0;
  }
  return degrees >= 180.0 ? 0.0 : degrees;
}

f64::TraceOutput widen(const f32::TraceOutput& r) {
  return {r.status,
          glm::dvec4(r.vergence),
          glm::dvec4(r.residual),
          glm::dvec4(r.blur),
          glm::dvec4(r.back_hit),
          glm::dvec4(r.front_hit),
          glm::dvec4(r.object_direction)};
}

f32::TraceInput narrow(const f64::TraceInput& r) {
  return {glm::vec4(r.direction), glm::vec4(r.gaze), r.which};
}

std::size_t lens_index_of(TraceBatch& batch, const TraceRequest& request) {
  constexpr std::size_t kRecent = 8;
  const double depth = request.eye.entrance_pupil_depth;
  if (!request.lens) {
    if (!batch.bare) {
      batch.bare = append_lens(batch.model, nullptr, request.side, depth);
    }
    return *batch.bare;
  }
  for (const TraceBatch::KnownLens& known : batch.recent) {
    if (known.side == request.side && known.entrance_pupil_depth == depth && known.lens == *request.lens) {
      return known.index;
    }
  }
  const std::size_t index = append_lens(batch.model, &*request.lens, request.side, depth);
  if (batch.recent.size() == kRecent) {
    batch.recent.erase(batch.recent.begin());
  }
  batch.recent.push_back({*request.lens, request.side, depth, index});
  return index;
}

}  // namespace

double accommodation_amplitude_at(double age) {
  return 7.083 / (1.0 + std::exp(0.2031 * (age - 36.2) - 0.6109));
}

void next_batch(TraceBatch& batch) {
  constexpr std::size_t kMostEntries = 1U << 20U;  // of the table: 32 MiB
  constexpr std::size_t kMostLenses = 1U << 15U;
  if (batch.model.table.size() > kMostEntries || batch.model.lens.size() > kMostLenses) {
    batch = {};
    return;
  }
  batch.eyes.clear();
  batch.rays.clear();
}

void append_request(TraceBatch& batch, const TraceRequest& request) {
  const std::size_t lens_index = lens_index_of(batch, request);
  batch.eyes.push_back(
      make_eye_data(request.eye, request.eye.accommodation_amplitude.value_or(accommodation_amplitude_at(kDefaultAge)),
                    request.eye.pupil_diameter.value_or(kDefaultPupilDiameter)));
  const double q = request.object_distance ? 1.0 / *request.object_distance : 0.0;
  f64::TraceInput ray{};
  ray.direction = glm::dvec4(glm::normalize(request.direction), q);
  ray.gaze = glm::dvec4(glm::normalize(request.gaze), 0.0);
  ray.which = glm::ivec4(static_cast<int>(lens_index), static_cast<int>(batch.eyes.size() - 1),
                         static_cast<int>(request.viewing), 0);
  batch.rays.push_back(ray);
}

std::vector<f64::TraceOutput> trace_reference(const TraceBatch& batch) {
  const f64::Table table{batch.model.table};
  std::vector<f64::TraceOutput> out;
  out.reserve(batch.rays.size());
  for (const f64::TraceInput& ray : batch.rays) {
    out.push_back(f64::trace_record(table, batch.model.lens[static_cast<std::size_t>(ray.which.x)],
                                    batch.eyes[static_cast<std::size_t>(ray.which.y)], ray));
  }
  return out;
}

std::vector<f32::TraceOutput> trace_reference_float(const TraceBatch& batch) {
  const std::vector<glm::vec4> entries = to_float(batch.model.table);
  const f32::Table table{entries};
  std::vector<f32::TraceOutput> out;
  out.reserve(batch.rays.size());
  for (const f64::TraceInput& ray : batch.rays) {
    out.push_back(f32::trace_record(table, to_float(batch.model.lens[static_cast<std::size_t>(ray.which.x)]),
                                    to_float(batch.eyes[static_cast<std::size_t>(ray.which.y)]), narrow(ray)));
  }
  return out;
}

namespace {

TraceResult result_of(const f64::TraceOutput& record, const f64::TraceInput& ray, bool has_lens, double rounding) {
  TraceResult result;
  result.status = static_cast<RayStatus>(record.status.x);
  result.has_lens = has_lens;
  if (result.status != RayStatus::ok) {
    return result;
  }
  const glm::dvec3 v(record.vergence);
  const glm::dvec3 k = f64::principal(v);
  result.vergence = v;
  result.power = 0.5 * (v.x + v.z);
  result.astigmatism = k.x - k.y;
  result.axis_deg = axis_degrees(k.z, result.astigmatism);
  result.back_hit = glm::dvec3(record.back_hit);
  result.front_hit = glm::dvec3(record.front_hit);
  result.object_direction = glm::normalize(glm::dvec3(record.object_direction));
  const glm::dvec3 direction(ray.direction);
  result.deviation =
      std::atan2(glm::length(cross(direction, result.object_direction)), dot(direction, result.object_direction));
  result.accommodation = record.vergence.w;
  result.residual = glm::dvec3(record.residual);
  result.blur = glm::dvec2(record.blur);
  const glm::dvec3 r = f64::principal(result.residual);
  const double largest = std::max({1.0, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const double difference = std::abs(std::abs(r.x) - std::abs(r.y));
  if (difference >= rounding * largest) {
    result.blur_axis_deg = axis_degrees(record.residual.w, difference);
  }
  return result;
}

}  // namespace

TraceResult to_result(const f64::TraceOutput& record, const f64::TraceInput& ray, bool has_lens) {
  return result_of(record, ray, has_lens, 0.0);
}

TraceResult to_result(const f32::TraceOutput& record, const f64::TraceInput& ray, bool has_lens) {
  return result_of(widen(record), ray, has_lens, kRoundInFloat);
}

}  // namespace lenses
