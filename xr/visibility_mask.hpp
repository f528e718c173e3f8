// XR_KHR_visibility_mask: the parts of each view that the headset's lenses hide, as the runtime knows them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>

#include "tracking/hidden_area.hpp"
#include "xr/session.hpp"

namespace xr {

// A mesh of triangles on the view's plane z = -1. Nothing where it is no such mesh: indices beyond the vertices or not
// in threes, coordinates that are not finite.
[[nodiscard]] std::optional<tracking::HiddenArea> hidden_area(std::span<const XrVector2f> vertices,
                                                              std::span<const std::uint32_t> indices);

// Of one view, as the runtime answers. A mask saves time and is no reason to end a session: one that is no mesh, or a
// call that fails, hides nothing and is a problem in words. Throws LostError.
struct HiddenView {
  tracking::HiddenArea area;
  std::string problem;  // empty: none
};
[[nodiscard]] HiddenView ask_hidden(PFN_xrGetVisibilityMaskKHR get, XrSession session, tracking::Side side);

// What is hidden of both views, now and after each change; nothing where the runtime has no masks.
class VisibilityMasks {
 public:
  // Refers to the session.
  explicit VisibilityMasks(const Session& session);

  // Asks again after XrEventDataVisibilityMaskChangedKHR; events of other kinds pass by.
  void handle(const XrEventDataBuffer& event);

  // Whether the instance has the extension.
  [[nodiscard]] bool is_offered() const { return get_ != nullptr; }
  [[nodiscard]] const HiddenView& view(tracking::Side side) const { return views_[static_cast<std::size_t>(side)]; }
  // Since the constructor.
  [[nodiscard]] int changes() const { return changes_; }

 private:
  void ask(tracking::Side side);

  const Session& session_;
  PFN_xrGetVisibilityMaskKHR get_ = nullptr;
  std::array<HiddenView, 2> views_;  // indexed by Side
  int changes_ = 0;
};

}  // namespace xr
