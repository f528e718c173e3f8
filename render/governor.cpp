#include "render/governor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace render {
namespace {

constexpr std::size_t kRecent = 60;        // frames judged for going finer
constexpr std::size_t kFewestRecent = 20;  // of them, to judge at all
constexpr std::size_t kSettling = 4;       // frames after a change that may still pay for it
constexpr double kHighQuantile = 0.9;      // of the recent frames: going finer must suit the worse ones
constexpr double kFixedCost = 0.1;         // of a frame that does not depend on its pixels

double quantile(const std::deque<double>& values, double q) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(sorted.size() - 1) + 0.5);
  std::nth_element(sorted.begin(), sorted.begin() + at, sorted.end());
  return sorted[static_cast<std::size_t>(at)];
}

std::string percent_name(const std::string& name, double resolution) {
  char text[32];
  static_cast<void>(std::snprintf(text, sizeof text, " at %.0f %%", 100.0 * resolution));
  return name + text;
}

}  // namespace

std::vector<GovernorRung> governor_rungs(std::span<const std::string_view> names, std::span<const double> costs,
                                         std::span<const double> resolutions) {
  if (names.empty() || names.size() != costs.size()) {
    throw std::invalid_argument("a governor needs as many costs as rungs, and at least one");
  }
  std::vector<GovernorRung> rungs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Rung* rung = find_rung(names[i]);
    if (rung == nullptr) {
      throw std::invalid_argument("the ladder has no rung " + std::string(names[i]));
    }
    rungs.push_back({std::string(names[i]), rung->accuracy, costs[i]});
  }
  const GovernorRung last = rungs.back();
  for (const double resolution : resolutions) {
    GovernorRung rung = last;
    rung.name = percent_name(last.name, resolution);
    rung.accuracy.resolution = resolution;
    rung.cost = last.cost * (kFixedCost + (1.0 - kFixedCost) * resolution * resolution);
    rungs.push_back(rung);
  }
  return rungs;
}

Governor::Governor(const GovernorConfig& config, std::vector<GovernorRung> rungs)
    : config_(config), rungs_(std::move(rungs)), wait_(rungs_.size(), config.dwell) {
  if (rungs_.empty() || std::ranges::any_of(rungs_, [](const GovernorRung& r) { return !(r.cost > 0.0); })) {
    throw std::invalid_argument("a governor needs at least one rung, each with a positive cost");
  }
}

std::string Governor::milliseconds(double seconds) const {
  char text[64];
  static_cast<void>(std::snprintf(text, sizeof text, "%.1f of %.1f ms", 1e3 * seconds, 1e3 * config_.period));
  return text;
}

double Governor::predicted(std::size_t rung, double seconds) const {
  return seconds * rungs_[rung].cost / rungs_[rung_].cost;
}

void Governor::move(double time, std::size_t rung, const std::string& reason) {
  // Leaving a finer rung soon after it was taken was a mistake.
  if (rung > rung_ && went_finer_) {
    const bool mistaken = time - changed_ < config_.regret;
    wait_[rung_] = mistaken ? std::min(2.0 * wait_[rung_], config_.longest_wait) : config_.dwell;
  }
  went_finer_ = rung < rung_;
  from_ = rung_;
  before_ = recent_.empty() ? 0.0 : quantile(recent_, 0.5);
  rung_ = rung;
  changed_ = time;
  recent_.clear();
  seen_here_ = 0;
  late_ = 0;
  ++switches_;
  reason_ = reason;
}

// The first frames behind a change, against those before it, say what the two rungs cost in proportion.
void Governor::learn_cost(double seconds) {
  if (!(before_ > 0.0) || recent_.size() != kFewestRecent) {
    return;
  }
  double ratio = seconds / before_;
  // A scene that changed meanwhile may say that coarser is dearer; it is not.
  ratio = rung_ > from_ ? std::min(ratio, 1.0) : std::max(ratio, 1.0);
  rungs_[from_].cost = rungs_[rung_].cost / ratio;
  before_ = 0.0;
}

void Governor::consider_coarser(double time) {
  if (late_ < config_.late_frames || rung_ + 1 == rungs_.size()) {
    return;
  }
  // The last frames only: what was before them is not what has to be met.
  std::deque<double> last(recent_.end() - std::min<std::ptrdiff_t>(config_.late_frames, std::ssize(recent_)),
                          recent_.end());
  const double seconds = quantile(last, 0.5);
  std::size_t rung = rung_ + 1;
  while (rung + 1 < rungs_.size() && predicted(rung, seconds) > config_.aim * config_.period) {
    ++rung;
  }
  move(time, rung, std::to_string(config_.late_frames) + " frames took " + milliseconds(seconds));
}

void Governor::consider_finer(double time) {
  if (rung_ == 0 || recent_.size() < kFewestRecent || time - changed_ < wait_[rung_ - 1]) {
    return;
  }
  const double seconds = quantile(recent_, kHighQuantile);
  const double finer = predicted(rung_ - 1, seconds);
  if (finer < config_.finer_below * config_.period) {
    move(time, rung_ - 1, "frames took " + milliseconds(seconds) + " at the coarser one");
  }
}

void Governor::see(double time, std::size_t rung, double seconds) {
  if (!std::isfinite(time) || !std::isfinite(seconds) || !(seconds > 0.0) || rung != rung_) {
    return;
  }
  if (!started_) {
    started_ = true;
    changed_ = time;
  }
  if (++seen_here_ <= kSettling && switches_ > 0) {
    return;
  }
  recent_.push_back(seconds);
  if (recent_.size() > kRecent) {
    recent_.pop_front();
  }
  late_ = seconds > config_.budget * config_.period ? late_ + 1 : 0;
  learn_cost(quantile(recent_, 0.5));
  consider_coarser(time);
  consider_finer(time);
}

}  // namespace render
