// The shape of a glTF's JSON, checked before tinygltf reads it: tinygltf takes a value of the wrong type for an absent
// one, wraps large integers and keeps indices that lead nowhere. After this check every field that the reader uses has
// its type, its length and an index that exists.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace render {

// Throws tracking::InputError with the path of the field, such as meshes[0].primitives[0].indices.
void check_gltf_shape(const nlohmann::json& root, const std::string& file);

}  // namespace render
