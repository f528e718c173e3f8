#include "xr/layer/next_functions.hpp"

namespace xr::layer {

NextFunctions load_next_functions(XrInstance instance, PFN_xrGetInstanceProcAddr get) {
  NextFunctions next{.xrGetInstanceProcAddr = get};
#define VERGENCE_LOAD(name)                                                     \
  if (PFN_xrVoidFunction f = nullptr; XR_SUCCEEDED(get(instance, #name, &f))) { \
    next.name = reinterpret_cast<PFN_##name>(f);                                \
  }
  VERGENCE_NEXT_FUNCTIONS(VERGENCE_LOAD)
#undef VERGENCE_LOAD
  return next;
}

}  // namespace xr::layer
