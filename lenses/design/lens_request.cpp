#include "lenses/design/lens_request.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lenses/design/ordered_power.hpp"
#include "lenses/design/reason_text.hpp"

namespace lenses {
namespace {

using design::in_dioptres;
using design::in_mm;
using design::number_in_words;

constexpr double kMm = 1e-3;

struct Range {
  const char* field;
  double unit;
  const char* unit_name;
  double low, high;  // in that unit
};

void check(const Range& range, double value) {
  const double shown = value / range.unit;
  // Written this way round so that NaN is refused; a hair of rounding from degrees or millimetres is not.
  const double slack = 1e-9 * std::max(1.0, std::abs(range.high));
  if (!(shown >= range.low - slack && shown <= range.high + slack)) {
    throw DesignError(range.field, "is " + number_in_words(shown) + range.unit_name + "; from " +
                                       number_in_words(range.low) + " to " + number_in_words(range.high) +
                                       range.unit_name + " is allowed");
  }
}

void check(const Range& range, const std::optional<double>& value) {
  if (value) {
    check(range, *value);
  }
}

void check_prescription(const Prescription& p) {
  check({"prescription.sphere", 1.0, " D", -40.0, 40.0}, p.sphere);
  check({"prescription.cylinder", 1.0, " D", -20.0, 20.0}, p.cylinder);
  check({"prescription.add", 1.0, " D", 0.0, 6.0}, p.addition);
  check({"prescription.sphere", 1.0, " D with the cylinder", -40.0, 40.0}, p.sphere + p.cylinder);
  for (const Prism& prism : p.prism) {
    check({"prescription.prism", 1.0, " prism dioptres", 0.0, 30.0}, prism.magnitude);
  }
  const glm::dvec2 sum = design::prism_vector(p.prism);
  check({"prescription.prism", 1.0, " prism dioptres in all", 0.0, 30.0}, std::hypot(sum.x, sum.y));
}

void check_making(const LensRequest& r) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  check({"index", 1.0, "", 1.3, 2.2}, r.index);
  check({"abbe", 1.0, "", 5.0, 200.0}, r.abbe);
  check({"base_curve_D", 1.0, " D", 0.0, 30.0}, r.base_curve);
  check({"centre_thickness_mm", kMm, " mm", 0.01, 100.0}, r.centre_thickness);
  check({"diameter_mm", kMm, " mm", 1.0, 150.0}, r.diameter);
  check({"minimum_centre_thickness_mm", kMm, " mm", 0.01, 20.0}, r.minimum_centre_thickness);
  check({"minimum_edge_thickness_mm", kMm, " mm", 0.0, 20.0}, r.minimum_edge_thickness);
  check({"segment_top_mm", kMm, " mm", -15.0, -0.5}, r.segment_top);
  check({"inset_mm", kMm, " mm", 0.0, 5.0}, r.inset);
  check({"corridor_mm", kMm, " mm", 8.0, 18.0}, r.corridor_length);
  check({"back_radius_mm", kMm, " mm", 4.0, 20.0}, r.back_radius);
  check({"refraction_vertex_mm", kMm, " mm", 0.0, 30.0}, r.refraction_vertex);
  check({"fit.vertex_distance_mm", kMm, " mm", 0.0, 100.0}, r.fit.vertex_distance);
  check({"fit.pantoscopic_tilt_deg", kDegree, " deg", -60.0, 60.0}, r.fit.pantoscopic_tilt);
  check({"fit.wrap_deg", kDegree, " deg", -60.0, 60.0}, r.fit.wrap);
}

void check_addition(const LensRequest& r) {
  const double add = r.prescription.addition;
  if (r.design == LensDesign::progressive) {
    check({"prescription.add", 1.0, " D for a progressive lens", 0.75, 3.5}, add);
  } else if (r.design == LensDesign::bifocal) {
    check({"prescription.add", 1.0, " D for a bifocal lens", 0.25, 6.0}, add);
  } else if (add != 0.0) {
    throw DesignError("prescription.add", "is " + in_dioptres(add) + ", which a " +
                                              (r.design == LensDesign::contact ? "contact" : "single vision") +
                                              " lens does not have; must be 0, or the design bifocal or progressive");
  }
}

void refuse_if(bool wrong, const char* field, const std::string& reason) {
  if (wrong) {
    throw DesignError(field, reason);
  }
}

void check_together(const LensRequest& r) {
  const bool contact = r.design == LensDesign::contact;
  const bool progressive = r.design == LensDesign::progressive;
  refuse_if(r.prism_thinning && !progressive, "prism_thinning", "is for progressive lenses only");
  refuse_if(r.prism_by == PrismBy::decentration && (contact || progressive), "prism_by",
            "is decentration, which moves a contact lens off the eye and a progressive's zones; must be tilt");
  refuse_if(r.front == FrontDesign::aspheric && r.design != LensDesign::single_vision, "front_design",
            "is aspheric, which is for single vision lenses; must be spherical");
  refuse_if(r.back_radius.has_value() && !contact, "back_radius_mm", "is for contact lenses only");
  refuse_if(r.base_curve.has_value() && contact, "base_curve_D",
            "is for spectacle lenses; a contact lens takes back_radius_mm");
  const double strongest = std::max(r.prescription.sphere, r.prescription.sphere + r.prescription.cylinder);
  refuse_if((contact || r.as_worn) && strongest * r.refraction_vertex > 0.9, "prescription.sphere",
            "has its focus before the eye, " + in_mm(1.0 / std::max(strongest, 1e-9)) + " behind a lens at " +
                in_mm(r.refraction_vertex) + "; at most " + in_dioptres(0.9 / std::max(r.refraction_vertex, 1e-9)) +
                " is possible there");
}

}  // namespace

void set_contact_material(LensRequest& request) {
  request.index = request.contact == ContactKind::soft ? 1.42 : 1.45;
  request.abbe = 50.0;
}

void LensRequest::validate() const {
  check_prescription(prescription);
  check_making(*this);
  check_addition(*this);
  check_together(*this);
}

}  // namespace lenses
