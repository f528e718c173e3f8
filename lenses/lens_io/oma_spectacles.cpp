#include "lenses/lens_io/oma_spectacles.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "lenses/design/lens_edge.hpp"
#include "lenses/design/lens_shape.hpp"
#include "lenses/design/materials.hpp"
#include "lenses/design/power_solver.hpp"
#include "lenses/design/prescription_lens.hpp"
#include "lenses/design/surface_making.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace {

using tracking::InputError;

constexpr double kLeastCentre = 0.0012, kLeastEdge = 0.001;  // m, where the job gives no thickness
constexpr double kRoundDiameter = 0.065;                     // m, where it gives no outline
constexpr double kDesignFittingCross = 0.004;                // y of design_lens's progressives, m

double abbe_of(double index) {
  double abbe = 0.0, nearest = 1e9;
  for (const Material& material : materials()) {
    if (std::abs(material.index - index) < nearest) {
      nearest = std::abs(material.index - index);
      abbe = material.abbe;
    }
  }
  return abbe;
}

double reach_of(const std::vector<glm::dvec2>& outline) {
  double reach = 0.0;
  for (const glm::dvec2& point : outline) reach = std::max(reach, length(point));
  return reach;
}

class LensMaker {
 public:
  LensMaker(const io::OmaJob& job, const OmaOrder& order, Side side, const JobReading& reading)
      : job_(job), order_(order), eye_(order.eye[static_cast<std::size_t>(side)]), side_(side), reading_(reading) {
    if (eye_.prescription) prescription_ = *eye_.prescription;
    const bool progressive = prescription_.addition > 0.0 || (!eye_.prescription && eye_.fitting_cross);
    type_ = order.type[static_cast<std::size_t>(side)].value_or(progressive ? OmaLensType::progressive
                                                                            : OmaLensType::single_vision);
  }

  [[nodiscard]] JobLens make() {
    JobLens result;
    const bool plain_radii = eye_.front_curvature && eye_.back_curvature && prescription_.cylinder == 0.0 &&
                             prescription_.addition == 0.0 && prescription_.prism.empty();
    if (eye_.front_surface || eye_.back_surface || plain_radii) {
      result = from_surfaces();
    } else if (eye_.prescription) {
      result.lens = designed();
    } else {
      fail("SPH", "is missing; a prescription, or FRNT and BACK, or SURFMT surfaces are needed to make a lens");
    }
    if (eye_.prescription) {
      result.lens.order = Order{prescription_, eye_.designed};
      if (result.lens.order->compensated) result.lens.order->compensated->prism = prescription_.prism;
    }
    return result;
  }

  [[nodiscard]] JobLens plano() {
    prescription_ = {};
    type_ = OmaLensType::single_vision;
    JobLens result;
    result.lens = designed();
    result.made = false;
    return result;
  }

 private:
  [[noreturn]] void fail(std::string_view label, const std::string& reason) const {
    std::optional<std::size_t> line;
    for (std::size_t i = 0; i < job_.lines.size() && !line; ++i) {
      if (job_.lines[i].label() == label) line = i;
    }
    const std::string eye = side_ == Side::right ? "right: " : "left: ";
    throw InputError(job_.file, line ? job_.place(*line) : std::string(label), eye + reason);
  }

  // Where the lens is fitted, in lens axes: this point comes before the pupil.
  [[nodiscard]] glm::dvec2 fitting_point() const {
    if (type_ != OmaLensType::progressive) return {0.0, 0.0};
    const bool own_surface = eye_.front_surface || eye_.back_surface;
    return eye_.fitting_cross.value_or(glm::dvec2(0.0, own_surface ? 0.0 : kDesignFittingCross));
  }

  [[nodiscard]] std::vector<glm::dvec2> outline(const glm::dvec2& fitting_point) const {
    const bool fitting_height =
        type_ == OmaLensType::progressive || (type_ == OmaLensType::single_vision && !eye_.optical_centre_height);
    const glm::dvec2 shift = fitting_point - pupil_in_box(order_, side_, fitting_height);
    std::vector<glm::dvec2> result = eye_.outline;
    for (glm::dvec2& point : result) point += shift;
    return result;
  }

  void set_fit(Fit& fit) const {
    if (eye_.vertex_distance) fit.vertex_distance = *eye_.vertex_distance;
    if (eye_.pantoscopic_tilt) fit.pantoscopic_tilt = *eye_.pantoscopic_tilt;
    if (eye_.wrap) fit.wrap = *eye_.wrap;
  }

