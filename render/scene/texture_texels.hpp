// A scene's textures as the words of one texel buffer: each a header of kTextureHeader words (where its levels begin,
// counted from the header's first word), then its mip levels, finest first, row by row. Colours are linear, so that
// filtering them is: RGB9E5, a word a texel. Alpha is a texture of its own, a byte a texel, because the test whether a
// ray meets a cut-out triangle wants nothing else; data (roughness, normals) are 4 x 8 bit.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "render/scene/scene.hpp"

namespace render {

enum class TexelUse : std::uint32_t {
  colour,
  cut_out,  // a colour whose texels count by their alpha when they are averaged
  data,
  alpha
};

struct PlacedTexture {
  std::uint32_t first_word = 0, width = 0, height = 0, levels = 0;
  std::uint32_t wrap = 0;    // wrap_u | wrap_v << 8
  std::uint32_t format = 0;  // kTexel... of shaders/view.h
};

class TextureTexels {
 public:
  explicit TextureTexels(const Scene& scene) : scene_(scene) {}

  // The place in textures() of a texture of the scene stored for that use; -1 for -1. Nothing is stored twice.
  [[nodiscard]] std::int32_t place(std::int32_t texture, TexelUse use);

  [[nodiscard]] const std::vector<PlacedTexture>& textures() const { return textures_; }
  [[nodiscard]] std::size_t word_count() const { return word_count_; }

  // All that was placed, packed now.
  [[nodiscard]] std::vector<std::uint32_t> pack() const;

 private:
  struct Request {
    std::int32_t texture;
    TexelUse use;
  };
  const Scene& scene_;
  std::vector<Request> requests_;
  std::vector<PlacedTexture> textures_;
  std::map<std::pair<std::int32_t, TexelUse>, std::int32_t> places_;
  std::size_t word_count_ = 0;
};

}  // namespace render
