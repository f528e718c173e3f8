// A scene model as binary glTF 2.0: one mesh a node, one primitive a material, KHR_lights_punctual, pictures as PNG in
// the buffer. Sky and ambient light go to asset.extras.vergence, targets to the node's extras.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/generator/scene_model.hpp"

namespace assets {

[[nodiscard]] std::vector<std::uint8_t> glb_bytes(const SceneModel& scene);

}  // namespace assets
