// The one place where the layer's exceptions end: nothing is thrown through the C interface.
#pragma once

#include "xr/openxr_compat.hpp"

#include <new>

namespace xr::layer {

// A call answers with this result.
struct CallFailed {
  XrResult result;
};

inline XrResult check(XrResult result) {
  if (XR_FAILED(result)) {
    throw CallFailed{result};
  }
  return result;
}

template <class Call>
XrResult guarded(Call&& call) noexcept {
  try {
    return call();
  } catch (const CallFailed& failed) {
    return failed.result;
  } catch (const std::bad_alloc&) {
    return XR_ERROR_OUT_OF_MEMORY;
  } catch (...) {
    return XR_ERROR_RUNTIME_FAILURE;
  }
}

}  // namespace xr::layer
