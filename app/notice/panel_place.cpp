#include "app/notice/panel_place.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

namespace app {
namespace {

using tracking::EyeView;
using tracking::Pose;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kCentre = -17.5 * kDegree, kTop = -8.0 * kDegree, kStep = 1.0 * kDegree;
constexpr double kMiddle = 0.85;    // of a field of view, where headset lenses are sharp enough for letters
constexpr double kShrink = 0.95;    // from one try to the next
constexpr double kSmallest = 0.05;  // of the size wished for

bool sees(const EyeView& view, const glm::dvec3& head_point) {
  const glm::dvec3 p = view.head_from_view.inverse().point(head_point);
  const glm::dvec2 t(p.x / -p.z, p.y / -p.z);
  // About the field's own middle, which an asymmetric one has off its axis.
  const glm::dvec2 middle(0.5 * (view.fov.tan_right - view.fov.tan_left), 0.5 * (view.fov.tan_up - view.fov.tan_down));
  const glm::dvec2 half(0.5 * (view.fov.tan_right + view.fov.tan_left), 0.5 * (view.fov.tan_up + view.fov.tan_down));
  return p.z < 0.0 && std::abs(t.x - middle.x) <= kMiddle * half.x && std::abs(t.y - middle.y) <= kMiddle * half.y;
}

bool both_see(const std::array<EyeView, 2>& views, const PanelPlace& place) {
  for (const EyeView& view : views) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        if (!sees(view, place.head_from_panel.point({x * place.width, y * place.height, 0.0}))) {
          return false;
        }
      }
    }
  }
  return true;
}

PanelPlace placed(const glm::dvec3& eyes, const PanelPlaceConfig& config, double scale, double elevation) {
  const glm::dvec3 ahead = tracking::direction_from_yaw_pitch(0.0, elevation);
  return {Pose{tracking::orientation_from_yaw_pitch(0.0, elevation), eyes + config.distance * ahead},
          2.0 * config.distance * std::tan(0.5 * scale * config.width),
          2.0 * config.distance * std::tan(0.5 * scale * config.height)};
}

}  // namespace

PanelPlace place_panel(const std::array<EyeView, 2>& views, const PanelPlaceConfig& config) {
  const glm::dvec3 eyes = 0.5 * (views[0].head_from_view.position + views[1].head_from_view.position);
  double scale = 1.0;
  for (; scale > kSmallest; scale *= kShrink) {
    const double wished = std::min(kCentre, kTop - 0.5 * scale * config.height);
    for (double elevation = wished; elevation <= 0.0; elevation += kStep) {
      const PanelPlace place = placed(eyes, config, scale, elevation);
      if (both_see(views, place)) {
        return place;
      }
    }
  }
  return placed(eyes, config, scale, 0.0);
}

double letter_angle(double pixels_per_degree) {
  return std::max(12.0 / pixels_per_degree, 0.4) * kDegree;
}

}  // namespace app
