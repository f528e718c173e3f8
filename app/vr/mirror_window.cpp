#include "app/vr/mirror_window.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <string_view>

#include "app/device.hpp"
#include "app/vr/stop_signal.hpp"

namespace app {
namespace {

constexpr const char* kTitle = "Vergence: what the headset shows";
constexpr double kTurn_s = 1.0 / 60.0;

struct Key {
  std::string_view name;
  xr::Control control;
};
constexpr std::array kKeys{Key{"space", xr::Control::spectacles}, Key{"n", xr::Control::next_pair},
                           Key{"c", xr::Control::compare},        Key{"m", xr::Control::map},
                           Key{"t", xr::Control::next_target},    Key{"r", xr::Control::recentre},
                           Key{"escape", xr::Control::clear_view}};
constexpr std::string_view kEnd = "q";

}  // namespace

MirrorWindow::MirrorWindow() try
    : window_(kTitle),
      binding_(window_.binding()),
      device_({.validation = kValidation, .window = &binding_}),
      pictures_(device_),
      picture_{1, 1, {0xff000000U}
}  // namespace app
{  // black, until there is one
}
catch (const std::exception& error) {
  throw WindowError("--mirror: " + std::string(error.what()));
}

void MirrorWindow::run_beside(const std::function<void(MirrorLink&)>& session) {
  MirrorLink link;
  auto running = std::async(std::launch::async, [&] { session(link); });
  try {
    while (running.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      turn(link);
    }
  } catch (...) {
    StopOnSignal::stop();
    running.wait();
    throw;
  }
  running.get();
  pictures_.wait();
  close_device(device_);
}

void MirrorWindow::turn(MirrorLink& link) {
  window_.poll(kTurn_s);
  if (const auto shape = link.take_shape()) {
    window_.fit((*shape)[0], (*shape)[1]);
    window_.show();
  }
  heed_keys(link);
  const std::array<int, 2> size = window_.size();
  link.set_room(size);
  if (link.take(picture_) || size != window_size_ || window_.is_damaged()) {
    window_size_ = {};
    redraw(size);
  }
}

void MirrorWindow::heed_keys(MirrorLink& link) {
  for (const std::string& key : window_.pressed()) {
    if (const auto found = std::ranges::find(kKeys, key, &Key::name); found != kKeys.end()) {
      link.press(found->control);
    } else if (key == kEnd) {
      StopOnSignal::stop();
    }
  }
  if (window_.close_wanted()) {
    window_.hide();
    StopOnSignal::stop();
  }
}

// What does not find an image free is drawn again in the next turn.
void MirrorWindow::redraw(const std::array<int, 2>& size) {
  pictures_.wait();
  const std::size_t bytes = 4 * picture_.pixels.size();
  if (!pixels_ || pixels_->bytes() != bytes) {
    pixels_ = std::make_unique<render::vk::Buffer>(device_, bytes, render::vk::Memory::upload);
  }
  pixels_->write(picture_.pixels);
  const render::vk::PixelBlock block{
      .from = pixels_.get(), .row_pixels = picture_.width, .width = picture_.width, .height = picture_.height};
  if (pictures_.show({&block, 1}, picture_.width, picture_.height, size)) {
    window_size_ = size;
  }
}

}  // namespace app
