#include "lenses/lens_io/oma_order.hpp"

#include <cmath>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/oma_trace.hpp"
#include "lenses/lens_io/units.hpp"

namespace lenses {
namespace {

using io::from_degrees;
using io::from_mm;
using io::OmaJob;

constexpr double kToolingIndex = 1.53;
constexpr double kLongestPowerField = 20.0;  // a greater number is a radius in mm

class EyeReader {
 public:
  EyeReader(const OmaJob& job, Side side) : job_(job), side_(side) {}

  [[nodiscard]] OmaEye read() const {
    OmaEye eye;
    eye.prescription = prescription();
    eye.designed = designed("LDDRSPH", "LDDRCYL", "LDDRAX");
    if (eye.designed) eye.designed->addition = number("LDADD", 0.0, 10.0).value_or(0.0);
    eye.designed_near = designed("LDNRSPH", "LDNRCYL", "LDNRAX");
    eye.far_pd = mm("IPD", 10.0, 50.0);
    eye.near_pd = mm("NPD", 10.0, 50.0);
    eye.optical_centre_height = mm("OCHT", -50.0, 100.0);
    eye.fitting_height = mm("SEGHT", -50.0, 100.0);
    eye.box_width = mm("HBOX", 5.0, 150.0);
    eye.box_height = mm("VBOX", 5.0, 150.0);
    eye.vertex_distance = mm("BVD", 0.0, 50.0);
    eye.pantoscopic_tilt = degrees("PANTO", -45.0, 45.0);
    eye.wrap = degrees("ZTILT", -45.0, 45.0);
    eye.index = number("LIND", 1.2, 3.0);
    eye.centre_thickness = mm("CTHICK", 0.0, 100.0);
    eye.corridor_length = mm("CORRLEN", 3.0, 40.0);
    eye.fitting_cross = point("BCSGIN", "BCSGUP");
    eye.distance_point = point("BCDRPIN", "BCDRPUP");
    eye.near_point = point("BCNRPIN", "BCNRPUP");
    eye.front_curvature = curvature("FRNT", 1.0);
    eye.back_curvature = curvature("BACK", -1.0);
    return eye;
  }

