#include "lenses/design/lens_draft.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lenses/design/reason_text.hpp"
#include "lenses/design/surface_making.hpp"
#include "tracking/input_error.hpp"

namespace lenses::design {
namespace {

constexpr double kFittingCross = 0.004, kDistancePoint = 0.008;  // y on a progressive lens, m
constexpr double kLargestDecentration = 0.02;                    // m
constexpr glm::dvec2 kCentre(0.0);

double default_back_radius(ContactKind kind) {
  return kind == ContactKind::soft ? 0.0086 : 0.0078;
}

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

Lens blank(const LensRequest& r) {
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

double mean_power(const PointPower& p) {
  return 0.5 * (p.power[0][0] + p.power[1][1]);
}

}  // namespace

LensDraft::LensDraft(const LensRequest& request)
    : request_(request), ordered_(order_of(request)), lensmeter_(ordered_), base_curve_(0.0), shape_(blank(request)) {
  if (request_.design == LensDesign::contact) {
    lensmeter_.power = nearer_to_eye(ordered_.power, request_.refraction_vertex);
  }
  base_curve_ = request_.base_curve.value_or(vogel_base_curve(mean_power(lensmeter_)));
  segment_curvature_ = (base_curve_ + request_.prescription.addition) / (request_.index - 1.0);
  make_fixed_surfaces();
}

// The surface that carries no cylinder.
bool LensDraft::toric_front() const {
  return request_.design == LensDesign::contact ||
         (request_.design == LensDesign::progressive && request_.progressive_face == ProgressiveConfig::Face::eye_side);
}

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
  config.addition = request_.prescription.addition;
  config.corridor_length = request_.corridor_length;
  config.inset = request_.inset;
  config.index = request_.index;
  config.fitting_cross = kFittingCross;
  config.distance_point = kDistancePoint;
  const double t = shape_.lens().centre_thickness / request_.index;
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
  if (changed) {
    renew();
  }
}

void LensDraft::renew() {
  if (request_.design == LensDesign::progressive) {
    make_progressive();
  }
}

void LensDraft::set_conic_constant(double conic_constant) {
  conic_constant_ = conic_constant;
  make_fixed_surfaces();
}

void LensDraft::apply(const LensUnknowns& u, bool simplest) {
  const Surface toric = toric_surface(u.curvature, request_.toric, simplest);
  if (toric_front()) {
    shape_.set_front(toric);
    shape_.place_front(tilted(Torus{}, u.prismatic));
    return;
  }
  shape_.set_back(toric);
  if (request_.design == LensDesign::bifocal) {
    const glm::dvec2 centre = decentres() ? u.prismatic : kCentre;
    shape_.set_front(bifocal_front(request_, base_curve_ / (request_.index - 1.0), segment_curvature_, centre));
  }
  if (decentres()) {
    shape_.place_front(decentred(shape_.lens().front, u.prismatic));
    shape_.place_back(decentred(shape_.lens().back, u.prismatic));
  } else {
    shape_.place_front(tilted(shape_.lens().front, u.prismatic));
  }
}

// The thick lens on its axis, and prism in proportion.
LensUnknowns LensDraft::first_guess(const PointPower& target) const {
  const double n = request_.index;
  const double t = shape_.lens().centre_thickness / n;
  const glm::dmat2 one(1.0);
  LensUnknowns guess;
  if (toric_front()) {
    const f64::SurfacePoint back = shape_.back(kCentre);
    const glm::dmat2 back_curvature(back.hessian.x, back.hessian.y, back.hessian.y, back.hessian.z);
    const glm::dmat2 in_glass = target.power + (n - 1.0) * back_curvature;
    guess.curvature = in_glass * glm::inverse(one + t * in_glass) / (n - 1.0);
  } else {
    guess.curvature = (base_curve_ / (1.0 - t * base_curve_) * one - target.power) / (n - 1.0);
  }
  if (!decentres()) {
    guess.prismatic = -0.01 * target.prism / (n - 1.0);
  } else if (target.prism != kCentre) {
    // Prentice's rule: the optical centre lies towards the base by prism over power.
    guess.prismatic = 0.01 * (glm::inverse(target.power) * target.prism);
    if (!(length(guess.prismatic) <= kLargestDecentration)) {
      throw DesignError(
          "prism_by",
          "is decentration, and " + number_in_words(length(target.prism)) +
              " prism dioptres would move the optical centre by " +
              (std::isfinite(length(guess.prismatic)) ? in_mm(length(guess.prismatic)) : std::string("any distance")) +
              " at this power; at most " + in_mm(kLargestDecentration) + " is possible, tilt always is");
    }
  }
  return guess;
}

void LensDraft::solve_reading() {
  const auto measure = [this](const LensUnknowns& u) {
    apply(u, false);
    return verification();
  };
  const bool with_prism = !decentres() || lensmeter_.prism != kCentre;
  const LensUnknowns start = guessed_ ? unknowns_ : first_guess(lensmeter_);
  auto solved = solve_power(start, measure, lensmeter_, with_prism);
  if (!solved && guessed_) {
    solved = solve_power(first_guess(lensmeter_), measure, lensmeter_, with_prism);
  }
  if (!solved) {
    throw DesignError("prescription", "cannot be met with a base curve of " + in_dioptres(base_curve_) + " and index " +
                                          number_in_words(request_.index) +
                                          ": light does not pass; less prism, another base curve or a higher index "
                                          "are possible");
  }
  unknowns_ = *solved;
  guessed_ = true;
}

void LensDraft::solve_worn() {
  const auto measure = [this](const LensUnknowns& u) {
    apply(u, false);
    return worn();
  };
  const bool with_prism = !decentres() || ordered_.prism != kCentre;
  auto solved = solve_power(unknowns_, measure, ordered_, with_prism);
  if (!solved) {
    solve_reading();
    solved = solve_power(unknowns_, measure, ordered_, with_prism);
  }
  if (!solved) {
    throw DesignError("as_worn",
                      "the prescription cannot be met in this position of wear; less tilt, wrap or power "
                      "are possible, or a lens as a lensmeter reads it");
  }
  unknowns_ = *solved;
}

void LensDraft::solve(double thickness) {
  shape_.set_thickness(thickness);
  if (!request_.as_worn || !guessed_) {
    solve_reading();
  }
  if (request_.as_worn) {
    solve_worn();
  }
  apply(unknowns_, true);
  if (request_.design == LensDesign::bifocal) {
    solve_segment();
  }
}

double LensDraft::segment_addition() const {
  const auto near = reading_at_front(shape_, *shape_.lens().reference_points.near);
  const auto distance = reading_at_front(shape_, kCentre);
  if (!near || !distance) {
    throw DesignError("segment_top_mm",
                      "leaves the near point of the segment where no light passes the lens; a higher "
                      "segment is possible");
  }
  return mean_power(*near) - mean_power(*distance);
}

// The addition as a lensmeter reads it with the front on its stop: in a few secant steps, as it grows with the
// segment's curvature all but linearly.
void LensDraft::solve_segment() {
  constexpr double kSettled = 1e-9;
  constexpr int kMostSteps = 20;
  for (int step = 0; step < kMostSteps; ++step) {
    const double missing = request_.prescription.addition - segment_addition();
    if (std::abs(missing) < kSettled) {
      return;
    }
    segment_curvature_ += missing / (request_.index - 1.0);
    apply(unknowns_, true);
  }
  throw DesignError("prescription.add", "is not reached by this segment; a smaller addition is possible");
}

std::optional<PointPower> LensDraft::verification() const {
  const ReferencePoints& points = shape_.lens().reference_points;
  auto reading = reading_at_back(shape_, *points.distance);
  if (reading && *points.prism != *points.distance) {
    const auto prism = reading_at_back(shape_, *points.prism);
    if (!prism) {
      return std::nullopt;
    }
    reading->prism = prism->prism;
  }
  return reading;
}

WornSetup LensDraft::worn_setup() const {
  return {.side = request_.side, .reference_vertex = request_.refraction_vertex};
}

std::optional<PointPower> LensDraft::worn() const {
  const ReferencePoints& points = shape_.lens().reference_points;
  auto power = worn_power(shape_.lens(), worn_setup(), *points.distance);
  if (power && *points.prism != *points.distance) {
    const auto prism = worn_power(shape_.lens(), worn_setup(), *points.prism);
    if (!prism) {
      return std::nullopt;
    }
    power->prism = prism->prism;
  }
  return power;
}

Lens LensDraft::finished() const {
  return shape_.lens();
}

}  // namespace lenses::design
