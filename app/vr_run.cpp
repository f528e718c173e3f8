#include "app/vr_run.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <glm/gtc/quaternion.hpp>

#include "app/device.hpp"
#include "app/headset_device.hpp"
#include "app/live_wearer.hpp"
#include "app/mode_option.hpp"
#include "app/option_values.hpp"
#include "render/guard_band.hpp"
#include "render/image/png.hpp"
#include "render/ladder.hpp"
#include "render/live_frame.hpp"
#include "tracking/input_error.hpp"
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

// A running map cannot take its range from the picture: colours would change with every turn of the head.
render::MapRange range_of(const VrOptions& options, Mode mode) {
  if (!options.range.empty()) {
    const auto v = numbers_of("--range", options.range, 2, "LO,HI, such as 0,3");
    if (!(v[0] < v[1])) {
      throw tracking::InputError("--range", "", "'" + options.range + "' must have LO below HI");
    }
    return {v[0], v[1]};
  }
  switch (mode) {
    case Mode::astigmatism:
      return {0.0, 3.0};
    case Mode::accommodation:
      return {0.0, 4.0};
    case Mode::blur:
      return {0.0, 20.0};
    default:
      return {-3.0, 3.0};
  }
}

xr::SpaceChoice space_of(const std::string& name) {
  return name == "local_floor" ? xr::SpaceChoice::local_floor
         : name == "stage"     ? xr::SpaceChoice::stage
         : name == "local"     ? xr::SpaceChoice::local
                               : xr::SpaceChoice::automatic;
}

std::string name_of(XrReferenceSpaceType type) {
  return type == XR_REFERENCE_SPACE_TYPE_STAGE   ? "stage"
         : type == XR_REFERENCE_SPACE_TYPE_LOCAL ? "local"
                                                 : "local_floor";
}

// The scene's camera is where a wearer starts: the runtime's floor is the scene's, and its centre lies below the
// camera. A space without a floor has its origin where the head was, so that is put at the camera.
Pose world_from_space(const SceneOptions& options, const render::Scene& scene, XrReferenceSpaceType type) {
  Pose start = start_pose(options, scene);
  const glm::dvec3 ahead = start.direction({0.0, 0.0, -1.0});
  start.orientation = tracking::orientation_from_yaw_pitch(std::atan2(ahead.x, -ahead.z), 0.0);
  if (xr::is_on_floor(type)) {
    start.position.y = 0.0;
  }
  return start;
}

// One size for both eyes: the larger of what is recommended for each.
std::array<int, 2> size_of_images(const VrOptions& options, const xr::Instance& instance) {
  if (!options.size.empty()) {
    return size_of("--size", options.size);
  }
  const auto sizes = xr::recommended_sizes(instance);
  return {std::max(sizes[0][0], sizes[1][0]), std::max(sizes[0][1], sizes[1][1])};
}

std::vector<std::string> wanted_extensions() {
  std::vector<std::string> names = xr::gaze_extensions();
  names.emplace_back(XR_EXT_LOCAL_FLOOR_EXTENSION_NAME);
  return names;
}

class VrRun {
 public:
  explicit VrRun(const VrOptions& options)
      : options_(options),
        scene_(render::read_gltf(options.scene.scene.empty() ? built_in_scene().string() : options.scene.scene)),
        wearer_(make_render_setup(scene_options(options), scene_), scene_),
        config_(frame_config(options)),
        instance_({.wanted_extensions = wanted_extensions()}),
        device_(open_headset_device(
            instance_, {.device = options.device, .validation = kValidation, .pipeline_cache = pipeline_cache_file()})),
        renderer_(device_, scene_, {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()}),
        session_(instance_, graphics_of(device_)),
        bindings_(instance_),
        gaze_actions_(instance_, bindings_),
        loop_(session_, {.space = space_of(options.space), .size = size_of_images(options, instance_)}),
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
  }

  VrReport run() {
    while (const auto frame = loop_.next()) {
      stop_if_wanted();
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
    finish();
    return report_;
  }

 private:
  static SceneOptions scene_options(const VrOptions& options) {
    SceneOptions scene = options.scene;
    scene.in_headset = true;
    return scene;
  }

  static render::LiveConfig frame_config(const VrOptions& options) {
    render::LiveConfig config;
    config.frame.mode = mode_of(options.mode);
    config.frame.accuracy = render::find_rung(options.picture.accuracy)->accuracy;
    config.frame.threshold_px = options.picture.threshold();
    config.frame.exposure = options.picture.exposure;
    config.frame.samples = options.samples;
    config.frame.colour_map = options.colour_map == "hsv" ? 0 : 1;
    if (render::is_map(config.frame.mode)) {
      config.frame.range = range_of(options, config.frame.mode);
    }
    return config;
  }

  [[nodiscard]] bool finished() const { return options_.frames && report_.shown >= *options_.frames; }

  bool stop_if_wanted() {
    if (StopOnSignal::wanted() && !exit_requested_) {
      exit_requested_ = true;
      session_.request_exit();
    }
    return session_.is_over();
  }

  void place(const xr::Frame& frame) {
    Sighting sighting;
    sighting.world_from_head = world_from_space_ * frame.space_from_head;
    const tracking::FollowedGaze gaze = gaze_.step(xr::seconds(frame.display_time), sighting.world_from_head,
                                                   gaze_input_->read(loop_.view_space(), frame.display_time));
    sighting.gaze = gaze.target[0] + gaze.target[1];
    ++report_.gaze_sources[std::string(xr::source_name(gaze))];
    for (const Side side : {Side::right, Side::left}) {
      const auto i = static_cast<std::size_t>(side);
      sighting.eyes[i] = {.head_from_view = frame.views[i].head_from_view, .fov = frame.views[i].fov};
    }
    wearer_.place(sighting);
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
  tracking::GazeFollower gaze_;
  xr::FrameLoop loop_;
  Pose world_from_space_;
  std::unique_ptr<render::LiveFrame> live_;
  VrReport report_;
  bool exit_requested_ = false;
};

}  // namespace

VrReport run_vr(const VrOptions& options) {
  return VrRun(options).run();
}

}  // namespace app
