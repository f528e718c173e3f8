// A session and its life: the runtime says by events when to begin, to stop and to go.
#pragma once

#include "xr/instance.hpp"

namespace xr {

// Of the Vulkan device that both draws and submits. The runtime may use the queue during xrBeginFrame, xrEndFrame,
// xrAcquireSwapchainImage, xrReleaseSwapchainImage and while the session is made and destroyed; so all of that and
// every submission of ours belong on one thread.
struct GraphicsBinding {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  std::uint32_t queue_family = 0;
  std::uint32_t queue = 0;
};

class Session {
 public:
  // Refers to the instance.
  Session(const Instance& instance, const GraphicsBinding& graphics);
  // Poses and input without pictures; the instance has XR_MND_headless.
  explicit Session(const Instance& instance);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  [[nodiscard]] const Instance& instance() const { return instance_; }
  [[nodiscard]] XrSession handle() const { return session_; }
  [[nodiscard]] XrSessionState state() const { return state_; }
  // Frames are waited for and submitted: from READY to STOPPING. A headset that is taken off stops the session, and
  // begins it again when it is put back on.
  [[nodiscard]] bool is_running() const { return running_; }
  // Input is delivered.
  [[nodiscard]] bool is_focused() const { return state_ == XR_SESSION_STATE_FOCUSED; }
  // The runtime or the user ended it (EXITING).
  [[nodiscard]] bool is_over() const { return over_; }

  // Begins and ends as the event asks; events of other kinds pass by. Throws LostError for a loss that is announced.
  void handle(const XrEventDataBuffer& event);

  // Asks the runtime to go through the states that end in is_over(). A session that never ran is over at once.
  void request_exit();

 private:
  void create(const void* graphics_binding);
  void enter(XrSessionState state);

  const Instance& instance_;
  XrSession session_ = XR_NULL_HANDLE;
  XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
  bool running_ = false, over_ = false;
};

[[nodiscard]] std::string state_name(XrSessionState state);

}  // namespace xr
