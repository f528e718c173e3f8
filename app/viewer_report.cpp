#include "app/viewer_report.hpp"

#include <nlohmann/json.hpp>

namespace app {
namespace {

std::array<lenses::SightDirections, 2> sight_of(const WornPair& pair) {
  std::array<lenses::SightDirections, 2> sight;
  for (std::size_t i = 0; i < 2; ++i) {
    const render::LineOfSight& line = pair.fixation.line[i];
    sight[i] = {line.gaze, pair.eyes[i].world_from_eye.inverse().direction(line.direction)};
  }
  return sight;
}

}  // namespace

std::vector<ViewerFinding> viewer_report(const RenderSetup& setup) {
  std::vector<ViewerFinding> report;
  if (!setup.headset) {
    return report;
  }
  for (const lenses::Finding& finding : lenses::viewer_findings(setup.wearer, *setup.headset)) {
    report.push_back({"", finding});
  }
  for (const ViewerFinding& finding : prism_findings(setup)) {
    report.push_back(finding);
  }
  return report;
}

std::vector<ViewerFinding> prism_findings(const RenderSetup& setup) {
  std::vector<ViewerFinding> findings;
  for (const WornPair& pair : setup.pairs) {
    if (const auto finding = lenses::vertical_prism_finding(sight_of(pair))) {
      findings.push_back({setup.pairs.size() > 1 ? pair.name : "", *finding});
    }
  }
  return findings;
}

std::string to_table(const std::vector<ViewerFinding>& findings) {
  std::string text;
  for (const ViewerFinding& f : findings) {
    text += "warning: ";
    if (!f.pair.empty()) {
      text.append(f.pair).append(": ");
    }
    text.append(f.finding.message).append("\n");
  }
  return text;
}

nlohmann::ordered_json to_json_array(const std::vector<ViewerFinding>& findings) {
  nlohmann::ordered_json array = nlohmann::ordered_json::array();
  for (const ViewerFinding& f : findings) {
    nlohmann::ordered_json entry = {{"code", f.finding.code}};
    if (!f.pair.empty()) entry["pair"] = f.pair;
    if (f.finding.side) entry["eye"] = *f.finding.side == lenses::Side::right ? "right" : "left";
    entry["value"] = f.finding.value;
    entry["unit"] = f.finding.unit;
    entry["message"] = f.finding.message;
    array.push_back(std::move(entry));
  }
  return array;
}

}  // namespace app
