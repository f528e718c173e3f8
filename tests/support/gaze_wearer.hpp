// A program that draws what somebody sees, as far as its gaze goes: our own client over whatever runtime and layers the
// environment names, in a session without pictures.
#pragma once

#include <chrono>
#include <ctime>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tracking/gaze_follower.hpp"
#include "xr/gaze_input.hpp"

namespace support {

class GazeWearer {
 public:
  explicit GazeWearer(std::vector<std::string> extensions = xr::gaze_extensions())
      : instance({.application = "gaze test", .wanted_extensions = with_basics(std::move(extensions))}),
        bindings(instance),
        actions(instance, bindings),
        session(instance),
        view(session, XR_REFERENCE_SPACE_TYPE_VIEW) {
    bindings.attach(session);
    input = std::make_unique<xr::GazeInput>(actions, session);
  }

  void wait_for_focus() {
    for (int tries = 0; tries < 2000 && !session.is_focused(); ++tries) {  // 20 s
      while (const auto event = instance.poll()) {
        session.handle(*event);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (!session.is_focused()) {
      throw std::runtime_error("the session never got the focus");
    }
    bindings.sync(session);
  }

  [[nodiscard]] XrTime time_of(const std::timespec& moment) const {
    XrTime time = 0;
    xr::check(instance.function<PFN_xrConvertTimespecTimeToTimeKHR>("xrConvertTimespecTimeToTimeKHR")(instance.handle(),
                                                                                                      &moment, &time),
              "xrConvertTimespecTimeToTimeKHR");
    return time;
  }
  [[nodiscard]] XrTime now() const {
    std::timespec moment{};
    clock_gettime(CLOCK_MONOTONIC, &moment);
    return time_of(moment);
  }

  [[nodiscard]] tracking::GazeSample read(XrTime time) const { return input->read(view, time).value(); }

  xr::Instance instance;
  xr::ActionBindings bindings;
  xr::GazeActions actions;
  xr::Session session;
  xr::Space view;
  std::unique_ptr<xr::GazeInput> input;

 private:
  static std::vector<std::string> with_basics(std::vector<std::string> extensions) {
    extensions.insert(extensions.end(), {XR_MND_HEADLESS_EXTENSION_NAME, XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME});
    return extensions;
  }
};

}  // namespace support
