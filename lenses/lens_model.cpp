#include "lenses/lens_model.hpp"

#include <cmath>
#include <numbers>

#include "lenses/surface_model.hpp"

namespace lenses {
namespace {

// Right eye Ry(-wrap) Rx(-panto), left eye Ry(+wrap) Rx(-panto): a positive wrap brings the temporal edge closer.
glm::dmat3 eye_from_lens_rotation(const Fit& fit, Side side) {
  const double w = side == Side::right ? -fit.wrap : fit.wrap;
  const double p = -fit.pantoscopic_tilt;
  const glm::dmat3 about_y({std::cos(w), 0.0, -std::sin(w)}, {0.0, 1.0, 0.0}, {std::sin(w), 0.0, std::cos(w)});
  const glm::dmat3 about_x({1.0, 0.0, 0.0}, {0.0, std::cos(p), std::sin(p)}, {0.0, -std::sin(p), std::cos(p)});
  return about_y * about_x;
}

glm::dmat2 cylinder_form(double along, double across, double axis) {
  const glm::dvec2 a(std::cos(axis), std::sin(axis));
  const glm::dvec2 b(-a.y, a.x);
  return along * glm::outerProduct(a, a) + across * glm::outerProduct(b, b);
}

// The excess power E - I/l of the relaxed eye at the pupil, in the axes of the wearer.
glm::dmat2 relaxed_excess(const Eye& eye) {
  if (eye.zernike) {
    // Thibos et al. 2002: the correcting lens's power vector from the second-order coefficients.
    const double r2 = 0.25 * eye.zernike->pupil_diameter * eye.zernike->pupil_diameter;
    const auto coefficient = [&](std::size_t j) {
      return j < eye.zernike->coefficients.size() ? eye.zernike->coefficients[j] : 0.0;
    };
    const double m = -4.0 * std::sqrt(3.0) * coefficient(4) / r2;
    const double j0 = -2.0 * std::sqrt(6.0) * coefficient(5) / r2;
    const double j45 = -2.0 * std::sqrt(6.0) * coefficient(3) / r2;
    return glm::dmat2(-(m + j0), j45, j45, -(m - j0));  // the examiner's x mirrored
  }
  if (const auto* relaxed = std::get_if<RelaxedPower>(&eye.power)) {
    return cylinder_form(relaxed->q1, relaxed->q2, relaxed->axis) - glm::dmat2(1.0 / eye.axial_length);
  }
  if (const auto* refraction = std::get_if<Refraction>(&eye.power)) {
    const glm::dmat2 f = cylinder_form(refraction->sphere, refraction->sphere + refraction->cylinder,
                                       std::numbers::pi - refraction->axis);
    const double d = eye.refraction_vertex + eye.entrance_pupil_depth;
    return -(f * glm::inverse(glm::dmat2(1.0) - d * f));
  }
  return glm::dmat2(0.0);
}

template <class To, class From>
void round_surface(To& to, const From& from) {
  to.shape = glm::vec4(from.shape);
  to.frame = glm::vec4(from.frame);
  to.domain = glm::vec4(from.domain);
  to.kind = from.kind;
  to.offset = from.offset;
  to.shift = glm::vec4(from.shift);
  to.slope = glm::vec4(from.slope);
  to.parts = from.parts;
}

// Whether the surfaces may cross within the lens's cylinder: no, where samples of the gap between them leave no room
// for it. 1.5: how much steeper the gap may be between samples than at them.
bool may_cross(const f64::LensData& lens, const std::vector<glm::dvec4>& table) {
  constexpr int kSamples = 32;                                       // along a half diameter
  if (lens.back.parts.z > 0 || lens.front.parts.z > 0) return true;  // the walls of segments
  const double step = lens.glass.z / kSamples;
  double least = 1e30;
  double steepest = 0.0;
  for (int i = -kSamples - 1; i <= kSamples + 1; ++i) {
    for (int j = -kSamples - 1; j <= kSamples + 1; ++j) {
      const glm::dvec2 p(i * step, j * step);
      if (glm::length(p) > lens.glass.z + 1.5 * step) continue;
      const f64::SurfacePoint back = f64::surface_point(f64::Table{table}, lens.back, p);
      const f64::SurfacePoint front = f64::surface_point(f64::Table{table}, lens.front, p);
      if (!back.inside || !front.inside) return true;
      least = std::min(least, lens.glass.y + back.z - front.z);
      steepest = std::max(steepest, glm::length(back.gradient - front.gradient));
    }
  }
  return !(least > 1.5 * steepest * step);
}

}  // namespace

std::size_t append_lens(LensModel& model, const Lens* lens, Side side, double entrance_pupil_depth) {
  f64::LensData data{};
  if (lens != nullptr) {
    const glm::dmat3 rotation = eye_from_lens_rotation(lens->fit, side);
    const double semi_diameter = 0.5 * lens->diameter;
    data.axis_x = glm::dvec4(rotation[0], lens->fit.decentration.x);
    data.axis_y = glm::dvec4(rotation[1], lens->fit.decentration.y);
    data.axis_z = glm::dvec4(rotation[2], -(lens->fit.vertex_distance + entrance_pupil_depth));
    data.glass = glm::dvec4(lens->index, lens->centre_thickness, semi_diameter, 1.0);
    data.mount.x = lens->attached_to == Lens::AttachedTo::eye ? 1 : 0;
    data.back = make_surface(lens->back, lens->back_placement, semi_diameter, model.table);
    data.front = make_surface(lens->front, lens->front_placement, semi_diameter, model.table);
    data.mount.y = may_cross(data, model.table) ? 1 : 0;
  }
  model.lens.push_back(data);
  return model.lens.size() - 1;
}

f64::EyeData make_eye_data(const Eye& eye, double accommodation_amplitude, double pupil_diameter) {
  const glm::dmat2 e = relaxed_excess(eye);
  f64::EyeData data{};
  data.excess = glm::dvec4(e[0][0], e[0][1], e[1][1], accommodation_amplitude);
  data.pupil = glm::dvec4(pupil_diameter, eye.centre_of_rotation_depth - eye.entrance_pupil_depth, 0.0, 0.0);
  return data;
}

f32::LensData to_float(const f64::LensData& lens) {
  f32::LensData out{};
  out.axis_x = glm::vec4(lens.axis_x);
  out.axis_y = glm::vec4(lens.axis_y);
  out.axis_z = glm::vec4(lens.axis_z);
  out.glass = glm::vec4(lens.glass);
  out.mount = lens.mount;
  round_surface(out.back, lens.back);
  round_surface(out.front, lens.front);
  return out;
}

f32::EyeData to_float(const f64::EyeData& eye) {
  f32::EyeData out{};
  out.excess = glm::vec4(eye.excess);
  out.pupil = glm::vec4(eye.pupil);
  return out;
}

std::vector<glm::vec4> to_float(const std::vector<glm::dvec4>& table) {
  return {table.begin(), table.end()};
}

}  // namespace lenses
