#include "lenses/design/prescription_lens.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "lenses/design/lens_draft.hpp"
#include "lenses/design/lens_edge.hpp"
#include "lenses/design/reason_text.hpp"

namespace lenses {
namespace {

using design::in_dioptres;
using design::in_mm;
using design::LensDraft;
using design::PointPower;
using design::ThicknessRange;

struct SizeRule {
  double diameter;                      // m
  double minimum_centre, minimum_edge;  // m
  double smallest_diameter;             // m, below it no lens is offered
};

// A contact lens is its optic zone, wide enough for light from 50 degrees aside.
SizeRule size_rule(const LensRequest& r) {
  SizeRule rule{0.065, 0.0012, 0.001, 0.015};
  if (r.design == LensDesign::contact) {
    rule = r.contact == ContactKind::soft ? SizeRule{0.011, 0.00008, 0.00005, 0.005}
                                          : SizeRule{0.0096, 0.00014, 0.00008, 0.005};
  }
  rule.minimum_centre = r.minimum_centre_thickness.value_or(rule.minimum_centre);
  rule.minimum_edge = r.minimum_edge_thickness.value_or(rule.minimum_edge);
  return rule;
}

double outline_diameter(const std::vector<glm::dvec2>& outline) {
  double farthest = 0.0;
  for (const glm::dvec2& p : outline) {
    farthest = std::max(farthest, length(p));
  }
  // A hair more, so that the corner itself is inside.
  return 2.0 * farthest * (1.0 + 1e-9);
}

// A surface that does not reach the edge.
struct SurfaceEnds {};

class LensMaker {
 public:
  explicit LensMaker(const LensRequest& request) : request_(request), rule_(size_rule(request)), draft_(request) {}

  DesignedLens make() {
    settle_size();
    if (request_.front == FrontDesign::aspheric) {
      choose_conic_constant();
      settle_size();
    }
    return report();
  }

 private:
  [[nodiscard]] bool by_rule() const { return !request_.diameter && request_.outline.empty(); }

  // A thicker lens of plus power has a steeper back, a smaller one is thinner: the diameter by rule only ever shrinks.
  void settle_size() {
    constexpr int kMostPasses = 60, kMostRenewals = 4;
    double diameter = asked_diameter();
    draft_.set_diameter(diameter);
    draft_.solve(request_.centre_thickness.value_or(rule_.minimum_centre));
    int renewals = 0;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      if (by_rule()) {
        diameter = narrower(diameter);
        draft_.set_diameter(diameter);
      }
      if (!settle_thickness() || (by_rule() && draft_.widest() < diameter)) {
        continue;
      }
      if (renewals++ == kMostRenewals || !draft_.renew()) {
        return;
      }
    }
    refuse_reach();
  }

  // What the surfaces allow, to a tenth of a millimetre.
  [[nodiscard]] double narrower(double diameter) const {
    constexpr double kTidy = 1e-4;  // m
    if (draft_.widest() >= diameter && surfaces_reach()) {
      return diameter;
    }
    const double allowed = std::min(draft_.widest(), surfaces_reach() ? diameter : 0.95 * diameter);
    const double result = kTidy * std::floor(allowed / kTidy * (1.0 + 1e-12));
    if (!(result >= rule_.smallest_diameter)) {
      throw DesignError("prescription", "asks for surfaces so steep that the lens would be " +
                                            in_mm(std::max(0.0, result)) + " wide; at least " +
                                            in_mm(rule_.smallest_diameter) +
                                            " is needed: less power or prism, another base curve or a higher index "
                                            "are possible");
    }
    return result;
  }

  [[nodiscard]] bool surfaces_reach() const { return design::thickness_range(draft_.shape(), edge()).has_value(); }

  [[nodiscard]] double asked_diameter() const {
    const double needed = outline_diameter(request_.outline);
    if (request_.diameter && !request_.outline.empty() && *request_.diameter < needed) {
      throw DesignError("diameter_mm",
                        "is " + in_mm(*request_.diameter) + "; the outline needs at least " + in_mm(needed));
    }
    return request_.diameter.value_or(request_.outline.empty() ? rule_.diameter : needed);
  }

  [[nodiscard]] std::vector<glm::dvec2> edge() const {
    return design::edge_points(request_.outline, draft_.shape().lens().diameter);
  }

  // How much glass is missing at this centre thickness, m; not above 0 when there is enough everywhere.
  double shortage(double thickness) {
    draft_.solve(thickness);
    const auto range = design::thickness_range(draft_.shape(), edge());
    if (!range) {
      throw SurfaceEnds{};
    }
    return std::max(rule_.minimum_edge - range->thinnest_edge,
                    std::min(rule_.minimum_edge, rule_.minimum_centre) - range->thinnest);
  }

  [[noreturn]] void refuse_reach() const {
    const bool outline = !request_.outline.empty();
    throw DesignError(outline ? "outline" : "diameter_mm",
                      std::string(outline ? "reaches " : "is ") + in_mm(draft_.shape().lens().diameter) +
                          " across, where a surface ends; at most " + in_mm(std::max(0.0, draft_.widest())) +
                          " is possible with a base curve of " + in_dioptres(draft_.base_curve()) +
                          ", more with flatter surfaces or a higher index");
  }

  // False where a lens whose diameter follows by rule must first become smaller.
  [[nodiscard]] bool settle_thickness() {
    try {
      if (request_.centre_thickness) {
        check_given_thickness(*request_.centre_thickness);
      } else {
        (void)least_thickness();
      }
      return true;
    } catch (const SurfaceEnds&) {
      if (!by_rule()) {
        refuse_reach();
      }
      return false;
    }
  }

