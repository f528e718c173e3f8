// Where to stand before a scene that has no camera.
#pragma once

#include "render/scene/scene.hpp"

namespace render {

// Level, before the middle of what the scene shows, on the side that a glTF asset turns to whoever looks at it (+z), so
// far off that all of it lies within a view of 60 degrees and no point of it nearer than a page is read at. At least
// one triangle.
[[nodiscard]] tracking::Pose framing_pose(const Scene& scene);

}  // namespace render
