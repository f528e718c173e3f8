#include "render/lens_forms/lens_form_cache.hpp"

#include <algorithm>
#include <span>

#include "lenses/surface_forms.hpp"

namespace render {
namespace {

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  static_assert(sizeof(T) % sizeof(int) == 0 && std::is_trivially_copyable_v<T>);  // and, of such members, no padding
  return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
}

}  // namespace

const lenses::LensModel& LensFormCache::in_form(const lenses::LensModel& lenses, const LensAccuracy& accuracy) {
  const bool is_mesh = accuracy.form == LensForm::mesh;
  if (!is_mesh && accuracy.form != LensForm::bezier) {
    return lenses;
  }
  Entry& entry = known_[{accuracy.form, is_mesh ? accuracy.facets : 0}];
  if (!same_bytes(entry.source.lens, lenses.lens) || !same_bytes(entry.source.table, lenses.table)) {
    entry.converted = is_mesh ? lenses::as_mesh(lenses, accuracy.facets) : lenses::as_bezier_patches(lenses);
    entry.source = lenses;
  }
  return entry.converted;
}

}  // namespace render
