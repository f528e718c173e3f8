#include "xr/session.hpp"

#include <openxr/openxr_reflection.h>

namespace xr {

std::string state_name(XrSessionState state) {
  switch (state) {
#define VERGENCE_XR_STATE(name, value) \
  case name:                           \
    return #name;
    XR_LIST_ENUM_XrSessionState(VERGENCE_XR_STATE)
#undef VERGENCE_XR_STATE
            default : return "XrSessionState " +
                      std::to_string(static_cast<int>(state));
  }
}

Session::Session(const Instance& instance, const GraphicsBinding& graphics) : instance_(instance) {
  XrGraphicsBindingVulkan2KHR binding{};
  binding.type = XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR;
  binding.instance = graphics.instance;
  binding.physicalDevice = graphics.physical;
  binding.device = graphics.device;
  binding.queueFamilyIndex = graphics.queue_family;
  binding.queueIndex = graphics.queue;
  create(&binding);
}

Session::Session(const Instance& instance) : instance_(instance) {
  create(nullptr);
}

void Session::create(const void* graphics_binding) {
  XrSessionCreateInfo info{};
  info.type = XR_TYPE_SESSION_CREATE_INFO;
  info.next = graphics_binding;
  info.systemId = instance_.system();
  check(xrCreateSession(instance_.handle(), &info, &session_), "xrCreateSession");
}

Session::~Session() {
  xrDestroySession(session_);
}

void Session::handle(const XrEventDataBuffer& event) {
  if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
    throw LostError("openxr: " + instance_.runtime_name() +
                    " is about to go (instance loss pending); start it again, then this command");
  }
  if (event.type != XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
    return;
  }
  const auto& changed = reinterpret_cast<const XrEventDataSessionStateChanged&>(event);
  if (changed.session == session_) {
    enter(changed.state);
  }
}

void Session::enter(XrSessionState state) {
  state_ = state;
  if (state == XR_SESSION_STATE_READY) {
    XrSessionBeginInfo info{};
    info.type = XR_TYPE_SESSION_BEGIN_INFO;
    info.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    check(xrBeginSession(session_, &info), "xrBeginSession");
    running_ = true;
  } else if (state == XR_SESSION_STATE_STOPPING) {
    running_ = false;
    check(xrEndSession(session_), "xrEndSession");
  } else if (state == XR_SESSION_STATE_EXITING) {
    over_ = true;
  } else if (state == XR_SESSION_STATE_LOSS_PENDING) {
    throw LostError("openxr: " + instance_.headset_name() +
                    " is being lost (session loss pending); connect it again, then start this command again");
  }
}

void Session::request_exit() {
  if (!running_) {
    over_ = true;
    return;
  }
  check(xrRequestExitSession(session_), "xrRequestExitSession");
}

}  // namespace xr
