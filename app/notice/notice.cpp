#include "app/notice/notice.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace app {
namespace {

using Kind = PlateLine::Kind;

constexpr const char* kDot = " \u00b7 ";

struct Source {
  const char* name;
  const char* brief;
  const char* whole;
};

// tracking::name of a source, and what a replay is.
constexpr std::array kSources{Source{"tracker", "eye tracker", "from the eye tracker"},
                              Source{"held", "held", "held: the eye tracker has lost the eyes"},
                              Source{"head", "head only", "no eye tracker: straight ahead of the head"},
                              Source{"target", "at the target", "no eye tracker: at the target"},
                              Source{"replay", "recording", "from the recording"}};

Source source_of(const std::string& name) {
  const auto found = std::ranges::find(kSources, std::string_view(name), &Source::name);
  return found != kSources.end() ? *found : Source{name.c_str(), name.c_str(), name.c_str()};
}

// The label of one pair alone, and of A and B.
using PairLabels = std::array<const char*, 3>;

std::vector<PlateLine> pair_lines(const NoticeContent& content, const PairLabels& labels) {
  if (content.pairs.empty()) {
    return {{labels[0], "no spectacles"}};
  }
  if (content.pairs.size() == 1) {
    return {{labels[0], content.pairs[0]}};
  }
  return {{labels[1], content.pairs[0]}, {labels[2], content.pairs[1]}};
}

std::size_t letters(const std::vector<PlateLine>& lines) {
  std::size_t count = 0;
  for (const PlateLine& line : lines) {
    count += line.label.size() + line.text.size();
  }
  return count;
}

}  // namespace

std::string gaze_source_text(const std::string& source) {
  return source_of(source).whole;
}

std::vector<PlateLine> Notice::whole(const NoticeContent& content) const {
  std::vector<PlateLine> lines = pair_lines(content, {"Pair", "A, left", "B, right"});
  lines.push_back({"Gaze", gaze_source_text(source_)});
  for (const auto& [label, text] : {std::pair<const char*, const std::string&>{"Accuracy", content.rung},
                                    {"Map", content.map},
                                    {"Target", content.target}}) {
    if (!text.empty()) {
      lines.push_back({label, text});
    }
  }
  for (const std::string& warning : content.warnings) {
    lines.push_back({"Warning", warning, Kind::warning});
  }
  if (with_limits_) {
    lines.insert(lines.end(), content.limits.begin(), content.limits.end());
  }
  return lines;
}

std::vector<PlateLine> Notice::brief(const NoticeContent& content) const {
  std::string source = std::string("gaze: ") + source_of(source_).brief;
  if (!content.rung.empty()) {
    source += kDot + content.rung;
  }
  std::vector<PlateLine> lines = pair_lines(content, {"", "A", "B"});
  lines.push_back({.text = std::move(source), .kind = Kind::quiet});
  return lines;
}

void Notice::see_source(double time, const std::string& source) {
  if (source_.empty()) {
    source_ = source;
  }
  if (source != other_source_) {
    other_source_ = source;
    other_since_ = time;
  }
  if (time - other_since_ >= config_.source_delay) {
    source_ = other_source_;
  }
}

std::optional<std::vector<PlateLine>> Notice::step(double time, const NoticeContent& content) {
  see_source(time, content.gaze_source);
  NoticeContent told = content;
  told.gaze_source.clear();
  told.rung.clear();
  if (told_ != told) {
    with_limits_ = !told_ || told_->limits != told.limits;
    told_ = std::move(told);
    const double reading = static_cast<double>(letters(whole(content))) / config_.reading_rate;
    whole_until_ = time + std::min(config_.shortest + reading, config_.longest);
  }
  std::vector<PlateLine> lines = time < whole_until_ ? whole(content) : brief(content);
  if (lines == shown_) {
    return std::nullopt;
  }
  shown_ = lines;
  return lines;
}

}  // namespace app
