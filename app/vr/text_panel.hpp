// Words on a panel before the head: drawn when they change, copied to the compositor without waiting, and left there.
#pragma once

#include <vector>

#include "app/notice/plate.hpp"
#include "render/vk/buffer.hpp"
#include "render/vk/external.hpp"
#include "xr/panel.hpp"

namespace app {

struct TextPanelConfig {
  double distance = 1.5;       // m
  double letter_angle = 0.01;  // rad, of the letter x
};

class TextPanel {
 public:
  // Refers to the device, session and space; the space is VIEW.
  TextPanel(const render::vk::Device& device, const xr::Session& session, const xr::Space& head,
            const PlateConfig& plate);

  // On the thread that submits: these lines from now on, where both of the views (by Side) see them.
  void write(const std::vector<PlateLine>& lines, const std::array<tracking::EyeView, 2>& views,
             const TextPanelConfig& config);

  [[nodiscard]] const xr::Panel& panel() const { return panel_; }

 private:
  void upload(const PlatePicture& picture);

  const render::vk::Device& device_;
  Plate plate_;
  xr::Panel panel_;
  render::vk::Buffer pixels_;
  render::vk::Submission copy_;
};

}  // namespace app
