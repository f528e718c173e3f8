// From a direction at the pupil to the ray and its ray-transfer matrix beyond the lens: all that needs no function that
// GLSL lacks in double precision.
#include "lenses/gpu/language.h"
#include "lenses/gpu/surface.h"
#include "lenses/gpu/facets.h"
#include "lenses/gpu/bezier.h"
#include "lenses/gpu/placed_surface.h"
#include "lenses/gpu/intersect.h"
#include "lenses/gpu/ray_transfer.h"
#include "lenses/gpu/lens_path.h"
#include "lenses/gpu/eye_axes.h"
#include "lenses/gpu/sight_line.h"
