#include "lenses/design/lens_shape.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "lenses/lens_model.hpp"

namespace lenses::design {
namespace {

// A surface that is not segmented, as the engine's functions evaluate it about its own vertex.
class Figure {
 public:
  explicit Figure(const BasicSurface& surface) {
    Lens carrier;
    carrier.front = std::visit([](const auto& s) { return Surface(s); }, surface);
    append_lens(model_, &carrier, Side::right, 0.0);
  }

  [[nodiscard]] f64::SurfacePoint at(const glm::dvec2& xy, const Placement& placement) const {
    f64::SurfacePoint point =
        f64::surface_point(f64::Table{model_.table}, model_.lens.front().front, xy - placement.decentration);
    point.z += dot(placement.slope, xy) + placement.height;
    point.gradient += placement.slope;
    return point;
  }

 private:
  LensModel model_;
};

BasicSurface basic(const Surface& surface) {
  return std::visit(
      [](const auto& s) -> BasicSurface {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, SegmentedSurface>) {
          return s.base;
        } else {
          return s;
        }
      },
      surface);
}

bool inside_polygon(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const glm::dvec2 &a = polygon[i], &b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
      inside = !inside;
    }
  }
  return inside;
}

Placement sum(const Placement& a, const Placement& b) {
  return {a.decentration + b.decentration, a.slope + b.slope, a.height + b.height};
}

}  // namespace

struct PlacedSurface::Prepared {
  Figure base;
  std::optional<Figure> segment;
  Placement segment_placement;
  std::vector<glm::dvec2> boundary;

  explicit Prepared(const Surface& surface) : base(basic(surface)) {
    if (const auto* segmented = std::get_if<SegmentedSurface>(&surface)) {
      segment.emplace(segmented->segment);
      segment_placement = segmented->segment_placement;
      boundary = segmented->boundary;
    }
  }
};

PlacedSurface::PlacedSurface(const Surface& surface, const Placement& placement)
    : prepared_(std::make_shared<Prepared>(surface)), placement_(placement) {}

f64::SurfacePoint PlacedSurface::at(const glm::dvec2& xy) const {
  if (prepared_->segment && inside_polygon(prepared_->boundary, xy)) {
    return prepared_->segment->at(xy, sum(placement_, prepared_->segment_placement));
  }
  return prepared_->base.at(xy, placement_);
}

LensShape::LensShape(Lens lens)
    : lens_(std::move(lens)), front_(lens_.front, lens_.front_placement), back_(lens_.back, lens_.back_placement) {}

f64::SurfacePoint LensShape::front(const glm::dvec2& xy) const {
  f64::SurfacePoint point = front_.at(xy);
  point.z -= lens_.centre_thickness;
  return point;
}

std::optional<double> LensShape::thickness(const glm::dvec2& xy) const {
  const f64::SurfacePoint f = front(xy);
  const f64::SurfacePoint b = back(xy);
  return f.inside && b.inside ? std::optional(b.z - f.z) : std::nullopt;
}

void LensShape::set_front(Surface surface) {
  lens_.front = std::move(surface);
  front_ = PlacedSurface(lens_.front, lens_.front_placement);
}

void LensShape::set_back(Surface surface) {
  lens_.back = std::move(surface);
  back_ = PlacedSurface(lens_.back, lens_.back_placement);
}

void LensShape::place_front(const Placement& placement) {
  lens_.front_placement = placement;
  front_.place(placement);
}

void LensShape::place_back(const Placement& placement) {
  lens_.back_placement = placement;
  back_.place(placement);
}

}  // namespace lenses::design
