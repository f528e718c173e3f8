#include "xr/visibility_mask.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "xr/convert.hpp"

namespace xr {
namespace {

using tracking::Side;

// What is hidden, not what is seen: an empty mesh says "nothing" of the one and nothing certain of the other.
constexpr auto kMesh = XR_VISIBILITY_MASK_TYPE_HIDDEN_TRIANGLE_MESH_KHR;
constexpr auto kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
constexpr std::uint32_t kMostCorners = 1U << 20U;  // some thousand are usual

// The mesh may change between the question for its size and the one for itself.
struct Mesh {
  XrResult result = XR_SUCCESS;
  std::vector<XrVector2f> vertices;
  std::vector<std::uint32_t> indices;
};

Mesh mesh_of(PFN_xrGetVisibilityMaskKHR get, XrSession session, Side side) {
  Mesh mesh;
  XrVisibilityMaskKHR mask{};
  mask.type = XR_TYPE_VISIBILITY_MASK_KHR;
  for (int tries = 0; tries < 4; ++tries) {
    const auto fill = [&] {
      mesh.result = get(session, kStereo, view_index(side), kMesh, &mask);
      return mesh.result;
    };
    mask.vertexCapacityInput = mask.indexCapacityInput = 0;
    if (XR_FAILED(fill())) {
      return mesh;
    }
    if (mask.vertexCountOutput > kMostCorners || mask.indexCountOutput > kMostCorners) {
      mesh.result = XR_ERROR_LIMIT_REACHED;
      return mesh;
    }
    mesh.vertices.resize(mask.vertexCountOutput);
    mesh.indices.resize(mask.indexCountOutput);
    if (mesh.vertices.empty() || mesh.indices.empty()) {
      return mesh;
    }
    mask.vertexCapacityInput = mask.vertexCountOutput;
    mask.indexCapacityInput = mask.indexCountOutput;
    mask.vertices = mesh.vertices.data();
    mask.indices = mesh.indices.data();
    if (fill() != XR_ERROR_SIZE_INSUFFICIENT) {
      break;
    }
  }
  mesh.vertices.resize(std::min<std::size_t>(mesh.vertices.size(), mask.vertexCountOutput));
  mesh.indices.resize(std::min<std::size_t>(mesh.indices.size(), mask.indexCountOutput));
  return mesh;
}

}  // namespace

std::optional<tracking::HiddenArea> hidden_area(std::span<const XrVector2f> vertices,
                                                std::span<const std::uint32_t> indices) {
  const auto is_sound = [&](std::uint32_t i) {
    return i < vertices.size() && std::isfinite(vertices[i].x) && std::isfinite(vertices[i].y);
  };
  if (indices.size() % 3 != 0 || !std::ranges::all_of(indices, is_sound)) {
    return std::nullopt;
  }
  tracking::HiddenArea area;
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    tracking::TangentTriangle& triangle = area.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const XrVector2f& corner = vertices[indices[i + k]];
      triangle[k] = {corner.x, corner.y};
    }
  }
  return area;
}

HiddenView ask_hidden(PFN_xrGetVisibilityMaskKHR get, XrSession session, Side side) {
  constexpr const char* kCall = "xrGetVisibilityMaskKHR";
  const Mesh mesh = mesh_of(get, session, side);
  if (mesh.result == XR_ERROR_SESSION_LOST || mesh.result == XR_ERROR_INSTANCE_LOST) {
    check(mesh.result, kCall);
  }
  if (XR_FAILED(mesh.result)) {
    return {{}, std::string(kCall) + ": " + result_name(mesh.result)};
  }
  if (auto area = hidden_area(mesh.vertices, mesh.indices)) {
    return {std::move(*area), {}};
  }
  return {{}, std::string(kCall) + ": the runtime's mesh of triangles is none"};
}

VisibilityMasks::VisibilityMasks(const Session& session) : session_(session) {
  if (!session.instance().has(XR_KHR_VISIBILITY_MASK_EXTENSION_NAME)) {
    return;
  }
  get_ = session.instance().function<PFN_xrGetVisibilityMaskKHR>("xrGetVisibilityMaskKHR");
  ask(Side::right);
  ask(Side::left);
}

void VisibilityMasks::handle(const XrEventDataBuffer& event) {
  if (event.type != XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR || get_ == nullptr) {
    return;
  }
  const auto& change = reinterpret_cast<const XrEventDataVisibilityMaskChangedKHR&>(event);
  for (const Side side : {Side::right, Side::left}) {
    if (change.session == session_.handle() && change.viewConfigurationType == kStereo &&
        change.viewIndex == view_index(side)) {
      ask(side);
      ++changes_;
    }
  }
}

void VisibilityMasks::ask(Side side) {
  views_[static_cast<std::size_t>(side)] = ask_hidden(get_, session_.handle(), side);
}

}  // namespace xr
