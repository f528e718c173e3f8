#include "app/vr_run.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <glm/geometric.hpp>
#include <iostream>
#include <memory>
#include <optional>

#include "app/device.hpp"
#include "app/headset_device.hpp"
#include "app/live_wearer.hpp"
#include "app/vr_recording.hpp"
#include "app/vr_setup.hpp"
#include "render/guard_band.hpp"
#include "render/image/png.hpp"
#include "render/live_frame.hpp"
#include "xr/actions.hpp"
#include "xr/frame_loop.hpp"
#include "xr/gaze_input.hpp"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;
using render::Mode;
using tracking::Pose;
using tracking::Side;

constexpr double kNearest_m = 0.25;  // what the guard band allows for; nearer things are rare and blurred anyway

volatile std::sig_atomic_t g_stop = 0;

// Ctrl-C ends the session as the runtime would; restored when it is over.
class StopOnSignal {
 public:
  StopOnSignal() {
    g_stop = 0;
    struct sigaction action {};
    action.sa_handler = [](int) { g_stop = 1; };
    ::sigaction(SIGINT, &action, &old_[0]);
    ::sigaction(SIGTERM, &action, &old_[1]);
  }
  ~StopOnSignal() {
    ::sigaction(SIGINT, &old_[0], nullptr);
    ::sigaction(SIGTERM, &old_[1], nullptr);
  }
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
  [[nodiscard]] static bool wanted() { return g_stop != 0; }

 private:
  std::array<struct sigaction, 2> old_{};
};

class VrRun {
 public:
  explicit VrRun(const VrOptions& options)
      : options_(options),
        replay_(options.replay.empty() ? std::nullopt : std::optional<SessionReplay>(options.replay)),
        scene_(render::read_gltf(options.scene.scene.empty() ? built_in_scene().string() : options.scene.scene)),
        wearer_(make_render_setup(scene_options(options), scene_), scene_),
        config_(live_config(options)),
        instance_({.wanted_extensions = wanted_extensions()}),
        device_(open_headset_device(
            instance_, {.device = options.device, .validation = kValidation, .pipeline_cache = pipeline_cache_file()})),
        renderer_(device_, scene_, {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()}),
        session_(instance_, graphics_of(device_)),
        bindings_(instance_),
        gaze_actions_(instance_, bindings_),
        loop_(session_, {.space = space_of(options.space), .size = size_of_images(options, replay_, instance_)}),
        world_from_space_(world_from_space(options.scene, scene_, loop_.space().type())) {
    bindings_.attach(session_);
    gaze_input_ = std::make_unique<xr::GazeInput>(gaze_actions_, session_);
    loop_.while_idle([this] { return !stop_if_wanted(); });
    config_.frame.width = loop_.swapchain(Side::left).width();
    config_.frame.height = loop_.swapchain(Side::left).height();
    config_.eyes = wearer_.setup().sides.size();
    config_.pairs = wearer_.setup().pairs.size();
    report_.runtime = instance_.runtime_name();
    report_.headset = instance_.headset_name();
    report_.device = device_.name();
    report_.space = name_of(loop_.space().type());
    report_.width = config_.frame.width;
    report_.height = config_.frame.height;
    tell(lenses::viewer_findings(wearer_.setup().wearer, *wearer_.setup().headset));
    if (!options.record.empty()) {
      start_recording();
    }
  }

  VrReport run() {
    try {
      show_frames();
    } catch (const xr::LostError&) {
      if (recorder_) {
        recorder_->event(last_time_, "session lost");
      }
      throw;
    }
    finish();
    return report_;
  }

 private:
  static SceneOptions scene_options(const VrOptions& options) {
    SceneOptions scene = options.scene;
    scene.in_headset = true;
    return scene;
  }

  // Before the picture, and again in the report.
  void tell(const std::vector<lenses::Finding>& findings) {
    for (const lenses::Finding& finding : findings) {
      std::cerr << "note: " << finding.message << '\n';
      report_.findings.push_back(finding);
    }
  }

  // The headset's lenses stand apart as the views do; the wearer's spectacles as the wearer's pupils would.
  void compare_distances(const xr::Frame& frame) {
    const RenderSetup& setup = wearer_.setup();
    const double apart = glm::length(frame.views[0].head_from_view.position - frame.views[1].head_from_view.position);
    std::array<double, 2> power{};
    for (const std::size_t i : {0U, 1U}) {
      power[i] = horizontal_power(lenses::f64::Table{setup.lenses.table}, setup.pairs.front().eyes[i]);
    }
    if (const auto finding = lenses::distance_finding(setup.wearer, apart, power)) {
      tell({*finding});
    }
  }

  void show_frames() {
    while (const auto frame = loop_.next()) {
      stop_if_wanted();
      last_time_ = xr::seconds(frame->display_time);
      if (frame->should_render && !finished()) {
        show(*frame);
      } else {
        loop_.skip(*frame);
        ++report_.skipped;
      }
      if (finished() && !exit_requested_) {
        exit_requested_ = true;
        session_.request_exit();
      }
    }
  }

  [[nodiscard]] bool finished() const {
    return (options_.frames && report_.shown >= *options_.frames) ||
           (replay_ && static_cast<std::size_t>(report_.shown) >= replay_->frames());
  }

  void start_recording() {
    SessionRecord record;
    record.device = device_.name();
    record.size = {config_.frame.width, config_.frame.height};
    record.options = recorded_options(options_);
    recorder_.emplace(options_.record, std::move(record));
  }

