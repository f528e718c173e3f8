#include "lenses/design/lens_draft.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "lenses/design/lens_blank.hpp"
#include "lenses/design/reason_text.hpp"
#include "lenses/design/surface_making.hpp"

namespace lenses::design {
namespace {

constexpr double kLargestDecentration = 0.02;  // m
constexpr glm::dvec2 kCentre(0.0);

}  // namespace

LensDraft::LensDraft(const LensRequest& request)
    : request_(request),
      ordered_(order_of(request)),
      lensmeter_(ordered_),
      base_curve_(0.0),
      shape_(blank_lens(request)) {
  if (request_.design == LensDesign::contact) {
    lensmeter_.power = nearer_to_eye(ordered_.power, request_.refraction_vertex);
  }
  base_curve_ = request_.base_curve.value_or(vogel_base_curve(mean_power(lensmeter_)));
  progressive_addition_ = request_.prescription.addition;
  segment_curvature_ = (base_curve_ + request_.prescription.addition) / (request_.index - 1.0);
  make_fixed_surfaces();
}

// Which surface carries the cylinder: the other than the one whose shape is given.
bool LensDraft::toric_front() const {
  return request_.design == LensDesign::contact ||
         (request_.design == LensDesign::progressive && request_.progressive_face == ProgressiveConfig::Face::eye_side);
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

// As a lensmeter reads it with the side on its stop that carries it.
double LensDraft::read_addition() const {
  const bool on_back = request_.design == LensDesign::progressive && toric_front();
  const auto read = on_back ? reading_at_back : reading_at_front;
  const ReferencePoints& points = shape_.lens().reference_points;
  const auto near = read(shape_, *points.near);
  const auto distance = read(shape_, *points.distance);
  if (!near || !distance) {
    throw DesignError(request_.design == LensDesign::bifocal ? "segment_top_mm" : "corridor_mm",
                      "leaves the near point where no light passes the lens; a higher near point is possible");
  }
  return mean_power(*near) - mean_power(*distance);
}

// The addition grows all but linearly with the segment's curvature: a few steps find it.
void LensDraft::solve_segment() {
  constexpr double kSettled = 1e-9;
  constexpr int kMostSteps = 20;
  for (int step = 0; step < kMostSteps; ++step) {
    const double missing = request_.prescription.addition - read_addition();
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
  const WornLens lens(shape_.lens(), worn_setup());
  auto power = lens.through(*points.distance);
  if (power && *points.prism != *points.distance) {
    const auto prism = lens.through(*points.prism);
    if (!prism) {
      return std::nullopt;
    }
    power->prism = prism->prism;
  }
  return power;
}

}  // namespace lenses::design
