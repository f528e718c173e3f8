#include "lenses/design/worn_power.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lenses/design/lens_shape.hpp"
#include "lenses/lens_model.hpp"

namespace lenses::design {
namespace {

f64::EyeData eye_of(const WornSetup& setup) {
  Eye eye;
  eye.entrance_pupil_depth = setup.entrance_pupil_depth;
  eye.centre_of_rotation_depth = setup.centre_of_rotation_depth;
  return make_eye_data(eye, 0.0, 1e-3);
}

std::optional<PointPower> along(const LensModel& model, const WornSetup& setup, const glm::dvec3& gaze) {
  const f64::Table table{model.table};
  const f64::LensData& lens = model.lens.front();
  const glm::dvec2 centre(0.0);
  const f64::SightLine line =
      f64::trace_sight_line(table, lens, eye_of(setup), f64::listing_rotation(gaze), gaze, centre, centre);
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
  result.power = nearer_to_eye(glm::dmat2(v.x, v.y, v.y, v.z), -(setup.reference_vertex + setup.entrance_pupil_depth));
  const glm::dvec3 bend = line.direction_object / dot(line.direction_object, line.direction);
  result.prism = 100.0 * glm::dvec2(dot(bend, line.e_h), dot(bend, line.e_v));
  return result;
}

LensModel model_of(const Lens& lens, const WornSetup& setup) {
  LensModel model;
  append_lens(model, &lens, setup.side, setup.entrance_pupil_depth);
  return model;
}

}  // namespace

std::optional<PointPower> worn_power(const Lens& lens, const WornSetup& setup, const glm::dvec2& point) {
  const LensModel model = model_of(lens, setup);
  if (lens.attached_to == Lens::AttachedTo::eye) {
    return along(model, setup, {0.0, 0.0, -1.0});
  }
  const f64::SurfacePoint back = PlacedSurface(lens.back, lens.back_placement).at(point);
  if (!back.inside) {
    return std::nullopt;
  }
  const glm::dvec3 on_lens = f64::from_lens_point(model.lens.front(), {point, back.z});
  const glm::dvec3 centre(0.0, 0.0, setup.centre_of_rotation_depth - setup.entrance_pupil_depth);
  return along(model, setup, normalize(on_lens - centre));
}

std::optional<PointPower> worn_power_along(const Lens& lens, const WornSetup& setup, const glm::dvec3& gaze) {
  return along(model_of(lens, setup), setup, gaze);
}

}  // namespace lenses::design
