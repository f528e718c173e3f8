// Converged pictures kept between runs, each under a key of everything that it depends on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "render/image/image.hpp"
#include "render/renderer.hpp"

namespace app {

// FNV-1a, 64 bits.
class Digest {
 public:
  void add(std::span<const std::byte> bytes);
  void add(const std::string& text);
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void add(T value) { add(std::as_bytes(std::span(&value, 1))); }
  [[nodiscard]] std::string text() const;  // 16 hexadecimal digits

 private:
  std::uint64_t state_ = 0xcbf29ce484222325U;
};

// What a picture shows and how it is made. `program` names the build that makes it, `device` what it runs on.
[[nodiscard]] std::string reference_key(const render::Scene& scene, const lenses::LensModel& lenses,
                                        const std::vector<render::ViewSetup>& views, const render::FrameConfig& config,
                                        const std::string& device, const std::string& program);

class ReferenceStore {
 public:
  // An empty folder keeps nothing.
  explicit ReferenceStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Nothing where there is none, or none that is whole.
  [[nodiscard]] std::optional<render::Image8> find(const std::string& key) const;
  // The oldest go when there are many. A picture that cannot be kept is computed again: no error.
  void keep(const std::string& key, const render::Image8& picture) const;

  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace app
