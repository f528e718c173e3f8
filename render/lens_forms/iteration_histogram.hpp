// How many steps of Newton's method the rays of a picture take to meet a surface, beside the paper's claim that three
// always do (section 4.1).
#pragma once

#include <array>
#include <cstddef>

#include "lenses/lens_model.hpp"
#include "render/view_setup.hpp"

namespace render {

// Which engine's tolerance ends the iteration: a few roundings of its own lengths.
enum class Precision { single, twofold };

struct IterationHistogram {
  static constexpr std::size_t kMost = 12;  // the engines' own limit

  std::array<std::size_t, kMost + 1> surfaces{};  // [n]: surfaces met after n steps
  std::size_t searched = 0;                       // where a bracketed search had to decide instead
  std::size_t closed_form = 0;                    // planes and spheres, which take none

  [[nodiscard]] std::size_t iterated() const;  // all but those of closed form
  // Of the iterated, the part that n steps suffice for; 1 where nothing iterates.
  [[nodiscard]] double settled_within(std::size_t steps) const;

  IterationHistogram& operator+=(const IterationHistogram& other);
};

// The chief rays of every pixel of the view, both surfaces; rays that do not pass the lens are left out.
[[nodiscard]] IterationHistogram iteration_histogram(const ViewSetup& view, const lenses::LensModel& lenses, int width,
                                                     int height, Precision precision = Precision::single);

}  // namespace render
