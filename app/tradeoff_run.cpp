#include "app/tradeoff_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "app/device.hpp"
#include "app/option_values.hpp"
#include "app/picture.hpp"
#include "app/tradeoff/reference_store.hpp"
#include "lenses/lens_io/lens_io.hpp"
#include "render/image/flip.hpp"
#include "render/renderer.hpp"
#include "render/wavefront_error.hpp"

namespace app {
namespace {

using render::Mode;

// The reference's pattern of samples is another than that of the settings of mode dof: their noise shall not cancel.
constexpr std::uint32_t kReferenceSeed = 0x5bd1e995U;

const char* name(Mode mode) {
  constexpr const char* kNames[]{"pinhole", "adof", "dof", "power", "astigmatism", "accommodation", "blur"};
  return kNames[static_cast<std::size_t>(mode)];
}

// Stands for the build: whatever is changed in it may change the picture.
std::string program_digest() {
  std::ifstream in("/proc/self/exe", std::ios::binary);
  Digest digest;
  digest.add(std::string(std::istreambuf_iterator<char>(in), {}));
  return digest.text();
}

double pixels_per_degree(const SceneOptions& scene, int height) {
  if (!scene.headset.empty()) {
    return lenses::read_headset(scene.headset).pixels_per_degree;
  }
  constexpr double kDegree = std::numbers::pi / 180.0;
  return kDegree * height / (2.0 * std::tan(0.5 * scene.fov_deg * kDegree));  // in the middle of the picture
}

// A setting that is timed again and again.
struct Job {
  render::Rung rung;
  render::FrameConfig config;
  TradeoffRow row = {};
  std::vector<StageTimes> rounds = {};
  double seconds = 0.0;
};

double total_ms(const StageTimes& times) {
  double sum = 0.0;
  for (const auto& [stage, ms] : times) {
    sum += ms;
  }
  return sum;
}

class Tradeoff {
 public:
  Tradeoff(const TradeoffConfig& config, const render::Scene& scene, const TradeoffProgress& progress)
      : config_(config),
        scene_(scene),
        progress_(progress),
        setup_(make_render_setup(config.scene, scene)),
        pixels_per_degree_(pixels_per_degree(config.scene, setup_.size[1])),
        device_(open_device(config.device)),
        renderer_(device_, scene, {.traversal = render::Traversal::automatic, .traversal_file = traversal_file()}) {}

  TradeoffResult run() {
    describe();
    find_reference();
    for (const render::Rung& rung : config_.rungs) {
      jobs_.push_back({.rung = rung, .config = frame_config(rung)});
    }
    const int all = static_cast<int>(jobs_.size());
    for (auto job = jobs_.begin(); job != jobs_.end();) {
      say(std::string(job->rung.name), static_cast<int>(result_.pictures.size()), all);
      job = can_draw(*job) ? job + 1 : jobs_.erase(job);
    }
    if (jobs_.empty()) {
      throw render::vk::DeviceError("no setting can be drawn: " + result_.report.left_out.front());
    }
    // All take turns, so that what else the machine does meets all of them alike.
    for (int round = 0; round < config_.rounds; ++round) {
      say("round", round, config_.rounds);
      for (Job& job : jobs_) {
        if (job.rounds.empty() || job.seconds < config_.most_seconds) {
          time(job);
        }
      }
    }
    report();
    close_device(device_);
    return std::move(result_);
  }

 private:
  void say(const std::string& what, int done, int of) const {
    if (progress_) {
      progress_(what, done, of);
    }
  }

  void describe() {
    TradeoffReport& report = result_.report;
    report.scene = scene_.source;
    report.device = device_.name();
    report.wearer = config_.scene.wearer.empty() ? "35 years, emmetropic" : config_.scene.wearer;
    report.spectacles = setup_.pairs.front().name;
    for (std::size_t i = 1; i < setup_.pairs.size(); ++i) {
      report.spectacles += " | " + setup_.pairs[i].name;
    }
    report.fov_deg = config_.scene.fov_deg;
    report.pixels_per_degree = pixels_per_degree_;
    report.reference_samples = config_.reference_samples;
    report.accuracy = config_.accuracy;
    for (const render::ViewSetup& view : setup_.views) {
      report.iterations += render::iteration_histogram(view, setup_.lenses, setup_.size[0], setup_.size[1]);
    }
    report.width = layout().picture_width();
    report.height = layout().height;
  }

  [[nodiscard]] PictureLayout layout() const {
    return {setup_.size[0], setup_.size[1], setup_.pairs.size(), setup_.sides.size()};
  }

  [[nodiscard]] render::FrameConfig frame_config(const render::Rung& rung) const {
    render::FrameConfig config;
    config.width = setup_.size[0];
    config.height = setup_.size[1];
    config.mode = rung.mode.value_or(Mode::adof);
    config.accuracy = rung.accuracy;
    config.threshold_px = config_.threshold_px;
    config.exposure = config_.exposure;
    config.seed = config_.seed;
    config.samples = rung.samples.value_or(1);
    if (render::is_map(config.mode)) {
      config.range = render::MapRange{-1.0, 3.0};
    }
    return config;
  }

