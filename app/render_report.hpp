// What a rendered picture says in numbers: the line of sight of each eye behind each pair, and the milliseconds of each
// stage.
#pragma once

#include <string>
#include <vector>

#include "app/render_setup.hpp"
#include "app/start_up.hpp"
#include "app/viewer_report.hpp"
#include "render/vk/device.hpp"

namespace app {

// One eye on the fixated point.
struct SightRow {
  std::string pair, eye;
  double yaw_deg = 0.0, pitch_deg = 0.0;  // gaze before the lens, head axes
  double distance_m = 0.0;                // fixation, from the midpoint between the eyes; infinite: sky
  std::string status;
  double power_D = 0.0, astigmatism_D = 0.0;  // of the wavefront at the pupil
  double demand_D = 0.0, accommodation_D = 0.0;
  double residual_D = 0.0;                                  // mean
  double blur_major_arcmin = 0.0, blur_minor_arcmin = 0.0;  // semi-axes
};

[[nodiscard]] std::vector<SightRow> sight_rows(const RenderSetup& setup);

struct StageRow {
  std::string stage;
  double median_ms = 0.0, min_ms = 0.0, max_ms = 0.0;
};

// One list of stages a repetition.
[[nodiscard]] std::vector<StageRow> stage_rows(const std::vector<std::vector<render::vk::StageTime>>& runs);

struct RenderReport {
  std::string output, device, mode;
  int width = 0, height = 0;  // of each view
  std::size_t triangles = 0, views = 0;
  int samples = 1;
  double error_estimate = 0.0;
  bool is_map = false;
  double range_low = 0.0, range_high = 0.0;
  std::string range_unit;
  std::vector<SightRow> sight;
  std::vector<ViewerFinding> findings;
  std::vector<StageRow> stages;
  StartUp::Parts start_up;
  double peak_memory_mib = 0.0;
};

[[nodiscard]] std::string to_table(const RenderReport& report);
[[nodiscard]] std::string to_json(const RenderReport& report);

// Throws tracking::InputError if the file holds anything but such a table.
void check_timings(const std::string& file);

// Adds this picture's stages to a CSV file (made with a header if absent), all or nothing; the parts of the start-up as
// stages named "start: ...".
void append_timings(const std::string& file, const RenderReport& report);

}  // namespace app
