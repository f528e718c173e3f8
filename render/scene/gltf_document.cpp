#include "render/scene/gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "render/scene/gltf_files.hpp"
#include "render/scene/gltf_json.hpp"
#include "render/scene/gltf_shape.hpp"
#include "tracking/input_error.hpp"

namespace render {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

constexpr std::array kExtensions = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit",
                                    "KHR_mesh_quantization", "KHR_texture_transform"};

bool is_data_uri(const std::string& uri) {
  return uri.starts_with("data:");
}

// Keeps a data URI's bytes; a buffer view's range is not checked yet, so its bytes are left alone.
bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void*) {
  if (image->bufferView >= 0) return true;
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

std::uint32_t word_at(const Bytes& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= static_cast<std::uint32_t>(bytes[offset + i]) << (8 * i);
  return word;
}

bool is_binary(const Bytes& bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

// The JSON chunk of a binary container whose chunks all lie inside the file (glTF 2.0, section 4.4).
std::string_view json_chunk(const std::string& file, const Bytes& bytes) {
  const auto fail = [&](const std::string& reason) -> void { throw tracking::InputError(file, "", reason); };
  constexpr std::uint32_t kJson = 0x4E4F534A;
  if (bytes.size() < 20)
    fail("is truncated: it has " + std::to_string(bytes.size()) + " bytes; a .glb has at least 20");
  if (word_at(bytes, 4) != 2) fail("is binary glTF " + std::to_string(word_at(bytes, 4)) + "; version 2 is allowed");
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size()) {
    fail("is truncated: its header says " + std::to_string(length) + " bytes, it has " + std::to_string(bytes.size()));
  }
  if (word_at(bytes, 16) != kJson) fail("does not begin with a JSON chunk; a .glb must");
  for (std::size_t at = 12; at < length;) {
    if (length - at < 8 || word_at(bytes, at) > length - at - 8) {
      fail("has a chunk at byte " + std::to_string(at) +
           " that reaches beyond its end; chunks must lie inside the file");
    }
    at += 8 + std::size_t{word_at(bytes, at)};
  }
  return {reinterpret_cast<const char*>(bytes.data()) + 20, word_at(bytes, 12)};
}

// Before anything else is found wrong with a file of another version. glTF 2.0, section 3.2: what a minor version adds
// may be passed over unless minVersion asks for it.
void check_version(const std::string& file, const json& root) {
  const auto asset = root.find("asset");
  if (!root.is_object() || asset == root.end() || !asset->is_object()) return;  // the shape's check says so
  for (const char* name : {"version", "minVersion"}) {
    const auto version = asset->find(name);
    if (version == asset->end() || !version->is_string()) continue;
    const auto& text = version->get_ref<const std::string&>();
    const bool is_two = text == "2" || text.starts_with("2.");
    if (!is_two || (name == std::string_view("minVersion") && text.starts_with("2.") && text != "2.0")) {
      throw tracking::InputError(file, std::string("asset.") + name, "is " + one_line(text) + "; glTF 2.0 is allowed");
    }
  }
}

void check_extensions(const std::string& file, const json& root) {
  const json required = root.value("extensionsRequired", json::array());
  for (std::size_t i = 0; i < required.size(); ++i) {
    const auto name = required[i].get<std::string>();
    if (std::find(kExtensions.begin(), kExtensions.end(), name) != kExtensions.end()) continue;
    std::string known;
    for (const char* extension : kExtensions) known += std::string(known.empty() ? "" : ", ") + extension;
    throw tracking::InputError(file, "extensionsRequired[" + std::to_string(i) + "]",
                               one_line(name) + " is not supported; supported are " + known);
  }
}

// An empty pair of braces becomes a structure of up to kilobytes.
void check_lists(const std::string& file, const json& root) {
  constexpr std::size_t kMost = std::size_t{1} << 29;  // bytes
  const std::pair<const char*, std::size_t> sizes[] = {
      {"accessors", sizeof(tinygltf::Accessor)}, {"animations", sizeof(tinygltf::Animation)},
      {"buffers", sizeof(tinygltf::Buffer)},     {"bufferViews", sizeof(tinygltf::BufferView)},
      {"cameras", sizeof(tinygltf::Camera)},     {"images", sizeof(tinygltf::Image)},
      {"materials", sizeof(tinygltf::Material)}, {"meshes", sizeof(tinygltf::Mesh)},
      {"nodes", sizeof(tinygltf::Node)},         {"samplers", sizeof(tinygltf::Sampler)},
      {"scenes", sizeof(tinygltf::Scene)},       {"skins", sizeof(tinygltf::Skin)},
      {"textures", sizeof(tinygltf::Texture)}};
  std::size_t bytes = 0;
  for (const auto& [name, size] : sizes) {
    const auto list = root.find(name);
    if (list == root.end()) continue;
    bytes += list->size() * size;
    if (bytes > kMost) {
      throw tracking::InputError(file, name,
                                 "has " + std::to_string(list->size()) + " elements; with the other lists they take " +
                                     std::to_string(bytes) + " bytes, of which " + std::to_string(kMost) +
                                     " are allowed");
    }
  }
}

// External buffers must exist and have their size, so that tinygltf has no reason to refuse them without a field. Each
// is kept, those that name one file too; bytes: of the scene's own file.
void check_buffers(const GltfDocument& document, const json& root, bool binary, std::size_t bytes) {
  const auto found = root.find("buffers");
  if (found == root.end()) return;
  const json& buffers = *found;
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::string field = "buffers[" + std::to_string(i) + "]";
    const std::string uri = buffers[i].value("uri", "");
    const auto length = buffers[i]["byteLength"].get<std::size_t>();
    if (length == 0) document.fail(field + ".byteLength", "is 0; at least 1 is allowed");
    if (uri.empty() && !binary) document.fail(field + ".uri", "is missing; a .gltf file needs it");
    if (uri.empty() || is_data_uri(uri)) continue;
    bytes += length;
    if (bytes > kMostSceneFileBytes) {
      document.fail(field + ".byteLength", "brings the scene to " + std::to_string(bytes) + " bytes; " +
                                               std::to_string(kMostSceneFileBytes) +
                                               " are allowed in all files together");
    }
    const std::size_t size = read_external_file(document, uri, field + ".uri").size();
    if (size != length) {
      document.fail(field + ".byteLength", "is " + std::to_string(length) + ", but " + uri + " has " +
                                               std::to_string(size) + " bytes; the two must agree");
    }
  }
}

