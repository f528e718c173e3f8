#include "app/vr/hidden_views.hpp"

namespace app {
namespace {

constexpr double kMostHidden = 0.75;  // of a view: lenses hide a fifth
constexpr int kSide = 64;             // px, to tell that

}  // namespace

std::optional<std::vector<tracking::HiddenArea>> HiddenViews::areas(const RenderSetup& setup) {
  if (!masks_.is_offered()) {
    return std::nullopt;
  }
  problem_.clear();
  std::vector<tracking::HiddenArea> areas;
  for (std::size_t at = 0; at < setup.sides.size(); ++at) {
    const xr::HiddenView& view = masks_.view(setup.sides[at]);
    const tracking::FieldOfView& fov = setup.views[at].view.fov;
    const bool is_sound = tracking::hidden_pixels(view.area, fov, kSide, kSide).hidden_fraction() <= kMostHidden;
    areas.push_back(is_sound ? view.area : tracking::HiddenArea{});
    if (!is_sound) {
      problem_ = "the runtime's mask hides nearly all of a view";
    } else if (!view.problem.empty()) {
      problem_ = view.problem;
    }
  }
  return areas;
}

}  // namespace app
