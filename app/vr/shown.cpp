#include "app/vr/shown.hpp"

#include <algorithm>
#include <array>

namespace app {
namespace {

using render::Mode;
using xr::Control;

constexpr std::array kMaps{Mode::power, Mode::astigmatism, Mode::accommodation, Mode::blur};

// The next map after this one, then the picture again.
Mode next_map(Mode now, Mode picture) {
  const auto at = std::ranges::find(kMaps, now);
  if (at == kMaps.end()) {
    return kMaps.front();
  }
  return std::next(at) == kMaps.end() ? picture : *std::next(at);
}

}  // namespace

Shown::Shown(const ShownChoices& choices)
    : choices_(choices), comparing_(choices.has_compared), mode_(choices.first_map) {}

bool Shown::apply(Control control) {
  if (clear_ && control != Control::clear_view && control != Control::next_target) {
    return false;
  }
  switch (control) {
    case Control::spectacles:
      spectacles_ = !spectacles_;
      return true;
    case Control::next_pair:
      pair_ = (pair_ + 1) % choices_.in_turn;
      spectacles_ = true;
      return true;
    case Control::compare:
      comparing_ = !comparing_ || !spectacles_;
      spectacles_ = true;
      return true;
    case Control::map:
      mode_ = next_map(mode_, choices_.picture);
      return true;
    case Control::next_target:
      if (choices_.targets == 0) {
        return false;
      }
      target_ = !target_ ? 0 : *target_ + 1 < choices_.targets ? std::optional(*target_ + 1) : std::nullopt;
      return true;
    case Control::clear_view:
      clear_ = !clear_;
      return true;
    case Control::recentre:
      return false;
  }
  return false;
}

// The compared pair, else the next in turn, else the eyes without spectacles.
std::vector<std::size_t> Shown::against(std::size_t pair) const {
  if (choices_.has_compared) {
    return {pair, choices_.compared()};
  }
  return {pair, choices_.in_turn > 1 ? (pair + 1) % choices_.in_turn : choices_.bare()};
}

ShownPicture Shown::picture() const {
  if (clear_) {
    return {{choices_.bare()}, Mode::pinhole};
  }
  if (!spectacles_) {
    return {{choices_.bare()}, mode_};
  }
  return {comparing_ ? against(pair_) : std::vector{pair_}, mode_};
}

std::vector<ShownPicture> Shown::reachable() const {
  std::vector<std::vector<std::size_t>> views{{choices_.bare()}};
  for (std::size_t pair = 0; pair < choices_.in_turn; ++pair) {
    views.push_back({pair});
    views.push_back(against(pair));
  }
  std::vector<ShownPicture> all{{{choices_.bare()}, Mode::pinhole}};
  for (const std::vector<std::size_t>& pairs : views) {
    all.push_back({pairs, choices_.picture});
    for (const Mode map : kMaps) {
      all.push_back({pairs, map});
    }
  }
  return all;
}

}  // namespace app
