// Tells Monado's remote headset where head and eyes are, and what the hands press. Its hub listens on every address, so
// the test moves into a network namespace of its own first.
#pragma once

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "tests/support/monado.hpp"

namespace support {

// This process, and its children, get a network of their own with nothing in it but the loopback. To be called before
// there are threads.
inline void leave_network() {
  if (::unshare(::geteuid() == 0 ? CLONE_NEWNET : CLONE_NEWUSER | CLONE_NEWNET) != 0) {
    throw std::runtime_error("no network namespace of its own: " + std::string(std::strerror(errno)));
  }
  const int any = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, "lo", IFNAMSIZ - 1);
  request.ifr_flags = IFF_UP | IFF_RUNNING;
  const int result = ::ioctl(any, SIOCSIFFLAGS, &request);
  ::close(any);
  if (result != 0) {
    throw std::runtime_error("no loopback interface: " + std::string(std::strerror(errno)));
  }
}

// The hub's packet, version 3.
struct RemoteHead {
  struct Quaternion {
    float x = 0, y = 0, z = 0, w = 1;
  };
  struct Vector {
    float x = 0, y = 0, z = 0;
  };
  struct Pose {
    Quaternion orientation;
    Vector position;
  };
  struct Fov {
    float left = -0.7F, right = 0.7F, up = 0.7F, down = -0.7F;  // rad
  };
  struct View {  // 0: left
    Fov fov;
    Pose head_from_view;
    std::uint32_t padding = 0;
  };
  std::array<View, 2> view;
  Pose head;
  std::uint8_t has_views = 1;
  std::array<std::uint8_t, 3> padding{};
};

// A controller of the same headset, an Index one, as the packet has it.
struct RemoteHand {
  RemoteHead::Pose pose;
  RemoteHead::Vector linear_velocity, angular_velocity;
  std::array<float, 5> curl{};
  float trigger = 0, squeeze = 0, squeeze_force = 0;
  std::array<float, 2> thumbstick{};
  float trackpad_force = 0;
  std::array<float, 2> trackpad{};
  bool hand_tracked = false, active = true;
  bool system_click = false, system_touch = false, a_click = false, a_touch = false, b_click = false, b_touch = false;
  bool trigger_click = false, trigger_touch = false, thumbstick_click = false, thumbstick_touch = false;
  bool trackpad_touch = false;
  std::array<bool, 3> padding{};
};

struct RemoteHands {
  RemoteHand left, right;
};

class RemoteHub {
 public:
  RemoteHub() { connect(); }
  ~RemoteHub() { ::close(socket_); }
  RemoteHub(const RemoteHub&) = delete;
  RemoteHub& operator=(const RemoteHub&) = delete;

  // Back when the hub has it: it answers nothing, but it greets a new connection with the latest it was told.
  void tell(const RemoteHead& head) {
    Packet packet = reset_;
    packet.head = head;
    send(packet);
  }
  void tell(const RemoteHands& hands) {
    Packet packet = reset_;
    packet.hands = hands;
    send(packet);
  }

 private:
  struct Packet {
    std::uint64_t header;
    RemoteHead head;
    RemoteHands hands;
  };
  static_assert(sizeof(Packet) == 376);

  void send(const Packet& packet) {
    write(packet);
    const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    do {
      ::close(socket_);
      connect();
      if (std::memcmp(&latest_, &packet, sizeof(packet)) == 0) {
        return;
      }
    } while (std::chrono::steady_clock::now() < stop);
    throw std::runtime_error("the remote hub does not take a pose");
  }

  void connect() {
    const auto stop = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    for (;;) {
      socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      const int at_once = 1;
      ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof(at_once));
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(Monado::kRemotePort);
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 && read(reset_) &&
          read(latest_)) {
        return;
      }
      ::close(socket_);
      if (std::chrono::steady_clock::now() > stop) {
        throw std::runtime_error("the remote hub does not answer");
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  bool read(Packet& packet) const {
    std::size_t done = 0;
    while (done < sizeof(packet)) {
      const ssize_t n = ::read(socket_, reinterpret_cast<char*>(&packet) + done, sizeof(packet) - done);
      if (n <= 0) {
        return false;
      }
      done += static_cast<std::size_t>(n);
    }
    return true;
  }

  void write(const Packet& packet) const {
    if (::write(socket_, &packet, sizeof(packet)) != static_cast<ssize_t>(sizeof(packet))) {
      throw std::runtime_error("the remote hub does not listen");
    }
  }

  int socket_ = -1;
  Packet reset_{}, latest_{};
};

}  // namespace support
