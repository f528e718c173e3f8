#include "render/scene/gltf_files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace render {

namespace fs = std::filesystem;

namespace {

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

}  // namespace

std::vector<std::uint8_t> read_whole(const fs::path& path, int& error) {
  struct Close {
    void operator()(std::FILE* f) const { (void)std::fclose(f); }
  };
  error = 0;
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    error = errno;
    return {};
  }
  // Of a pipe the size is not known before its end.
  std::error_code status;
  const std::uintmax_t size = fs::is_regular_file(path, status) ? fs::file_size(path, status) : 0;
  if (size > kMostSceneFileBytes) {
    error = EFBIG;
    return {};
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(size);
  std::vector<std::uint8_t> block(1U << 20);
  for (;;) {
    errno = 0;
    const std::size_t got = std::fread(block.data(), 1, block.size(), file.get());
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(got));
    if (std::ferror(file.get()) != 0) error = errno != 0 ? errno : EIO;
    if (bytes.size() > kMostSceneFileBytes) error = EFBIG;
    if (error != 0) return {};
    if (got < block.size()) return bytes;
  }
}

std::string why_unreadable(int error) {
  return std::string("cannot be read: ") +
         (error == EFBIG ? "it has more than " + std::to_string(kMostSceneFileBytes) + " bytes" : std::strerror(error));
}

bool is_inside(const fs::path& folder, const fs::path& path) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return false;
  const fs::path relative = real.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

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

tinygltf::FsCallbacks lent_files(fs::path& folder) {
  return {lent_exists, lent_expand, lent_read, nullptr, &folder};
}

}  // namespace render
