// Holds the display's rate: which rung of accuracy the next frame is drawn at, from what frames have taken. Pure: it
// neither draws nor measures.
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "render/accuracy.hpp"
#include "render/ladder.hpp"

namespace render {

struct GovernorRung {
  std::string name;  // of the ladder, or a variation of one
  Accuracy accuracy;
  double cost = 1.0;  // predicted, in proportion to the other rungs; what is measured replaces it
};

// The named rungs and, below the last of them, that one at each of these resolutions (0 to 1, falling). A frame's cost
// is predicted by its pixels, a tenth of it by nothing. Throws std::invalid_argument for a name that the ladder has
// not.
[[nodiscard]] std::vector<GovernorRung> governor_rungs(std::span<const std::string_view> names,
                                                       std::span<const double> costs,
                                                       std::span<const double> resolutions);

struct GovernorConfig {
  double period = 1.0 / 90.0;  // s, of the display
  double budget = 0.9;         // of the period: a frame that takes longer is late
  double aim = 0.8;            // of the period: what a coarser rung is chosen for
  double finer_below = 0.7;    // of the period: what the finer rung must be predicted to stay below
  int late_frames = 3;         // in a row, before it goes coarser
  double dwell = 1.0;          // s on a rung before it goes finer
  double regret = 10.0;        // s: a finer rung left sooner was a mistake, and is waited for twice as long
  double longest_wait = 60.0;  // s
};

class Governor {
 public:
  // rungs: from the finest to the coarsest, at least one. Throws std::invalid_argument otherwise. Starts with the
  // finest.
  Governor(const GovernorConfig& config, std::vector<GovernorRung> rungs);

  // A frame drawn at `rung` took so many seconds (s, of the stages that must end before the display's time); `time`
  // only grows. Frames still under way when the rung changed come with the rung they were drawn at. What is not finite
  // or not positive is passed over.
  void see(double time, std::size_t rung, double seconds);

  [[nodiscard]] std::size_t rung() const { return rung_; }
  [[nodiscard]] const GovernorRung& current() const { return rungs_[rung_]; }
  // Why this rung is in use, in words for people: "3 frames took more than 10.0 of 11.1 ms".
  [[nodiscard]] const std::string& reason() const { return reason_; }
  [[nodiscard]] int switches() const { return switches_; }

  void set_period(double seconds) { config_.period = seconds; }

 private:
  [[nodiscard]] double predicted(std::size_t rung, double seconds) const;
  void learn_cost(double seconds);
  void consider_coarser(double time);
  void consider_finer(double time);
  void move(double time, std::size_t rung, const std::string& reason);
  [[nodiscard]] std::string milliseconds(double seconds) const;

  GovernorConfig config_;
  std::vector<GovernorRung> rungs_;
  std::vector<double> wait_;  // s, for each rung, before it is tried from the coarser one
  std::size_t rung_ = 0;
  std::deque<double> recent_;  // s, frames of this rung
  std::size_t seen_here_ = 0;  // frames of this rung since the change
  int late_ = 0;               // in a row
  double changed_ = 0.0;       // time of the last change
  bool started_ = false;
  bool went_finer_ = false;  // the last change
  std::size_t from_ = 0;     // the rung before it
  double before_ = 0.0;      // s, what a frame took there
  int switches_ = 0;
  std::string reason_ = "the start";
};

}  // namespace render
