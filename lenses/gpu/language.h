// The few words that let the optics headers compile as C++ (once for double, once for float) and as GLSL.
// No include guard: lenses/engine.hpp includes the headers once in each of its namespaces, after naming `real`,
// `vec2`, `vec3`, `vec4`, `mat2`, `mat3`, `ivec4` and `kEpsilon` there; GLSL gets them here.
//
// TABLE_PARAM / TABLE hand on the table of spline coefficients: an argument in C++, a texel buffer named `lens_table`
// declared by the including shader in GLSL.
// BACK_KINDS, FRONT_KINDS: bit k is set if any lens has a back or front surface of kind k; a shader may define them as
// specialisation constants, so that code for kinds that no lens has is never compiled. KINDS_PARAM / KINDS(k) hand them
// on to the functions that look at one surface: a device that takes both sides of a branch then evaluates no spline for
// a spherical back. KIND_USED and IS_KIND ask inside such a function. Placement and segments have bits of their own, so
// that lenses without them pay nothing.
// MAY_CROSS: front and back of some lens may cross. HURRIED: a search that does not settle at once is given up as
// kStatusUnsettled, so that the code for it is not compiled; such rays are few and traced again.
// CELL_FIRST: an even spline is first searched by hurried_hit, hurried or not, so that all kernels agree to the bit.
// VIEWINGS: bit k is set if some eye views in the way k (trace_record.h). MAY_SIT_ON_EYE: some lens turns with the eye.
// NEWTON_STEPS: a ray goes on from a surface after so many steps of the search for it, wherever they have led; 0: as
// many as it takes.

#ifdef __cplusplus

#define VG_FUNCTION inline
#define VG_INOUT(type) type&
#define TABLE_PARAM const Table &table,
#define TABLE table,
#define TABLE_AT(i) table.at(i)
#define KINDS_PARAM
#define KINDS(k)
#define KIND_USED(k) true
#define IS_KIND(s, k) ((s).kind.x == (k))
#define LENS_USED true
#define MAY_CROSS true
#define HURRIED false
#define CELL_FIRST false
#define NEWTON_STEPS 0
#define VIEWINGS 7u
#define MAY_SIT_ON_EYE true

#else

#ifdef real  // a shader may have made all of these double
#define CELL_FIRST false
#else
#define CELL_FIRST true
#define real float
const float kEpsilon = 1.1920929e-7;
#endif
#define VG_FUNCTION
#define VG_INOUT(type) inout type
#define TABLE_PARAM
#define TABLE
#ifndef TABLE_AT
#define TABLE_AT(i) texelFetch(lens_table, i)
#endif
#ifndef BACK_KINDS
#define BACK_KINDS 0xffffffffu
#define FRONT_KINDS 0xffffffffu
#define MAY_CROSS true
#endif
#ifndef HURRIED
#define HURRIED false
#endif
#ifndef VIEWINGS
#define VIEWINGS 7u
#define MAY_SIT_ON_EYE true
#endif
#ifndef NEWTON_STEPS
#define NEWTON_STEPS 0
#endif
#define KINDS_PARAM uint kinds,
#define KINDS(k) k,
#define KIND_USED(k) ((kinds & (1u << uint(k))) != 0u)
#define IS_KIND(s, k) (KIND_USED(k) && ((kinds & kShapeBits) == (1u << uint(k)) || (s).kind.x == (k)))
#define LENS_USED (BACK_KINDS != 0u)

#endif

#define IS_PLACED(s) (KIND_USED(kPlaced) && (s).shift.w != real(0))
#define IS_SEGMENTED(s) (KIND_USED(kSegmented) && (s).parts.z > 0)
