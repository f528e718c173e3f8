// 8-bit PNG, marked as sRGB.
#pragma once

#include <filesystem>

#include "render/image/image.hpp"

namespace render {

// All or nothing; throws OutputError.
void write_png(const std::filesystem::path& file, const Image8& image);

// Any PNG, brought to 8-bit RGB without its transparency. Throws tracking::InputError.
[[nodiscard]] Image8 read_png(const std::filesystem::path& file);

}  // namespace render
