// OpenEXR: linear values of any channels, ZIP-compressed, with the chromaticities of sRGB.
#pragma once

#include <filesystem>

#include "render/image/image.hpp"

namespace render {

// R, G and B as half floats (clamped to their range), all other channels as floats. All or nothing; throws OutputError.
void write_exr(const std::filesystem::path& file, const FloatImage& image);

// Every channel, in the order of their names. Throws tracking::InputError.
[[nodiscard]] FloatImage read_exr(const std::filesystem::path& file);

}  // namespace render
