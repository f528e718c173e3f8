// Other representations of a lens's surfaces, to be traced in their place: triangle meshes and Bezier patches.
#pragma once

#include "lenses/lens_model.hpp"

namespace lenses {

// Each surface as a mesh on a square grid (lenses/gpu/facets.h) with about so many triangles, at least 8, on the lens's
// disc. Where a surface does not exist at a vertex, as beyond the border of a patch, the triangles there are missing.
[[nodiscard]] LensModel as_mesh(const LensModel& lenses, int facets);

// Each spline surface as the Bezier patches of its knot intervals behind a bounding volume hierarchy
// (lenses/gpu/bezier.h), exactly the same surface; the others, which the paper traces in closed form, as they are.
[[nodiscard]] LensModel as_bezier_patches(const LensModel& lenses);

}  // namespace lenses
