#include "app/bench_run.hpp"

#include <algorithm>
#include <ctime>
#include <thread>
#include <utility>

#include "app/device.hpp"
#include "app/option_values.hpp"
#include "render/chief_rays.hpp"
#include "render/device_speed.hpp"
#include "render/renderer.hpp"

namespace app {
namespace {

render::FrameConfig frame_config(const BenchRow& row, const BenchConfig& bench) {
  render::FrameConfig config;
  config.width = config.height = row.size;
  config.mode = row.mode == "adof"  ? render::Mode::adof
                : row.mode == "vis" ? render::Mode::power
                : row.mode == "pin" ? render::Mode::pinhole
                                    : render::Mode::dof;
  config.threshold_px = bench.threshold_px;
  config.exposure = bench.exposure;
  config.seed = bench.seed;
  config.samples = 1;
  config.accuracy = bench.accuracy;
  config.bare = row.shading == "bare";
  config.range = render::MapRange{-1.0, 3.0};
  return config;
}

StageTimes times_of(const render::RenderedFrame& frame) {
  StageTimes times;
  for (const render::vk::StageTime& stage : frame.stages) {
    times.emplace_back(stage.name, stage.milliseconds);
  }
  return times;
}

// Of this process, all threads together.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// A frame that is timed again and again.
struct Job {
  BenchRow row;
  const RenderSetup* setup;
  std::vector<StageTimes> rounds = {};
  std::vector<double> cpu = {};
};

struct PeerJob {
  PeerRow row;
  const RenderSetup* setup;
  std::vector<double> rounds = {}, cpu = {};
};

struct SizeJobs {
  std::vector<Job> frames;
  std::vector<PeerJob> peers;
};

class Bench {
 public:
  Bench(const BenchConfig& config, const render::Scene& scene, const BenchProgress& progress)
      : config_(config),
        scene_(scene),
        progress_(progress),
        setups_(make_setups()),
        device_(open_device(config.device)),
        renderer_(device_, scene, {.traversal = config.traversal, .traversal_file = traversal_file()}),
        peer_(scene) {
    report_.peer_threads = std::max(1U, std::thread::hardware_concurrency());
  }

  BenchReport run() {
    report_.scene = scene_.source;
    report_.device = device_.name();
    report_.triangles = scene_.triangles.size();
    report_.rounds = config_.rounds;
    report_.on_processor = device_.limits().on_processor;
    const render::DeviceSpeed speed = render::measure_speed(device_);
    report_.gflops = speed.gflops;
    report_.gigabytes_per_s = speed.gigabytes_per_s;
    std::vector<SizeJobs> sizes;
    for (const int size : config_.sizes) {
      sizes.push_back(jobs_of(size));
    }
    // Round 0 compiles and does not count. In the others everything takes turns, sizes too, so that what else the
    // machine does meets all of it alike.
    for (int round = 0; round <= config_.rounds; ++round) {
      for (SizeJobs& jobs : sizes) {
        measure_frames(round, jobs.frames);
        measure_peers(round, jobs.peers);
      }
    }
    for (SizeJobs& jobs : sizes) {
      report(jobs);
    }
    close_device(device_);
    return std::move(report_);
  }

 private:
  // One a lens; the field of view is square, so one serves every size.
  std::vector<RenderSetup> make_setups() {
    std::vector<RenderSetup> setups;
    for (const BenchLens& lens : config_.lenses) {
      SceneOptions scene = config_.scene;
      scene.spectacles = lens.spectacles;
      scene.compare.clear();
      scene.size = "512x512";
      scene.eye = "right";  // one eye, as the paper measured
      setups.push_back(make_render_setup(scene, scene_));
    }
    return setups;
  }

  // In full only the mode that is for looking at, unless nothing else is asked for.
  [[nodiscard]] bool wanted(const std::string& mode, const std::string& shading) const {
    return shading == "bare" || config_.shadings.size() == 1 || mode == "adof";
  }

  SizeJobs jobs_of(int size) {
    SizeJobs jobs;
    for (std::size_t i = 0; i < config_.lenses.size(); ++i) {
      const std::string& lens = config_.lenses[i].name;
      for (const std::string& mode : config_.modes) {
        for (const std::string& shading : config_.shadings) {
          if (wanted(mode, shading)) {
            jobs.frames.push_back({BenchRow{.lens = lens,
                                            .mode = mode,
                                            .shading = shading,
                                            .size = size,
                                            .triangles = scene_.triangles.size(),
                                            .ms = {},
                                            .cpu = {},
                                            .stages = {},
                                            .device = device_.name()},
                                   &setups_[i]});
          }
        }
      }
      jobs.peers.push_back({PeerRow{lens, size, 0, {}}, &setups_[i]});
    }
    return jobs;
  }

  void measure_frames(int round, std::vector<Job>& jobs) {
    // The first of a size pays for new buffers: once more, untimed.
    static_cast<void>(drawn(jobs.front()));
    for (Job& job : jobs) {
      if (progress_) {
        progress_(job.row, round);
      }
      const double start = processor_ms();
      StageTimes times = times_of(drawn(job));
      const double cpu = processor_ms() - start;
      if (times.empty()) {
        throw render::vk::DeviceError(device_.name() + " has no timestamps; bench needs them");
      }
      if (round > 0) {
        job.rounds.push_back(std::move(times));
        job.cpu.push_back(cpu);
      }
    }
  }

  render::RenderedFrame drawn(const Job& job) {
    return renderer_.render(job.setup->lenses, job.setup->views, frame_config(job.row, config_));
  }

  // The rays are found anew each time, untimed: those of every lens at once would fill half a gigabyte.
  void measure_peers(int round, std::vector<PeerJob>& peers) const {
    if (round == 0) {
      return;
    }
    for (PeerJob& peer : peers) {
      const int size = peer.row.size;
      const auto rays = render::chief_rays(peer.setup->views.front(), peer.setup->lenses, size, size);
      peer.row.rays = rays.size();
      const double start = processor_ms();
      peer.rounds.push_back(peer_.trace(rays, report_.peer_threads).milliseconds);
      peer.cpu.push_back(processor_ms() - start);
    }
  }

  void report(SizeJobs& jobs) {
    for (Job& job : jobs.frames) {
      set_times(job.row, job.rounds);
      job.row.cpu = spread_of(std::move(job.cpu));
      report_.rows.push_back(std::move(job.row));
    }
    for (PeerJob& peer : jobs.peers) {
      peer.row.ms = spread_of(std::move(peer.rounds));
      peer.row.cpu = spread_of(std::move(peer.cpu));
      report_.peers.push_back(std::move(peer.row));
    }
  }

  const BenchConfig& config_;
  const render::Scene& scene_;
  const BenchProgress& progress_;
  std::vector<RenderSetup> setups_;
  render::vk::Device device_;
  render::Renderer renderer_;
  render::PacketTracer peer_;
  BenchReport report_;
};

}  // namespace

BenchReport run_bench(const BenchConfig& config, const render::Scene& scene, const BenchProgress& progress) {
  return Bench(config, scene, progress).run();
}

}  // namespace app
