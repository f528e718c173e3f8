// The lenses of a picture in the form that its accuracy asks for: made once and kept while the lenses stay the same.
#pragma once

#include <map>
#include <utility>

#include "lenses/lens_model.hpp"
#include "render/accuracy.hpp"

namespace render {

class LensFormCache {
 public:
  // `lenses` itself where its surfaces are traced as they are. What is returned lives until the next call.
  [[nodiscard]] const lenses::LensModel& in_form(const lenses::LensModel& lenses, const LensAccuracy& accuracy);

 private:
  struct Entry {
    lenses::LensModel source, converted;
  };

  std::map<std::pair<LensForm, int>, Entry> known_;  // by form and facets, the last lenses of each
};

}  // namespace render
