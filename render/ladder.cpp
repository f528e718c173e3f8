#include "render/ladder.hpp"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr Rung resolution_rung(std::string_view name, double resolution, std::string_view what) {
  Accuracy accuracy;
  accuracy.resolution = resolution;
  return {.name = name, .subject = "resolution", .what = what, .accuracy = accuracy};
}

constexpr Rung foveated_rung(std::string_view name, double fovea_deg, int rate, std::string_view what) {
  Accuracy accuracy;
  accuracy.foveation = {.fovea_deg = fovea_deg, .rate = rate};
  return {.name = name, .subject = "foveation", .what = what, .accuracy = accuracy};
}

constexpr Rung samples_rung(std::string_view name, int samples) {
  return {.name = name,
          .subject = "dof samples",
          .what = "distributed rays over the pupil (the paper's DOF)",
          .accuracy = {},
          .mode = Mode::dof,
          .samples = samples};
}

constexpr std::array kLadder{
    Rung{.name = "standard",
         .subject = "standard",
         .what = "every pixel through the exact lens, disc blur",
         .accuracy = {}},

    // The lens.
    Rung{.name = "lens-1-iteration",
         .subject = "lens iterations",
         .what = "one step of Newton's method for each surface",
         .accuracy = {.lens = {.iterations = 1}}},
    Rung{.name = "lens-2-iterations",
         .subject = "lens iterations",
         .what = "two steps of Newton's method for each surface",
         .accuracy = {.lens = {.iterations = 2}}},
    Rung{.name = "lens-3-iterations",
         .subject = "lens iterations",
         .what = "three steps of Newton's method for each surface, as the paper takes",
         .accuracy = {.lens = {.iterations = 3}}},

    // Fewer pixels than are shown.
    resolution_rung("half-resolution", 0.5, "half the pixels along each side, enlarged"),
    resolution_rung("three-quarter-resolution", 0.75, "three quarters of the pixels along each side, enlarged"),
    foveated_rung("foveated-5-4", 5.0, 4, "a quarter of the pixels along each side beyond 5 degrees from the gaze"),
    foveated_rung("foveated-10-2", 10.0, 2, "half the pixels along each side beyond 10 degrees from the gaze"),

    // Modes and distributed rays.
    Rung{.name = "pinhole",
         .subject = "mode",
         .what = "no defocus at all (the paper's PIN)",
         .accuracy = {},
         .mode = Mode::pinhole},
    Rung{.name = "vis",
         .subject = "mode",
         .what = "a map of power instead of a picture (the paper's VIS)",
         .accuracy = {},
         .mode = Mode::power},

    samples_rung("dof-1", 1),
    samples_rung("dof-4", 4),
    samples_rung("dof-16", 16),
    samples_rung("dof-64", 64),
    samples_rung("dof-256", 256),
};

}  // namespace

std::span<const Rung> ladder() {
  return kLadder;
}

const Rung* find_rung(std::string_view name) {
  const auto found = std::ranges::find(kLadder, name, &Rung::name);
  return found == kLadder.end() ? nullptr : &*found;
}

}  // namespace render