  [[nodiscard]] Lens designed() const {
    LensRequest request;
    request.prescription = prescription_;
    request.design = type_ == OmaLensType::progressive ? LensDesign::progressive
                     : type_ == OmaLensType::bifocal   ? LensDesign::bifocal
                                                       : LensDesign::single_vision;
    request.side = side_;
    request.index = eye_.index.value_or(reading_.index);
    request.abbe = abbe_of(request.index);
    if (eye_.front_curvature) request.base_curve = (request.index - 1.0) * *eye_.front_curvature;
    request.centre_thickness = eye_.centre_thickness;
    if (type_ == OmaLensType::progressive) {
      const glm::dvec2 cross(0.0, kDesignFittingCross);
      request.outline = outline(cross);
      if (eye_.corridor_length) request.corridor_length = *eye_.corridor_length;
      if (eye_.far_pd && eye_.near_pd) request.inset = *eye_.far_pd - *eye_.near_pd;
    } else {
      request.outline = outline({0.0, 0.0});
      if (type_ == OmaLensType::bifocal && eye_.fitting_height && eye_.box_height) {
        const double pupil = pupil_in_box(order_, side_, false).y;
        request.segment_top = *eye_.fitting_height - 0.5 * *eye_.box_height - pupil;
      }
      if (eye_.far_pd && eye_.near_pd) request.inset = *eye_.far_pd - *eye_.near_pd;
    }
    set_fit(request.fit);
    try {
      return design_lens(request).lens;
    } catch (const DesignError& error) {
      fail(label_of(error.field()), "no lens can be made: " + error.field() + " " + error.reason());
    }
  }

