// At which rung of accuracy the pictures are drawn: one for all of them, or as a governor says that holds the display's
// rate.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "render/governor.hpp"

namespace app {

inline constexpr const char* kAutoAccuracy = "auto";

// From the finest to the coarsest, those that a governor has. Foveation only where an eye tracker says where it may be
// coarse: a gaze that is taken from the head would blur what somebody looks at from the corner of the eye.
[[nodiscard]] std::vector<render::GovernorRung> governed_rungs(bool tracks_gaze);

// By the name that a recording has: of the ladder, or one of the governor's. Nothing: there is none.
[[nodiscard]] std::optional<render::GovernorRung> find_live_rung(const std::string& name);

class RungChoice {
 public:
  // All pictures at the first of the rungs, or at those that use_named() says.
  explicit RungChoice(std::vector<render::GovernorRung> rungs);
  // At those that a governor chooses from them.
  RungChoice(std::vector<render::GovernorRung> rungs, const render::GovernorConfig& config);

  [[nodiscard]] const std::vector<render::GovernorRung>& rungs() const { return rungs_; }
  // Of the next picture.
  [[nodiscard]] std::size_t rung() const { return governor_ ? governor_->rung() : rung_; }
  void use_named(const std::string& name);  // one of them; another changes nothing

  [[nodiscard]] bool is_governed() const { return governor_.has_value(); }
  // A period of the display's (s). The shortest seen is its own: a runtime that waits for late pictures says longer
  // ones, and a governor that believed them would never come back to the display's rate.
  void see_period(double seconds);
  // See render::Governor::see.
  void see(double time, std::size_t rung, double seconds);
  [[nodiscard]] int switches() const { return governor_ ? governor_->switches() : 0; }
  [[nodiscard]] std::string reason() const { return governor_ ? governor_->reason() : "as asked for"; }

 private:
  std::vector<render::GovernorRung> rungs_;
  std::size_t rung_ = 0;
  std::optional<double> period_;
  std::optional<render::Governor> governor_;
};

}  // namespace app
