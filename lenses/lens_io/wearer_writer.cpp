#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/live_config_reader.hpp"
#include "lenses/lens_io/written_number.hpp"

namespace lenses {
namespace {

using io::written;
using io::written_degrees;
using io::written_mm;
using nlohmann::ordered_json;

ordered_json refraction_object(const Refraction& refraction) {
  return {{"sphere", written(refraction.sphere)},
          {"cylinder", written(refraction.cylinder)},
          {"axis", written_degrees(refraction.axis)}};
}

ordered_json zernike_object(const Zernike& zernike) {
  ordered_json coefficients = ordered_json::array();
  for (const double c : zernike.coefficients) coefficients.push_back(io::written_um(c));
  return {{"pupil_diameter_mm", written_mm(zernike.pupil_diameter)}, {"coefficients", std::move(coefficients)}};
}

void add_power(ordered_json& object, const Eye& eye) {
  if (const auto* refraction = std::get_if<Refraction>(&eye.power))
    object["refraction"] = refraction_object(*refraction);
  if (const auto* relaxed = std::get_if<RelaxedPower>(&eye.power)) {
    object["relaxed_power_D"] = ordered_json::array({written(relaxed->q1), written(relaxed->q2)});
    object["power_axis_deg"] = written_degrees(relaxed->axis);
  }
}

// What is absent in the struct stays absent: it follows age or light.
ordered_json eye_object(const Eye& eye) {
  ordered_json result = {{"axial_length_mm", written_mm(eye.axial_length)}};
  if (eye.pupil_diameter) result["pupil_diameter_mm"] = written_mm(*eye.pupil_diameter);
  if (eye.accommodation_amplitude) result["accommodation_amplitude_D"] = written(*eye.accommodation_amplitude);
  add_power(result, eye);
  result["refraction_vertex_mm"] = written_mm(eye.refraction_vertex);
  result["entrance_pupil_depth_mm"] = written_mm(eye.entrance_pupil_depth);
  result["centre_of_rotation_depth_mm"] = written_mm(eye.centre_of_rotation_depth);
  if (eye.zernike) result["zernike_um"] = zernike_object(*eye.zernike);
  return result;
}

const char* worn_name(Viewer::Worn worn) {
  switch (worn) {
    case Viewer::Worn::nothing:
      return "nothing";
    case Viewer::Worn::contacts:
      return "contacts";
    case Viewer::Worn::spectacles:
      return "spectacles";
    case Viewer::Worn::inserts:
      return "inserts";
  }
  return "nothing";
}

ordered_json viewer_object(const Viewer& viewer) {
  ordered_json result = {{"refraction", refraction_object(viewer.refraction)},
                         {"worn_in_headset", worn_name(viewer.worn_in_headset)}};
  if (viewer.accommodation_amplitude) result["accommodation_amplitude_D"] = written(*viewer.accommodation_amplitude);
  return result;
}

}  // namespace

std::string to_json(const Wearer& wearer) {
  const auto& [right_distance, left_distance] = wearer.pupillary_distance;
  ordered_json document = {
      {"version", 1},
      {"name", wearer.name},
      {"age", written(wearer.age)},
      {"pupillary_distance_mm", ordered_json::array({written_mm(right_distance), written_mm(left_distance)})},
      {"right", eye_object(wearer.eye[0])},
      {"left", eye_object(wearer.eye[1])}};
  ordered_json viewers = ordered_json::object();
  if (wearer.viewer[0]) viewers["right"] = viewer_object(*wearer.viewer[0]);
  if (wearer.viewer[1]) viewers["left"] = viewer_object(*wearer.viewer[1]);
  if (wearer.viewer_age) viewers["age"] = written(*wearer.viewer_age);
  if (!viewers.empty()) document["viewer"] = std::move(viewers);
  io::add_live_config(document, wearer.live);
  return io::document_text(document);
}

std::string to_json(const HeadsetDisplay& headset) {
  const bool at_pupil = headset.view_origin == HeadsetDisplay::ViewOrigin::pupil;
  return io::document_text({{"version", 1},
                            {"focal_distance_m", written(headset.focal_distance)},
                            {"pixels_per_degree", written(headset.pixels_per_degree)},
                            {"luminance_cd_m2", written(headset.luminance)},
                            {"view_origin", at_pupil ? "pupil" : "rotation_centre"}});
}

}  // namespace lenses
