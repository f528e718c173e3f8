// The structures the shaders share with the host (render/shaders/frame.h and view.h), as C++.
#pragma once

#include <cstdint>

#include "lenses/engine.hpp"

namespace render::gpu {
using uint = std::uint32_t;
using glm::ivec4;
using glm::uvec4;
using glm::vec4;
using lenses::f32::EyeData;
using lenses::f32::LensData;
#include "render/shaders/composite.h"
#include "render/shaders/frame.h"
#include "render/shaders/shrink.h"
#include "render/shaders/view.h"
}  // namespace render::gpu