  [[nodiscard]] std::optional<OmaLensType> type() const {
    const auto text = job_.value_of("LTYPE", side_);
    if (!text) return std::nullopt;
    for (const std::string_view word : io::split(*text, ' ')) {
      if (word.starts_with("PR")) return OmaLensType::progressive;
      if (word.starts_with("BI")) return OmaLensType::bifocal;
      if (word.starts_with("SV")) return OmaLensType::single_vision;
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<double> number(std::string_view label, double low, double high) const {
    return job_.number_of(label, side_, low, high);
  }

 private:
  [[nodiscard]] std::optional<double> mm(std::string_view label, double low, double high) const {
    const auto value = number(label, low, high);
    return value ? std::optional(from_mm(*value)) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> degrees(std::string_view label, double low, double high) const {
    const auto value = number(label, low, high);
    return value ? std::optional(from_degrees(*value)) : std::nullopt;
  }

  [[nodiscard]] std::optional<Prescription> prescription() const {
    auto result = designed("SPH", "CYL", "AX");
    const double addition = number("ADD", 0.0, 10.0).value_or(0.0);
    const double prism = number("PRVM", 0.0, 50.0).value_or(0.0);
    const double base = number("PRVA", 0.0, 360.0).value_or(0.0);
    if (!result) return std::nullopt;
    result->addition = addition;
    if (prism != 0.0) result->prism.push_back({prism, from_degrees(base)});
    return result;
  }

  // A power counts as given when its sphere is.
  [[nodiscard]] std::optional<Prescription> designed(const char* sphere, const char* cylinder, const char* axis) const {
    const auto s = number(sphere, -50.0, 50.0);
    const double c = number(cylinder, -25.0, 25.0).value_or(0.0);
    const auto a = number(axis, 0.0, 180.0);
    if (!s) return std::nullopt;
    if (c != 0.0 && !a) {
      const auto line = job_.find(axis) ? job_.find(axis) : job_.find(cylinder);
      job_.fail(*line, std::string("leaves the cylinder without an axis; ") + axis + " must be a number from 0 to 180");
    }
    return Prescription{*s, c, from_degrees(a.value_or(0.0)), 0.0, {}};
  }

  [[nodiscard]] std::optional<glm::dvec2> point(const char* in, const char* up) const {
    const auto x = mm(in, -50.0, 50.0), y = mm(up, -50.0, 50.0);
    if (!x && !y) return std::nullopt;
    const double nose = side_ == Side::right ? -1.0 : 1.0;
    return glm::dvec2(nose * x.value_or(0.0), y.value_or(0.0));
  }

  // power_sign: of a surface whose centre lies on the eye side.
  [[nodiscard]] std::optional<double> curvature(const char* label, double power_sign) const {
    const auto value = number(label, -1e6, 1e6);
    if (!value) return std::nullopt;
    if (std::abs(*value) > kLongestPowerField) return io::curvature_from_radius_mm(*value);
    const double index = number("TIND", 1.2, 3.0).value_or(kToolingIndex);
    return power_sign * *value / (index - 1.0);
  }

  const OmaJob& job_;
  Side side_;
};

void take_traces(const OmaJob& job, OmaOrder& order) {
  for (io::OmaTrace& trace : io::read_traces(job)) {
    OmaEye& eye = order.eye[static_cast<std::size_t>(trace.side)];
    if (!eye.outline.empty()) job.fail(trace.first_line, "traces this eye a second time; once is allowed");
    eye.outline = std::move(trace.outline);
  }
  for (const std::size_t other : {0U, 1U}) {
    if (order.eye[other].outline.empty()) order.eye[other].outline = io::mirrored(order.eye[1 - other].outline);
  }
}

void take_surfaces(const OmaJob& job, RowOrder rows, OmaOrder& order) {
  for (io::SdfSurface& surface : io::sdf_surfaces(job, rows)) {
    for (const Side side : {Side::right, Side::left}) {
      if (surface.side && *surface.side != side) continue;
      OmaEye& eye = order.eye[static_cast<std::size_t>(side)];
      std::optional<SagSamples>& target = surface.face == Face::front ? eye.front_surface : eye.back_surface;
      if (target) job.fail(surface.line, "gives this surface a second time; once is allowed");
      target = surface.samples;
    }
  }
}

}  // namespace

OmaOrder read_order(const OmaJob& job, RowOrder rows) {
  OmaOrder order;
  if (const auto line = job.find("DO")) {
    const std::string_view eyes = job.lines[*line].value();
    if (eyes != "B" && eyes != "R" && eyes != "L") {
      job.fail(*line, "is " + io::in_quotes(eyes) + "; must be B, R or L");
    }
    order.wanted = {eyes != "L", eyes != "R"};
  }
  for (const Side side : {Side::right, Side::left}) {
    const EyeReader reader(job, side);
    order.eye[static_cast<std::size_t>(side)] = reader.read();
    order.type[static_cast<std::size_t>(side)] = reader.type();
  }
  const EyeReader either(job, Side::right);
  if (const auto bridge = either.number("DBL", 0.0, 60.0)) order.bridge = from_mm(*bridge);
  if (const auto near = either.number("NWD", 5.0, 2000.0))
    order.near_distance = from_mm(*near > 150.0 ? *near : 10.0 * *near);
  take_traces(job, order);
  take_surfaces(job, rows, order);
  return order;
}

glm::dvec2 pupil_in_box(const OmaOrder& order, Side side, bool fitting_height) {
  const OmaEye& eye = order.eye[static_cast<std::size_t>(side)];
  glm::dvec2 pupil(0.0);
  if (eye.box_width && order.bridge && eye.far_pd) {
    const double in = 0.5 * (*eye.box_width + *order.bridge) - *eye.far_pd;
    pupil.x = side == Side::right ? -in : in;
  }
  const auto& height = fitting_height ? eye.fitting_height : eye.optical_centre_height;
  if (height && eye.box_height) pupil.y = *height - 0.5 * *eye.box_height;
  return pupil;
}

}  // namespace lenses
