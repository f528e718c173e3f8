#include "app/vr/pictures.hpp"

#include <algorithm>

#include "render/guard_band.hpp"

namespace app {
namespace {

using tracking::Side;

constexpr double kMostHidden = 0.75;  // of a view: with more than that a mask is a mistake, not a lens
constexpr int kMaskSide = 64;         // px, to tell that
constexpr double kNearest_m = 0.25;   // what the guard band allows for; nearer things are rare and blurred anyway

// As wide as the largest blur of any pair and eye.
int guard_of(const RenderSetup& setup, int width, int height) {
  int guard_px = 0;
  for (const WornPair& pair : setup.pairs) {
    for (std::size_t at = 0; at < setup.sides.size(); ++at) {
      const double blur =
          render::largest_blur(lenses::f64::Table{setup.lenses.table},
                               pair.eyes[static_cast<std::size_t>(setup.sides[at])], setup.viewing, kNearest_m);
      guard_px = std::max(guard_px, render::guard_pixels(blur, setup.views[at].view.fov, width, height));
    }
  }
  return guard_px;
}

}  // namespace

Pictures::Pictures(render::Renderer& renderer, const xr::FrameLoop& loop, xr::VisibilityMasks& masks,
                   const render::LiveConfig& config)
    : renderer_(renderer), loop_(loop), masks_(masks), config_(config) {
  config_.frame.width = loop.swapchain(Side::left).width();
  config_.frame.height = loop.swapchain(Side::left).height();
  config_.blue_first = loop.swapchain(Side::left).format() == VK_FORMAT_B8G8R8A8_SRGB;
}

// What is recorded for the device depends on the lenses and on how wide the blur can be, and on nothing that moves.
void Pictures::prepare(const RenderSetup& setup) {
  if (live_) {
    return;
  }
  config_.eyes = setup.sides.size();
  config_.pairs = setup.pairs.size();
  if (config_.frame.mode == render::Mode::adof) {
    config_.guard_px = guard_of(setup, config_.frame.width, config_.frame.height);
  }
  std::vector<std::vector<VkImage>> images;
  for (const Side side : setup.sides) {
    images.push_back(loop_.swapchain(side).images());
  }
  if (masks_.is_offered()) {
    config_.hidden = hidden_areas(setup);
  }
  live_ = std::make_unique<render::LiveFrame>(renderer_, setup.lenses, setup.views, config_, images);
}

std::vector<tracking::HiddenArea> Pictures::hidden_areas(const RenderSetup& setup) {
  std::vector<tracking::HiddenArea> areas;
  mask_problem_.clear();
  for (std::size_t at = 0; at < setup.sides.size(); ++at) {
    const xr::HiddenView& view = masks_.view(setup.sides[at]);
    const double hidden =
        tracking::hidden_pixels(view.area, setup.views[at].view.fov, kMaskSide, kMaskSide).hidden_fraction();
    const bool is_sound = hidden <= kMostHidden;
    areas.push_back(is_sound ? view.area : tracking::HiddenArea{});
    if (!is_sound || !view.problem.empty()) {
      mask_problem_ = is_sound ? view.problem : "the runtime's mask hides nearly all of a view";
    }
  }
  return areas;
}

void Pictures::start(const RenderSetup& setup, const std::array<std::uint32_t, 2>& images) {
  std::vector<std::uint32_t> of_eyes;
  for (const Side side : setup.sides) {
    of_eyes.push_back(images[static_cast<std::size_t>(side)]);
  }
  if (masks_.has_changed()) {
    live_->hide(hidden_areas(setup));
  }
  live_->start(setup.lenses, setup.views, of_eyes);
}

std::vector<render::vk::StageTime> Pictures::wait() {
  return live_ ? live_->wait() : std::vector<render::vk::StageTime>{};
}

std::optional<render::Image8> Pictures::read_picture() {
  if (!live_) {
    return std::nullopt;
  }
  render::Image8 picture = render::black_image(2 * config_.frame.width, config_.frame.height);
  for (std::size_t eye = 0; eye < config_.eyes; ++eye) {
    const render::Image8 one = live_->read_picture(eye);
    const std::size_t row = 3 * static_cast<std::size_t>(one.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(one.height); ++y) {
      std::copy_n(one.rgb.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                  picture.rgb.begin() + static_cast<std::ptrdiff_t>((2 * y + eye) * row));
    }
  }
  return picture;
}

}  // namespace app
