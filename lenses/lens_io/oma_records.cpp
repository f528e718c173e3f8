#include "lenses/lens_io/oma_records.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "lenses/design/ordered_power.hpp"

namespace lenses::io {
namespace {

constexpr double kLeastRadius = 0.020;  // m; a lesser number would read as dioptres
constexpr std::array<Side, 2> kSides{Side::right, Side::left};

class Records {
 public:
  Records(const Spectacles& spectacles, const std::array<double, 2>& pd, const std::optional<double>& bridge)
      : spectacles_(spectacles) {
    orders();
    making();
    frame(pd, bridge);
  }

  [[nodiscard]] std::vector<OmaNumber> take() { return std::move(records_); }

 private:
  template <class Value>
  void add(const std::string& label, Value value) {
    OmaNumber record{label, {}};
    for (const Side side : kSides) record.value[static_cast<std::size_t>(side)] = value(lens(side), side);
    if (record.value[0] || record.value[1]) records_.push_back(std::move(record));
  }
  [[nodiscard]] const Lens& lens(Side side) const { return spectacles_.lens[static_cast<std::size_t>(side)]; }

  void orders() {
    const auto ordered = [](const Lens& lens) { return lens.order ? &lens.order->ordered : nullptr; };
    const auto designed = [](const Lens& lens) {
      return lens.order && lens.order->compensated ? &*lens.order->compensated : nullptr;
    };
    power(ordered, "SPH", "CYL", "AX", "ADD");
    const auto prism = [&](const Lens& lens) -> std::optional<glm::dvec2> {
      if (!lens.order) return std::nullopt;
      return design::prism_vector(lens.order->ordered.prism);
    };
    const auto has_prism = [&](const Lens& lens) { return prism(lens).value_or(glm::dvec2(0.0)) != glm::dvec2(0.0); };
    if (has_prism(lens(Side::right)) || has_prism(lens(Side::left))) {
      add("PRVM",
          [&](const Lens& lens, Side) { return prism(lens) ? std::optional(length(*prism(lens))) : std::nullopt; });
      add("PRVA", [&](const Lens& lens, Side) -> std::optional<double> {
        if (!prism(lens)) return std::nullopt;
        if (!has_prism(lens)) return 0.0;
        const glm::dvec2 base = *prism(lens);  // the wearer's axes; the record is the viewer's
        const double angle = std::atan2(base.y, -base.x) * 180.0 / std::numbers::pi;
        return angle < 0.0 ? angle + 360.0 : angle;
      });
    }
    power(designed, "LDDRSPH", "LDDRCYL", "LDDRAX", "LDADD");
  }

  template <class Get>
  void power(Get get, const char* sphere, const char* cylinder, const char* axis, const char* addition) {
    const auto part = [&](const char* label, auto value) {
      add(label, [&](const Lens& lens, Side) -> std::optional<double> {
        const Prescription* p = get(lens);
        return p != nullptr ? std::optional<double>(value(*p)) : std::nullopt;
      });
    };
    part(sphere, [](const Prescription& p) { return p.sphere; });
    part(cylinder, [](const Prescription& p) { return p.cylinder; });
    part(axis, [](const Prescription& p) { return p.axis * 180.0 / std::numbers::pi; });
    const auto adds = [&](Side side) { return get(lens(side)) != nullptr && get(lens(side))->addition != 0.0; };
    if (adds(Side::right) || adds(Side::left)) part(addition, [](const Prescription& p) { return p.addition; });
  }

  void making() {
    constexpr double kDegree = std::numbers::pi / 180.0;
    add("BVD", [](const Lens& lens, Side) { return std::optional(1e3 * lens.fit.vertex_distance); });
    add("PANTO", [](const Lens& lens, Side) { return std::optional(lens.fit.pantoscopic_tilt / kDegree); });
    add("ZTILT", [](const Lens& lens, Side) { return std::optional(lens.fit.wrap / kDegree); });
    add("LIND", [](const Lens& lens, Side) { return std::optional(lens.index); });
    add("CTHICK", [](const Lens& lens, Side) { return std::optional(1e3 * lens.centre_thickness); });
    add("FRNT", [](const Lens& lens, Side) { return radius_record(lens.front, lens.front_placement); });
    add("BACK", [](const Lens& lens, Side) { return radius_record(lens.back, lens.back_placement); });
    point("BCSG", "IN", "UP", &ReferencePoints::fitting_cross);
    point("BCDRP", "IN", "UP", &ReferencePoints::distance);
    point("BCNRP", "IN", "UP", &ReferencePoints::near);
  }