void load_model(GltfDocument& document, const Bytes& bytes) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(lent_files(document.folder));
  loader.SetImageLoader(keep_image, nullptr);
  std::string errors, warnings;
  bool loaded = false;
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = document.folder.string();
  try {
    loaded = is_binary(bytes)
                 ? loader.LoadBinaryFromMemory(&document.model, &errors, &warnings, bytes.data(), size, folder)
                 : loader.LoadASCIIFromString(&document.model, &errors, &warnings,
                                              reinterpret_cast<const char*>(bytes.data()), size, folder);
  } catch (const std::exception& error) {
    errors += error.what();
  }
  if (!loaded || !errors.empty()) {
    document.fail("", "is not a valid glTF: " + one_line(errors + " " + warnings) + "; glTF 2.0 is expected");
  }
}

void check_views(const GltfDocument& document) {
  for (std::size_t i = 0; i < document.model.bufferViews.size(); ++i) {
    const tinygltf::BufferView& view = document.model.bufferViews[i];
    const std::size_t size = document.model.buffers.at(static_cast<std::size_t>(view.buffer)).data.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset || view.byteLength == 0) {
      document.fail("bufferViews[" + std::to_string(i) + "].byteLength",
                    "is " + std::to_string(view.byteLength) + " from byte " + std::to_string(view.byteOffset) +
                        "; buffer " + std::to_string(view.buffer) + " has " + std::to_string(size) +
                        " bytes, and at least one must be taken");
    }
  }
}

}  // namespace

void GltfDocument::fail(const std::string& field, const std::string& reason) const {
  throw tracking::InputError(file, field, reason);
}

bool GltfDocument::uses(const std::string& extension) const {
  const auto& used = model.extensionsUsed;
  const auto& required = model.extensionsRequired;
  return std::find(used.begin(), used.end(), extension) != used.end() ||
         std::find(required.begin(), required.end(), extension) != required.end();
}

std::span<const std::uint8_t> GltfDocument::view_bytes(int buffer_view) const {
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(buffer_view));
  const auto& data = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  return std::span(data).subspan(view.byteOffset, view.byteLength);
}

std::vector<std::uint8_t> read_external_file(const GltfDocument& document, const std::string& uri,
                                             const std::string& field) {
  const fs::path local = local_path(uri);
  const std::string shown = one_line(uri);
  if (local.empty() || !is_inside(document.folder, document.folder / local)) {
    document.fail(field, "is " + shown + "; a file in the scene's own folder or below is allowed");
  }
  std::error_code status;
  int error = fs::exists(document.folder / local, status) ? EINVAL : ENOENT;
  Bytes bytes;
  if (fs::is_regular_file(document.folder / local, status)) bytes = read_whole(document.folder / local, error);
  if (error != 0) {
    document.fail(field, shown + " " + why_unreadable(error) + "; a regular file of at most 512 MiB is expected");
  }
  return bytes;
}

// A binary file shorter than its header says is refused before it is read.
void check_length(const GltfDocument& document) {
  std::error_code status;
  if (!fs::is_regular_file(document.file, status)) return;
  Bytes head(20);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(document.file.c_str(), "rb"), std::fclose);
  if (!file || std::fread(head.data(), 1, head.size(), file.get()) != head.size() || !is_binary(head)) return;
  const std::uintmax_t size = fs::file_size(document.file, status);
  if (!status && word_at(head, 4) == 2 && word_at(head, 8) > size) {
    document.fail("", "is truncated: its header says " + std::to_string(word_at(head, 8)) + " bytes, it has " +
                          std::to_string(size));
  }
}

GltfDocument load_gltf_document(const std::string& path) {
  GltfDocument document{.file = path, .folder = {}, .model = {}};
  int error = 0;
  check_length(document);
  const Bytes bytes = read_whole(path, error);
  if (error != 0) document.fail("", why_unreadable(error) + "; a .gltf or .glb file of at most 512 MiB is expected");
  if (bytes.empty()) document.fail("", "is empty; a .gltf or .glb file is expected");
  document.folder = fs::canonical(fs::absolute(path).parent_path());
  const bool binary = is_binary(bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  {
    const json root = parse_gltf_json(path, binary ? json_chunk(path, bytes) : text);
    check_version(path, root);
    check_gltf_shape(root, path);
    check_extensions(path, root);
    check_lists(path, root);
    check_buffers(document, root, binary, bytes.size());
  }  // tinygltf makes a tree of its own
  load_model(document, bytes);
  check_views(document);
  return document;
}

}  // namespace render
