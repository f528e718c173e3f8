// Gaze as it comes in over a local socket. A thread of its own reads; asking never waits for it.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "xr/layer/recorded_gaze.hpp"

namespace xr::layer {

class SocketGaze : public GazeSource {
 public:
  struct Config {
    std::string path;
    double longest_silence = 0.2;  // s; after that what was last seen is lost
    double retry = 0.25;           // s between attempts to connect
    // The runtime's time at a moment of CLOCK_MONOTONIC (s), where it can tell.
    std::function<std::optional<XrTime>(double)> time_of_monotonic;
    std::function<void(const std::string&)> report;  // of what the user should know
  };

  // Throws tracking::InputError for a path that no socket can have.
  explicit SocketGaze(Config config);
  ~SocketGaze() override;

  [[nodiscard]] bool present() const override;
  [[nodiscard]] GazeReading at(XrTime time, XrTime start) const override;

 private:
  void run(const std::stop_token& stop);
  void converse(int socket, const std::stop_token& stop);
  void take(const std::string& line);
  void lose(bool connected);
  void report_once(bool& reported, const std::string& text) const;
  // False when it is time to stop.
  [[nodiscard]] bool wait_for(int file, int milliseconds, const std::stop_token& stop) const;

  Config config_;
  mutable std::mutex mutex_;                // of the two below
  std::optional<tracking::TraceRow> last_;  // its time in CLOCK_MONOTONIC's seconds; none: lost
  bool connected_ = false;
  std::string header_;                                        // of the connection
  bool reported_connection_ = false, reported_line_ = false;  // the thread's own
  int wake_ = -1;                                             // an eventfd that ends every wait
  std::jthread thread_;
};

}  // namespace xr::layer
