#include "lenses/lens_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "lenses/design/lens_edge.hpp"
#include "lenses/design/lens_shape.hpp"
#include "lenses/lens_model.hpp"
#include "lenses/polygon.hpp"

namespace lenses {
namespace {

constexpr double kLeastGlass = 0.0008, kLeastUncutEdge = 0.0005, kLeastContactGlass = 0.00003;  // m
constexpr double kFaceHeight = 0.010;  // m above and below the pupil: brow and cheek, which stand about as the cornea
constexpr int kRings = 40;

std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return {text.data(), end};
}

std::string mm(double metres) {
  return text_of(1e3 * metres) + " mm";
}

std::string place(const glm::dvec2& at) {
  const auto whole_um = [](double metres) { return text_of(std::round(1e4 * metres) / 10.0); };
  return std::string("(").append(whole_um(at.x)).append(", ").append(whole_um(at.y)).append(") mm");
}

class LensChecker {
 public:
  LensChecker(const Lens& lens, Side side, const LensCheckLimits& limits)
      : lens_(lens),
        shape_(lens),
        side_(side),
        limits_(limits),
        contact_(lens.attached_to == Lens::AttachedTo::eye),
        edge_(design::edge_points(lens.outline, lens.diameter)) {}

  [[nodiscard]] LensCheck check() {
    result_.centre_thickness = lens_.centre_thickness;
    check_outline();
    check_glass();
    check_nets();
    if (!contact_) check_face();
    check_points();
    return std::move(result_);
  }

 private:
  void add(LensFault fault, std::string field, std::string message, double value, double limit,
           std::optional<glm::dvec2> at = std::nullopt) {
    result_.findings.push_back({fault, std::move(field), std::move(message), value, limit, at});
  }

  // Where thickness faults belong: the outline, or the round lens.
  [[nodiscard]] const char* edge_field() const { return lens_.outline.empty() ? "diameter_mm" : "outline"; }

  void check_outline() {
    if (lens_.outline.empty()) return;
    const auto farthest = std::ranges::max_element(lens_.outline, {}, [](const glm::dvec2& p) { return length(p); });
    const double reach = length(*farthest), radius = 0.5 * lens_.diameter;
    if (reach > radius * (1.0 + 1e-6)) {
      add(LensFault::outline_too_large, "outline",
          "reaches " + mm(reach) + " from the lens axis; a diameter of " + mm(lens_.diameter) + " allows " + mm(radius),
          1e3 * reach, 1e3 * radius, *farthest);
    }
    if (const auto at = self_crossing(lens_.outline)) {
      add(LensFault::outline_crosses_itself, "outline",
          "crosses itself at " + place(*at) + "; a simple polygon is needed", 0.0, 0.0, *at);
    }
  }

  struct Least {
    double thickness = 1e9;
    glm::dvec2 at{0.0};
    void take(double here, const glm::dvec2& place) {
      if (here < thickness) *this = {here, place};
    }
  };

  void check_glass() {
    Least edge, inner;
    double thickest_edge = -1e9;
    for (const glm::dvec2& point : edge_) {
      for (int ring = 0; ring <= kRings; ++ring) {
        const glm::dvec2 at = point * (static_cast<double>(ring) / kRings);
        const auto here = shape_.thickness(at);
        if (!here) {
          name_missing_surface(at);
          return;
        }
        if (ring == kRings) {
          edge.take(*here, at);
          thickest_edge = std::max(thickest_edge, *here);
        } else {
          inner.take(*here, at);
        }
      }
    }
    result_.thinnest = std::min(edge.thickness, inner.thickness);
    result_.thinnest_edge = edge.thickness;
    result_.thickest_edge = thickest_edge;
    judge_glass(edge, inner);
  }

  void judge_glass(const Least& edge, const Least& inner) {
    const Least& least = edge.thickness < inner.thickness ? edge : inner;
    const double glass = contact_ ? kLeastContactGlass : kLeastGlass;
    // A round lens is still to be cut; its edge will not be worn.
    const double rim = contact_ || !lens_.outline.empty() ? glass : kLeastUncutEdge;
    const double least_edge = limits_.least_edge.value_or(rim);
    const double least_centre = limits_.least_centre.value_or(glass);
    if (least.thickness < 0.0) {
      add(LensFault::surfaces_cross, edge_field(),
          "lets front and back surface cross: at " + place(least.at) + " the glass would be " + mm(least.thickness) +
              " thick; at least " + mm(least_edge) + " is needed",
          1e3 * least.thickness, 1e3 * least_edge, least.at);
      return;
    }
    // A hair of rounding below the limit is the limit.
    constexpr double kHair = 1e-8;
    if (edge.thickness < least_edge - kHair) {
      add(LensFault::edge_too_thin, edge_field(),
          "leaves an edge of " + mm(edge.thickness) + " at " + place(edge.at) + "; at least " + mm(least_edge) +
              " is needed",
          1e3 * edge.thickness, 1e3 * least_edge, edge.at);
    }
    const double least_inner = std::min(least_centre, least_edge);
    const bool thin_centre = lens_.centre_thickness < least_centre - kHair && inner.thickness >= least_inner - kHair;
    if (inner.thickness < least_inner - kHair || thin_centre) {
      const Least& thin = thin_centre ? Least{*shape_.thickness({0.0, 0.0}), {0.0, 0.0}} : inner;
      if (thin.thickness < least_centre - kHair) {
        add(LensFault::glass_too_thin, "centre_thickness_mm",
            "leaves " + mm(thin.thickness) + " of glass at " + place(thin.at) + "; at least " + mm(least_centre) +
                " is needed",
            1e3 * thin.thickness, 1e3 * least_centre, thin.at);
      }
    }
  }

