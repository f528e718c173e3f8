// What the viewer of a headset is told about this wearer, this headset and where the eyes look now.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/render_setup.hpp"
#include "lenses/viewer_findings.hpp"

namespace app {

// Of each pair; the pair is named where there are two. Empty without a headset.
struct ViewerFinding {
  std::string pair;
  lenses::Finding finding;
};
[[nodiscard]] std::vector<ViewerFinding> viewer_report(const RenderSetup& setup);
// Of these, what depends on where the eyes look now: the vertical prism of each pair.
[[nodiscard]] std::vector<ViewerFinding> prism_findings(const RenderSetup& setup);

// A line each, "warning: ...".
[[nodiscard]] std::string to_table(const std::vector<ViewerFinding>& findings);
[[nodiscard]] nlohmann::ordered_json to_json_array(const std::vector<ViewerFinding>& findings);

}  // namespace app
