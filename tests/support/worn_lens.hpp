// One lens before both eyes of the default wearer, and the project's example lenses.
#pragma once

#include <string>

#include "tests/support/worn_views.hpp"

namespace support {

struct WornLens {
  WornPair pair;
  render::ViewSetup view;  // of the first eye, along the gaze
};

inline WornLens worn_lens(const lenses::Lens& lens, const tracking::FieldOfView& fov, render::Viewing viewing,
                          const glm::dvec3& gaze) {
  const lenses::Spectacles both{"both", {lens, lens}, glm::dvec3(1.0)};
  WornLens worn{wear(lenses::Wearer{}, &both, tracking::Pose{}), {}};
  worn.view = view_along(worn.pair, 0, viewing, gaze, fov);
  return worn;
}

inline lenses::Lens progressive_lens() {
  return lenses::read_lens(VERGENCE_TEST_DATA "/progressive_add200_right.json");
}

// The first lens of assets/spectacles/<name>.json.
inline lenses::Lens example_lens(const std::string& name) {
  return lenses::read_spectacles(VERGENCE_ASSETS "/spectacles/" + name + ".json").lens[0];
}

}  // namespace support
