// The connection to a runtime, and the headset it drives.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "xr/error.hpp"

namespace xr {

struct InstanceConfig {
  std::string application = "vergence";
  // Enabled where the runtime (or an API layer) offers them; has() tells which are.
  std::vector<std::string> wanted_extensions;
};

class Instance {
 public:
  // Throws Error, in words that say how to get there, for: no runtime, one that does not know our version of OpenXR or
  // cannot draw with Vulkan, no headset, a headset without two views.
  explicit Instance(const InstanceConfig& config = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  [[nodiscard]] XrInstance handle() const { return instance_; }
  [[nodiscard]] XrSystemId system() const { return system_; }
  [[nodiscard]] const std::string& runtime_name() const { return runtime_name_; }
  [[nodiscard]] const std::string& headset_name() const { return headset_name_; }
  [[nodiscard]] bool has(std::string_view extension) const { return extensions_.contains(extension); }

  // Fills a chain of the caller's with the system's properties (xrGetSystemProperties).
  void get_properties(XrSystemProperties& properties) const;

  // The runtime's next event, if there is one.
  [[nodiscard]] std::optional<XrEventDataBuffer> poll() const;

  [[nodiscard]] XrPath path(const char* text) const;

  // A function of an extension; throws Error where the runtime does not have it.
  template <class F>
  [[nodiscard]] F function(const char* name) const {
    return reinterpret_cast<F>(function_pointer(name));
  }

 private:
  [[nodiscard]] PFN_xrVoidFunction function_pointer(const char* name) const;

  XrInstance instance_ = XR_NULL_HANDLE;
  XrSystemId system_ = XR_NULL_SYSTEM_ID;
  std::string runtime_name_, headset_name_;
  std::set<std::string, std::less<>> extensions_;
};

}  // namespace xr
