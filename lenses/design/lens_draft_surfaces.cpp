// The surfaces of a lens in the making that do not follow from its power: base curves, contact lenses' backs, segments,
// progressive surfaces.
#include <algorithm>
#include <cmath>

#include "lenses/design/lens_blank.hpp"
#include "lenses/design/lens_draft.hpp"
#include "lenses/design/surface_making.hpp"
#include "tracking/input_error.hpp"

namespace lenses::design {
namespace {

constexpr double kLeastAddition = 0.75, kMostAddition = 3.5;  // of a progressive surface, D
constexpr glm::dvec2 kCentre(0.0);

double default_back_radius(ContactKind kind) {
  return kind == ContactKind::soft ? 0.0086 : 0.0078;
}

// The widest net up to what is asked that the surface family allows: steep surfaces end early.
double progressive_diameter(ProgressiveConfig config, double asked) {
  constexpr double kNarrowest = 0.04, kWidest = 0.08, kStep = 0.0005;  // m
  for (config.diameter = std::clamp(asked, kNarrowest, kWidest);; config.diameter -= kStep) {
    try {
      config.validate();
      return config.diameter;
    } catch (const tracking::InputError& error) {
      if (error.field() != "diameter" || config.diameter - kStep < kNarrowest) {
        throw DesignError("design",
                          "progressive is not possible here: the surface's " + error.field() + " " + error.reason());
      }
    }
  }
}

}  // namespace

void LensDraft::make_fixed_surfaces() {
  const double curvature = base_curve_ / (request_.index - 1.0);
  switch (request_.design) {
    case LensDesign::contact:
      shape_.set_back(Sphere{1.0 / request_.back_radius.value_or(default_back_radius(request_.contact))});
      base_curve_ = 0.0;
      break;
    case LensDesign::progressive:
      make_progressive();
      break;
    case LensDesign::single_vision:
      if (request_.front == FrontDesign::aspheric) {
        if (curvature == 0.0) {
          throw DesignError("base_curve_D", "is 0; an aspheric front needs a curved one");
        }
        shape_.set_front(Conic{curvature, conic_constant_, {}});
      } else {
        shape_.set_front(curvature == 0.0 ? Surface(Plane{}) : Surface(Sphere{curvature}));
      }
      break;
    case LensDesign::bifocal:
      shape_.set_front(bifocal_front(request_, curvature, segment_curvature_, kCentre));
      break;
  }
}

void LensDraft::make_progressive() {
  ProgressiveConfig config;
  config.method = ProgressiveConfig::Method::closed_form;
  config.face = request_.progressive_face;
  config.side = request_.side;
  config.addition = std::clamp(progressive_addition_, kLeastAddition, kMostAddition);
  config.corridor_length = request_.corridor_length;
  config.inset = request_.inset;
  config.index = request_.index;
  config.fitting_cross = kFittingCross;
  config.distance_point = kDistancePoint;
  progressive_thickness_ = shape_.lens().centre_thickness;
  const double t = progressive_thickness_ / request_.index;
  const bool front = config.face == ProgressiveConfig::Face::front;
  config.distance_power = front ? base_curve_ : mean_power(lensmeter_) - base_curve_ / (1.0 - t * base_curve_);
  config.diameter = progressive_diameter(config, shape_.lens().diameter);
  progressive_diameter_ = config.diameter;
  const BsplineHeightField surface = closed_form_progressive(config);
  if (front) {
    shape_.set_front(surface);
  } else {
    shape_.set_back(surface);
  }
}

double LensDraft::widest() const {
  const Lens& lens = shape_.lens();
  return std::min({widest_diameter(lens.front, lens.front_placement), widest_diameter(lens.back, lens.back_placement),
                   progressive_diameter_});
}

void LensDraft::set_diameter(double diameter) {
  const bool changed = diameter != shape_.lens().diameter;
  shape_.rest().diameter = diameter;
  if (changed && request_.design == LensDesign::progressive) {
    make_progressive();
  }
}

bool LensDraft::renew() {
  constexpr double kSettled = 1e-3;       // D
  constexpr double kThinnestStep = 1e-4;  // m; changes the base curve by a thousandth
  if (request_.design != LensDesign::progressive) {
    return false;
  }
  const double missing = request_.prescription.addition - read_addition();
  const double thicker = shape_.lens().centre_thickness - progressive_thickness_;
  if (std::abs(missing) < kSettled && std::abs(thicker) < kThinnestStep) {
    return false;
  }
  progressive_addition_ += missing;
  make_progressive();
  return true;
}

void LensDraft::set_conic_constant(double conic_constant) {
  conic_constant_ = conic_constant;
  make_fixed_surfaces();
}

}  // namespace lenses::design
