// Typed, range-checked reading of glTF accessors: plain, strided, quantised (KHR_mesh_quantization) and sparse.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "render/scene/gltf_document.hpp"

namespace render {

// field: where the accessor is used, for messages. Every number that comes back is finite.
[[nodiscard]] std::vector<glm::vec3> read_vec3(const GltfDocument& document, int accessor, const std::string& field);
// Texture coordinates may also be normalised 8- or 16-bit integers.
[[nodiscard]] std::vector<glm::vec2> read_texture_coordinates(const GltfDocument& document, int accessor,
                                                              const std::string& field);
// Vertex colours, VEC3 (alpha 1) or VEC4: floats or normalised 8- or 16-bit integers, clamped to 0..1.
[[nodiscard]] std::vector<glm::vec4> read_colours(const GltfDocument& document, int accessor, const std::string& field);
// Every index is below vertices.
[[nodiscard]] std::vector<std::uint32_t> read_indices(const GltfDocument& document, int accessor,
                                                      const std::string& field, std::size_t vertices);

}  // namespace render
