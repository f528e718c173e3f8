// All optics, in the order they build on each other. See language.h for how one text serves three compilers.
#include "lenses/gpu/sight_optics.h"
#include "lenses/gpu/eye_optics.h"
#include "lenses/gpu/trace_record.h"
