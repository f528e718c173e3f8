#include "render/ladder.hpp"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr Rung lens_rung(std::string_view name, std::string_view subject, std::string_view what,
                         const LensAccuracy& lens) {
  return {.name = name, .subject = subject, .what = what, .accuracy = {.lens = lens}};
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
    lens_rung("lens-1-iteration", "lens iterations", "one step of Newton's method for each surface", {.iterations = 1}),
    lens_rung("lens-2-iterations", "lens iterations", "two steps of Newton's method for each surface",
              {.iterations = 2}),
    lens_rung("lens-3-iterations", "lens iterations",
              "three steps of Newton's method for each surface, as the paper takes", {.iterations = 3}),
    lens_rung("lens-grid-32", "lens spacing", "lens rays 32 pixels apart, those between interpolated", {.spacing = 32}),
    lens_rung("lens-grid-16", "lens spacing", "lens rays 16 pixels apart, those between interpolated", {.spacing = 16}),
    lens_rung("lens-grid-8", "lens spacing",
              "lens rays at the corners of tiles of 8 pixels, those between interpolated", {.spacing = 8}),
    lens_rung("lens-double", "lens precision", "the lens in double precision, where the device has it",
              {.in_double = true}),
    lens_rung("lens-mesh-1k", "lens mesh", "each surface as a mesh of 1000 triangles with normals at their vertices",
              {.form = LensForm::mesh, .facets = 1000}),
    lens_rung("lens-mesh-10k", "lens mesh", "each surface as a mesh of 10,000 triangles with normals at their vertices",
              {.form = LensForm::mesh, .facets = 10000}),
    lens_rung("lens-mesh-100k", "lens mesh",
              "each surface as a mesh of 100,000 triangles with normals at their vertices",
              {.form = LensForm::mesh, .facets = 100000}),
    lens_rung("lens-bezier", "lens patches",
              "free-form surfaces as Bezier patches behind a bounding volume hierarchy, the paper's way",
              {.form = LensForm::bezier}),
    lens_rung("lens-field-16", "lens field", "16 x 16 lens rays over the view, kept while eye and lens stay",
              {.form = LensForm::field, .field_side = 16}),
    lens_rung("lens-field-64", "lens field", "64 x 64 lens rays over the view, kept while eye and lens stay",
              {.form = LensForm::field, .field_side = 64}),
    lens_rung("lens-field-256", "lens field", "256 x 256 lens rays over the view, kept while eye and lens stay",
              {.form = LensForm::field, .field_side = 256}),

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
