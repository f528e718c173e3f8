#include "app/notice/notice.hpp"

#include <algorithm>
#include <cstddef>

namespace app {
namespace {

using Kind = PlateLine::Kind;

constexpr const char* kDot = " \u00b7 ";

std::string short_source(const std::string& source) {
  return source == "tracker" ? "eye tracker" : source == "held" ? "held" : source == "head" ? "head only" : "recording";
}

std::string pairs_text(const NoticeContent& content) {
  if (!content.spectacles_on || content.pairs.empty()) {
    return "no spectacles";
  }
  return content.pairs.size() == 1 ? content.pairs[0] : "A " + content.pairs[0] + kDot + "B " + content.pairs[1];
}

void add_pairs(std::vector<PlateLine>& lines, const NoticeContent& content) {
  if (content.pairs.size() < 2 || !content.spectacles_on) {
    lines.push_back({"Pair", pairs_text(content)});
    return;
  }
  lines.push_back({"Left of line", "A: " + content.pairs[0]});
  lines.push_back({"Right of line", "B: " + content.pairs[1]});
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
  return source == "tracker" ? "from the eye tracker"
         : source == "held"  ? "held: the eye tracker has lost the eyes"
         : source == "head"  ? "no eye tracker: straight ahead of the head"
                             : "from the recording";
}

std::vector<PlateLine> Notice::whole(const NoticeContent& content) const {
  std::vector<PlateLine> lines;
  add_pairs(lines, content);
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
  std::string source = "gaze: " + short_source(source_);
  if (!content.rung.empty()) {
    source += kDot + content.rung;
  }
  return {{.text = pairs_text(content)}, {.text = std::move(source), .kind = Kind::quiet}};
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
