// Where a command's time goes before and around its frames, and the most memory that the process has held.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace app {

class StartUp {
 public:
  using Parts = std::vector<std::pair<std::string, double>>;  // name, ms by the clock on the wall

  // Ends the part that began with the last mark, or with the object.
  void mark(const std::string& name) {
    const auto now = std::chrono::steady_clock::now();
    parts_.emplace_back(name, std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }
  [[nodiscard]] const Parts& parts() const { return parts_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  Parts parts_;
};

// Of this process so far; a driver that computes on the CPU counts too, a card's own memory does not.
[[nodiscard]] double peak_memory_mib();

}  // namespace app
