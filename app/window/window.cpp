#include "app/window/window.hpp"

#include <algorithm>
#include <utility>

#define GLFW_INCLUDE_NONE
#include <vulkan/vulkan_core.h>

#include <GLFW/glfw3.h>

namespace app {
namespace {

constexpr double kShareOfDisplay = 0.8;

[[noreturn]] void fail(const std::string& what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw WindowError(what + (reason != nullptr ? std::string(": ") + reason : ""));
}

// GLFW as a whole, for as long as there is a window.
struct Library {
  Library() {
    if (glfwInit() != GLFW_TRUE) {
      fail("no display for a window");
    }
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

bool is_printable_ascii(const char* name) {
  return name != nullptr && name[0] > ' ' && name[0] < 127 && name[1] == '\0';
}

// What is printed on a key depends on the keyboard; where that is no letter of ours, its place on an American one
// counts.
std::string name_of(int key, int scancode) {
  switch (key) {
    case GLFW_KEY_SPACE:
      return "space";
    case GLFW_KEY_ESCAPE:
      return "escape";
    default:
      break;
  }
  if (const char* name = glfwGetKeyName(key, scancode); is_printable_ascii(name)) {
    return name;
  }
  return key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? std::string(1, static_cast<char>('a' + (key - GLFW_KEY_A))) : "";
}

}  // namespace

struct Window::State {
  explicit State(const std::string& title) {
    if (glfwVulkanSupported() != GLFW_TRUE) {
      fail("the display takes no windows for Vulkan");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_TRUE);
    window.reset(glfwCreateWindow(640, 360, title.c_str(), nullptr, nullptr));
    if (!window) {
      fail("no window on the display");
    }
    glfwSetWindowUserPointer(window.get(), this);
    glfwSetKeyCallback(window.get(), [](GLFWwindow* on, int key, int scancode, int action, int) {
      if (action == GLFW_PRESS) {
        if (std::string name = name_of(key, scancode); !name.empty()) {
          of(on).pressed.push_back(std::move(name));
        }
      }
    });
    glfwSetWindowRefreshCallback(window.get(), [](GLFWwindow* on) { of(on).damaged = true; });
  }

  static State& of(GLFWwindow* window) { return *static_cast<State*>(glfwGetWindowUserPointer(window)); }

  struct Destroy {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
  };

  Library library;
  std::unique_ptr<GLFWwindow, Destroy> window;
  std::vector<std::string> pressed;
  bool damaged = false;
};

Window::Window(const std::string& title) : state_(std::make_unique<State>(title)) {}
Window::~Window() = default;

void Window::fit(int width, int height) {
  double scale = 1.0;
  if (GLFWmonitor* monitor = glfwGetPrimaryMonitor(); monitor != nullptr) {
    int x = 0, y = 0, across = 0, down = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &across, &down);
    scale = std::min({1.0, kShareOfDisplay * across / width, kShareOfDisplay * down / height});
  }
  glfwSetWindowSize(state_->window.get(), std::max(1, static_cast<int>(scale * width)),
                    std::max(1, static_cast<int>(scale * height)));
}

void Window::show() {
  glfwShowWindow(state_->window.get());
}

void Window::hide() {
  glfwHideWindow(state_->window.get());
}

void Window::poll(double seconds) {
  if (seconds > 0.0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

std::vector<std::string> Window::pressed() {
  return std::exchange(state_->pressed, {});
}

std::array<int, 2> Window::size() const {
  GLFWwindow* const window = state_->window.get();
  if (glfwGetWindowAttrib(window, GLFW_VISIBLE) != GLFW_TRUE ||
      glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE) {
    return {0, 0};
  }
  std::array<int, 2> size{};
  glfwGetFramebufferSize(window, &size[0], &size[1]);
  return size;
}

bool Window::is_damaged() {
  return std::exchange(state_->damaged, false);
}

bool Window::close_wanted() const {
  return glfwWindowShouldClose(state_->window.get()) == GLFW_TRUE;
}

render::vk::WindowBinding Window::binding() const {
  std::uint32_t count = 0;
  const char** const names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) {
    fail("the display takes no windows for Vulkan");
  }
  return {{names, names + count}, [window = state_->window.get()](VkInstance instance) {
            VkSurfaceKHR surface = VK_NULL_HANDLE;
            if (glfwCreateWindowSurface(instance, window, nullptr, &surface) != VK_SUCCESS) {
              fail("no pictures in a window of the display");
            }
            return surface;
          }};
}

}  // namespace app
