#include "app/prescription_options.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "app/option_values.hpp"
#include "app/prism_option.hpp"
#include "lenses/design/materials.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "tracking/input_error.hpp"

namespace app {
namespace {

using lenses::LensRequest;
using tracking::InputError;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kMm = 1e-3;

template <class Enum>
std::vector<std::string> words(const std::map<std::string, Enum>& names) {
  std::vector<std::string> result;
  for (const auto& [name, unused] : names) {
    result.push_back(name);
  }
  return result;
}

const std::map<std::string, lenses::LensDesign> kDesigns{{"single_vision", lenses::LensDesign::single_vision},
                                                         {"bifocal", lenses::LensDesign::bifocal},
                                                         {"progressive", lenses::LensDesign::progressive},
                                                         {"contact", lenses::LensDesign::contact}};
const std::map<std::string, lenses::FrontDesign> kFronts{{"spherical", lenses::FrontDesign::spherical},
                                                         {"aspheric", lenses::FrontDesign::aspheric}};
const std::map<std::string, lenses::ToricForm> kToricForms{{"tyre", lenses::ToricForm::tyre},
                                                           {"barrel", lenses::ToricForm::barrel}};
const std::map<std::string, lenses::PrismBy> kPrismWays{{"tilt", lenses::PrismBy::tilt},
                                                        {"decentration", lenses::PrismBy::decentration}};
const std::map<std::string, lenses::SegmentShape> kSegments{{"ft28", lenses::SegmentShape::ft28},
                                                            {"r24", lenses::SegmentShape::r24},
                                                            {"executive", lenses::SegmentShape::executive}};
const std::map<std::string, lenses::ContactKind> kContacts{{"soft", lenses::ContactKind::soft},
                                                           {"rigid", lenses::ContactKind::rigid}};
const std::map<std::string, lenses::ProgressiveConfig::Face> kFaces{
    {"eye_side", lenses::ProgressiveConfig::Face::eye_side}, {"front", lenses::ProgressiveConfig::Face::front}};
const std::map<std::string, lenses::Side> kSides{{"right", lenses::Side::right}, {"left", lenses::Side::left}};

lenses::Prescription prescription_of(const PrescriptionOptions& o, const std::optional<lenses::Side>& side) {
  lenses::Prescription p;
  p.sphere = o.sphere;
  p.cylinder = o.cylinder;
  p.addition = o.add;
  if (o.cylinder != 0.0 && !o.axis) {
    throw InputError("--axis", "", "is missing; a number of degrees (TABO), as the cylinder is not 0");
  }
  if (o.axis) {
    check_range("--axis", *o.axis, 0.0, 180.0, "degrees");
    p.axis = (*o.axis == 0.0 ? 180.0 : *o.axis) * kDegree;  // ISO 8429 writes 180, not 0
  }
  for (const std::string& text : o.prism) {
    p.prism.push_back(prism_of("--prism", text, side));
  }
  return p;
}

// The density where the material has a name.
std::optional<double> choose_glass(const PrescriptionOptions& o, LensRequest& request) {
  if (o.material.empty() && !o.index && request.design == lenses::LensDesign::contact) {
    lenses::set_contact_material(request);
  }
  std::optional<double> density;
  if (!o.index && (request.design != lenses::LensDesign::contact || !o.material.empty())) {
    const lenses::Material* material = lenses::find_material(o.material.empty() ? "CR-39" : o.material);
    request.index = material->index;
    request.abbe = material->abbe;
    density = material->density;
  }
  request.index = o.index.value_or(request.index);
  request.abbe = o.abbe.value_or(request.abbe);
  return density;
}

template <class Target>
void set_if(Target& target, const std::optional<double>& value, double unit) {
  if (value) {
    target = *value * unit;
  }
}

LensRequest request_of(const PrescriptionOptions& o) {
  LensRequest r;
  const auto side = o.side.empty() ? std::nullopt : std::optional(kSides.at(o.side));
  r.side = side.value_or(lenses::Side::right);
  r.prescription = prescription_of(o, side);
  r.design = !o.design.empty() ? kDesigns.at(o.design)
             : o.add > 0.0     ? lenses::LensDesign::progressive
                               : lenses::LensDesign::single_vision;
  r.front = kFronts.at(o.front);
  r.toric = kToricForms.at(o.toric);
  r.prism_by = kPrismWays.at(o.prism_by);
  r.segment = kSegments.at(o.segment);
  r.contact = kContacts.at(o.contact);
  r.progressive_face = kFaces.at(o.progressive_surface);
  r.prism_thinning = o.thinning;
  r.as_worn = o.as_worn;
  r.base_curve = o.base_curve;
  set_if(r.centre_thickness, o.centre_thickness, kMm);
  set_if(r.diameter, o.diameter, kMm);
  set_if(r.minimum_centre_thickness, o.min_centre, kMm);
  set_if(r.minimum_edge_thickness, o.min_edge, kMm);
  set_if(r.segment_top, o.segment_top, kMm);
  set_if(r.inset, o.inset, kMm);
  set_if(r.corridor_length, o.corridor, kMm);
  set_if(r.back_radius, o.back_radius, kMm);
  set_if(r.refraction_vertex, o.refraction_vertex, kMm);
  set_if(r.fit.vertex_distance, o.vertex, kMm);
  set_if(r.fit.pantoscopic_tilt, o.panto, kDegree);
  set_if(r.fit.wrap, o.wrap, kDegree);
  if (!o.outline.empty()) {
    r.outline = lenses::read_outline(o.outline);
  }
  return r;
}

void add_order_options(CLI::App& command, PrescriptionOptions& o) {
  std::vector<std::string> materials;
  for (const lenses::Material& material : lenses::materials()) {
    materials.emplace_back(material.name);
  }
  command.add_option("--sphere", o.sphere, "Sphere, D")->capture_default_str();
  command.add_option("--cylinder", o.cylinder, "Cylinder of either sign, D")->capture_default_str();
  command.add_option("--axis", o.axis, "Axis of the cylinder, 0 to 180 deg (TABO)");
  command.add_option("--add", o.add, "Addition, D")->capture_default_str();
  command.add_option("--prism", o.prism, "M@B: prism dioptres and base (0-360 TABO, up, down, in, out); may repeat")
      ->allow_extra_args(false);
  command.add_option("--side", o.side, "Eye: right or left; in, out and insets need it (else right)")
      ->check(CLI::IsMember(words(kSides)));
  command.add_option("--design", o.design, "single_vision, bifocal, progressive, contact (by the addition)")
      ->check(CLI::IsMember(words(kDesigns)));
  command.add_option("--material", o.material, "Material by its trade name (CR-39)")->check(CLI::IsMember(materials));
  command.add_option("--index", o.index, "Index of refraction, instead of a material")->excludes("--material");
  command.add_option("--abbe", o.abbe, "Abbe number, with --index")->excludes("--material");
}

void add_form_options(CLI::App& command, PrescriptionOptions& o) {
  command.add_option("--base-curve", o.base_curve, "Front surface power, D (Vogel's rule)");
  command.add_option("--front", o.front, "spherical, or aspheric with the least oblique error")
      ->check(CLI::IsMember(words(kFronts)))
      ->capture_default_str();
  command.add_option("--toric", o.toric, "tyre or barrel")
      ->check(CLI::IsMember(words(kToricForms)))
      ->capture_default_str();
  command.add_option("--prism-by", o.prism_by, "tilt of the front, or decentration of the lens")
      ->check(CLI::IsMember(words(kPrismWays)))
      ->capture_default_str();
  command.add_flag("--thinning", o.thinning, "Progressive: prism of 2/3 of the addition, base down");
  command.add_option("--segment", o.segment, "Bifocal: ft28, r24, executive")
      ->check(CLI::IsMember(words(kSegments)))
      ->capture_default_str();
  command.add_option("--segment-top", o.segment_top, "Bifocal: height of the segment's top, mm (-5)");
  command.add_option("--inset", o.inset, "Near point towards the nose, mm (2.5)");
  command.add_option("--corridor", o.corridor, "Progressive: fitting cross to near point, mm (14)");
  command.add_option("--progressive-surface", o.progressive_surface, "eye_side or front")
      ->check(CLI::IsMember(words(kFaces)))
      ->capture_default_str();
  command.add_option("--contact", o.contact, "soft or rigid")
      ->check(CLI::IsMember(words(kContacts)))
      ->capture_default_str();
  command.add_option("--back-radius", o.back_radius, "Contact: radius on the eye, mm (soft 8.6, rigid 7.8)");
}

void add_size_options(CLI::App& command, PrescriptionOptions& o) {
  command.add_option("--diameter", o.diameter, "mm (65, or less for steep surfaces)");
  command.add_option("--outline", o.outline, "JSON file with the polygon the lens is cut to: {\"polygon_mm\": ...}");
  command.add_option("--centre-thickness", o.centre_thickness, "mm (as thin as the two limits allow)");
  command.add_option("--min-centre", o.min_centre, "Least centre thickness, mm (1.2; contact 0.08, 0.14)");
  command.add_option("--min-edge", o.min_edge, "Least edge thickness, mm (1.0; contact 0.05, 0.08)");
  command.add_option("--vertex", o.vertex, "Cornea to lens as worn, mm (13)");
  command.add_option("--panto", o.panto, "Pantoscopic tilt, deg (8)");
  command.add_option("--wrap", o.wrap, "Wrap, deg (5)");
  command.add_option("--refraction-vertex", o.refraction_vertex,
                     "Cornea to the lens the eye was refracted with, mm (13)");
  command.add_flag("--as-worn", o.as_worn, "Meet the prescription before the eye, not on the lensmeter");
  command.add_option("--output", o.output, "Lens file to write")->capture_default_str();
  command.add_flag("--json", o.json, "Report as JSON");
}

}  // namespace

void add_prescription_options(CLI::App& command, PrescriptionOptions& options) {
  add_order_options(command, options);
  add_form_options(command, options);
  add_size_options(command, options);
}

RequestedLens requested_lens(const PrescriptionOptions& options) {
  RequestedLens result{request_of(options), {}};
  result.density = choose_glass(options, result.request);
  return result;
}

std::string option_of(const std::string& field) {
  static const std::map<std::string, std::string> options{
      {"prescription", "--sphere"},
      {"prescription.sphere", "--sphere"},
      {"prescription.cylinder", "--cylinder"},
      {"prescription.add", "--add"},
      {"prescription.prism", "--prism"},
      {"base_curve_D", "--base-curve"},
      {"front_design", "--front"},
      {"prism_by", "--prism-by"},
      {"prism_thinning", "--thinning"},
      {"centre_thickness_mm", "--centre-thickness"},
      {"diameter_mm", "--diameter"},
      {"minimum_centre_thickness_mm", "--min-centre"},
      {"minimum_edge_thickness_mm", "--min-edge"},
      {"segment_top_mm", "--segment-top"},
      {"inset_mm", "--inset"},
      {"corridor_mm", "--corridor"},
      {"back_radius_mm", "--back-radius"},
      {"refraction_vertex_mm", "--refraction-vertex"},
      {"as_worn", "--as-worn"},
      {"fit", "--panto"},
      {"fit.vertex_distance_mm", "--vertex"},
      {"fit.pantoscopic_tilt_deg", "--panto"},
      {"fit.wrap_deg", "--wrap"},
  };
  const auto found = options.find(field);
  return found == options.end() ? "--" + field : found->second;
}

}  // namespace app
