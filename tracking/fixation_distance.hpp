// How far away the eyes look, in dioptres from the midpoint between them: from where their lines come nearest each
// other, and from what the scene holds along the gaze.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace tracking {

struct Line {
  glm::dvec3 origin{0.0};                // m
  glm::dvec3 direction{0.0, 0.0, -1.0};  // unit
};

struct VergenceEstimate {
  double dioptres = 0.0;  // 1/m; 0: parallel, negative: the lines diverge
  double sigma = 0.0;  // D, its standard error: the tracker's noise, and more where the lines pass far from each other
};

// direction_noise: rad rms of each line. The lines' directions differ by q times the baseline across the gaze, which q
// fits by least squares; so parallel and diverging lines need no case of their own. It leaves out terms of second order
// in baseline / distance, 0.6 % at 40 cm. No baseline across the gaze: nothing is known.
[[nodiscard]] std::optional<VergenceEstimate> vergence_estimate(const Line& right, const Line& left,
                                                                double direction_noise);

struct FixationDistance {
  enum class From { scene, vergence, nothing };
  double dioptres = 0.0;  // >= 0; 0: the sky
  From from = From::nothing;
};

// `scene`: dioptres of what lies along the gaze (0 for the sky), the line's own first, then what lies beside it within
// the tracker's error. Vergence picks among them; where it agrees with none to within three standard errors, it is
// itself the distance, as a gaze at something that the scene does not hold.
[[nodiscard]] FixationDistance fixation_distance(std::span<const double> scene,
                                                 const std::optional<VergenceEstimate>& vergence);

// The depth that is looked at in time. Noise across an edge makes the scene's depth flicker, and both eyes' lines with
// it: another depth counts once it has lasted, at once after a saccade, and is approached as the eyes converge.
class DepthHold {
 public:
  // dwell: s; convergence_time_constant: s.
  explicit DepthHold(double dwell, double convergence_time_constant = 0.08)
      : dwell_(dwell), time_constant_(convergence_time_constant) {}

  // Dioptres at a time; `jumped`: the eyes have just made a saccade.
  double see(double time, double dioptres, bool jumped);

 private:
  double dwell_, time_constant_;
  bool started_ = false;
  double time_ = 0.0, value_ = 0.0, goal_ = 0.0;
  double candidate_ = 0.0, candidate_since_ = 0.0;
  bool has_candidate_ = false;
};

}  // namespace tracking
