#include "lenses/trace.hpp"

#include <cmath>
#include <numbers>

namespace lenses {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kRound = 1e-9;  // D; below this a wavefront or a blur has no axis

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
    return append_lens(batch.model, nullptr, request.side, depth);
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

TraceResult to_result(const f64::TraceOutput& record, const f64::TraceInput& ray, bool has_lens) {
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
  result.blur_axis_deg = axis_degrees(record.residual.w, std::abs(std::abs(r.x) - std::abs(r.y)));
  return result;
}

TraceResult to_result(const f32::TraceOutput& record, const f64::TraceInput& ray, bool has_lens) {
  return to_result(widen(record), ray, has_lens);
}

}  // namespace lenses
