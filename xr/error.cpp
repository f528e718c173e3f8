#include "xr/error.hpp"

#include <openxr/openxr_reflection.h>

namespace xr {

std::string result_name(XrResult result) {
  switch (result) {
#define VERGENCE_XR_RESULT(name, value) \
  case name:                            \
    return #name;
    XR_LIST_ENUM_XrResult(VERGENCE_XR_RESULT)
#undef VERGENCE_XR_RESULT
            default : return "XrResult " +
                      std::to_string(static_cast<int>(result));
  }
}

XrResult check(XrResult result, const char* call) {
  if (XR_SUCCEEDED(result)) {
    return result;
  }
  const std::string what = std::string("openxr: ") + call + ": " + result_name(result);
  if (result == XR_ERROR_INSTANCE_LOST || result == XR_ERROR_SESSION_LOST) {
    throw LostError(what + ": the runtime went away; start it again, then this command");
  }
  throw Error(what);
}

}  // namespace xr
