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
    Rung{.name = "lens-grid-32",
         .subject = "lens spacing",
         .what = "lens rays 32 pixels apart, those between interpolated",
         .accuracy = {.lens = {.spacing = 32}}},
    Rung{.name = "lens-grid-16",
         .subject = "lens spacing",
         .what = "lens rays 16 pixels apart, those between interpolated",
         .accuracy = {.lens = {.spacing = 16}}},
    Rung{.name = "lens-grid-8",
         .subject = "lens spacing",
         .what = "lens rays at the corners of tiles of 8 pixels, those between interpolated",
         .accuracy = {.lens = {.spacing = 8}}},
    Rung{.name = "lens-double",
         .subject = "lens precision",
         .what = "the lens in double precision, where the device has it",
         .accuracy = {.lens = {.in_double = true}}},
    Rung{.name = "lens-mesh-1k",
         .subject = "lens mesh",
         .what = "each surface as a mesh of 1000 triangles with normals at their vertices",
         .accuracy = {.lens = {.form = LensForm::mesh, .facets = 1000}}},
    Rung{.name = "lens-mesh-10k",
         .subject = "lens mesh",
         .what = "each surface as a mesh of 10,000 triangles with normals at their vertices",
         .accuracy = {.lens = {.form = LensForm::mesh, .facets = 10000}}},
    Rung{.name = "lens-mesh-100k",
         .subject = "lens mesh",
         .what = "each surface as a mesh of 100,000 triangles with normals at their vertices",
         .accuracy = {.lens = {.form = LensForm::mesh, .facets = 100000}}},
    Rung{.name = "lens-bezier",
         .subject = "lens patches",
         .what = "free-form surfaces as Bezier patches behind a bounding volume hierarchy, the paper's way",
         .accuracy = {.lens = {.form = LensForm::bezier}}},
    Rung{.name = "lens-field-16",
         .subject = "lens field",
         .what = "16 x 16 lens rays over the view, kept while eye and lens stay, those between interpolated",
         .accuracy = {.lens = {.form = LensForm::field, .field_side = 16}}},
    Rung{.name = "lens-field-64",
         .subject = "lens field",
         .what = "64 x 64 lens rays over the view, kept while eye and lens stay, those between interpolated",
         .accuracy = {.lens = {.form = LensForm::field, .field_side = 64}}},
    Rung{.name = "lens-field-256",
         .subject = "lens field",
         .what = "256 x 256 lens rays over the view, kept while eye and lens stay, those between interpolated",
         .accuracy = {.lens = {.form = LensForm::field, .field_side = 256}}},

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
