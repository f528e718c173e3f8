#include "lenses/design/progressive_lens.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lenses/design/lens_edge.hpp"
#include "lenses/design/lens_shape.hpp"
#include "lenses/design/reason_text.hpp"
#include "lenses/design/surface_making.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace {

using design::in_dioptres;
using design::in_mm;
using design::LensShape;
using design::PointPower;
using Face = ProgressiveConfig::Face;
using tracking::InputError;

constexpr double kDefaultDiameter = 0.065, kSmallestDiameter = 0.04, kThickest = 0.05;  // m

[[noreturn]] void refuse(const std::string& field, const std::string& reason) {
  throw InputError("progressive", field, reason);
}

double mean(const PointPower& power) {
  return 0.5 * (power.power[0][0] + power.power[1][1]);
}

class Maker {
 public:
  Maker(const ProgressiveLensRequest& request, const DesignProgress& progress)
      : request_(request),
        progress_(progress),
        config_(request.surface),
        base_curve_(request.base_curve.value_or(design::vogel_base_curve(request.sphere))),
        shape_(blank()) {
    config_.addition = request.addition;
    config_.diameter = request.diameter.value_or(kDefaultDiameter);
  }

  // Thickness, the surface's powers and the width it allows depend on each other all but linearly and weakly; a few
  // rounds settle them.
  ProgressiveLens make() {
    constexpr int kMostRounds = 12;
    constexpr double kSettledAddition = 5e-4, kSettledThickness = 5e-6;  // D, m
    shape_.set_thickness(request_.centre_thickness.value_or(ample_thickness()));
    for (int round = 0; round < kMostRounds; ++round) {
      make_surfaces(round);
      const double missing = request_.addition - addition();
      const double thickness = shape_.lens().centre_thickness;
      const double needed = std::max(request_.minimum_centre_thickness, thickness + glass_missing());
      const bool settled = request_.centre_thickness ? needed <= thickness + 2.0 * kSettledThickness
                                                     : std::abs(needed - thickness) <= kSettledThickness;
      if (!settled) change_thickness(needed);
      correct_addition(missing);
      if (std::abs(missing) < kSettledAddition && settled) break;
    }
    if (progress_) progress_(1.0);
    return finished();
  }

 private:
  [[nodiscard]] bool front() const { return config_.face == Face::front; }

  [[nodiscard]] Lens blank() const {
    Lens lens;
    lens.index = request_.surface.index;
    lens.abbe = request_.abbe;
    lens.fit = request_.fit;
    lens.fit.decentration.y -= request_.surface.fitting_cross;  // the fitting cross goes to the pupil
    lens.reference_points = {.fitting_cross = glm::dvec2(0.0, request_.surface.fitting_cross),
                             .distance = glm::dvec2(0.0, request_.surface.distance_point),
                             .near = request_.surface.near_point(),
                             .prism = glm::dvec2(0.0)};
    return lens;
  }

  // A plus lens with glass all over; too thin a first lens would be no lens at its edge.
  [[nodiscard]] double ample_thickness() const {
    const double power = std::max(0.0, request_.sphere + request_.addition), radius = 0.5 * config_.diameter;
    return std::max(
        request_.minimum_centre_thickness,
        std::min(kThickest, request_.minimum_edge_thickness + 0.5 * power / (config_.index - 1.0) * radius * radius));
  }

  // Front vertex power of the thick lens: what the back has to bring to the ordered sphere.
  [[nodiscard]] double brought_by_front() const {
    return base_curve_ / (1.0 - shape_.lens().centre_thickness * base_curve_ / config_.index);
  }

  void make_surfaces(int round) {
    config_.distance_power = front() ? base_curve_ : request_.sphere - brought_by_front();
    settle_diameter();
    const auto step = [&](double done) {
      constexpr double kUsualRounds = 4.0;
      if (progress_) progress_(std::min(0.98, (round + done) / kUsualRounds));
    };
    ProgressiveDesign design = design_progressive(config_, step);
    report_ = design.report;
    const double other =
        front() ? (brought_by_front() - request_.sphere) / (config_.index - 1.0) : base_curve_ / (config_.index - 1.0);
    shape_.set_front(front() ? Surface(design.surface) : Surface(Sphere{other}));
    shape_.set_back(front() ? Surface(Sphere{other}) : Surface(std::move(design.surface)));
    shape_.rest().diameter = config_.diameter;
    solve_sphere(other);
  }

  void settle_diameter() {
    if (request_.diameter) return;
    constexpr double kTidy = 1e-3;
    const double widest = std::min(config_.widest(), widest_of_sphere());
    config_.diameter = std::min(config_.diameter, kTidy * std::floor(widest / kTidy * (1.0 + 1e-12)));
    if (config_.diameter < kSmallestDiameter) {
      refuse("base_curve", "of " + in_dioptres(base_curve_) + " leaves a lens no wider than " + in_mm(widest) +
                               "; at least " + in_mm(kSmallestDiameter) +
                               " is needed: less power, another base curve " + "or a higher index are possible");
    }
  }

  [[nodiscard]] double widest_of_sphere() const {
    const double power = front() ? request_.sphere - brought_by_front() : base_curve_;
    return 1.8 * (config_.index - 1.0) / std::max(std::abs(power), 1e-3);
  }

