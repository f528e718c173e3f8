#include "render/lens_forms/lens_form_cache.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <type_traits>

#include "lenses/surface_forms.hpp"

namespace render {
namespace {

using lenses::LensModel;
using lenses::f64::LensData;

template <class T>
bool same_bytes(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) == alignof(double));  // members without padding
  return std::ranges::equal(std::as_bytes(std::span(&a, 1)), std::as_bytes(std::span(&b, 1)));
}

// A lens may sit elsewhere: that changes none of its surfaces.
bool same_surfaces(const LensData& a, const LensData& b) {
  return same_bytes(a.back, b.back) && same_bytes(a.front, b.front) && a.glass.z == b.glass.z && a.glass.w == b.glass.w;
}

}  // namespace

const LensModel& LensFormCache::in_form(const LensModel& lenses, const LensAccuracy& accuracy) {
  const bool is_mesh = accuracy.form == LensForm::mesh;
  if (!is_mesh && accuracy.form != LensForm::bezier) {
    return lenses;
  }
  Entry& entry = known_[{accuracy.form, is_mesh ? accuracy.facets : 0}];
  if (entry.source.table != lenses.table || !std::ranges::equal(entry.source.lens, lenses.lens, same_surfaces)) {
    entry.converted = is_mesh ? lenses::as_mesh(lenses, accuracy.facets) : lenses::as_bezier_patches(lenses);
    entry.source = lenses;
  }
  for (std::size_t i = 0; i < lenses.lens.size(); ++i) {
    LensData& to = entry.converted.lens[i];
    const LensData& from = lenses.lens[i];
    to.axis_x = from.axis_x;
    to.axis_y = from.axis_y;
    to.axis_z = from.axis_z;
    to.glass = from.glass;
    to.mount = from.mount;
  }
  return entry.converted;
}

}  // namespace render
