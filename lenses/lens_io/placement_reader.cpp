#include "lenses/lens_io/placement_reader.hpp"

namespace lenses::io {
namespace {

constexpr double kReachMm = 100.0;
constexpr double kSteepest = 2.0;  // 63 degrees; 20 prism dioptres at index 1.5 are 0.4

}  // namespace

Placement read_placement(const Field& surface) {
  Placement placement;
  if (const auto decentration = surface.find("decentration_mm")) {
    placement.decentration = decentration->pair(millimetres(-kReachMm, kReachMm));
  }
  if (const auto slope = surface.find("slope")) placement.slope = slope->pair(plain(-kSteepest, kSteepest));
  surface.read("height_mm", millimetres(-kReachMm, kReachMm), placement.height);
  return placement;
}

}  // namespace lenses::io
