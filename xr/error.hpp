// What fails at run time between us and the OpenXR runtime.
#pragma once

#include <stdexcept>
#include <string>

#include "xr/openxr_compat.hpp"

namespace xr {

// Its text is one line, fit for the user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The runtime, the session or the headset went away, and with it whatever was made from it.
class LostError : public Error {
 public:
  using Error::Error;
};

// "XR_ERROR_..." of the results a program of ours can meet, else the number.
[[nodiscard]] std::string result_name(XrResult result);

// Throws Error, or LostError where the loss is final, with the call's name and the result's; success passes through,
// qualified success too (XR_TIMEOUT_EXPIRED, XR_SESSION_LOSS_PENDING, ...).
XrResult check(XrResult result, const char* call);

}  // namespace xr
