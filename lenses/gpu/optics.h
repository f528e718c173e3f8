// All optics, in the order they build on each other. See language.h for how one text serves three compilers.
#include "lenses/gpu/language.h"
#include "lenses/gpu/surface.h"
#include "lenses/gpu/intersect.h"
#include "lenses/gpu/ray_transfer.h"
#include "lenses/gpu/lens_path.h"
#include "lenses/gpu/eye_optics.h"
#include "lenses/gpu/sight_line.h"
#include "lenses/gpu/trace_record.h"
