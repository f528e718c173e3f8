// Seeded random numbers that are the same with every standard library: the engine is defined by the standard, its
// distributions are not, so only raw words are used.
#pragma once

#include <cstddef>
#include <random>

namespace assets {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  [[nodiscard]] double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0);
  }
  [[nodiscard]] std::size_t below(std::size_t count) { return engine_() % count; }

 private:
  std::mt19937 engine_;
};

}  // namespace assets
