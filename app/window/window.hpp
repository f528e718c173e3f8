// A plain window on the desktop: its size, its keys, whether it is to be closed. Pictures come into it by
// render::vk::WindowPictures. One at a time, and all of it on the main thread, as GLFW asks.
#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/vk/external.hpp"

namespace app {

// No display, or none that takes windows for Vulkan.
class WindowError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Window {
 public:
  // Hidden. Throws WindowError.
  explicit Window(const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Makes room for a picture of this shape: its own size, or what of the display's it takes up comfortably.
  void fit(int width, int height);
  void show();
  void hide();

  // Takes in what happened, after waiting for it for `seconds` at most.
  void poll(double seconds = 0.0);
  // Keys that went down since the call before, by what is printed on them in lower case: "n", or their name: "space",
  // "escape". Keys held down count once.
  [[nodiscard]] std::vector<std::string> pressed();
  // Pixels; 0, 0 while nobody can see it.
  [[nodiscard]] std::array<int, 2> size() const;
  // The desktop has lost what it showed, since the last call.
  [[nodiscard]] bool is_damaged();
  [[nodiscard]] bool close_wanted() const;

  // For a Device that shows pictures here; the window must outlive it.
  [[nodiscard]] render::vk::WindowBinding binding() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace app
