#include "lenses/lens_io/live_config_reader.hpp"

#include <nlohmann/json.hpp>

namespace lenses::io {
namespace {

using tracking::AccommodationConfig;
using tracking::GazeConfig;
using tracking::kDegree;
using tracking::OneEuroConfig;
using tracking::PupilConfig;
using tracking::SaccadeConfig;

constexpr Limits kLatency = plain(0.0, 2.0);

void read_accommodation(const Field& object, AccommodationConfig& config) {
  object.allow_only({"latency_s", "time_constant_s", "slope", "tonic_D", "depth_of_focus_D"});
  object.read("latency_s", kLatency, config.latency);
  object.read("time_constant_s", plain(0.01, 5.0), config.time_constant);
  object.read("slope", plain(0.1, 1.5), config.slope);
  object.read("tonic_D", plain(0.0, 5.0), config.tonic);
  object.read("depth_of_focus_D", plain(0.0, 2.0), config.depth_of_focus);
}

void read_pupil(const Field& object, PupilConfig& config) {
  object.allow_only({"latency_s", "constriction_time_constant_s", "dilation_time_constant_s"});
  object.read("latency_s", kLatency, config.latency);
  object.read("constriction_time_constant_s", plain(0.01, 10.0), config.constriction_time_constant);
  object.read("dilation_time_constant_s", plain(0.01, 10.0), config.dilation_time_constant);
}

void read_filter(const Field& object, OneEuroConfig& config) {
  object.allow_only({"rest_cutoff_Hz", "speed_slope_per_deg", "speed_cutoff_Hz"});
  object.read("rest_cutoff_Hz", plain(0.01, 100.0), config.rest_cutoff);
  if (const auto slope = object.find("speed_slope_per_deg")) {
    config.speed_slope = slope->number(plain(0.0, 10.0)) / kDegree;
  }
  object.read("speed_cutoff_Hz", plain(0.01, 100.0), config.speed_cutoff);
}

void read_saccade(const Field& object, SaccadeConfig& config) {
  object.allow_only({"least_speed_deg_per_s", "noise_multiple", "start_noise_deg_per_s", "window_s", "longest_s"});
  object.read("least_speed_deg_per_s", degrees(1.0, 1000.0), config.least_speed);
  object.read("noise_multiple", plain(1.0, 50.0), config.noise_multiple);
  object.read("start_noise_deg_per_s", degrees(0.0, 1000.0), config.start_noise);
  object.read("window_s", plain(0.001, 0.1), config.window);
  object.read("longest_s", plain(0.02, 2.0), config.longest);
}

void read_tracking(const Field& object, GazeConfig& config) {
  object.allow_only(
      {"target", "pupil_position", "saccade", "noise_deg", "hold_s", "return_time_constant_s", "depth_dwell_s"});
  if (const auto filter = object.find("target")) read_filter(*filter, config.target);
  if (const auto filter = object.find("pupil_position")) read_filter(*filter, config.pupil);
  if (const auto saccade = object.find("saccade")) read_saccade(*saccade, config.saccade);
  object.read("noise_deg", degrees(0.0, 10.0), config.noise);
  object.read("hold_s", plain(0.1, 10.0), config.hold);
  object.read("return_time_constant_s", plain(0.0, 10.0), config.return_time_constant);
  object.read("depth_dwell_s", plain(0.0, 2.0), config.depth_dwell);
}

}  // namespace

tracking::LiveConfig read_live_config(const Field& wearer) {
  tracking::LiveConfig config;
  if (const auto object = wearer.find("accommodation")) read_accommodation(*object, config.accommodation);
  if (const auto object = wearer.find("pupil")) read_pupil(*object, config.pupil);
  if (const auto object = wearer.find("tracking")) read_tracking(*object, config.gaze);
  return config;
}

}  // namespace lenses::io
