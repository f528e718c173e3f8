#include "app/vr/pictures.hpp"

#include <algorithm>
#include <iterator>

#include "app/vr/setup.hpp"
#include "render/guard_band.hpp"

namespace app {
namespace {

using tracking::Side;

constexpr double kNearest_m = 0.25;  // what the guard band allows for; nearer things are rare and blurred anyway

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

Pictures::Pictures(render::Renderer& renderer, const xr::FrameLoop& loop, HiddenViews& hidden, const VrOptions& options,
                   std::vector<render::GovernorRung> rungs)
    : renderer_(renderer), loop_(loop), hidden_(hidden), options_(options), rungs_(std::move(rungs)) {}

// What is recorded for the device depends on the lenses and on how wide the blur can be, and on nothing that moves.
render::LiveConfig Pictures::config_of(const PictureKey& key, const RenderSetup& setup) const {
  render::LiveConfig config = live_config(options_, key.shown.mode);
  config.frame.accuracy = rungs_.at(key.rung).accuracy;
  config.frame.width = loop_.swapchain(Side::left).width();
  config.frame.height = loop_.swapchain(Side::left).height();
  config.blue_first = loop_.swapchain(Side::left).format() == VK_FORMAT_B8G8R8A8_SRGB;
  config.eyes = setup.sides.size();
  config.pairs = setup.pairs.size();
  if (config.frame.mode == render::Mode::adof) {
    config.guard_px = guard_of(setup, config.frame.width, config.frame.height);
  }
  config.hidden = hidden_.areas(setup);
  return config;
}

// A small picture of the same kernels: those of one that may leave out what is hidden are not those of other frames. It
// hides nothing, so that all of them run.
void Pictures::prepare(const PictureKey& key, const RenderSetup& setup) {
  render::LiveConfig config = config_of(key, setup);
  if (!config.hidden) {
    renderer_.prepare(setup.lenses, setup.views, config.frame);
    return;
  }
  constexpr int kSide = 8;
  config.frame.width = config.frame.height = kSide;
  config.frame.samples = 1;
  config.guard_px = 0;
  config.hidden = std::vector<tracking::HiddenArea>(config.eyes);
  const render::LiveFrame small(renderer_, setup.lenses, setup.views, config,
                                std::vector<std::vector<VkImage>>(config.eyes));
}

bool Pictures::has(const PictureKey& key) const {
  return std::ranges::find(made_, key, &Made::key) != made_.end();
}

void Pictures::make(const PictureKey& key, const RenderSetup& setup) {
  if (made_.size() >= rungs_.size() + kMost) {
    made_.pop_back();
  }
  std::vector<std::vector<VkImage>> images;
  for (const Side side : setup.sides) {
    images.push_back(loop_.swapchain(side).images());
  }
  const render::LiveConfig config = config_of(key, setup);
  const auto frame = [&] {
    return std::make_unique<render::LiveFrame>(renderer_, setup.lenses, setup.views, config, images);
  };
  try {
    made_.push_back({key, config, frame(), hidden_.changes()});
  } catch (const render::vk::DeviceError&) {
    if (made_.size() < 2) {
      throw;
    }
    // A device with little memory keeps the last shown alone: the mirror may be copying it.
    made_.erase(std::next(made_.begin()), made_.end());
    made_.push_back({key, config, frame(), hidden_.changes()});
  }
}

void Pictures::start(const PictureKey& key, const RenderSetup& setup, const std::array<std::uint32_t, 2>& images) {
  made_.splice(made_.begin(), made_, std::ranges::find(made_, key, &Made::key));
  std::vector<std::uint32_t> of_eyes;
  for (const Side side : setup.sides) {
    of_eyes.push_back(images[static_cast<std::size_t>(side)]);
  }
  Made& made = made_.front();
  if (made.mask != hidden_.changes()) {
    made.frame->hide(*hidden_.areas(setup));
    made.mask = hidden_.changes();
  }
  made.frame->start(setup.lenses, setup.views, of_eyes);
  shown_ = under_way_ = true;
}

std::optional<Pictures::Done> Pictures::wait() {
  if (!under_way_) {
    return std::nullopt;
  }
  under_way_ = false;
  return Done{made_.front().key, made_.front().frame->wait()};
}

std::optional<render::Image8> Pictures::read_picture() {
  if (!shown_) {
    return std::nullopt;
  }
  Made& last = made_.front();
  const render::FrameConfig& size = last.config.frame;
  render::Image8 picture = render::black_image(2 * size.width, size.height);
  for (std::size_t eye = 0; eye < last.config.eyes; ++eye) {
    const render::Image8 one = last.frame->read_picture(eye);
    const std::size_t row = 3 * static_cast<std::size_t>(one.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(one.height); ++y) {
      std::copy_n(one.rgb.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                  picture.rgb.begin() + static_cast<std::ptrdiff_t>((2 * y + eye) * row));
    }
  }
  return picture;
}

std::optional<int> Pictures::guard_px(const PictureKey& key) const {
  const auto made = std::ranges::find(made_, key, &Made::key);
  return made == made_.end() ? std::nullopt : std::optional(made->config.guard_px);
}

}  // namespace app
