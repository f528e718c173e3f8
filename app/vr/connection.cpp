#include "app/vr/connection.hpp"

#include <array>
#include <chrono>
#include <ctime>
#include <glm/geometric.hpp>
#include <utility>

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

VrConnection::VrConnection(VrWorld& world, ControlSource more_controls, MirrorLink* mirror)
    : world_(world),
      more_controls_(std::move(more_controls)),
      instance_({.wanted_extensions = wanted_extensions()}),
      device_(open_headset_device(
          instance_,
          {.device = world.options().device, .validation = kValidation, .pipeline_cache = pipeline_cache_file()})),
      renderer_(device_, world.scene(),
                {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()}),
      session_(instance_, graphics_of(device_)),
      bindings_(instance_),
      gaze_actions_(instance_, bindings_),
      controls_(instance_, bindings_),
      loop_(session_, {.space = space_of(world.options().space), .size = size_of_images(world, instance_)}),
      hidden_(session_),
      world_from_space_(world_from_space(world.options().scene, world.scene(), loop_.space().type())) {
  bindings_.attach(session_);
  gaze_input_ = std::make_unique<xr::GazeInput>(gaze_actions_, session_);
  loop_.on_event([this](const XrEventDataBuffer& event) { hidden_.handle(event); });
  loop_.while_idle([this] { return !stop_if_wanted(); });
  if (!world.options().no_text) {
    text_.emplace(device_, session_, loop_);
  }
  describe();
  if (mirror != nullptr) {
    mirror_.emplace(*mirror, device_, std::array{world_.report().width, world_.report().height});
  }
  world_.begin_recording(device_.name(), {world_.report().width, world_.report().height});
  const xr::GazeSupport gaze = gaze_actions_.support();
  world_.choose_rungs(gaze.per_eye || gaze.combined);
  pictures_.emplace(renderer_, loop_, hidden_, world.options(), world.rungs().rungs());
  compile_pictures();
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
    if (world_.is_finished()) {
      request_exit();
    }
  }
}

std::optional<xr::Frame> VrConnection::next_frame() {
  processor_before_ = processor_ms();
  return loop_.next();
}

void VrConnection::request_exit() {
  if (!exit_requested_) {
    exit_requested_ = true;
    session_.request_exit();
  }
}

bool VrConnection::stop_if_wanted() {
  if (StopOnSignal::wanted()) {
    request_exit();
  }
  return session_.is_over();
}

// The scene moves under the head; what is remembered of directions in it goes with it.
void VrConnection::recentre(const tracking::Pose& world_from_space, const tracking::Pose& new_from_old) {
  world_.turned((world_from_space * new_from_old * world_from_space_.inverse()).orientation);
  world_from_space_ = world_from_space;
  world_.record_event("recentred");
}

void VrConnection::heed_controls(const xr::Frame& frame) {
  std::vector<xr::Control> pressed = controls_.pressed(session_);
  if (more_controls_) {
    const std::vector<xr::Control> more = more_controls_();
    pressed.insert(pressed.end(), more.begin(), more.end());
  }
  for (const xr::Control control : pressed) {
    if (control == xr::Control::recentre) {
      recentre(recentred(world_.options().scene, world_.scene(), loop_.space().type(), frame.space_from_head), {});
    } else {
      world_.apply(control);
    }
  }
}

void VrConnection::place(const xr::Frame& frame, double time) {
  if (frame.new_from_old) {
    recentre(world_from_space(world_.options().scene, world_.scene(), loop_.space().type()), *frame.new_from_old);
  }
  heed_controls(frame);
  HeadAndViews where;
  where.world_from_head = world_from_space_ * frame.space_from_head;
  for (const Side side : {Side::right, Side::left}) {
    const auto i = static_cast<std::size_t>(side);
    where.eyes[i] = {.head_from_view = frame.views[i].head_from_view, .fov = frame.views[i].fov};
  }
  world_.place(time, where, gaze_input_->read(loop_.view_space(), frame.display_time));
  world_.watch_reprojection(time, where, xr::seconds(frame.period));
}

// Before the session begins, which waits for no application: whatever the controls may ask for.
void VrConnection::compile_pictures() {
  for (const ShownPicture& shown : world_.reachable()) {
    const RenderSetup setup = world_.wearer().wearing(shown.pairs);
    for (std::size_t rung = 0; rung < world_.rungs_of(shown); ++rung) {
      pictures_->prepare({shown, rung}, setup);
    }
  }
  kernels_prepared_ = renderer_.kernels_made();
}

// What is shown first is made at every rung, so that a change of rung waits for nothing at all.
void VrConnection::make_first_pictures(const xr::Frame& frame) {
  world_.warn(glm::length(frame.views[0].head_from_view.position - frame.views[1].head_from_view.position));
  const ShownPicture& first = world_.picture();
  for (std::size_t rung = 0; rung < world_.rungs_of(first); ++rung) {
    pictures_->make({first, rung}, world_.wearer().wearing(first.pairs));
  }
  world_.report().guard_px = pictures_->guard_px({first, world_.rung()}).value_or(0);
  has_pictures_ = true;
}

void VrConnection::wait_for_device() {
  const auto done = pictures_->wait();
  if (!done) {
    return;
  }
  double seconds = 0.0;
  for (const render::vk::StageTime& stage : done->stages) {
    world_.report().device_stage(stage.name).add(stage.milliseconds);
    seconds += 1e-3 * stage.milliseconds;
  }
  world_.see_frame_time(done->key.shown, done->key.rung, seconds);
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
  world_.rungs().see_period(xr::seconds(frame.period));
  place(frame, time);
  mark("place");
  const bool is_first = !has_pictures_;
  if (is_first) {
    make_first_pictures(frame);
    last = Clock::now();
  }
  double processor = processor_ms() - processor_before_;
  wait_for_device();
  mark("device wait");
  const PictureKey key{world_.picture(), world_.rung()};
  if (!pictures_->has(key)) {
    pictures_->make(key, world_.wearer().wearing(key.shown.pairs));
    mark("new picture");
  }
  const std::array<std::uint32_t, 2> images = loop_.acquire();
  mark("image wait");
  const double processor_after_waits = processor_ms();
  std::vector<const xr::Panel*> panels;
  if (text_) {
    text_->update(world_, frame);
    panels.push_back(&text_->panel());
  }
  mark("text");
  pictures_->start(key, world_.setup(), images);
  report.hidden_fraction = pictures_->hidden_fraction();
  report.left_out_fraction = pictures_->left_out_fraction();
  report.mask_problem = hidden_.problem();
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
  if (mirror_) {
    mirror_->after_frame(pictures_->shown());
    mark("mirror");
  }
}

void VrConnection::finish() {
  wait_for_device();
  world_.report().kernels_late += renderer_.kernels_made() - kernels_prepared_;
  if (!world_.options().screenshot.empty()) {
    if (const auto picture = pictures_->read_picture()) {
      render::write_png(world_.options().screenshot, *picture);
    }
  }
  close_device(device_);
}

}  // namespace app
