// What a session in the headset was, in numbers.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/viewer_report.hpp"

namespace app {

// Values of one kind, a time in ms if nothing else is said; the last kMost of them are kept, so that a long session
// needs no more memory than a short one.
class TimeRing {
 public:
  static constexpr std::size_t kMost = 10000;

  void add(double value);
  [[nodiscard]] bool empty() const { return times_.empty(); }
  // fraction 0.5: the median. Of nothing: 0.
  [[nodiscard]] double quantile(double fraction) const;

 private:
  std::vector<double> times_;
  std::size_t next_ = 0;
};

struct VrReport {
  std::string runtime, headset, device, space;
  int width = 0, height = 0;  // of each eye's image
  int guard_px = 0;
  // What the headset's lenses hide of the images; what is not drawn therefore, of all pixels that would be.
  double hidden_fraction = 0.0, left_out_fraction = 0.0;
  std::string mask_problem;                 // why the runtime's mask was not taken; empty: it was
  double period = 0.0;                      // s, of the display, as the runtime last gave it
  std::map<std::string, int> gaze_sources;  // frames by where the gaze came from
  std::map<std::string, int> pictures;      // frames by what was worn and shown
  std::map<std::string, int> rungs;         // frames by how exactly they were drawn
  int rung_switches = 0;
  std::string rung_reason;                             // of the last
  std::vector<ViewerFinding> findings;                 // what the person inside should know
  std::size_t kernels_late = 0;                        // compiled after the first picture, while somebody waited
  int shown = 0, skipped = 0;                          // frames with a picture and without
  std::vector<std::pair<std::string, TimeRing>> host;  // parts of a frame on this side, in order
  std::vector<std::pair<std::string, TimeRing>> device_stages;
  // From xrWaitFrame's return to the submission of the picture; and the processor time that this thread spent on the
  // frame, waits for device and images left out.
  TimeRing wait_to_submit, frame_code;
  TimeRing head_speed;          // deg/s, of frames in quick enough succession that it is known
  TimeRing reprojection_error;  // arcmin, see ReprojectionWatch: of a runtime that reprojects by one period
  int reconnections = 0;        // runtimes after the first

  [[nodiscard]] TimeRing& host_part(const std::string& name);
  [[nodiscard]] TimeRing& device_stage(const std::string& name);
};

[[nodiscard]] std::string to_table(const VrReport& report);
[[nodiscard]] std::string to_json(const VrReport& report);

}  // namespace app
