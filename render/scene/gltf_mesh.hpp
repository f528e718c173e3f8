// A glTF mesh as world-space triangles.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "render/scene/gltf_document.hpp"
#include "render/scene/gltf_material.hpp"
#include "render/scene/scene.hpp"

namespace render {

// Appends all triangles of the mesh; points and lines have no surface and are passed over.
void append_mesh(const GltfDocument& document, int mesh, const glm::dmat4& world_from_mesh,
                 const std::vector<UvSets>& uv_sets, Scene& scene);

}  // namespace render
