// How chief rays find what they meet; the picture is the same.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace render {

enum class Traversal {
  automatic,  // what a short measurement finds faster on this device
  per_ray,    // each ray by itself through the 4-wide tree
  tile,       // 8 x 8 rays together through the 8-wide tree; where the device cannot, per ray
  ray_query,  // by the device's own ray queries; a renderer on a device without them throws vk::DeviceError
};

struct RendererConfig {
  Traversal traversal = Traversal::tile;
  std::filesystem::path traversal_file = {};  // keeps what automatic measured; empty: each renderer measures for itself
};

// Chief rays without a lens share an origin and are straight; through lenses they do neither.
enum class RayKind { bare, refracted };

// What was measured, in a text file of one line a device and kind of ray.
class TraversalRecord {
 public:
  // An empty path keeps nothing.
  TraversalRecord(std::filesystem::path file, std::string device)
      : file_(std::move(file)), device_(std::move(device)) {}

  // Nothing where the file is missing, damaged or silent about this device.
  [[nodiscard]] std::optional<Traversal> find(RayKind kind) const;

  // All or nothing; a file that cannot be written is no error, for the next run measures again.
  void keep(RayKind kind, Traversal traversal) const;

 private:
  [[nodiscard]] std::string line(RayKind kind, Traversal traversal) const;

  std::filesystem::path file_;
  std::string device_;
};

}  // namespace render
