// How a wearer's eyes move, focus and open in time, and how a tracker's gaze is read: the parameters that a wearer file
// may set. SI units; the ranges that make sense are the reader's.
#pragma once

#include <numbers>

namespace tracking {

inline constexpr double kDegree = std::numbers::pi / 180.0;  // rad

// 1 Euro filter (Casiez, Roussel and Vogel 2012): a low pass whose cutoff is rest_cutoff + speed_slope * speed.
struct OneEuroConfig {
  double rest_cutoff = 1.0;   // Hz, of what stands still
  double speed_slope = 0.0;   // Hz for each radian a second
  double speed_cutoff = 1.0;  // Hz, of the low pass that the speed itself goes through
  bool operator==(const OneEuroConfig&) const = default;
};

// Saccades by a velocity threshold that adapts to the tracker's noise (I-VT with Engbert and Kliegl's robust scale).
struct SaccadeConfig {
  double least_speed = 30.0 * kDegree;  // rad/s: no slower movement is a saccade
  double noise_multiple = 6.0;          // of the standard deviation of an axis's speed
  double start_noise = 20.0 * kDegree;  // rad/s: that deviation until it has been measured
  double window = 0.02;                 // s over which a speed is taken
  double longest = 0.15;                // s; what lasts longer is no saccade
  bool operator==(const SaccadeConfig&) const = default;
};

struct GazeConfig {
  // The target: what is looked at, for accommodation and for what follows the gaze on the picture.
  OneEuroConfig target{.rest_cutoff = 1.5, .speed_slope = 0.1 / kDegree, .speed_cutoff = 1.0};
  // The pupil's position: whatever moves it shakes the picture behind a strong lens, so it rests far more.
  OneEuroConfig pupil{.rest_cutoff = 0.2, .speed_slope = 0.08 / kDegree, .speed_cutoff = 0.4};
  SaccadeConfig saccade;
  double noise = 0.3 * kDegree;       // rad rms of one eye's direction: how far vergence is trusted
  double hold = 0.5;                  // s that the last gaze is held through a blink or a loss
  double return_time_constant = 0.2;  // s, from there to the head's own direction
  double depth_dwell = 0.1;           // s that another depth must last to be looked at without a saccade
  bool operator==(const GazeConfig&) const = default;
};

// The response to a demand D is tonic + slope * (D - tonic), reached after the latency as 1 - exp(-t / time_constant).
struct AccommodationConfig {
  double latency = 0.35;        // s
  double time_constant = 0.25;  // s
  double slope = 0.9;
  double tonic = 0.75;          // D
  double depth_of_focus = 0.3;  // D to either side: smaller changes of demand are not answered
  bool operator==(const AccommodationConfig&) const = default;
};

// A pupil constricts about three times as fast as it dilates (Ellis 1981; Pamplona, Oliveira and Baranoski 2009).
struct PupilConfig {
  double latency = 0.22;                     // s (Lee, Cohen and Boynton 1969: 0.18 to 0.3 by luminance)
  double constriction_time_constant = 0.25;  // s
  double dilation_time_constant = 0.75;      // s
  bool operator==(const PupilConfig&) const = default;
};

struct LiveConfig {
  GazeConfig gaze;
  AccommodationConfig accommodation;
  PupilConfig pupil;
  bool operator==(const LiveConfig&) const = default;
};

}  // namespace tracking
