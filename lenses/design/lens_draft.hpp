// A lens between order and finish: at a given thickness and diameter its surfaces are solved for.
#pragma once

#include <limits>

#include "lenses/design/lens_request.hpp"
#include "lenses/design/lens_shape.hpp"
#include "lenses/design/power_solver.hpp"
#include "lenses/design/worn_power.hpp"

namespace lenses::design {

class LensDraft {
 public:
  explicit LensDraft(const LensRequest& request);

  [[nodiscard]] const LensShape& shape() const { return shape_; }
  [[nodiscard]] double base_curve() const { return base_curve_; }
  // By the rule of the smallest radius.
  [[nodiscard]] double widest() const;
  void set_diameter(double diameter);
  // Makes a progressive surface anew for the thickness and the addition that came out, so that base curve and addition
  // become what they are meant to be; false when there is nothing left to mend.
  [[nodiscard]] bool renew();
  void set_conic_constant(double conic_constant);

  // Solves the surfaces for this thickness. Throws DesignError where there is no such lens.
  void solve(double thickness);

  // What a lensmeter reads at the reference points, and what the eye gets there.
  [[nodiscard]] std::optional<PointPower> verification() const;
  [[nodiscard]] std::optional<PointPower> worn() const;
  [[nodiscard]] WornSetup worn_setup() const;
  [[nodiscard]] const PointPower& ordered() const { return ordered_; }

 private:
  [[nodiscard]] bool toric_front() const;
  [[nodiscard]] bool decentres() const { return request_.prism_by == PrismBy::decentration; }
  void make_fixed_surfaces();
  void make_progressive();
  void apply(const LensUnknowns& unknowns, bool simplest);
  [[nodiscard]] LensUnknowns first_guess(const PointPower& target) const;
  void solve_reading();
  void solve_worn();
  void solve_segment();
  [[nodiscard]] double read_addition() const;

  LensRequest request_;
  PointPower ordered_;    // thinning included
  PointPower lensmeter_;  // what a lensmeter is to read unless the worn power decides
  double base_curve_;     // D
  double conic_constant_ = 0.0;
  double segment_curvature_ = 0.0;
  double progressive_addition_ = 0.0;                                      // of the surface, D
  double progressive_thickness_ = 0.0;                                     // that the surface was made for, m
  double progressive_diameter_ = std::numeric_limits<double>::infinity();  // of the net, m
  LensShape shape_;
  LensUnknowns unknowns_;
  bool guessed_ = false;
};

}  // namespace lenses::design
