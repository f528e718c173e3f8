#include "lenses/design/lens_blank.hpp"

#include "lenses/design/surface_making.hpp"

namespace lenses::design {
namespace {

constexpr glm::dvec2 kCentre(0.0);

ReferencePoints reference_points(const LensRequest& r) {
  ReferencePoints points;
  points.prism = kCentre;
  switch (r.design) {
    case LensDesign::progressive:
      points.fitting_cross = {0.0, kFittingCross};
      points.distance = {0.0, kDistancePoint};
      points.near = {r.side == Side::right ? -r.inset : r.inset, kFittingCross - r.corridor_length};
      break;
    case LensDesign::bifocal:
      points.distance = kCentre;
      points.near = segment_layout(r).near_point;
      break;
    case LensDesign::single_vision:
    case LensDesign::contact:
      points.distance = kCentre;
      break;
  }
  return points;
}

}  // namespace

Lens blank_lens(const LensRequest& r) {
  Lens lens;
  lens.index = r.index;
  lens.abbe = r.abbe;
  lens.fit = r.fit;
  lens.outline = r.outline;
  lens.reference_points = reference_points(r);
  if (r.design == LensDesign::contact) {
    lens.attached_to = Lens::AttachedTo::eye;
    lens.fit = {.vertex_distance = 0.0};
  } else if (r.design == LensDesign::progressive) {
    lens.fit.decentration.y -= kFittingCross;  // the fitting cross goes to the pupil
  }
  return lens;
}

PointPower order_of(const LensRequest& r) {
  PointPower order = ordered_power(r.prescription);
  if (r.prism_thinning) {
    order.prism.y -= r.prescription.addition * 2.0 / 3.0;
  }
  return order;
}

double mean_power(const PointPower& p) {
  return 0.5 * (p.power[0][0] + p.power[1][1]);
}

}  // namespace lenses::design
