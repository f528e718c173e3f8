// An X server of the test's own that draws into memory (Xvfb), and what is on its screen.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xcb/xcb.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

#include "render/image/image.hpp"

namespace support {

class XScreen {
 public:
  static constexpr int kWidth = 1280, kHeight = 800;

  // Sets DISPLAY for this process and its children.
  XScreen() {
    int ends[2];
    if (::pipe(ends) != 0) {
      throw std::runtime_error("no pipe");
    }
    server_ = ::fork();
    if (server_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      ::close(ends[0]);
      const std::string write_end = std::to_string(ends[1]);
      const std::string mode = std::to_string(kWidth) + "x" + std::to_string(kHeight) + "x24";
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDERR_FILENO);
      ::execlp("Xvfb", "Xvfb", "-displayfd", write_end.c_str(), "-screen", "0", mode.c_str(), "-nolisten", "tcp",
               static_cast<char*>(nullptr));
      ::_exit(127);
    }
    ::close(ends[1]);
    // It writes its number once clients may come, or closes the pipe when it cannot start.
    std::string number;
    char c = 0;
    pollfd ready{ends[0], POLLIN, 0};
    while (::poll(&ready, 1, 60'000) > 0 && ::read(ends[0], &c, 1) == 1 && c != '\n') {
      number += c;
    }
    ::close(ends[0]);
    if (number.empty()) {
      throw std::runtime_error("Xvfb does not start; the package xvfb has it");
    }
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
    connection_.reset(xcb_connect(nullptr, nullptr));
    if (xcb_connection_has_error(connection_.get()) != 0) {
      throw std::runtime_error("no connection to Xvfb");
    }
  }

  ~XScreen() {
    connection_.reset();
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
  }
  XScreen(const XScreen&) = delete;
  XScreen& operator=(const XScreen&) = delete;

  [[nodiscard]] xcb_connection_t* connection() const { return connection_.get(); }
  [[nodiscard]] xcb_window_t root() const {
    return xcb_setup_roots_iterator(xcb_get_setup(connection_.get())).data->root;
  }

  [[nodiscard]] render::Image8 screenshot() const {
    const auto cookie = xcb_get_image(connection_.get(), XCB_IMAGE_FORMAT_Z_PIXMAP, root(), 0, 0, kWidth, kHeight, ~0U);
    const std::unique_ptr<xcb_get_image_reply_t, decltype(&std::free)> reply(
        xcb_get_image_reply(connection_.get(), cookie, nullptr), &std::free);
    if (!reply || xcb_get_image_data_length(reply.get()) != 4 * kWidth * kHeight) {
      throw std::runtime_error("no screenshot");
    }
    const std::uint8_t* data = xcb_get_image_data(reply.get());  // blue, green, red, nothing
    render::Image8 image = render::black_image(kWidth, kHeight);
    for (std::size_t i = 0; i < static_cast<std::size_t>(kWidth) * kHeight; ++i) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        image.rgb[3 * i + channel] = data[4 * i + 2 - channel];
      }
    }
    return image;
  }

 private:
  struct Disconnect {
    void operator()(xcb_connection_t* connection) const { xcb_disconnect(connection); }
  };
  pid_t server_ = -1;
  std::unique_ptr<xcb_connection_t, Disconnect> connection_;
};

}  // namespace support
