// A flat picture that hangs before the head, seen by both eyes and laid over the scene: for words. Its image is changed
// when there is something new to read, and else stays with the compositor.
#pragma once

#include "tracking/stereo_view.hpp"
#include "xr/spaces.hpp"
#include "xr/swapchain.hpp"

namespace xr {

// Pixels of a panel's image.
struct PanelRect {
  int x = 0, y = 0, width = 0, height = 0;
};

struct PanelShape {
  tracking::Pose head_from_panel;    // of its centre; +z towards the head
  double width = 0.0, height = 0.0;  // m
  PanelRect shown;                   // the part of the image that fills it
};

class Panel {
 public:
  // Refers to session and space, which is VIEW. Images of `most_width` x `most_height`, sRGB, colours multiplied by
  // their opacity in linear light.
  Panel(const Session& session, const Space& head, int most_width, int most_height);

  [[nodiscard]] const Swapchain& swapchain() const { return swapchain_; }

  // The image to be written next; what was shown stays until show().
  [[nodiscard]] std::uint32_t acquire() { return swapchain_.acquire(); }
  // All work on the acquired image has been submitted.
  void show(const PanelShape& shape);

  // Nothing was shown yet.
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  // As FrameLoop submits it.
  [[nodiscard]] XrCompositionLayerQuad layer() const;

 private:
  const Space& head_;
  Swapchain swapchain_;
  PanelShape shape_;
  bool is_empty_ = true;
};

}  // namespace xr
