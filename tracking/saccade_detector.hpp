// Fixations and saccades by velocity (I-VT, Salvucci and Goldberg 2000), the threshold a multiple of the noise that the
// tracker shows while the eye is still (after Engbert and Kliegl 2003, with the median as a robust scale). Directions
// are the world's, so that an eye that counters the head's turn counts as still.
#pragma once

#include <deque>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "tracking/live_config.hpp"

namespace tracking {

enum class GazePhase { fixation, saccade };

class SaccadeDetector {
 public:
  explicit SaccadeDetector(const SaccadeConfig& config = {}) : config_(config) {}

  // A unit direction at a time later than the last; one that is not later changes nothing.
  GazePhase see(double time, const glm::dvec3& direction);

  // After a loss: what came before says nothing about speed. The noise is remembered.
  void restart();

  // All directions so far are to be seen in axes that have turned.
  void turn(const glm::dquat& new_from_old);

  [[nodiscard]] GazePhase phase() const { return phase_; }
  [[nodiscard]] double threshold() const { return threshold_; }  // rad/s, in force
  [[nodiscard]] double speed() const { return speed_; }          // rad/s, of the last sample

 private:
  struct Sample {
    double time;
    glm::dvec3 direction;
  };

  void remember_speed();

  SaccadeConfig config_;
  std::deque<Sample> samples_;  // back to one at least a window old
  std::deque<double> speeds_;   // while still
  double speed_ = 0.0;
  double threshold_ = config_.least_speed > config_.noise_multiple* config_.start_noise
                          ? config_.least_speed
                          : config_.noise_multiple* config_.start_noise;
  double began_ = 0.0;  // of the saccade
  bool overlong_ = false;
  GazePhase phase_ = GazePhase::fixation;
};

}  // namespace tracking
