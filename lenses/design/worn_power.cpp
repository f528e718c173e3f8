#include "lenses/design/worn_power.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace lenses::design {
namespace {

f64::EyeData eye_of(const WornSetup& setup) {
  Eye eye;
  eye.entrance_pupil_depth = setup.entrance_pupil_depth;
  eye.centre_of_rotation_depth = setup.centre_of_rotation_depth;
  return make_eye_data(eye, 0.0, 1e-3);
}

}  // namespace

WornLens::WornLens(const Lens& lens, const WornSetup& setup)
    : setup_(setup), attached_to_(lens.attached_to), back_(lens.back, lens.back_placement) {
  append_lens(model_, &lens, setup.side, setup.entrance_pupil_depth);
}

std::optional<PointPower> WornLens::along(const glm::dvec3& gaze) const {
  const f64::LensData& lens = model_.lens.front();
  const glm::dvec2 centre(0.0);
  const f64::SightLine line = f64::trace_sight_line(f64::Table{model_.table}, lens, eye_of(setup_),
                                                    f64::listing_rotation(gaze), gaze, centre, centre);
  int status = line.status;
  if (status != f64::kStatusOk) {
    return std::nullopt;
  }
  const glm::dvec3 v = f64::sight_line_vergence(f64::sight_line_transfer(lens, line), 0.0, status);
  if (status != f64::kStatusOk) {
    return std::nullopt;
  }
  PointPower result;
  // From the pupil against the light to the reference vertex.
  result.power =
      nearer_to_eye(glm::dmat2(v.x, v.y, v.y, v.z), -(setup_.reference_vertex + setup_.entrance_pupil_depth));
  const glm::dvec3 bend = line.direction_object / dot(line.direction_object, line.direction);
  result.prism = 100.0 * glm::dvec2(dot(bend, line.e_h), dot(bend, line.e_v));
  return result;
}

std::optional<PointPower> WornLens::through(const glm::dvec2& point) const {
  if (attached_to_ == Lens::AttachedTo::eye) {
    return along({0.0, 0.0, -1.0});
  }
  const f64::SurfacePoint back = back_.at(point);
  if (!back.inside) {
    return std::nullopt;
  }
  const glm::dvec3 on_lens = f64::from_lens_point(model_.lens.front(), {point, back.z});
  const glm::dvec3 centre(0.0, 0.0, setup_.centre_of_rotation_depth - setup_.entrance_pupil_depth);
  return along(normalize(on_lens - centre));
}

}  // namespace lenses::design
