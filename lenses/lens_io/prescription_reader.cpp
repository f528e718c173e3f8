#include "lenses/lens_io/prescription_reader.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "lenses/design/materials.hpp"
#include "lenses/design/prescription_lens.hpp"
#include "lenses/design/prism_base.hpp"
#include "lenses/lens_io/lens_parts_reader.hpp"
#include "lenses/lens_io/units.hpp"

namespace lenses::io {
namespace {

constexpr std::size_t kMostPrisms = 8;
constexpr const char* kBase = "a number of degrees from 0 to 360 (TABO), or one of \"up\" \"down\" \"in\" \"out\"";

double read_base(const Field& base, std::optional<Side> side) {
  if (base.value().is_number()) {
    const double degrees = base.value().get<double>();
    if (!(degrees >= 0.0 && degrees <= 360.0)) base.fail_type(kBase);
    return from_degrees(degrees < 360.0 ? degrees : 0.0);
  }
  const std::string& word = base.text(kBase);
  const std::optional<PrismBase> known = prism_base(word);
  if (!known) base.fail_type(kBase);
  if (!side && known_by_side(*known)) {
    base.fail("is \"" + word + "\", but for which eye is not known; \"side\" must say it, or the base be in degrees");
  }
  return base_angle(*known, side.value_or(Side::right));
}

// What may be ordered; and what may follow from an order, as a strong lens on the eye itself does.
struct PowerLimits {
  double sphere, cylinder, prism;
};
constexpr PowerLimits kOrdered{40.0, 20.0, 30.0};
constexpr PowerLimits kCompensated{400.0, 400.0, 100.0};

Prism read_prism(const Field& object, const PowerLimits& limits, std::optional<Side> side) {
  object.allow_only({"magnitude", "base"});
  Prism prism;
  prism.magnitude = object.required_number("magnitude", plain(0.0, limits.prism));
  prism.base = read_base(object.require("base", kBase), side);
  return prism;
}

// ISO 8429 writes 180 degrees, not 0.
double tabo_axis(const Field& field) {
  const double axis = field.axis();
  return axis > 0.0 ? axis : std::numbers::pi;
}

Prescription read_powers(const Field& object, const PowerLimits& limits, std::optional<Side> side) {
  object.allow_only({"sphere", "cylinder", "axis", "add", "prism"});
  Prescription result;
  result.sphere = object.required_number("sphere", plain(-limits.sphere, limits.sphere));
  object.read("cylinder", plain(-limits.cylinder, limits.cylinder), result.cylinder);
  if (result.cylinder != 0.0) {
    result.axis = tabo_axis(object.require("axis", "a number of degrees, as the cylinder is not 0"));
  } else if (const auto axis = object.find("axis")) {
    result.axis = tabo_axis(*axis);
  }
  object.read("add", plain(0.0, 6.0), result.addition);
  if (const auto prisms = object.find("prism")) {
    for (const Field& prism : prisms->elements(0, kMostPrisms, "prisms")) {
      result.prism.push_back(read_prism(prism, limits, side));
    }
  }
  return result;
}

// The side of a lens that is part of something larger is known; a lens of its own may say it.
std::optional<Side> read_side(const Field& lens, std::optional<Side> known) {
  const auto field = lens.find("side");
  if (!field) return known;
  const Side side = field->choice<Side>({{"right", Side::right}, {"left", Side::left}});
  if (known && side != *known) {
    field->fail(std::string("is not the eye this lens stands before; must be \"") +
                (*known == Side::right ? "right" : "left") + "\" here, or left out");
  }
  return side;
}

LensDesign read_design(const Field& lens, const Prescription& prescription) {
  const auto design = lens.find("design");
  if (!design) return prescription.addition > 0.0 ? LensDesign::progressive : LensDesign::single_vision;
  return design->choice<LensDesign>({{"single_vision", LensDesign::single_vision},
                                     {"bifocal", LensDesign::bifocal},
                                     {"progressive", LensDesign::progressive},
                                     {"contact", LensDesign::contact}});
}

void read_glass(const Field& lens, LensRequest& request) {
  const auto material = lens.find("material");
  const auto index = lens.find("index");
  if (material && index) index->fail("is given beside material; only one of the two is allowed");
  if (material) {
    std::string names = "one of";
    for (const Material& known : materials()) names += " \"" + std::string(known.name) + "\"";
    const Material* known = find_material(material->text(names));
    if (known == nullptr) material->fail_type(names);
    request.index = known->index;
    request.abbe = known->abbe;
  } else if (request.design == LensDesign::contact && !index) {
    set_contact_material(request);
  }
  lens.read("index", plain(1.3, 2.2), request.index);
  lens.read("abbe", plain(5.0, 200.0), request.abbe);
}

void read_making(const Field& lens, LensRequest& r) {
  lens.read("base_curve_D", plain(0.0, 30.0), r.base_curve);
  lens.read("centre_thickness_mm", millimetres(0.01, 100.0), r.centre_thickness);
  lens.read("diameter_mm", millimetres(1.0, 150.0), r.diameter);
  lens.read("minimum_centre_thickness_mm", millimetres(0.01, 20.0), r.minimum_centre_thickness);
  lens.read("minimum_edge_thickness_mm", millimetres(0.0, 20.0), r.minimum_edge_thickness);
  lens.read("segment_top_mm", millimetres(-15.0, -0.5), r.segment_top);
  lens.read("inset_mm", millimetres(0.0, 5.0), r.inset);
  lens.read("corridor_mm", millimetres(8.0, 18.0), r.corridor_length);
  lens.read("back_radius_mm", millimetres(4.0, 20.0), r.back_radius);
  lens.read("refraction_vertex_mm", millimetres(0.0, 30.0), r.refraction_vertex);
  if (const auto thinning = lens.find("prism_thinning")) r.prism_thinning = thinning->truth();
  if (const auto as_worn = lens.find("as_worn")) r.as_worn = as_worn->truth();
  if (const auto outline = lens.find("outline")) r.outline = read_outline(*outline);
  if (const auto fit = lens.find("fit")) r.fit = read_fit(*fit, r.fit);
}

void read_choices(const Field& lens, LensRequest& r) {
  using Face = ProgressiveConfig::Face;
  if (const auto front = lens.find("front_design")) {
    r.front = front->choice<FrontDesign>({{"spherical", FrontDesign::spherical}, {"aspheric", FrontDesign::aspheric}});
  }
  if (const auto toric = lens.find("toric")) {
    r.toric = toric->choice<ToricForm>({{"tyre", ToricForm::tyre}, {"barrel", ToricForm::barrel}});
  }
  if (const auto by = lens.find("prism_by")) {
    r.prism_by = by->choice<PrismBy>({{"tilt", PrismBy::tilt}, {"decentration", PrismBy::decentration}});
  }
  if (const auto segment = lens.find("segment")) {
    r.segment = segment->choice<SegmentShape>(
        {{"ft28", SegmentShape::ft28}, {"r24", SegmentShape::r24}, {"executive", SegmentShape::executive}});
  }
  if (const auto contact = lens.find("contact")) {
    r.contact = contact->choice<ContactKind>({{"soft", ContactKind::soft}, {"rigid", ContactKind::rigid}});
  }
  if (const auto face = lens.find("progressive_surface")) {
    r.progressive_face = face->choice<Face>({{"eye_side", Face::eye_side}, {"front", Face::front}});
  }
}

void check_keys(const Field& lens) {
  for (const std::string_view key : {"front", "back", "reference_points_mm", "attached_to", "order"}) {
    if (const auto found = lens.find(key)) {
      found->fail("is given beside prescription, from which it follows; only one of the two is allowed");
    }
  }
  lens.allow_only_in_root({"prescription",
                           "design",
                           "material",
                           "index",
                           "abbe",
                           "side",
                           "base_curve_D",
                           "front_design",
                           "toric",
                           "prism_by",
                           "prism_thinning",
                           "segment",
                           "segment_top_mm",
                           "inset_mm",
                           "corridor_mm",
                           "progressive_surface",
                           "contact",
                           "back_radius_mm",
                           "centre_thickness_mm",
                           "diameter_mm",
                           "minimum_centre_thickness_mm",
                           "minimum_edge_thickness_mm",
                           "outline",
                           "fit",
                           "refraction_vertex_mm",
                           "as_worn"});
}

}  // namespace

Prescription read_prescription(const Field& object, std::optional<Side> side) {
  return read_powers(object, kOrdered, side);
}

Order read_order(const Field& object, std::optional<Side> side) {
  object.allow_only({"ordered", "compensated"});
  Order order;
  order.ordered = read_prescription(object.require("ordered", "a prescription"), side);
  if (const auto compensated = object.find("compensated"))
    order.compensated = read_powers(*compensated, kCompensated, side);
  return order;
}

Lens read_prescription_lens(const Field& lens, std::optional<Side> known_side) {
  check_keys(lens);
  const std::optional<Side> side = read_side(lens, known_side);
  LensRequest request;
  request.side = side.value_or(Side::right);
  request.prescription = read_prescription(lens.require("prescription", "a prescription"), side);
  request.design = read_design(lens, request.prescription);
  read_choices(lens, request);
  read_glass(lens, request);
  read_making(lens, request);
  try {
    return design_lens(request).lens;
  } catch (const DesignError& error) {
    lens.fail_below(error.field(), error.reason());
  }
}

}  // namespace lenses::io