  // The record that a field of a request came from.
  [[nodiscard]] static std::string_view label_of(const std::string& field) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kLabels{
        {{"centre_thickness_mm", "CTHICK"},
         {"index", "LIND"},
         {"outline", "R"},
         {"base_curve_D", "FRNT"},
         {"corridor_mm", "CORRLEN"},
         {"inset_mm", "NPD"},
         {"segment_top_mm", "SEGHT"},
         {"fit.vertex_distance_mm", "BVD"},
         {"fit.pantoscopic_tilt_deg", "PANTO"},
         {"fit.wrap_deg", "ZTILT"},
         {"prescription.add", "ADD"},
         {"prescription.cylinder", "CYL"},
         {"prescription.prism", "PRVM"}}};
    for (const auto& [name, label] : kLabels) {
      if (field.starts_with(name)) return label;
    }
    return "SPH";
  }

  [[nodiscard]] SurfaceOrigin fitted(const SagSamples& samples) const {
    return {SurfaceOrigin::Kind::tabulated,
            fit_sag_file({side_, std::nullopt, samples}, job_.file + ": SURFMT", reading_.fit)};
  }

  // One surface as the job has it; nullopt: neither table nor radius, or a radius that is not this eye's whole story.
  [[nodiscard]] std::optional<Surface> given(const std::optional<SagSamples>& samples,
                                             const std::optional<double>& curvature, SurfaceOrigin& origin) const {
    if (samples) {
      origin = fitted(*samples);
      return origin.fit->surface;
    }
    const bool whole = !eye_.prescription || (prescription_.cylinder == 0.0 && prescription_.prism.empty());
    if (!curvature || !whole) return std::nullopt;
    origin.kind = SurfaceOrigin::Kind::radius;
    return *curvature == 0.0 ? Surface(Plane{}) : Surface(Sphere{*curvature});
  }

  [[nodiscard]] JobLens from_surfaces() {
    JobLens result;
    Lens lens;
    lens.index = eye_.index.value_or(reading_.index);
    lens.abbe = abbe_of(lens.index);
    lens.fit = LensRequest{}.fit;
    set_fit(lens.fit);
    lens.fit.decentration = -fitting_point();
    lens.reference_points = {type_ == OmaLensType::progressive ? std::optional(fitting_point()) : eye_.fitting_cross,
                             eye_.distance_point, eye_.near_point, glm::dvec2(0.0)};
    lens.outline = outline(fitting_point());
    lens.diameter = lens.outline.empty() ? kRoundDiameter : 2.0 * reach_of(lens.outline) * (1.0 + 1e-9);
    lens.centre_thickness = eye_.centre_thickness.value_or(kLeastCentre);
    const auto front = given(eye_.front_surface, eye_.front_curvature, result.front);
    const auto back = given(eye_.back_surface, eye_.back_curvature, result.back);
    if (front) lens.front = *front;
    if (back) lens.back = *back;
    if (lens.outline.empty())
      lens.diameter = std::min({lens.diameter, patch_diameter(lens.front), patch_diameter(lens.back)});
    design::LensShape shape(lens);
    if ((!front || !back) && !eye_.prescription) {
      fail(front ? "BACK" : "FRNT", "is missing; with no prescription both surfaces must be given");
    }
    const auto edge = design::edge_points(lens.outline, lens.diameter);
    // A thicker lens has another power, which the solved surface takes up; two rounds settle both.
    for (int round = 0; round < 2; ++round) {
      if (!front || !back) solve_missing(shape, !front);
      if (eye_.centre_thickness) break;
      const auto range = design::thickness_range(shape, edge);
      if (!range) fail("R", "reaches beyond a surface of the lens; surfaces must cover the whole outline");
      const double missing = std::max(kLeastEdge - range->thinnest, 0.0);
      shape.set_thickness(shape.lens().centre_thickness + missing);
    }
    result.lens = shape.lens();
    return result;
  }

  // Of the largest circle about the axis within a spline's patch.
  [[nodiscard]] static double patch_diameter(const Surface& surface) {
    const auto* spline = std::get_if<BsplineHeightField>(&surface);
    if (spline == nullptr) return kRoundDiameter;
    const auto reach = [](const std::vector<double>& knots) { return std::min(-knots[3], knots[knots.size() - 4]); };
    return 2.0 * std::min(reach(spline->knots_x), reach(spline->knots_y)) * (1.0 - 1e-9);
  }

  // The surface that the job does not give: toric, tilted for the prism, solved for what a lensmeter is to read.
  void solve_missing(design::LensShape& shape, bool front) const {
    const Prescription target = eye_.designed.value_or(prescription_);
    design::PointPower aim = design::ordered_power(target);
    aim.prism = design::prism_vector(prescription_.prism);
    const ReferencePoints& points = shape.lens().reference_points;
    const glm::dvec2 at = points.distance.value_or(points.fitting_cross.value_or(glm::dvec2(0.0)));
    const auto apply = [&](const design::LensUnknowns& unknowns) {
      const Surface toric = design::toric_surface(unknowns.curvature, ToricForm::tyre, true);
      if (front) {
        shape.set_front(toric);
        shape.place_front(design::tilted(Torus{}, unknowns.prismatic));
      } else {
        shape.set_back(toric);
        shape.place_back(design::tilted(Torus{}, unknowns.prismatic));
      }
    };
    const auto measure = [&](const design::LensUnknowns& unknowns) -> std::optional<design::PointPower> {
      apply(unknowns);
      auto reading = design::reading_at_back(shape, at);
      const auto at_prism = design::reading_at_back(shape, glm::dvec2(0.0));
      if (!reading || !at_prism) return std::nullopt;
      reading->prism = at_prism->prism;
      return reading;
    };
    const f64::SurfacePoint other = front ? shape.back(at) : shape.front(at);
    design::LensUnknowns start;
    const double sign = front ? 1.0 : -1.0;
    start.curvature = glm::dmat2(other.hessian.x, other.hessian.y, other.hessian.y, other.hessian.z) +
                      sign * aim.power / (shape.lens().index - 1.0);
    const auto solved = design::solve_power(start, measure, aim, !prescription_.prism.empty());
    if (!solved) fail("SPH", "cannot be met with the surface that the job gives");
    apply(*solved);
  }

  const io::OmaJob& job_;
  const OmaOrder& order_;
  const OmaEye& eye_;
  Side side_;
  const JobReading& reading_;
  Prescription prescription_;
  OmaLensType type_;
};

}  // namespace

JobSpectacles spectacles_of(const io::OmaJob& job, const JobReading& reading) {
  const OmaOrder order = read_order(job, reading.rows);
  JobSpectacles result;
  if (const auto name = job.value_of("JOB", Side::right)) result.spectacles.name = std::string(*name);
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    LensMaker maker(job, order, side, reading);
    result.lens[i] = order.wanted[i] ? maker.make() : maker.plano();
    result.spectacles.lens[i] = result.lens[i].lens;
  }
  return result;
}

}  // namespace lenses
