// Between a session in the headset and the window that mirrors it, each on a thread of its own: pictures one way, keys
// and the window's size the other. Neither waits for the other.
#pragma once

#include <array>
#include <mutex>
#include <optional>
#include <vector>

#include "render/mirror_copy.hpp"
#include "xr/controls.hpp"

namespace app {

class MirrorLink {
 public:
  // The session's side.

  // The shape of the pictures to come: from now on there is something to see. The same again changes nothing.
  void expect(int width, int height);
  // Pixels that the window has for them; 0, 0 while nobody can see it.
  [[nodiscard]] std::array<int, 2> room() const;
  // The newest picture. What is left in its place is an older one, for its memory.
  void put(render::MirrorPicture& picture);
  // What the window's keys asked for since the last call.
  [[nodiscard]] std::vector<xr::Control> pressed();

  // The window's side.

  // What is expected, if that is news.
  [[nodiscard]] std::optional<std::array<int, 2>> take_shape();
  void set_room(const std::array<int, 2>& room);
  // A picture that came since the last call, in exchange for an older one.
  bool take(render::MirrorPicture& picture);
  void press(xr::Control control);

 private:
  mutable std::mutex mutex_;
  std::array<int, 2> shape_{};
  bool is_new_shape_ = false;
  std::array<int, 2> room_{};
  render::MirrorPicture picture_;
  bool is_new_picture_ = false;
  std::vector<xr::Control> pressed_;
};

}  // namespace app
