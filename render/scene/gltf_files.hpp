// The files of a scene: its own and those it names, all in its folder and of bounded size.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace render {

// Of the scene's file and all its buffers' files together; tinygltf copies what a binary file holds.
inline constexpr std::size_t kMostSceneFileBytes = std::size_t{1} << 29;

// Empty and an error number when it cannot be read; EFBIG when it has more bytes than a scene may.
[[nodiscard]] std::vector<std::uint8_t> read_whole(const std::filesystem::path& path, int& error);
[[nodiscard]] std::string why_unreadable(int error);

// Percent-decoded; empty when it is not a plain relative path.
[[nodiscard]] std::filesystem::path local_path(const std::string& uri);
// With symbolic links followed.
[[nodiscard]] bool is_inside(const std::filesystem::path& folder, const std::filesystem::path& path);

// The file system that tinygltf sees: regular files in the folder, which must outlive it.
[[nodiscard]] tinygltf::FsCallbacks lent_files(std::filesystem::path& folder);

}  // namespace render