  void check_given_thickness(double given) {
    const double missing = shortage(given);
    if (missing <= 0.0 && given >= rule_.minimum_centre * (1.0 - 1e-9)) {
      return;
    }
    const double needed = 1e-6 * std::ceil(1e6 * least_thickness());
    throw DesignError("centre_thickness_mm",
                      "is " + in_mm(given) + ", which leaves " + in_mm(rule_.minimum_edge - missing) +
                          " at the thinnest place of the edge; at least " + in_mm(needed) + " is needed for " +
                          in_mm(rule_.minimum_edge) + " there and " + in_mm(rule_.minimum_centre) + " in the centre");
  }

  // The least centre thickness that leaves enough glass everywhere; the draft is solved for it.
  double least_thickness() {
    constexpr double kThickest = 0.05;  // m
    double thin = rule_.minimum_centre;
    double missing = shortage(thin);
    if (missing <= 0.0) {
      return thin;
    }
    double thick = thin;
    double missing_thin = missing;
    while (missing > 0.0) {
      thin = thick;
      missing_thin = missing;
      thick += std::max(1.2 * missing, 1e-5);
      if (thick > kThickest) {
        throw DesignError(request_.outline.empty() ? "diameter_mm" : "outline",
                          "is " + in_mm(draft_.shape().lens().diameter) +
                              " across, for which this lens would have to "
                              "be thicker than " +
                              in_mm(kThickest) + "; a smaller lens or a higher index are possible");
      }
      missing = shortage(thick);
    }
    const auto close = [](double a, double b) { return std::abs(b - a) < 1e-8; };  // m
    std::uintmax_t most = 60;
    const auto found = boost::math::tools::toms748_solve([this](double t) { return shortage(t); }, thin, thick,
                                                         missing_thin, missing, close, most);
    thick = found.second;
    (void)shortage(thick);
    return thick;
  }

  // Mean square error of the power the turning eye gets, D^2.
  [[nodiscard]] double oblique_error() const {
    Lens lens = draft_.shape().lens();
    lens.fit = {.vertex_distance = lens.fit.vertex_distance};
    design::WornSetup setup = draft_.worn_setup();
    setup.reference_vertex = lens.fit.vertex_distance;
    const design::WornLens before_the_eye(lens, setup);
    double sum = 0.0;
    int rays = 0;
    constexpr double kDegree = std::numbers::pi / 180.0;
    for (const double turn : {10.0 * kDegree, 20.0 * kDegree, 30.0 * kDegree}) {
      for (int k = 0; k < 8; ++k) {
        const double direction = k * 45.0 * kDegree;
        const glm::dvec3 gaze(std::sin(turn) * std::cos(direction), std::sin(turn) * std::sin(direction),
                              -std::cos(turn));
        if (const auto worn = before_the_eye.along(gaze)) {
          const glm::dmat2 error = worn->power - draft_.ordered().power;
          sum += dot(error[0], error[0]) + dot(error[1], error[1]);
          ++rays;
        }
      }
    }
    return rays == 0 ? std::numeric_limits<double>::infinity() : sum / rays;
  }

  // The conic front with the least oblique error. The search is over (1 + k) c^2 r^2 at the lens's edge, which says how
  // far the surface departs from a paraboloid there and must stay below 1.
  void choose_conic_constant() {
    constexpr double kHyperbolic = -3.0, kElliptic = 0.8;
    constexpr double kLargest = 9e3;  // what a lens file holds
    const double c = draft_.base_curve() / (request_.index - 1.0);
    const double scale = std::pow(c * 0.5 * draft_.shape().lens().diameter, 2);
    const auto constant = [&](double q) { return std::clamp(q / scale - 1.0, -kLargest, kLargest); };
    std::uintmax_t most = 60;
    const auto best = boost::math::tools::brent_find_minima(
        [&](double q) {
          draft_.set_conic_constant(constant(q));
          return oblique_error();
        },
        kHyperbolic, kElliptic, 26, most);
    draft_.set_conic_constant(constant(best.first));
  }

  [[nodiscard]] DesignedLens report() const {
    DesignedLens result;
    result.lens = draft_.shape().lens();
    result.base_curve = draft_.base_curve();
    const Prescription& ordered = request_.prescription;
    const bool plus = ordered.cylinder > 0.0;
    const auto verification = draft_.verification();
    const auto worn = draft_.worn();
    const auto range = design::thickness_range(draft_.shape(), edge());
    if (!verification || !range) {
      refuse_reach();
    }
    result.verification = design::to_prescription(*verification, plus, ordered.addition);
    if (worn) {
      result.worn = design::to_prescription(*worn, plus, ordered.addition);
    }
    result.thinnest_edge = range->thinnest_edge;
    result.thickest_edge = range->thickest_edge;
    result.volume = design::volume(draft_.shape(), edge());
    result.lens.order = Order{ordered, std::nullopt};
    if (request_.as_worn || request_.prism_thinning || request_.design == LensDesign::contact) {
      result.lens.order->compensated = result.verification;
    }
    return result;
  }

  const LensRequest& request_;
  SizeRule rule_;
  LensDraft draft_;
};

}  // namespace

DesignedLens design_lens(const LensRequest& request) {
  request.validate();
  return LensMaker(request).make();
}

}  // namespace lenses