  void find_reference() {
    render::FrameConfig config;
    config.width = setup_.size[0];
    config.height = setup_.size[1];
    config.mode = Mode::dof;
    config.accuracy.lens.in_double = device_.limits().has_float64;
    result_.report.reference_in_double = config.accuracy.lens.in_double;
    config.samples = config_.reference_samples;
    config.seed = config_.seed ^ kReferenceSeed;
    config.exposure = config_.exposure;
    const std::string key =
        reference_key(scene_, setup_.lenses, setup_.views, config, device_.name(), program_digest());
    const ReferenceStore store(config_.cache);
    const int width = layout().picture_width(), height = layout().height;
    if (auto kept = store.find(key); kept && kept->width == width && kept->height == height) {
      result_.reference = std::move(*kept);
      result_.report.reference_kept = true;
      return;
    }
    const auto progress = [this](int done, int of) { say("reference", done, of); };
    result_.reference = compose_display(layout(), renderer_.render(setup_.lenses, setup_.views, config, progress));
    store.keep(key, result_.reference);
  }

  bool can_draw(Job& job) {
    try {
      look_at(job);
      return true;
    } catch (const render::vk::DeviceError& error) {
      result_.report.left_out.push_back(std::string(job.rung.name) + ": " + error.what());
      return false;
    }
  }

  // The picture and its errors; compiled before, so that a slow frame need not be drawn again for its time.
  void look_at(Job& job) {
    renderer_.prepare(setup_.lenses, setup_.views, job.config);
    render::FrameConfig config = job.config;
    config.keep_wavefront = true;
    if (!render::is_map(config.mode) && config.accuracy.lens.cubics == render::TileCubics::in_pictures) {
      config.accuracy.lens.cubics = render::TileCubics::always;  // the wavefronts of the picture that is timed
    }
    const render::RenderedFrame frame = renderer_.render(setup_.lenses, setup_.views, config);
    job.row.setting = job.rung.name;
    job.row.subject = job.rung.subject;
    job.row.what = job.rung.what;
    job.row.mode = name(config.mode);
    job.row.samples = frame.samples;
    render::Image8 picture = compose_display(layout(), frame);
    if (!render::is_map(config.mode)) {
      const render::Comparison comparison = render::compare(picture, result_.reference);
      job.row.rmse = comparison.rmse;
      job.row.psnr_db = comparison.psnr_db;
      job.row.flip = render::flip(picture, result_.reference, pixels_per_degree_).mean;
    }
    result_.pictures.push_back(std::move(picture));
    compare_wavefronts(frame, job.row);
    // Once for the picture and once for the time would be too long; the wavefront's trace is lost in so many samples.
    constexpr int kManySamples = 128;
    if (config.mode == Mode::dof && config.samples >= kManySamples) {
      keep_time(job, frame);
    }
  }

  void compare_wavefronts(const render::RenderedFrame& frame, TradeoffRow& row) {
    if (wavefronts_.empty()) {
      for (const render::ViewSetup& view : setup_.views) {
        wavefronts_.emplace_back(setup_.lenses, view, setup_.size[0], setup_.size[1]);
      }
    }
    std::vector<double> power, astigmatism;
    for (std::size_t i = 0; i < wavefronts_.size(); ++i) {
      wavefronts_[i].append_differences(frame.views[i].wavefront, power, astigmatism);
    }
    if (const auto error = render::wavefront_error(std::move(power), std::move(astigmatism))) {
      row.power_error_D_p99 = error->power_p99;
      row.astigmatism_error_D_p99 = error->astigmatism_p99;
    }
  }

  void time(Job& job) { keep_time(job, renderer_.render(setup_.lenses, setup_.views, job.config)); }

  void keep_time(Job& job, const render::RenderedFrame& frame) const {
    StageTimes times;
    for (const render::vk::StageTime& stage : frame.stages) {
      times.emplace_back(stage.name, stage.milliseconds);
    }
    if (times.empty()) {
      throw render::vk::DeviceError(device_.name() + " has no timestamps; tradeoff needs them");
    }
    job.seconds += 1e-3 * total_ms(times);
    job.rounds.push_back(std::move(times));
  }

  void report() {
    for (Job& job : jobs_) {
      BenchRow timed;
      set_times(timed, job.rounds);
      job.row.ms = timed.ms;
      job.row.stages = timed.stages;
      job.row.rounds = static_cast<int>(job.rounds.size());
      result_.report.rows.push_back(std::move(job.row));
    }
    mark_efficient(result_.report.rows);
    const TradeoffRow* chosen = find_row(result_.report.rows, config_.accuracy);
    result_.report.target_rmse = config_.target_rmse.value_or(chosen != nullptr ? chosen->rmse.value_or(0.0) : 0.0);
  }

  const TradeoffConfig& config_;
  const render::Scene& scene_;
  const TradeoffProgress& progress_;
  RenderSetup setup_;
  double pixels_per_degree_;
  render::vk::Device device_;
  render::Renderer renderer_;
  std::vector<Job> jobs_;
  std::vector<render::WavefrontReference> wavefronts_;  // one a view, made when first asked for
  TradeoffResult result_;
};

}  // namespace

TradeoffResult run_tradeoff(const TradeoffConfig& config, const render::Scene& scene,
                            const TradeoffProgress& progress) {
  return Tradeoff(config, scene, progress).run();
}

}  // namespace app
