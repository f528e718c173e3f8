// OpenXR with the parts we use, and what headers before 1.1 lack. Include this, never openxr.h itself.
#pragma once

#include <vulkan/vulkan_core.h>
#include <ctime>
// openxr_platform.h wants both before it.
#ifndef XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_GRAPHICS_API_VULKAN
#endif
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// XR_EXT_local_floor, in the core from 1.1 on.
#ifndef XR_EXT_local_floor
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
inline constexpr auto XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT = static_cast<XrReferenceSpaceType>(1000426000);
#endif
