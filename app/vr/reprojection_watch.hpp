// What the runtime's reprojection gets wrong behind lenses while the head turns: it turns the picture as if the lens
// stood in the room, and a spectacle lens turns with the head.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "app/render_setup.hpp"

namespace app {

class ReprojectionWatch {
 public:
  // The head of the frame at `time` (s). The speed is that since the frame before; 0 for the first, and after a pause
  // or a time that does not grow.
  void see(double time, const tracking::Pose& world_from_head);
  // The world moved, not the head: the next frame is a first one.
  void forget() { last_.reset(); }

  // Whether a speed is known of the last frame.
  [[nodiscard]] bool is_known() const { return known_; }
  // rad/s about the head's axes.
  [[nodiscard]] const glm::dvec3& head_turn() const { return turn_; }

  // rad, in the picture: the largest of all pairs' eyes in the direction they look (by Side, head axes), for a picture
  // shown `late` seconds after the moment that it was drawn for, at the present turn. 0 where nothing is seen through a
  // lens.
  [[nodiscard]] double error(const lenses::LensModel& lenses, std::span<const WornPair> pairs,
                             const std::array<glm::dvec3, 2>& gaze, double late) const;

 private:
  struct Seen {
    double time;
    glm::dquat orientation;
  };
  std::optional<Seen> last_;
  bool known_ = false;
  glm::dvec3 turn_{0.0};
};

}  // namespace app