  // The sphere for which the lensmeter reads the ordered power at the distance point.
  void solve_sphere(double curvature) {
    constexpr int kMostSteps = 20;
    constexpr double kSettled = 1e-9;  // D
    const double by_curvature = front() ? 1.0 - config_.index : config_.index - 1.0;
    for (int step = 0; step < kMostSteps; ++step) {
      const auto reading = design::reading_at_back(shape_, *shape_.lens().reference_points.distance);
      if (!reading) refuse_light();
      const double missing = request_.sphere - mean(*reading);
      if (std::abs(missing) < kSettled) return;
      curvature += missing / by_curvature;
      if (front()) {
        shape_.set_back(Sphere{curvature});
      } else {
        shape_.set_front(Sphere{curvature});
      }
    }
  }

  [[nodiscard]] double addition() const {
    const auto at = [&](const std::optional<glm::dvec2>& point) {
      const auto reading = front() ? design::reading_at_front(shape_, *point) : design::reading_at_back(shape_, *point);
      if (!reading) refuse_light();
      return mean(*reading);
    };
    return at(shape_.lens().reference_points.near) - at(shape_.lens().reference_points.distance);
  }

  void correct_addition(double missing) {
    config_.addition += missing;
    if (config_.addition >= ProgressiveConfig::kLeastAddition && config_.addition <= ProgressiveConfig::kMostAddition) {
      return;
    }
    refuse("sphere", "of " + in_dioptres(request_.sphere) + " with a base curve of " + in_dioptres(base_curve_) +
                         " is so oblique at the near point that no surface reads an addition of " +
                         in_dioptres(request_.addition) + " there; less power, another base curve, a higher index or " +
                         "a shorter corridor are possible");
  }

  [[noreturn]] void refuse_light() const {
    refuse("sphere", "of " + in_dioptres(request_.sphere) + " with a base curve of " + in_dioptres(base_curve_) +
                         " makes a lens that light does not pass; less power or another base curve are possible");
  }

  [[nodiscard]] design::ThicknessRange thickness() const {
    const auto range = design::thickness_range(shape_, design::edge_points({}, config_.diameter));
    if (!range) {
      refuse("diameter", "is " + in_mm(config_.diameter) + ", where a surface ends; a smaller lens is possible, or " +
                             "flatter surfaces or a higher index");
    }
    return *range;
  }

  [[nodiscard]] double glass_missing() const {
    constexpr double kSpare = 1e-5;  // m, so that rounding leaves the edge on the right side of the minimum
    const design::ThicknessRange range = thickness();
    const double anywhere = std::min(request_.minimum_edge_thickness, request_.minimum_centre_thickness);
    return kSpare + std::max(request_.minimum_edge_thickness - range.thinnest_edge, anywhere - range.thinnest);
  }

  void change_thickness(double needed) {
    if (request_.centre_thickness) {
      refuse("centre_thickness", "is " + in_mm(*request_.centre_thickness) + "; about " + in_mm(needed) +
                                     " is needed to leave " + in_mm(request_.minimum_edge_thickness) + " at the edge");
    }
    if (needed > kThickest) {
      refuse("diameter", "is " + in_mm(config_.diameter) + ", for which this lens would have to be thicker than " +
                             in_mm(kThickest) + "; a smaller lens or a higher index are possible");
    }
    shape_.set_thickness(needed);
  }

  [[nodiscard]] ProgressiveLens finished() const {
    const design::ThicknessRange range = thickness();
    ProgressiveLens made;
    made.lens = shape_.lens();
    Prescription ordered;
    ordered.sphere = request_.sphere;
    ordered.addition = request_.addition;
    made.lens.order = Order{ordered, std::nullopt};
    made.report = report_;
    made.base_curve = base_curve_;
    made.distance_reading = mean(*design::reading_at_back(shape_, *shape_.lens().reference_points.distance));
    made.addition_reading = addition();
    made.thinnest_edge = range.thinnest_edge;
    made.thickest_edge = range.thickest_edge;
    return made;
  }

  const ProgressiveLensRequest& request_;
  const DesignProgress& progress_;
  ProgressiveConfig config_;
  double base_curve_;  // D
  LensShape shape_;
  ProgressiveReport report_;
};

}  // namespace

void ProgressiveLensRequest::validate() const {
  const auto within = [](const char* field, double value, double lo, double hi, const auto& in_words) {
    if (value >= lo - 1e-12 && value <= hi + 1e-12) return;
    refuse(field, "is " + in_words(value) + "; " + in_words(lo) + " to " + in_words(hi) + " is allowed");
  };
  within("addition", addition, 0.75, 3.5, in_dioptres);
  within("sphere", sphere, -20.0, 15.0, in_dioptres);
  within("base_curve", base_curve.value_or(1.0), 0.0, 25.0, in_dioptres);
  within("abbe", abbe, 15.0, 100.0, design::number_in_words);
  within("diameter", diameter.value_or(kDefaultDiameter), kSmallestDiameter, 0.08, in_mm);
  within("minimum_edge_thickness", minimum_edge_thickness, 0.0002, 0.01, in_mm);
  within("minimum_centre_thickness", minimum_centre_thickness, 0.0005, 0.02, in_mm);
  within("centre_thickness", centre_thickness.value_or(minimum_centre_thickness), minimum_centre_thickness, kThickest,
         in_mm);
  ProgressiveConfig layout = surface;
  layout.distance_power = 0.0;
  layout.addition = addition;
  layout.diameter = kSmallestDiameter;
  layout.validate();
}

ProgressiveLens make_progressive_lens(const ProgressiveLensRequest& request, const DesignProgress& progress) {
  request.validate();
  return Maker(request, progress).make();
}

}  // namespace lenses
