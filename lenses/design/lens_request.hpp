// What is asked of a lens to be made from a prescription, and how it is to be made. SI units.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "lenses/design/progressive.hpp"
#include "lenses/lens.hpp"

namespace lenses {

// A lens that cannot be made as asked: which of the request's fields is to blame (as lens files name it), and why, with
// what would be possible.
class DesignError : public std::runtime_error {
 public:
  DesignError(std::string field, std::string reason)
      : std::runtime_error(field + ": " + reason), field_(std::move(field)), reason_(std::move(reason)) {}

  [[nodiscard]] const std::string& field() const { return field_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string field_, reason_;
};

enum class LensDesign { single_vision, bifocal, progressive, contact };
enum class FrontDesign { spherical, aspheric };
// Of a toric surface's two sections the arc that is turned about an axis: the steeper (tyre) or the flatter (barrel).
enum class ToricForm { tyre, barrel };
// How a lens gets prism: its front tilted against its back, or the whole lens moved aside (Prentice's rule).
enum class PrismBy { tilt, decentration };
// Flat-top of 28 mm, round of 24 mm, a segment over the whole width.
enum class SegmentShape { ft28, r24, executive };
enum class ContactKind { soft, rigid };

struct LensRequest {
  Prescription prescription;
  LensDesign design = LensDesign::single_vision;
  Side side = Side::right;  // where the nose is: inset
  double index = 1.498, abbe = 58.0;
  std::optional<double> base_curve;  // front surface power of the distance portion, D; absent: Vogel's rule
  FrontDesign front = FrontDesign::spherical;
  ToricForm toric = ToricForm::tyre;
  PrismBy prism_by = PrismBy::tilt;
  bool prism_thinning = false;                       // progressive: 2/3 of the addition, base down
  std::optional<double> centre_thickness, diameter;  // m; absent: by rule
  std::optional<double> minimum_centre_thickness, minimum_edge_thickness;  // m; absent: by rule
  std::vector<glm::dvec2> outline;                                         // m, lens axes; empty: round

  SegmentShape segment = SegmentShape::ft28;
  double segment_top = -0.005;  // y of the segment's highest point, m
  double inset = 0.0025;        // of the near point, towards the nose, m

  ContactKind contact = ContactKind::soft;
  std::optional<double> back_radius;  // contact: m; absent: by kind

  ProgressiveConfig::Face progressive_face = ProgressiveConfig::Face::eye_side;
  double corridor_length = 0.014;  // fitting cross to near point, m

  Fit fit{.vertex_distance = 0.013, .pantoscopic_tilt = 8.0 * 0.017453292519943295, .wrap = 5.0 * 0.017453292519943295};
  double refraction_vertex = 0.013;  // where the prescription was found, cornea to lens, m
  bool as_worn = false;              // the prescription is to be met before the eye, not on the lensmeter

  // Throws DesignError for values out of range or that contradict each other.
  void validate() const;
};

// Index and Abbe number usual for contact lenses of the request's kind: a hydrogel, or a gas-permeable hard material.
void set_contact_material(LensRequest& request);

}  // namespace lenses
