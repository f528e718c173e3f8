#include "render/scene/gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "render/scene/gltf_shape.hpp"
#include "tracking/input_error.hpp"

namespace render {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kLargestFile = 0xFFFFFFFF;  // tinygltf and the binary container count in 32 bits
// Far beyond any real file; tinygltf descends into extras by recursion.
constexpr int kDeepestJson = 64;

constexpr std::array kExtensions = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_unlit",
                                    "KHR_mesh_quantization", "KHR_texture_transform"};

// For messages: no control characters, and not a whole data URI.
std::string one_line(std::string text) {
  if (text.size() > 300) text = text.substr(0, 300) + "...";
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

// Empty and an error number when it cannot be read.
Bytes read_whole(const fs::path& path, int& error) {
  struct Close {
    void operator()(std::FILE* f) const { (void)std::fclose(f); }
  };
  error = 0;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    error = errno;
    return {};
  }
  Bytes bytes;
  std::vector<std::uint8_t> block(1U << 20);
  for (;;) {
    errno = 0;
    const std::size_t got = std::fread(block.data(), 1, block.size(), file.get());
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(got));
    if (std::ferror(file.get()) != 0) error = errno != 0 ? errno : EIO;
    if (bytes.size() > kLargestFile) error = EFBIG;
    if (error != 0) return {};
    if (got < block.size()) return bytes;
  }
}

bool is_inside(const fs::path& folder, const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return false;
  const fs::path relative = real.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

// Percent-decoded; empty when it is not a plain relative path inside the folder.
fs::path local_path(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const auto is_hex = [&](std::size_t at) {
      return at < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[at]));
    };
    if (uri[i] == '%' && is_hex(i + 1) && is_hex(i + 2)) {
      name += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      name += uri[i];
    }
  }
  const fs::path path(name);
  const bool climbs = std::any_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
  const bool foreign = name.find_first_of(std::string(":\\\0", 3)) != std::string::npos;
  return path.is_absolute() || climbs || foreign ? fs::path() : path;
}

bool is_data_uri(const std::string& uri) {
  return uri.starts_with("data:");
}

// The file system that tinygltf sees: regular files in the scene's folder.
bool lent_exists(const std::string& path, void* folder) {
  std::error_code error;
  return fs::is_regular_file(path, error) && is_inside(*static_cast<const fs::path*>(folder), path);
}

std::string lent_expand(const std::string& path, void*) {
  return path;
}

bool lent_read(std::vector<unsigned char>* out, std::string* message, const std::string& path, void* folder) {
  int error = ENOENT;
  if (lent_exists(path, folder)) *out = read_whole(path, error);
  if (error != 0 && message != nullptr) *message += std::strerror(error);
  return error == 0;
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

json parse_json(const std::string& file, std::string_view text) {
  const auto bounded = [&](int depth, json::parse_event_t, json&) {
    if (depth > kDeepestJson) throw tracking::InputError(file, "", "nests deeper than 64 levels; 64 are allowed");
    return true;
  };
  try {
    return json::parse(text, bounded);
  } catch (const json::exception& error) {
    // Without the library's own name for it, which stands in brackets.
    const std::string what = error.what();
    const std::size_t name = what.find("] ");
    const std::string said = what.substr(name == std::string::npos ? 0 : name + 2);
    throw tracking::InputError(file, "", "is not valid JSON: " + one_line(said) + "; a .gltf or .glb file is expected");
  }
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

// External buffers must exist and have their size, so that tinygltf has no reason to refuse them without a field.
void check_buffers(const GltfDocument& document, const json& root, bool binary) {
  const json buffers = root.value("buffers", json::array());
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::string field = "buffers[" + std::to_string(i) + "]";
    const std::string uri = buffers[i].value("uri", "");
    const auto length = buffers[i]["byteLength"].get<std::size_t>();
    if (length == 0) document.fail(field + ".byteLength", "is 0; at least 1 is allowed");
    if (uri.empty() && !binary) document.fail(field + ".uri", "is missing; a .gltf file needs it");
    if (uri.empty() || is_data_uri(uri)) continue;
    const std::size_t size = read_external_file(document, uri, field + ".uri").size();
    if (size != length) {
      document.fail(field + ".byteLength", "is " + std::to_string(length) + ", but " + uri + " has " +
                                               std::to_string(size) + " bytes; the two must agree");
    }
  }
}

void load_model(GltfDocument& document, const Bytes& bytes) {
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({lent_exists, lent_expand, lent_read, nullptr, &document.folder});
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
    document.fail(field, shown + " cannot be read: " + std::strerror(error) + "; a regular file is expected");
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
  GltfDocument document{path, {}, 0, {}};
  int error = 0;
  check_length(document);
  const Bytes bytes = read_whole(path, error);
  if (error != 0)
    document.fail("", std::string("cannot be read: ") + std::strerror(error) + "; a .gltf or .glb file is expected");
  if (bytes.empty()) document.fail("", "is empty; a .gltf or .glb file is expected");
  document.folder = fs::canonical(fs::absolute(path).parent_path());
  const bool binary = is_binary(bytes);
  const json root =
      parse_json(path, binary ? json_chunk(path, bytes)
                              : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  check_version(path, root);
  check_gltf_shape(root, path);
  check_extensions(path, root);
  check_buffers(document, root, binary);
  load_model(document, bytes);
  check_views(document);
  return document;
}

}  // namespace render
