#include "render/ladder.hpp"

#include <algorithm>
#include <array>

namespace render {
namespace {

constexpr Rung lens_rung(std::string_view name, std::string_view subject, std::string_view what,
                         const LensAccuracy& lens) {
  return {.name = name, .subject = subject, .what = what, .accuracy = {.lens = lens}};
}

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

constexpr Rung blur_rung(std::string_view name, std::string_view subject, std::string_view what,
                         const BlurAccuracy& blur) {
  return {.name = name, .subject = subject, .what = what, .accuracy = {.blur = blur}, .mode = Mode::adof};
}

constexpr std::array kLadder{
    Rung{.name = "standard",
         .subject = "standard",
         .what = "the exact lens, cubics between 16 rays a tile of 8 x 8 pixels where they are as good; disc blur",
         .accuracy = {}},

    // The lens.
    lens_rung("lens-every-pixel", "lens spacing", "every pixel's own ray through the lens",
              {.cubics = TileCubics::never}),
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

    // The blur.
    blur_rung("blur-4-taps", "blur taps", "at most 4 taps for a blur", {.taps = 4}),
    blur_rung("blur-16-taps", "blur taps", "at most 16 taps for a blur", {.taps = 16}),
    blur_rung("blur-64-taps", "blur taps", "at most 64 taps for a blur", {.taps = 64}),
    blur_rung("blur-1024-taps", "blur taps", "at most 1024 taps for a blur", {.taps = 1024}),
    blur_rung("blur-full-rate", "blur rate", "wide blurs gathered for every pixel, not every second", {.rate = 1}),
    blur_rung("blur-finest", "blur rate", "at most 1024 taps for a blur, gathered for every pixel",
              {.taps = 1024, .rate = 1}),
    blur_rung("blur-gaussian", "blur kernel", "a Gaussian of the disc's second moments (the paper's ADOF)",
              {.kernel = BlurKernel::gaussian}),

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
