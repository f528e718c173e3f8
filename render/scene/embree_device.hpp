// Owners of Embree's handles, its errors as exceptions, and the calls that differ between Embree 3 (Debian 12) and 4
// (Debian 13).
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace render {

template <auto release>
struct EmbreeRelease {
  template <typename T>
  void operator()(T* handle) const {
    release(handle);
  }
};

using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, EmbreeRelease<rtcReleaseDevice>>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, EmbreeRelease<rtcReleaseScene>>;
using EmbreeGeometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, EmbreeRelease<rtcReleaseGeometry>>;
using EmbreeBvh = std::unique_ptr<std::remove_pointer_t<RTCBVH>, EmbreeRelease<rtcReleaseBVH>>;

// Throws when the last call on the device failed; what: the call.
inline void check_embree(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error(std::string("Embree: ") + what + " failed with error " + std::to_string(error));
  }
}

inline EmbreeDevice make_embree_device() {
  EmbreeDevice device(rtcNewDevice(nullptr));
  if (!device) check_embree(nullptr, "rtcNewDevice");
  return device;
}

inline void intersect_one(RTCScene scene, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
#endif
}

// Sixteen rays that run side by side; valid: -1 for each that takes part.
inline void intersect_sixteen(const int* valid, RTCScene scene, RTCRayHit16& rays) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &context, &rays);
#endif
}

}  // namespace render
