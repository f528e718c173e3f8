// A row of the trade-off: one setting, what it costs in time and how far its picture and wavefronts are from the
// reference.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/bench/bench_row.hpp"
#include "render/lens_forms/iteration_histogram.hpp"

namespace app {

struct TradeoffRow {
  std::string setting, subject, what;  // of the rung
  std::string mode;                    // as --mode calls it
  int samples = 1;                     // rays a pixel through the pupil
  Spread ms = {};                      // sums of a frame's stages
  int rounds = 0;
  StageTimes stages = {};  // medians
  // Of the picture's display values as fractions of full scale; a map is no picture and has none.
  std::optional<double> rmse = {}, psnr_db = {}, flip = {};
  std::optional<double> power_error_D_p99 = {}, astigmatism_error_D_p99 = {};
  bool efficient = false;  // no other setting is both as fast and as good
};

struct TradeoffReport {
  std::string scene, device, wearer, spectacles;
  int width = 0, height = 0;  // of the whole picture
  double fov_deg = 0.0, pixels_per_degree = 0.0;
  int reference_samples = 0;
  bool reference_kept = false;            // found in the cache
  double target_rmse = 0.0;               // that the samples of mode dof are counted for
  std::string accuracy;                   // the setting that the advice begins with
  render::IterationHistogram iterations;  // of every pixel's chief ray in single precision
  std::vector<TradeoffRow> rows;
  std::vector<std::string> left_out;  // settings that the device cannot draw, with its reason
};

// Sets `efficient`: rows with a picture that no other row beats in time without being worse, or in error without being
// slower. Of equals the first.
void mark_efficient(std::vector<TradeoffRow>& rows);
// Those rows from the fastest on; their errors fall.
[[nodiscard]] std::vector<const TradeoffRow*> efficient_rows(std::span<const TradeoffRow> rows);

[[nodiscard]] const TradeoffRow* find_row(std::span<const TradeoffRow> rows, const std::string& setting);

// What mode dof needs for an error: between the measured numbers of samples on a straight line of logarithms.
struct DofNeed {
  double samples = 0.0, ms = 0.0;
  bool at_most = false;    // the fewest that were measured are good enough
  bool more_than = false;  // not even the most are
};
// Nothing without a row of mode dof.
[[nodiscard]] std::optional<DofNeed> dof_need(std::span<const TradeoffRow> rows, double rmse);

[[nodiscard]] std::string tradeoff_csv(std::span<const TradeoffRow> rows);
[[nodiscard]] std::string tradeoff_json(const TradeoffReport& report);

}  // namespace app
