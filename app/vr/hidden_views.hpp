// What the runtime's visibility masks hide, as the running pictures take it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/render_setup.hpp"
#include "xr/visibility_mask.hpp"

namespace app {

class HiddenViews {
 public:
  // Refers to the session.
  explicit HiddenViews(const xr::Session& session) : masks_(session) {}

  void handle(const XrEventDataBuffer& event) { masks_.handle(event); }

  // Of each eye in the order of the setup's views; a mask that hides nearly all of a view is a mistake and hides
  // nothing. Absent: the runtime knows no masks.
  [[nodiscard]] std::optional<std::vector<tracking::HiddenArea>> areas(const RenderSetup& setup);
  // How often they have changed: what was made of areas() holds until then.
  [[nodiscard]] int changes() const { return masks_.changes(); }
  // Why a mask was not taken by the last areas(); empty: all were.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  xr::VisibilityMasks masks_;
  std::string problem_;
};

}  // namespace app
