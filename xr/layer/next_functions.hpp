// The functions of whoever comes next in the chain, a further layer or the runtime, as far as this layer calls them.
#pragma once

#include "xr/openxr_compat.hpp"

namespace xr::layer {

#define VERGENCE_NEXT_FUNCTIONS(function)                                                                             \
  function(xrDestroyInstance) function(xrGetSystemProperties) function(xrPollEvent) function(xrStringToPath)          \
      function(xrCreateSession) function(xrDestroySession) function(xrCreateReferenceSpace)                           \
          function(xrCreateActionSpace) function(xrDestroySpace) function(xrLocateSpace) function(xrCreateActionSet)  \
              function(xrDestroyActionSet) function(xrCreateAction) function(xrDestroyAction)                         \
                  function(xrSuggestInteractionProfileBindings) function(xrAttachSessionActionSets)                   \
                      function(xrSyncActions) function(xrGetActionStatePose) function(xrGetCurrentInteractionProfile) \
                          function(xrEnumerateBoundSourcesForAction) function(xrGetInputSourceLocalizedName)          \
                              function(xrLocateSpacesKHR) function(xrCreateEyeTrackerFB)                              \
                                  function(xrDestroyEyeTrackerFB) function(xrGetEyeGazesFB)                           \
                                      function(xrConvertTimespecTimeToTimeKHR)

// Null where the chain below does not offer the function, and in those of extensions that are not enabled.
struct NextFunctions {
  PFN_xrGetInstanceProcAddr xrGetInstanceProcAddr = nullptr;
#define VERGENCE_DECLARE(name) PFN_##name name = nullptr;
  VERGENCE_NEXT_FUNCTIONS(VERGENCE_DECLARE)
#undef VERGENCE_DECLARE
};

[[nodiscard]] NextFunctions load_next_functions(XrInstance instance, PFN_xrGetInstanceProcAddr get);

}  // namespace xr::layer
