#include "app/vr/text_panel.hpp"

#include <array>
#include <utility>

#include "app/notice/panel_place.hpp"

namespace app {
namespace {

constexpr int kBorder = PlatePicture::kBorder;

// One border pixel stays, which both the part shown and what lies beyond it end in.
xr::PanelRect shown_part(const PlatePicture& picture) {
  return {kBorder - 1, kBorder - 1, picture.width - 2 * (kBorder - 1), picture.height - 2 * (kBorder - 1)};
}

void swap_red_and_blue(PlatePicture& picture) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    std::swap(picture.rgba[i], picture.rgba[i + 2]);
  }
}

}  // namespace

TextPanel::TextPanel(const render::vk::Device& device, const xr::Session& session, const xr::Space& head,
                     const PlateConfig& plate)
    : device_(device),
      plate_(plate),
      panel_(session, head, plate.most_width, plate.most_height),
      pixels_(device, 4 * static_cast<std::size_t>(plate.most_width) * static_cast<std::size_t>(plate.most_height),
              render::vk::Memory::upload),
      copy_(device) {}

void TextPanel::upload(const PlatePicture& picture) {
  (void)copy_.wait();  // of the text before: the buffer is its
  pixels_.write(picture.rgba);
  const std::uint32_t image = panel_.acquire();
  render::vk::Commands commands(device_);
  const render::vk::PixelBlock all{
      .from = &pixels_, .row_pixels = picture.width, .width = picture.width, .height = picture.height};
  render::vk::copy_to_image(commands, std::array{all},
                            {.image = panel_.swapchain().images()[image],
                             .width = panel_.swapchain().width(),
                             .height = panel_.swapchain().height()});
  copy_.start(std::array{&commands});
}

void TextPanel::write(const std::vector<PlateLine>& lines, const std::array<tracking::EyeView, 2>& views,
                      const TextPanelConfig& config) {
  PlatePicture picture = plate_.draw(lines);
  if (panel_.swapchain().format() == VK_FORMAT_B8G8R8A8_SRGB) {
    swap_red_and_blue(picture);
  }
  upload(picture);
  const xr::PanelRect part = shown_part(picture);
  const double pixel_angle = config.letter_angle / plate_.config().x_height;
  const PanelPlace place = place_panel(
      views, {.distance = config.distance, .width = pixel_angle * part.width, .height = pixel_angle * part.height});
  panel_.show({place.head_from_panel, place.width, place.height, part});
}

}  // namespace app
