// A row of the benchmark: one lens, one mode, one size, timed over several rounds; and the paper's own numbers beside
// it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace app {

struct Spread {
  double median = 0.0, min = 0.0, max = 0.0;
};

// Of at least one value; the median of an even number is the mean of the middle two.
[[nodiscard]] Spread spread_of(std::vector<double> values);

// A stage's name and its milliseconds; one list a round.
using StageTimes = std::vector<std::pair<std::string, double>>;

inline const std::array<std::string, 5> kBenchLenses{"none", "sphere/sphere", "sphere/torus", "bspline/sphere",
                                                     "bspline/torus"};
// The front of bspline/sphere with 100 x 100 control points instead of 50 x 50; no lens of the paper's table.
inline const std::string kFineNetLens = "bspline100/sphere";
inline const std::array<std::string, 4> kBenchModes{"adof", "vis", "pin", "dof"};

// bare: as the paper drew, in base colours with one light, no shadow rays and one ray a pixel. full: as `render` draws.
inline const std::array<std::string, 2> kBenchShadings{"bare", "full"};

struct BenchRow {
  std::string lens, mode, shading;
  int size = 0;  // pixels along each side
  std::size_t triangles = 0;
  Spread ms;          // sum of a round's stages
  StageTimes stages;  // medians
  std::string device;

  [[nodiscard]] double pixels() const { return static_cast<double>(size) * size; }
  [[nodiscard]] double fps() const { return ms.median > 0.0 ? 1000.0 / ms.median : 0.0; }
  [[nodiscard]] double stage(const std::string& name) const;  // 0 if it has none of this name
};

// Fills ms and stages; the rounds agree in their stages and are at least one.
void set_times(BenchRow& row, std::span<const StageTimes> rounds);

// Embree's packets on the rays that a lens sends into the scene.
struct PeerRow {
  std::string lens;
  int size = 0;
  std::size_t rays = 0;
  Spread ms;
};

// Frames a second of Table 1 of the paper, at 1024 x 1024 on a GeForce GTX 480.
[[nodiscard]] std::optional<double> paper_fps(const std::string& lens, const std::string& mode);
// Its milliseconds for a row's lens and mode, in proportion to the row's pixels; 0 for what the paper has not.
[[nodiscard]] double paper_ms(const BenchRow& row);
inline constexpr int kPaperSize = 1024;
inline constexpr double kPaperGflops = 1345.0, kPaperGigabytes_per_s = 177.4;  // published for that card

// The contract's object a row, with the rays' peer beside it where there is one.
[[nodiscard]] std::string rows_json(std::span<const BenchRow> rows, std::span<const PeerRow> peers);
[[nodiscard]] std::string rows_csv(std::span<const BenchRow> rows, std::span<const PeerRow> peers);

}  // namespace app
