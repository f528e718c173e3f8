// OpenXR with the parts we use, and what headers before 1.1 lack. Include this, never openxr.h itself.
#pragma once

#include <vulkan/vulkan_core.h>
#include <ctime>
// openxr_platform.h wants all of this before it.
#ifndef XR_USE_GRAPHICS_API_VULKAN
#define XR_USE_GRAPHICS_API_VULKAN
#endif
#ifndef XR_USE_TIMESPEC
#define XR_USE_TIMESPEC
#endif
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

// XR_EXT_local_floor, in the core from 1.1 on.
#ifndef XR_EXT_local_floor
#define XR_EXT_LOCAL_FLOOR_EXTENSION_NAME "XR_EXT_local_floor"
inline constexpr auto XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT = static_cast<XrReferenceSpaceType>(1000426000);
#endif

// XR_FB_eye_tracking_social: a pose for each eye.
#ifndef XR_FB_eye_tracking_social
#define XR_FB_eye_tracking_social 1
XR_DEFINE_HANDLE(XrEyeTrackerFB)
#define XR_FB_EYE_TRACKING_SOCIAL_EXTENSION_NAME "XR_FB_eye_tracking_social"
inline constexpr auto XR_TYPE_EYE_TRACKER_CREATE_INFO_FB = static_cast<XrStructureType>(1000202001);
inline constexpr auto XR_TYPE_EYE_GAZES_INFO_FB = static_cast<XrStructureType>(1000202002);
inline constexpr auto XR_TYPE_EYE_GAZES_FB = static_cast<XrStructureType>(1000202003);
inline constexpr auto XR_TYPE_SYSTEM_EYE_TRACKING_PROPERTIES_FB = static_cast<XrStructureType>(1000202004);

enum XrEyePositionFB { XR_EYE_POSITION_LEFT_FB = 0, XR_EYE_POSITION_RIGHT_FB = 1, XR_EYE_POSITION_COUNT_FB = 2 };

struct XrSystemEyeTrackingPropertiesFB {
  XrStructureType type;
  void* next;
  XrBool32 supportsEyeTracking;
};

struct XrEyeTrackerCreateInfoFB {
  XrStructureType type;
  const void* next;
};

struct XrEyeGazesInfoFB {
  XrStructureType type;
  const void* next;
  XrSpace baseSpace;
  XrTime time;
};

struct XrEyeGazeFB {
  XrBool32 isValid;
  XrPosef gazePose;
  float gazeConfidence;
};

struct XrEyeGazesFB {
  XrStructureType type;
  void* next;
  XrEyeGazeFB gaze[XR_EYE_POSITION_COUNT_FB];
  XrTime time;
};

using PFN_xrCreateEyeTrackerFB = XrResult(XRAPI_PTR*)(XrSession session, const XrEyeTrackerCreateInfoFB* createInfo,
                                                      XrEyeTrackerFB* eyeTracker);
using PFN_xrDestroyEyeTrackerFB = XrResult(XRAPI_PTR*)(XrEyeTrackerFB eyeTracker);
using PFN_xrGetEyeGazesFB = XrResult(XRAPI_PTR*)(XrEyeTrackerFB eyeTracker, const XrEyeGazesInfoFB* gazeInfo,
                                                 XrEyeGazesFB* eyeGazes);
#endif

// XR_KHR_locate_spaces: many spaces in one call.
#ifndef XR_KHR_locate_spaces
#define XR_KHR_locate_spaces 1
#define XR_KHR_LOCATE_SPACES_EXTENSION_NAME "XR_KHR_locate_spaces"
inline constexpr auto XR_TYPE_SPACES_LOCATE_INFO_KHR = static_cast<XrStructureType>(1000471000);
inline constexpr auto XR_TYPE_SPACE_LOCATIONS_KHR = static_cast<XrStructureType>(1000471001);
inline constexpr auto XR_TYPE_SPACE_VELOCITIES_KHR = static_cast<XrStructureType>(1000471002);

struct XrSpacesLocateInfoKHR {
  XrStructureType type;
  const void* next;
  XrSpace baseSpace;
  XrTime time;
  uint32_t spaceCount;
  const XrSpace* spaces;
};

struct XrSpaceLocationDataKHR {
  XrSpaceLocationFlags locationFlags;
  XrPosef pose;
};

struct XrSpaceLocationsKHR {
  XrStructureType type;
  void* next;
  uint32_t locationCount;
  XrSpaceLocationDataKHR* locations;
};

struct XrSpaceVelocityDataKHR {
  XrSpaceVelocityFlags velocityFlags;
  XrVector3f linearVelocity;
  XrVector3f angularVelocity;
};

struct XrSpaceVelocitiesKHR {
  XrStructureType type;
  void* next;
  uint32_t velocityCount;
  XrSpaceVelocityDataKHR* velocities;
};

using PFN_xrLocateSpacesKHR = XrResult(XRAPI_PTR*)(XrSession session, const XrSpacesLocateInfoKHR* locateInfo,
                                                   XrSpaceLocationsKHR* spaceLocations);
#endif
