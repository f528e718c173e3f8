// What the person in the headset reads: everything at the start and, for some seconds, after each change; then in
// brief the pair and where the gaze comes from, which always stays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/notice/plate.hpp"

namespace app {

struct NoticeContent {
  std::vector<std::string> pairs = {};     // one, or A and B to either side of a divider
  std::string gaze_source = {};            // as tracking::name has it, or "replay"
  std::string rung = {};                   // of accuracy; empty: none is in use
  std::string map = {};                    // laid over the scene; empty: none
  std::string target = {};                 // empty: none was chosen
  std::vector<std::string> warnings = {};  // sentences
  std::vector<PlateLine> limits = {};      // of the display
  bool operator==(const NoticeContent&) const = default;
};

struct NoticeConfig {
  double shortest = 3.0, longest = 20.0;  // s, that the whole is shown
  double reading_rate = 20.0;             // characters/s beyond the shortest; people read 15 to 25
  // s that another source of gaze lasts before it is named: a blink is no news, and nobody reads during one.
  double source_delay = 0.4;
};

class Notice {
 public:
  explicit Notice(const NoticeConfig& config = {}) : config_(config) {}

  // What is to be read from now on; nothing: what was. Times (s) do not fall.
  [[nodiscard]] std::optional<std::vector<PlateLine>> step(double time, const NoticeContent& content);

 private:
  void see_source(double time, const std::string& source);
  [[nodiscard]] std::vector<PlateLine> whole(const NoticeContent& content) const;
  [[nodiscard]] std::vector<PlateLine> brief(const NoticeContent& content) const;

  NoticeConfig config_;
  std::optional<NoticeContent> told_;  // without source and rung, which show in what always stays
  bool with_limits_ = true;
  double whole_until_ = 0.0;  // s
  std::string source_;        // named
  std::string other_source_;  // not yet
  double other_since_ = 0.0;  // s
  std::vector<PlateLine> shown_;
};

// In words: "eye tracker", "held: the eye tracker has lost the eyes", ...
[[nodiscard]] std::string gaze_source_text(const std::string& source);

}  // namespace app
