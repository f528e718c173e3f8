// The few words that let the optics headers compile as C++ (once for double, once for float) and as GLSL.
// No include guard: lenses/engine.hpp includes the headers once in each of its namespaces, after naming `real`,
// `vec2`, `vec3`, `vec4`, `mat2`, `mat3`, `ivec4` and `kEpsilon` there; GLSL gets them here.
//
// TABLE_PARAM / TABLE hand on the table of spline coefficients: an argument in C++, a texel buffer named `lens_table`
// declared by the including shader in GLSL.
// USED_KINDS: bit k is set if any lens has a surface of kind k; a shader may define it as a specialisation constant, so
// that code for kinds that no lens has is never compiled.
#define KIND_USED(kind) ((USED_KINDS & (1u << uint(kind))) != 0u)

#ifdef __cplusplus

#define VG_FUNCTION inline
#define VG_INOUT(type) type&
#define TABLE_PARAM const Table &table,
#define TABLE table,
#define TABLE_AT(i) table.at(i)
#define USED_KINDS 0xffffffffu

#else

#define real float
#define VG_FUNCTION
#define VG_INOUT(type) inout type
#define TABLE_PARAM
#define TABLE
#define TABLE_AT(i) texelFetch(lens_table, i)
#ifndef USED_KINDS
#define USED_KINDS 0xffffffffu
#endif
const float kEpsilon = 1.1920929e-7;

#endif
