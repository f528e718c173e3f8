#include <nlohmann/json.hpp>

#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/live_config_reader.hpp"
#include "lenses/lens_io/written_number.hpp"

namespace lenses::io {
namespace {

using nlohmann::ordered_json;
using tracking::kDegree;
using tracking::OneEuroConfig;

ordered_json filter_object(const OneEuroConfig& config) {
  const double slope = shortest_in_file(written(config.speed_slope), config.speed_slope * kDegree,
                                        [](double per_degree) { return per_degree / kDegree; });
  return {{"rest_cutoff_Hz", written(config.rest_cutoff)},
          {"speed_slope_per_deg", slope},
          {"speed_cutoff_Hz", written(config.speed_cutoff)}};
}

ordered_json saccade_object(const tracking::SaccadeConfig& config) {
  return {{"least_speed_deg_per_s", written_degrees(config.least_speed)},
          {"noise_multiple", written(config.noise_multiple)},
          {"start_noise_deg_per_s", written_degrees(config.start_noise)},
          {"window_s", written(config.window)},
          {"longest_s", written(config.longest)}};
}

ordered_json tracking_object(const tracking::GazeConfig& config) {
  return {{"target", filter_object(config.target)},
          {"pupil_position", filter_object(config.pupil)},
          {"saccade", saccade_object(config.saccade)},
          {"noise_deg", written_degrees(config.noise)},
          {"hold_s", written(config.hold)},
          {"return_time_constant_s", written(config.return_time_constant)},
          {"depth_dwell_s", written(config.depth_dwell)}};
}

}  // namespace

void add_live_config(ordered_json& wearer, const tracking::LiveConfig& config) {
  const tracking::LiveConfig usual;
  if (const auto& a = config.accommodation; !(a == usual.accommodation)) {
    wearer["accommodation"] = {{"latency_s", written(a.latency)},
                               {"time_constant_s", written(a.time_constant)},
                               {"slope", written(a.slope)},
                               {"tonic_D", written(a.tonic)},
                               {"depth_of_focus_D", written(a.depth_of_focus)}};
  }
  if (const auto& p = config.pupil; !(p == usual.pupil)) {
    wearer["pupil"] = {{"latency_s", written(p.latency)},
                       {"constriction_time_constant_s", written(p.constriction_time_constant)},
                       {"dilation_time_constant_s", written(p.dilation_time_constant)}};
  }
  if (!(config.gaze == usual.gaze)) wearer["tracking"] = tracking_object(config.gaze);
}

}  // namespace lenses::io
