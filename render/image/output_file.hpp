// Files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

namespace render {

// Calls write with the path of a temporary file beside the target, then renames it to the target. When anything fails
// the temporary file is removed, the target stays as it was, and OutputError is thrown.
void replace_file(const std::filesystem::path& target,
                  const std::function<void(const std::filesystem::path& temporary)>& write);

void write_file(const std::filesystem::path& target, std::span<const std::byte> contents);

}  // namespace render
