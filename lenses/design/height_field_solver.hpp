// Height fields of wanted curvature: Gauss-Newton on the coefficients of a bicubic B-spline for
//   sum over sites of  w_P (P - P_target)^2 + w_C cyl^2
// (Loos, Greiner, Seidel 1998), height and slope at the centre held at 0: without that the surface may drift as a rigid
// body. Cylinder enters by its two components over the axes, which are smooth where cylinder itself has a kink.
#pragma once

#include <span>
#include <vector>

#include "lenses/bspline_field.hpp"

namespace lenses {

// A place where the surface is judged; the caller sets what is wanted there.
struct DesignSite {
  glm::dvec2 place;                                               // m
  double power = 0.0, power_weight = 0.0, cylinder_weight = 0.0;  // D, of squared D
};

class HeightFieldSolver {
 public:
  // Sites at the 2 x 2 Gauss points of each cell of the net.
  HeightFieldSolver(BsplineHeightField start, double power_per_curvature);

  [[nodiscard]] std::span<DesignSite> sites() { return sites_; }
  [[nodiscard]] const BsplineHeightField& surface() const { return surface_; }
  // What is minimised, D^2.
  [[nodiscard]] double cost() const { return cost_of(surface_.control_z); }
  // One Gauss-Newton step, shortened until it lowers the cost. Returns the share of the cost that it took away, 0 if
  // none could be.
  double step();

 private:
  // A row of the least-squares problem over the 16 coefficients of a cell.
  struct Row {
    double residual;
    std::array<double, 16> by_coefficient;
  };
  [[nodiscard]] HeightPoint point(std::size_t i, std::size_t j, std::span<const double> control) const;
  [[nodiscard]] std::array<Row, 3> rows(std::size_t i, std::size_t j) const;
  [[nodiscard]] std::array<Row, 3> pins(std::span<const double> control) const;
  [[nodiscard]] double cost_of(std::span<const double> control) const;
  [[nodiscard]] std::vector<double> direction() const;

  BsplineHeightField surface_;
  double factor_;
  std::vector<BasisAt> along_x_, along_y_;  // at the sites' coordinates
  BasisAt centre_x_, centre_y_;
  std::vector<DesignSite> sites_;  // [i * along_y_.size() + j]
};

}  // namespace lenses
