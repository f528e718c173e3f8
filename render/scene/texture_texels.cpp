#include "render/scene/texture_texels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>
#include <glm/vec4.hpp>
#include <stdexcept>

namespace render {
namespace {

// As in shaders/view.h; tests hold them together by what they show.
constexpr std::uint32_t kHeader = 16;
enum : std::uint32_t { kColour, kData, kAlpha };

std::uint32_t format_of(TexelUse use) {
  if (use == TexelUse::alpha) return kAlpha;
  return use == TexelUse::data ? kData : kColour;
}

std::uint32_t level_size(std::uint32_t size, std::uint32_t level) {
  return std::max(size >> level, 1U);
}

std::uint32_t level_count(std::uint32_t width, std::uint32_t height) {
  std::uint32_t levels = 1;
  while (levels < kHeader && std::max(level_size(width, levels - 1), level_size(height, levels - 1)) > 1) ++levels;
  return levels;
}

std::size_t level_words(const PlacedTexture& t, std::uint32_t level) {
  const std::size_t texels = std::size_t{level_size(t.width, level)} * level_size(t.height, level);
  return t.format == kAlpha ? (texels + 3) / 4 : texels;
}

std::size_t words_of(const PlacedTexture& t) {
  std::size_t words = kHeader;
  for (std::uint32_t level = 0; level < t.levels; ++level) words += level_words(t, level);
  return words;
}

// The 8-bit image as linear values.
class Image {
 public:
  Image(const Texture& texture, TexelUse use) : texture_(texture) {
    const bool encoded = use == TexelUse::colour || use == TexelUse::cut_out;
    for (std::size_t i = 0; i < linear_.size(); ++i) {
      const double x = static_cast<double>(i) / 255.0;
      // IEC 61966-2-1.
      const double decoded = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
      linear_[i] = static_cast<float>(encoded ? decoded : x);
    }
  }
  [[nodiscard]] glm::vec4 operator()(std::size_t x, std::size_t y) const {
    const std::uint8_t* p = &texture_.rgba[4 * (y * texture_.width + x)];
    return {linear_[p[0]], linear_[p[1]], linear_[p[2]], static_cast<float>(p[3]) / 255.0F};
  }

 private:
  const Texture& texture_;
  std::array<float, 256> linear_{};
};

// A level already averaged.
struct Level {
  std::uint32_t width, height;
  std::vector<glm::vec4> texels;
  [[nodiscard]] glm::vec4 operator()(std::size_t x, std::size_t y) const { return texels[y * width + x]; }
};

struct Overlap {
  std::size_t first = 0, count = 0;
  std::array<float, 3> weight{};  // of at most three texels
};

// Which texels of `from` the i-th of `to` equal parts covers: exact also where a size is odd.
Overlap overlap(std::size_t i, std::size_t from, std::size_t to) {
  const double step = static_cast<double>(from) / static_cast<double>(to);
  const double low = static_cast<double>(i) * step, high = low + step;
  Overlap o;
  o.first = static_cast<std::size_t>(low);
  for (std::size_t at = o.first; at < from && o.count < 3 && static_cast<double>(at) < high - 1e-9; ++at) {
    const double covered = std::min(high, static_cast<double>(at) + 1.0) - std::max(low, static_cast<double>(at));
    o.weight[o.count++] = static_cast<float>(covered / step);
  }
  return o;
}

template <class Source>
Level halved(const Source& source, std::uint32_t width, std::uint32_t height, bool by_alpha) {
  Level out{level_size(width, 1), level_size(height, 1), {}};
  out.texels.reserve(std::size_t{out.width} * out.height);
  std::vector<Overlap> columns;
  for (std::size_t x = 0; x < out.width; ++x) columns.push_back(overlap(x, width, out.width));
  for (std::size_t y = 0; y < out.height; ++y) {
    const Overlap rows = overlap(y, height, out.height);
    for (const Overlap& column : columns) {
      glm::vec4 sum(0.0F);
      glm::vec3 opaque(0.0F);
      for (std::size_t j = 0; j < rows.count; ++j) {
        for (std::size_t i = 0; i < column.count; ++i) {
          const glm::vec4 texel = source(column.first + i, rows.first + j) * (rows.weight[j] * column.weight[i]);
          const glm::vec4 plain = source(column.first + i, rows.first + j);
          sum += texel;
          opaque += glm::vec3(texel) * plain.w;
        }
      }
      if (by_alpha && sum.w > 0.0F) sum = glm::vec4(opaque / sum.w, sum.w);
      out.texels.push_back(sum);
    }
  }
  return out;
}

template <class Source>
void append_level(const Source& source, const PlacedTexture& t, std::uint32_t level,
                  std::vector<std::uint32_t>& words) {
  const std::size_t width = level_size(t.width, level), height = level_size(t.height, level);
  const std::size_t first = words.size();
  words.resize(first + level_words(t, level), 0);
  for (std::size_t i = 0; i < width * height; ++i) {
    const glm::vec4 texel = source(i % width, i / width);
    if (t.format == kAlpha) {
      words[first + i / 4] |= static_cast<std::uint32_t>(std::lround(texel.w * 255.0F)) << (8 * (i % 4));
    } else if (t.format == kData) {
      words[first + i] = glm::packUnorm4x8(texel);
    } else {
      words[first + i] = glm::packF3x9_E1x5(glm::vec3(texel));
    }
  }
}

void append_texture(const Texture& texture, TexelUse use, const PlacedTexture& placed,
                    std::vector<std::uint32_t>& words) {
  const std::size_t header = words.size();
  words.resize(header + kHeader, 0);
  const Image image(texture, use);
  Level level;
  const bool by_alpha = use == TexelUse::cut_out;
  for (std::uint32_t l = 0; l < placed.levels; ++l) {
    words[header + l] = static_cast<std::uint32_t>(words.size() - header);
    if (l == 0) {
      append_level(image, placed, l, words);
      continue;
    }
    level = l == 1 ? halved(image, texture.width, texture.height, by_alpha)
                   : halved(level, level.width, level.height, by_alpha);
    append_level(level, placed, l, words);
  }
}

}  // namespace

std::int32_t TextureTexels::place(std::int32_t texture, TexelUse use) {
  if (texture < 0) return -1;
  const auto [found, is_new] = places_.try_emplace({texture, use}, static_cast<std::int32_t>(textures_.size()));
  if (!is_new) return found->second;
  const Texture& source = scene_.textures.at(static_cast<std::size_t>(texture));
  PlacedTexture placed;
  placed.first_word = static_cast<std::uint32_t>(word_count_);
  placed.width = source.width;
  placed.height = source.height;
  placed.levels = level_count(source.width, source.height);
  placed.wrap = static_cast<std::uint32_t>(source.wrap_u) | (static_cast<std::uint32_t>(source.wrap_v) << 8);
  placed.format = format_of(use);
  word_count_ += words_of(placed);
  requests_.push_back({texture, use});
  textures_.push_back(placed);
  return found->second;
}

std::vector<std::uint32_t> TextureTexels::pack() const {
  std::vector<std::uint32_t> words;
  words.reserve(word_count_);
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    append_texture(scene_.textures[static_cast<std::size_t>(requests_[i].texture)], requests_[i].use, textures_[i],
                   words);
  }
  if (words.size() != word_count_) throw std::logic_error("texels do not lie where they were placed");
  return words;
}

}  // namespace render