  bool stop_if_wanted() {
    if (StopOnSignal::wanted() && !exit_requested_) {
      exit_requested_ = true;
      session_.request_exit();
    }
    return session_.is_over();
  }

  void place(const xr::Frame& frame) {
    HeadAndViews where;
    where.world_from_head = world_from_space_ * frame.space_from_head;
    for (const Side side : {Side::right, Side::left}) {
      const auto i = static_cast<std::size_t>(side);
      where.eyes[i] = {.head_from_view = frame.views[i].head_from_view, .fov = frame.views[i].fov};
    }
    if (replay_) {
      replay_frame(wearer_, replay_->frame(static_cast<std::size_t>(report_.shown)), where);
      ++report_.gaze_sources["replay"];
      return;
    }
    const double time = xr::seconds(frame.display_time);
    const auto sample = gaze_input_->read(loop_.view_space(), frame.display_time);
    wearer_.step(time, where, sample);
    ++report_.gaze_sources[tracking::name(wearer_.state().source)];
    if (recorder_) {
      if (frame.new_from_old) {
        recorder_->event(time, "recentred");
      }
      recorder_->frame(trace_row(time, where, wearer_, sample && sample->valid), recorded_views(where),
                       options_.picture.accuracy, wearer_.setup().pairs.front().name);
    }
  }

  // What is recorded for the device depends on the lenses and on how wide the blur can be, and on nothing that moves.
  void make_live() {
    const RenderSetup& setup = wearer_.setup();
    if (config_.frame.mode == Mode::adof) {
      for (const WornPair& pair : setup.pairs) {
        for (const Side side : setup.sides) {
          const auto i = static_cast<std::size_t>(side);
          const double blur =
              render::largest_blur(lenses::f64::Table{setup.lenses.table}, pair.eyes[i], setup.viewing, kNearest_m);
          const auto& fov =
              setup.views[static_cast<std::size_t>(std::ranges::find(setup.sides, side) - setup.sides.begin())]
                  .view.fov;
          config_.guard_px =
              std::max(config_.guard_px, render::guard_pixels(blur, fov, config_.frame.width, config_.frame.height));
        }
      }
    }
    report_.guard_px = config_.guard_px;
    config_.blue_first = loop_.swapchain(Side::left).format() == VK_FORMAT_B8G8R8A8_SRGB;
    std::vector<std::vector<VkImage>> images;
    for (const Side side : setup.sides) {
      images.push_back(loop_.swapchain(side).images());
    }
    live_ = std::make_unique<render::LiveFrame>(renderer_, setup.lenses, setup.views, config_, images);
  }

  void show(const xr::Frame& frame) {
    Clock::time_point last = frame.woken;
    const auto mark = [&](const char* part) {
      const auto now = Clock::now();
      report_.host_part(part).add(std::chrono::duration<double, std::milli>(now - last).count());
      last = now;
    };
    mark("locate");
    bindings_.sync(session_);
    place(frame);
    mark("place");
    if (!live_) {
      compare_distances(frame);
      make_live();
      last = Clock::now();
    }
    for (const render::vk::StageTime& stage : live_->wait()) {
      report_.device_stage(stage.name).add(stage.milliseconds);
    }
    mark("device wait");
    const std::array<std::uint32_t, 2> by_side = loop_.acquire();
    std::vector<std::uint32_t> images;
    for (const Side side : wearer_.setup().sides) {
      images.push_back(by_side[static_cast<std::size_t>(side)]);
    }
    mark("image wait");
    live_->start(wearer_.setup().lenses, wearer_.setup().views, images);
    mark("submit");
    loop_.show(frame);
    mark("hand over");
    ++report_.shown;
  }

  void finish() {
    if (live_) {
      for (const render::vk::StageTime& stage : live_->wait()) {
        report_.device_stage(stage.name).add(stage.milliseconds);
      }
      if (!options_.screenshot.empty()) {
        write_screenshot();
      }
    }
    close_device(device_);
  }

  void write_screenshot() {
    render::Image8 picture = render::black_image(2 * config_.frame.width, config_.frame.height);
    for (std::size_t eye = 0; eye < config_.eyes; ++eye) {
      const render::Image8 one = live_->read_picture(eye);
      const std::size_t row = 3 * static_cast<std::size_t>(one.width);
      for (std::size_t y = 0; y < static_cast<std::size_t>(one.height); ++y) {
        std::copy_n(one.rgb.begin() + static_cast<std::ptrdiff_t>(y * row), row,
                    picture.rgb.begin() + static_cast<std::ptrdiff_t>((2 * y + eye) * row));
      }
    }
    render::write_png(options_.screenshot, picture);
  }

  const VrOptions& options_;
  StopOnSignal signals_;
  std::optional<SessionReplay> replay_;
  render::Scene scene_;
  LiveWearer wearer_;
  render::LiveConfig config_;
  xr::Instance instance_;
  render::vk::Device device_;
  render::Renderer renderer_;
  xr::Session session_;
  xr::ActionBindings bindings_;
  xr::GazeActions gaze_actions_;
  std::unique_ptr<xr::GazeInput> gaze_input_;
  std::optional<SessionRecorder> recorder_;
  xr::FrameLoop loop_;
  Pose world_from_space_;
  std::unique_ptr<render::LiveFrame> live_;
  VrReport report_;
  double last_time_ = 0.0;  // s, of the last frame
  bool exit_requested_ = false;
};

}  // namespace

VrReport run_vr(const VrOptions& options) {
  return VrRun(options).run();
}

}  // namespace app