  void point(const std::string& label, const char* in, const char* up,
             std::optional<glm::dvec2> ReferencePoints::*which) {
    add(label + in, [&](const Lens& lens, Side side) -> std::optional<double> {
      const auto& point = lens.reference_points.*which;
      return point ? std::optional((side == Side::right ? -1e3 : 1e3) * point->x) : std::nullopt;
    });
    add(label + up, [&](const Lens& lens, Side) -> std::optional<double> {
      const auto& point = lens.reference_points.*which;
      return point ? std::optional(1e3 * point->y) : std::nullopt;
    });
  }

  void frame(const std::array<double, 2>& pd, const std::optional<double>& bridge) {
    const auto traced = [&](Side side) { return !lens(side).outline.empty(); };
    if (!traced(Side::right) && !traced(Side::left)) return;
    const auto box = [](const Lens& lens) { return box_of(lens.outline); };
    // The pupil from the box's centre: in is towards the nose.
    const auto pupil = [&](const Lens& lens, Side side) {
      const glm::dvec2 p = -lens.fit.decentration - box(lens).centre();
      return glm::dvec2(side == Side::right ? -p.x : p.x, p.y);
    };
    const auto given = [&](const Lens& lens, double value) {
      return lens.outline.empty() ? std::nullopt : std::optional(1e3 * value);
    };
    const Side known = traced(Side::right) ? Side::right : Side::left;
    const double width = bridge.value_or(2.0 * (pd[static_cast<std::size_t>(known)] + pupil(lens(known), known).x) -
                                         box(lens(known)).size().x);
    add("HBOX", [&](const Lens& lens, Side) { return given(lens, box(lens).size().x); });
    add("VBOX", [&](const Lens& lens, Side) { return given(lens, box(lens).size().y); });
    records_.push_back({"DBL", {1e3 * width, 1e3 * width}, true});
    add("IPD", [&](const Lens& lens, Side side) {
      return given(lens, 0.5 * (box(lens).size().x + width) - pupil(lens, side).x);
    });
    const auto progressive = [](const Lens& lens) { return lens.reference_points.fitting_cross.has_value(); };
    const auto height = [&](const Lens& lens, Side side) { return pupil(lens, side).y + 0.5 * box(lens).size().y; };
    add("SEGHT", [&](const Lens& lens, Side side) {
      return progressive(lens) ? given(lens, height(lens, side)) : std::nullopt;
    });
    add("OCHT", [&](const Lens& lens, Side side) {
      return progressive(lens) ? std::nullopt : given(lens, height(lens, side));
    });
  }

  const Spectacles& spectacles_;
  std::vector<OmaNumber> records_;
};

}  // namespace

std::vector<OmaNumber> numbers_of(const Spectacles& spectacles, const std::array<double, 2>& pd,
                                  const std::optional<double>& bridge) {
  return Records(spectacles, pd, bridge).take();
}

std::optional<double> radius_record(const Surface& surface, const Placement& placement) {
  if (placement != Placement{}) return std::nullopt;
  if (std::holds_alternative<Plane>(surface)) return 0.0;
  const auto* sphere = std::get_if<Sphere>(&surface);
  if (sphere == nullptr) return std::nullopt;
  if (sphere->curvature == 0.0) return 0.0;
  if (std::abs(1.0 / sphere->curvature) <= kLeastRadius) return std::nullopt;
  return 1e3 / sphere->curvature;
}

Box box_of(const std::vector<glm::dvec2>& outline) {
  Box box;
  for (const glm::dvec2& point : outline) {
    box.low = glm::min(box.low, point);
    box.high = glm::max(box.high, point);
  }
  return box;
}

}  // namespace lenses::io
