#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "lenses/lens_io/written_number.hpp"

namespace lenses {
namespace {

using io::written;
using io::written_degrees;
using io::written_mm;
using io::written_radius_mm;
using nlohmann::ordered_json;

ordered_json mm(const glm::dvec2& p) {
  return ordered_json::array({written_mm(p.x), written_mm(p.y)});
}

ordered_json mm(const glm::dvec3& p) {
  return ordered_json::array({written_mm(p.x), written_mm(p.y), written_mm(p.z)});
}

template <class Values, class Write>
ordered_json list(const Values& values, Write write) {
  ordered_json result = ordered_json::array();
  for (const auto& value : values) result.push_back(write(value));
  return result;
}

// A net stored row after row as an array of rows.
template <class Values, class Write>
ordered_json net(const Values& values, std::size_t row_length, Write write) {
  ordered_json rows = ordered_json::array();
  for (std::size_t start = 0; start + row_length <= values.size(); start += row_length) {
    ordered_json row = ordered_json::array();
    for (std::size_t j = 0; j < row_length; ++j) row.push_back(write(values[start + j]));
    rows.push_back(std::move(row));
  }
  return rows;
}

// A surface object with what its placement departs from the neutral one.
ordered_json placed(ordered_json surface, const Placement& placement) {
  const Placement neutral;
  if (placement.decentration != neutral.decentration) surface["decentration_mm"] = mm(placement.decentration);
  if (placement.slope != neutral.slope) {
    surface["slope"] = ordered_json::array({written(placement.slope.x), written(placement.slope.y)});
  }
  if (placement.height != neutral.height) surface["height_mm"] = written_mm(placement.height);
  return surface;
}

struct SurfaceWriter {
  ordered_json operator()(const Plane&) const { return {{"type", "plane"}}; }

  ordered_json operator()(const Sphere& s) const {
    return {{"type", "sphere"}, {"radius_mm", written_radius_mm(s.curvature)}};
  }

  ordered_json operator()(const Conic& s) const {
    ordered_json coefficients = ordered_json::array();
    for (std::size_t i = 0; i < s.even_coefficients.size(); ++i) {
      coefficients.push_back(io::written_even_coefficient(s.even_coefficients[i], i));
    }
    return {{"type", "conic"},
            {"radius_mm", written_radius_mm(s.curvature)},
            {"conic_constant", written(s.conic_constant)},
            {"even_coefficients_mm", std::move(coefficients)}};
  }

  ordered_json operator()(const Torus& s) const {
    return {{"type", "torus"},
            {"radius_u_mm", written_radius_mm(s.curvature_u)},
            {"radius_v_mm", written_radius_mm(s.curvature_v)},
            {"axis_deg", written_degrees(s.axis)},
            {"revolve", s.revolve == Torus::Revolve::u ? "u" : "v"}};
  }

  ordered_json operator()(const BsplineHeightField& s) const {
    return {{"type", "bspline"},
            {"knots_x_mm", list(s.knots_x, written_mm)},
            {"knots_y_mm", list(s.knots_y, written_mm)},
            {"control_z_mm", net(s.control_z, s.count_y(), written_mm)}};
  }

  ordered_json operator()(const BsplineSurface& s) const {
    return {{"type", "bspline_surface"},
            {"knots_u", list(s.knots_u, written)},
            {"knots_v", list(s.knots_v, written)},
            {"control_mm", net(s.control, s.count_v(), [](const glm::dvec3& p) { return mm(p); })}};
  }

  ordered_json operator()(const SegmentedSurface& s) const {
    return {{"type", "segment"},
            {"base", std::visit(*this, s.base)},
            {"segment", placed(std::visit(*this, s.segment), s.segment_placement)},
            {"boundary_mm", list(s.boundary, [](const glm::dvec2& p) { return mm(p); })}};
  }
};

ordered_json points_object(const ReferencePoints& points) {
  ordered_json result = ordered_json::object();
  const auto add = [&result](const char* key, const std::optional<glm::dvec2>& point) {
    if (point) result[key] = mm(*point);
  };
  add("fitting_cross", points.fitting_cross);
  add("distance", points.distance);
  add("near", points.near);
  add("prism", points.prism);
  return result;
}

ordered_json prescription_object(const Prescription& p) {
  ordered_json result = {{"sphere", written(p.sphere)}, {"cylinder", written(p.cylinder)}};
  if (p.cylinder != 0.0 || p.axis != 0.0) result["axis"] = written_degrees(p.axis);
  if (p.addition != 0.0) result["add"] = written(p.addition);
  if (!p.prism.empty()) {
    result["prism"] = list(p.prism, [](const Prism& prism) -> ordered_json {
      return {{"magnitude", written(prism.magnitude)}, {"base", written_degrees(prism.base)}};
    });
  }
  return result;
}

ordered_json lens_object(const Lens& lens) {
  ordered_json result = {{"index", written(lens.index)},
                         {"abbe", written(lens.abbe)},
                         {"centre_thickness_mm", written_mm(lens.centre_thickness)},
                         {"diameter_mm", written_mm(lens.diameter)},
                         {"front", placed(std::visit(SurfaceWriter{}, lens.front), lens.front_placement)},
                         {"back", placed(std::visit(SurfaceWriter{}, lens.back), lens.back_placement)},
                         {"fit",
                          {{"vertex_distance_mm", written_mm(lens.fit.vertex_distance)},
                           {"decentration_mm", mm(lens.fit.decentration)},
                           {"pantoscopic_tilt_deg", written_degrees(lens.fit.pantoscopic_tilt)},
                           {"wrap_deg", written_degrees(lens.fit.wrap)}}}};
  ordered_json points = points_object(lens.reference_points);
  if (!points.empty()) result["reference_points_mm"] = std::move(points);
  if (!lens.outline.empty()) {
    result["outline"] = {{"polygon_mm", list(lens.outline, [](const glm::dvec2& p) { return mm(p); })}};
  }
  result["attached_to"] = lens.attached_to == Lens::AttachedTo::eye ? "eye" : "head";
  if (lens.order) {
    result["order"]["ordered"] = prescription_object(lens.order->ordered);
    if (lens.order->compensated) result["order"]["compensated"] = prescription_object(*lens.order->compensated);
  }
  return result;
}

}  // namespace

std::string to_json(const Lens& lens) {
  ordered_json document = {{"version", 1}};
  document.update(lens_object(lens));
  return io::document_text(document);
}

std::string to_json(const Spectacles& spectacles) {
  const glm::dvec3& tint = spectacles.tint_transmission;
  return io::document_text(
      {{"version", 1},
       {"name", spectacles.name},
       {"right", lens_object(spectacles.lens[0])},
       {"left", lens_object(spectacles.lens[1])},
       {"tint", {{"transmission", ordered_json::array({written(tint.x), written(tint.y), written(tint.z)})}}}});
}

}  // namespace lenses
