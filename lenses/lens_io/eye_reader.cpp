#include "lenses/lens_io/eye_reader.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_text.hpp"

namespace lenses::io {
namespace {

constexpr Limits kAmplitude = plain(0.0, 25.0);
constexpr Limits kPupil = millimetres(0.5, 9.0);
constexpr std::size_t kMostZernike = 66;  // all terms to the tenth order

// A plus lens whose focus lies at the pupil or in front of it corrects no eye, and F / (1 - dF) has its pole there.
constexpr double kMostVertexPower = 0.95;

Refraction read_refraction(const Field& object, double lens_to_pupil) {
  object.allow_only({"sphere", "cylinder", "axis"});
  Refraction result;
  result.sphere = object.required_number("sphere", plain(-40.0, 40.0));
  object.read("cylinder", plain(-20.0, 20.0), result.cylinder);
  if (result.cylinder != 0.0) {
    result.axis = object.require("axis", "a number of degrees, as the cylinder is not 0").axis();
  } else if (const auto axis = object.find("axis")) {
    result.axis = axis->axis();
  }
  const double strongest = std::max(result.sphere, result.sphere + result.cylinder);
  if (strongest * lens_to_pupil > kMostVertexPower) {
    object.fail("has its focus at or before the pupil, " + number_text(rounded(1e3 * lens_to_pupil, 4)) +
                " mm behind the lens; sphere and sphere + cylinder must be at most " +
                number_text(rounded(kMostVertexPower / lens_to_pupil, 4)));
  }
  return result;
}

RelaxedPower read_relaxed_power(const Field& object, const Field& powers) {
  const std::vector<double> q = powers.numbers(plain(0.0, 200.0), 2, 2);
  RelaxedPower result{q[0], q[1], 0.0};
  if (q[0] != q[1]) {
    result.axis = object.require("power_axis_deg", "a number of degrees, as the two powers differ").axis();
  } else if (const auto axis = object.find("power_axis_deg")) {
    result.axis = axis->axis();
  }
  return result;
}

void read_power(const Field& object, Eye& eye) {
  const auto refraction = object.find("refraction");
  const auto relaxed = object.find("relaxed_power_D");
  if (refraction && relaxed) relaxed->fail("is given beside refraction; only one of the two is allowed");
  if (const auto axis = object.find("power_axis_deg"); axis && !relaxed) {
    axis->fail("is given without relaxed_power_D; it is allowed only beside it");
  }
  if (refraction) eye.power = read_refraction(*refraction, eye.refraction_vertex + eye.entrance_pupil_depth);
  if (relaxed) eye.power = read_relaxed_power(object, *relaxed);
}

Zernike read_zernike(const Field& object) {
  object.allow_only({"pupil_diameter_mm", "coefficients"});
  Zernike result;
  result.pupil_diameter = object.required_number("pupil_diameter_mm", kPupil);
  const Field coefficients = object.require("coefficients", "an array of numbers, from j = 0");
  result.coefficients = coefficients.numbers(micrometres(-1000.0, 1000.0), 1, kMostZernike);
  return result;
}

}  // namespace

Eye read_eye_object(const Field& object) {
  object.allow_only({"axial_length_mm", "pupil_diameter_mm", "accommodation_amplitude_D", "refraction",
                     "relaxed_power_D", "power_axis_deg", "refraction_vertex_mm", "entrance_pupil_depth_mm",
                     "centre_of_rotation_depth_mm", "zernike_um"});
  Eye eye;
  object.read("axial_length_mm", millimetres(15.0, 40.0), eye.axial_length);
  object.read("pupil_diameter_mm", kPupil, eye.pupil_diameter);
  object.read("accommodation_amplitude_D", kAmplitude, eye.accommodation_amplitude);
  object.read("refraction_vertex_mm", millimetres(0.0, 30.0), eye.refraction_vertex);
  object.read("entrance_pupil_depth_mm", millimetres(0.0, 10.0), eye.entrance_pupil_depth);
  object.read("centre_of_rotation_depth_mm", millimetres(0.0, 30.0), eye.centre_of_rotation_depth);
  read_power(object, eye);
  if (const auto zernike = object.find("zernike_um")) eye.zernike = read_zernike(*zernike);
  return eye;
}

Viewer read_viewer_object(const Field& object) {
  object.allow_only({"refraction", "worn_in_headset", "accommodation_amplitude_D"});
  Viewer viewer;
  const Eye usual;
  if (const auto refraction = object.find("refraction")) {
    viewer.refraction = read_refraction(*refraction, usual.refraction_vertex + usual.entrance_pupil_depth);
  }
  if (const auto worn = object.find("worn_in_headset")) {
    using Worn = Viewer::Worn;
    viewer.worn_in_headset = worn->choice<Worn>({{"nothing", Worn::nothing},
                                                 {"contacts", Worn::contacts},
                                                 {"spectacles", Worn::spectacles},
                                                 {"inserts", Worn::inserts}});
  }
  object.read("accommodation_amplitude_D", kAmplitude, viewer.accommodation_amplitude);
  return viewer;
}

}  // namespace lenses::io
