// A glTF file as tinygltf's model, after everything that can be checked without decoding: the container, the JSON's
// shape, required extensions, external files, and the ranges of buffer views.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace render {

struct GltfDocument {
  std::string file;                 // as the user named it, for messages
  std::filesystem::path folder;     // absolute; external files lie here or below
  mutable std::size_t decoded = 0;  // elements of accessors so far: the same ones may be asked for again and again
  mutable std::size_t encoded = 0;  // bytes of images so far, as decoded
  tinygltf::Model model;            // images are encoded bytes (data URI), a uri, or a buffer view: none is decoded

  [[noreturn]] void fail(const std::string& field, const std::string& reason) const;
  [[nodiscard]] bool uses(const std::string& extension) const;
  [[nodiscard]] std::span<const std::uint8_t> view_bytes(int buffer_view) const;
};

[[nodiscard]] GltfDocument load_gltf_document(const std::string& path);

// The bytes of a file that a uri names relative to the document; throws at the field.
[[nodiscard]] std::vector<std::uint8_t> read_external_file(const GltfDocument& document, const std::string& uri,
                                                           const std::string& field);

}  // namespace render
