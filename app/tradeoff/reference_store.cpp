#include "app/tradeoff/reference_store.hpp"

#include <algorithm>
#include <charconv>
#include <exception>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "app/report/text.hpp"
#include "render/image/output_file.hpp"

namespace app {
namespace {

constexpr std::size_t kMostKept = 32;  // of about half a megabyte each
constexpr const char* kKind = "vergence reference 1";
constexpr const char* kExtension = ".picture";

template <class T>
void add_all(Digest& digest, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  digest.add(values.size());
  digest.add(std::as_bytes(std::span(values)));
}

template <class T>
void add_vector(Digest& digest, const T& vector) {
  digest.add(std::as_bytes(std::span(&vector, 1)));
}

void add_use(Digest& digest, const render::TextureUse& use) {
  digest.add(use.index);
  digest.add(use.second_uv);
  add_vector(digest, use.linear);
  add_vector(digest, use.offset);
}

// Member by member: what pads a structure is anything.
void add_material(Digest& digest, const render::Material& m) {
  add_vector(digest, m.base_colour);
  add_vector(digest, m.emission);
  for (const render::TextureUse* use :
       {&m.base_colour_texture, &m.emission_texture, &m.surface_texture, &m.normal_texture, &m.occlusion_texture}) {
    add_use(digest, *use);
  }
  for (const float value : {m.metallic, m.roughness, m.normal_scale, m.occlusion_strength, m.alpha_cutoff}) {
    digest.add(value);
  }
  digest.add(m.alpha);
  digest.add(m.double_sided);
  digest.add(m.unlit);
}

void add_light(Digest& digest, const render::Light& light) {
  digest.add(light.type);
  add_vector(digest, light.colour);
  add_vector(digest, light.position);
  add_vector(digest, light.direction);
  for (const float value : {light.range, light.cos_inner, light.cos_outer}) {
    digest.add(value);
  }
}

void add_scene(Digest& digest, const render::Scene& scene) {
  static_assert(sizeof(render::Vertex) == 8 * sizeof(float));
  add_all(digest, scene.vertices);
  add_all(digest, scene.second_uvs);
  add_all(digest, scene.colours);
  add_all(digest, scene.triangles);
  add_all(digest, scene.triangle_material);
  for (const render::Material& material : scene.materials) {
    add_material(digest, material);
  }
  for (const render::Texture& texture : scene.textures) {
    for (const std::uint32_t value : {texture.width, texture.height}) {
      digest.add(value);
    }
    digest.add(texture.wrap_u);
    digest.add(texture.wrap_v);
    add_all(digest, texture.rgba);
  }
  for (const render::Light& light : scene.lights) {
    add_light(digest, light);
  }
  add_vector(digest, scene.environment.sky_zenith);
  add_vector(digest, scene.environment.sky_horizon);
  add_vector(digest, scene.environment.ambient);
}

std::optional<int> whole_number(const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::string digest_of(const std::vector<std::uint8_t>& bytes) {
  Digest digest;
  add_all(digest, bytes);
  return digest.text();
}

void drop_oldest(const std::filesystem::path& folder) {
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> kept;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == kExtension) {
      kept.emplace_back(entry.last_write_time(), entry.path());
    }
  }
  std::ranges::sort(kept);
  for (std::size_t i = 0; i + kMostKept < kept.size(); ++i) {
    std::filesystem::remove(kept[i].second);
  }
}

}  // namespace

void Digest::add(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    state_ = (state_ ^ static_cast<std::uint64_t>(byte)) * 0x100000001b3U;
  }
}

void Digest::add(const std::string& text) {
  add(text.size());
  add(std::as_bytes(std::span(text)));
}

std::string Digest::text() const {
  return format("%016llx", static_cast<unsigned long long>(state_));
}

std::string reference_key(const render::Scene& scene, const lenses::LensModel& lenses,
                          const std::vector<render::ViewSetup>& views, const render::FrameConfig& config,
                          const std::string& device, const std::string& program) {
  Digest shown;
  add_scene(shown, scene);
  add_all(shown, lenses.lens);
  add_all(shown, lenses.table);
  for (const render::ViewSetup& view : views) {
    add_vector(shown, render::make_view_data(view, lenses));
    add_vector(shown, view.eye);
  }
  return "picture " + shown.text() +
         format(" size %dx%d samples %d seed %u", config.width, config.height, config.samples,
                static_cast<unsigned>(config.seed)) +
         format(" exposure %.17g bare %d double %d", config.exposure, config.bare ? 1 : 0,
                config.accuracy.lens.in_double ? 1 : 0) +
         " program " + program + " device " + device;
}

std::filesystem::path ReferenceStore::file_of(const std::string& key) const {
  Digest digest;
  digest.add(key);
  return folder_ / (digest.text() + kExtension);
}

// Lines: kind, key, width, height, digest of the pixels; then the pixels.
std::optional<render::Image8> ReferenceStore::find(const std::string& key) const {
  if (folder_.empty()) {
    return std::nullopt;
  }
  std::ifstream in(file_of(key), std::ios::binary);
  std::string kind, whose, width, height, digest;
  for (std::string* line : {&kind, &whose, &width, &height, &digest}) {
    if (!std::getline(in, *line)) {
      return std::nullopt;
    }
  }
  const auto w = whole_number(width), h = whole_number(height);
  constexpr int kLargestSide = 65536;
  if (kind != kKind || whose != key || !w || !h || *w < 1 || *h < 1 || *w > kLargestSide || *h > kLargestSide) {
    return std::nullopt;
  }
  render::Image8 picture{*w, *h, std::vector<std::uint8_t>(std::istreambuf_iterator<char>(in), {})};
  const std::size_t expected = 3 * static_cast<std::size_t>(*w) * static_cast<std::size_t>(*h);
  if (picture.rgb.size() != expected || digest_of(picture.rgb) != digest) {
    return std::nullopt;
  }
  return picture;
}

void ReferenceStore::keep(const std::string& key, const render::Image8& picture) const {
  if (folder_.empty()) {
    return;
  }
  std::string text = std::string(kKind) + "\n" + key + "\n" + std::to_string(picture.width) + "\n" +
                     std::to_string(picture.height) + "\n" + digest_of(picture.rgb) + "\n";
  text.append(picture.rgb.begin(), picture.rgb.end());
  try {
    std::filesystem::create_directories(folder_);
    render::write_file(file_of(key), std::as_bytes(std::span(text)));
    drop_oldest(folder_);
  } catch (const std::exception&) {
    // The next run takes as long as this one: no reason to lose what has been measured.
  }
}

}  // namespace app
