#include "app/vr/rungs.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace app {
namespace {

// Of the whole frame, in proportion to the first; measured on a CPU's driver at 384 x 384 pixels an eye. The governor
// replaces them by what it measures.
constexpr double kFoveated10 = 0.7, kFoveated5 = 0.3;

}  // namespace

std::vector<render::GovernorRung> governed_rungs(bool tracks_gaze) {
  if (tracks_gaze) {
    constexpr std::array<std::string_view, 3> kNames{"standard", "foveated-10-2", "foveated-5-4"};
    constexpr std::array kCosts{1.0, kFoveated10, kFoveated5};
    constexpr std::array kResolutions{0.75, 0.5};
    return render::governor_rungs(kNames, kCosts, kResolutions);
  }
  constexpr std::array<std::string_view, 1> kNames{"standard"};
  constexpr std::array kCosts{1.0};
  constexpr std::array kResolutions{0.75, 0.5, 0.35};
  return render::governor_rungs(kNames, kCosts, kResolutions);
}

std::optional<render::GovernorRung> find_live_rung(const std::string& name) {
  if (const render::Rung* rung = render::find_rung(name)) {
    return render::GovernorRung{name, rung->accuracy, 1.0};
  }
  for (const bool tracks_gaze : {false, true}) {
    const std::vector<render::GovernorRung> rungs = governed_rungs(tracks_gaze);
    if (const auto found = std::ranges::find(rungs, name, &render::GovernorRung::name); found != rungs.end()) {
      return *found;
    }
  }
  return std::nullopt;
}

RungChoice::RungChoice(std::vector<render::GovernorRung> rungs) : rungs_(std::move(rungs)) {}

RungChoice::RungChoice(std::vector<render::GovernorRung> rungs, const render::GovernorConfig& config)
    : rungs_(std::move(rungs)), governor_(std::in_place, config, rungs_) {}

void RungChoice::use_named(const std::string& name) {
  if (const auto found = std::ranges::find(rungs_, name, &render::GovernorRung::name); found != rungs_.end()) {
    rung_ = static_cast<std::size_t>(found - rungs_.begin());
  }
}

void RungChoice::see_period(double seconds) {
  if (governor_ && seconds > 0.0 && (!period_ || seconds < *period_)) {
    period_ = seconds;
    governor_->set_period(seconds);
  }
}

void RungChoice::see(double time, std::size_t rung, double seconds) {
  if (governor_) {
    governor_->see(time, rung, seconds);
  }
}

}  // namespace app