  void name_missing_surface(const glm::dvec2& at) {
    const bool front = !shape_.front(at).inside;
    add(LensFault::surface_ends, front ? "front" : "back",
        "ends inside the lens: there is no surface at " + place(at) + ", " + mm(length(at)) +
            " from the axis; it must reach over the whole outline",
        1e3 * length(at), 0.0, at);
  }

  void check_nets() {
    result_.front_net_error = check_net(lens_.front, "front");
    result_.back_net_error = check_net(lens_.back, "back");
  }

  std::optional<double> check_net(const Surface& surface, const char* field) {
    const auto* spline = std::get_if<BsplineHeightField>(&surface);
    if (spline == nullptr) return std::nullopt;
    double reach = 0.0;
    for (const glm::dvec2& point : edge_) reach = std::max(reach, length(point));
    const double error = net_error(*spline, lens_.index, reach);
    if (error > limits_.coarse_net) {
      add(LensFault::net_too_coarse, field,
          "has a control net too coarse for its curvature: its power may be off by " + text_of(error) + " D; up to " +
              text_of(limits_.coarse_net) + " D is allowed, more control points are needed",
          error, limits_.coarse_net);
    }
    return error;
  }

  // The globe as the sphere about the centre of rotation that touches the cornea; brow and cheek as the plane of the
  // cornea, above and below the eye.
  void check_face() {
    LensModel model;
    append_lens(model, &lens_, side_, limits_.entrance_pupil_depth);
    const f64::LensData& data = model.lens.front();
    const glm::dmat3 rotation(glm::dvec3(data.axis_x), glm::dvec3(data.axis_y), glm::dvec3(data.axis_z));
    const glm::dvec3 origin(data.axis_x.w, data.axis_y.w, data.axis_z.w);
    const glm::dvec3 centre(0.0, 0.0, limits_.centre_of_rotation_depth - limits_.entrance_pupil_depth);
    Least eye, face;
    for (const glm::dvec2& point : edge_) {
      for (int ring = 0; ring <= kRings; ++ring) {
        const glm::dvec2 at = point * (static_cast<double>(ring) / kRings);
        const f64::SurfacePoint back = shape_.back(at);
        if (!back.inside) continue;
        const glm::dvec3 in_eye = rotation * glm::dvec3(at, back.z) + origin;
        eye.take(distance(in_eye, centre) - limits_.centre_of_rotation_depth, at);
        if (std::abs(in_eye.y) > kFaceHeight) face.take(-limits_.entrance_pupil_depth - in_eye.z, at);
      }
    }
    result_.eye_clearance = eye.thickness;
    if (eye.thickness <= 0.0) {
      add(LensFault::touches_eye, "fit",
          "lets the lens touch the eye at " + place(eye.at) + ", by " + mm(-eye.thickness) +
              "; a greater vertex distance or less wrap and tilt is needed",
          1e3 * eye.thickness, 0.0, eye.at);
    }
    if (face.thickness <= 0.0) {
      add(LensFault::touches_face, "fit",
          std::string("lets the lens touch the ") + (face.at.y > 0.0 ? "brow" : "cheek") + " at " + place(face.at) +
              ", " + mm(-face.thickness) +
              " behind the plane of the cornea; a smaller outline, less tilt or a greater "
              "vertex distance is needed",
          1e3 * face.thickness, 0.0, face.at);
    }
  }

  void check_points() {
    const auto check = [this](const std::string& field, const std::optional<glm::dvec2>& point, const char* what) {
      if (!point || is_inside(edge_, *point)) return;
      add(LensFault::point_outside, field, std::string(what) + " at " + place(*point) + " lies outside the outline",
          0.0, 0.0, *point);
    };
    const ReferencePoints& points = lens_.reference_points;
    check("reference_points_mm.fitting_cross", points.fitting_cross, "the fitting cross");
    check("reference_points_mm.distance", points.distance, "the distance reference point");
    check("reference_points_mm.near", points.near, "the near reference point");
    check("reference_points_mm.prism", points.prism, "the prism reference point");
    if (!contact_) check("fit.decentration_mm", -lens_.fit.decentration, "the pupil, straight ahead,");
  }

  const Lens& lens_;
  design::LensShape shape_;
  Side side_;
  const LensCheckLimits& limits_;
  bool contact_;
  std::vector<glm::dvec2> edge_;
  LensCheck result_;
};

}  // namespace

const char* name_of(LensFault fault) {
  switch (fault) {
    case LensFault::surfaces_cross:
      return "surfaces_cross";
    case LensFault::surface_ends:
      return "surface_ends";
    case LensFault::edge_too_thin:
      return "edge_too_thin";
    case LensFault::glass_too_thin:
      return "glass_too_thin";
    case LensFault::net_too_coarse:
      return "net_too_coarse";
    case LensFault::outline_too_large:
      return "outline_too_large";
    case LensFault::outline_crosses_itself:
      return "outline_crosses_itself";
    case LensFault::touches_eye:
      return "touches_eye";
    case LensFault::touches_face:
      return "touches_face";
    case LensFault::point_outside:
      return "point_outside";
  }
  return "";
}

LensCheck check_lens(const Lens& lens, Side side, const LensCheckLimits& limits) {
  return LensChecker(lens, side, limits).check();
}

}  // namespace lenses
