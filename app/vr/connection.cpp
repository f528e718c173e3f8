#include "app/vr/connection.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <glm/geometric.hpp>

#include "app/device.hpp"
#include "app/headset_device.hpp"
#include "app/vr/setup.hpp"
#include "app/vr/stop_signal.hpp"
#include "render/image/png.hpp"

namespace app {
namespace {

// A runtime after a lost one goes on with the images of the first.
std::array<int, 2> size_of_images(const VrWorld& world, const xr::Instance& instance) {
  const VrReport& report = world.report();
  return report.width > 0 ? std::array{report.width, report.height}
                          : size_of_images(world.options(), world.replay(), instance);
}

using Clock = std::chrono::steady_clock;
using tracking::Side;

// ms that this thread has had of a processor.
double processor_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

VrConnection::VrConnection(VrWorld& world)
    : world_(world),
      instance_({.wanted_extensions = wanted_extensions()}),
      device_(open_headset_device(
          instance_,
          {.device = world.options().device, .validation = kValidation, .pipeline_cache = pipeline_cache_file()})),
      renderer_(device_, world.scene(),
                {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()}),
      session_(instance_, graphics_of(device_)),
      bindings_(instance_),
      gaze_actions_(instance_, bindings_),
      loop_(session_, {.space = space_of(world.options().space), .size = size_of_images(world, instance_)}),
      masks_(session_),
      world_from_space_(world_from_space(world.options().scene, world.scene(), loop_.space().type())),
      pictures_(renderer_, loop_, masks_, world.config()) {
  bindings_.attach(session_);
  gaze_input_ = std::make_unique<xr::GazeInput>(gaze_actions_, session_);
  loop_.on_event([this](const XrEventDataBuffer& event) { masks_.handle(event); });
  loop_.while_idle([this] { return !stop_if_wanted(); });
  if (!world.options().no_text) {
    text_.emplace(device_, session_, loop_);
  }
  describe();
  world_.begin_recording(device_.name(), {world_.report().width, world_.report().height});
}

void VrConnection::describe() {
  VrReport& report = world_.report();
  report.runtime = instance_.runtime_name();
  report.headset = instance_.headset_name();
  report.device = device_.name();
  report.space = name_of(loop_.space().type());
  report.width = loop_.swapchain(Side::left).width();
  report.height = loop_.swapchain(Side::left).height();
}

void VrConnection::show_frames() {
  while (const auto frame = next_frame()) {
    stop_if_wanted();
    const double time = world_.session_time(xr::seconds(frame->display_time));
    if (frame->should_render && !world_.is_finished()) {
      show(*frame, time);
    } else {
      loop_.skip(*frame);
      ++world_.report().skipped;
    }
    if (world_.is_finished() && !exit_requested_) {
      exit_requested_ = true;
      session_.request_exit();
    }
  }
}

std::optional<xr::Frame> VrConnection::next_frame() {
  processor_before_ = processor_ms();
  return loop_.next();
}

bool VrConnection::stop_if_wanted() {
  if (StopOnSignal::wanted() && !exit_requested_) {
    exit_requested_ = true;
    session_.request_exit();
  }
  return session_.is_over();
}

void VrConnection::place(const xr::Frame& frame, double time) {
  HeadAndViews where;
  where.world_from_head = world_from_space_ * frame.space_from_head;
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    where.eyes[i] = {.head_from_view = frame.views[i].head_from_view, .fov = frame.views[i].fov};
  }
  if (frame.new_from_old) {
    world_.head_was_moved();
    world_.record_event("recentred");
  }
  world_.place(time, where, gaze_input_->read(loop_.view_space(), frame.display_time));
  world_.watch_reprojection(time, where, xr::seconds(frame.period));
}

void VrConnection::prepare_first(const xr::Frame& frame) {
  world_.warn(glm::length(frame.views[0].head_from_view.position - frame.views[1].head_from_view.position));
  pictures_.prepare(world_.setup());
  world_.report().guard_px = pictures_.guard_px();
  world_.report().mask_problem = pictures_.mask_problem();
  prepared_ = true;
}

void VrConnection::wait_for_device() {
  for (const render::vk::StageTime& stage : pictures_.wait()) {
    world_.report().device_stage(stage.name).add(stage.milliseconds);
  }
}

void VrConnection::show(const xr::Frame& frame, double time) {
  VrReport& report = world_.report();
  report.period = xr::seconds(frame.period);
  const auto since = [](Clock::time_point then) {
    return std::chrono::duration<double, std::milli>(Clock::now() - then).count();
  };
  Clock::time_point last = frame.woken;
  const auto mark = [&](const char* part) {
    report.host_part(part).add(since(last));
    last = Clock::now();
  };
  mark("locate");
  bindings_.sync(session_);
  place(frame, time);
  mark("place");
  const bool is_first = !prepared_;
  if (is_first) {
    prepare_first(frame);
    last = Clock::now();
  }
  double processor = processor_ms() - processor_before_;
  wait_for_device();
  mark("device wait");
  const std::array<std::uint32_t, 2> images = loop_.acquire();
  mark("image wait");
  const double processor_after_waits = processor_ms();
  std::vector<const xr::Panel*> panels;
  if (text_) {
    text_->update(world_, frame);
    panels.push_back(&text_->panel());
  }
  mark("text");
  pictures_.start(world_.setup(), images);
  report.hidden_fraction = pictures_.hidden_fraction();
  report.left_out_fraction = pictures_.left_out_fraction();
  mark("submit");
  const double to_submit = since(frame.woken);
  loop_.show(frame, panels);
  mark("hand over");
  processor += processor_ms() - processor_after_waits;
  if (!is_first) {  // it compiles and draws beforehand
    report.wait_to_submit.add(to_submit);
    report.frame_code.add(processor);
  }
  ++report.shown;
}

void VrConnection::finish() {
  wait_for_device();
  if (!world_.options().screenshot.empty()) {
    if (const auto picture = pictures_.read_picture()) {
      render::write_png(world_.options().screenshot, *picture);
    }
  }
  close_device(device_);
}

}  // namespace app
