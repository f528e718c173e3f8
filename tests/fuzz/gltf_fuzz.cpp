// Any bytes make a scene or are refused by InputError. External files are looked for in a folder that holds nothing.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include "render/scene/bvh.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/texture_texels.hpp"
#include "tracking/input_error.hpp"

namespace {

// In memory where the system has such a folder; gone with the process.
class Folder {
 public:
  Folder() {
    const bool shared = std::filesystem::is_directory("/dev/shm");
    std::string name = (shared ? "/dev/shm" : std::filesystem::temp_directory_path().string()) + "/gltf-fuzz-XXXXXX";
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string scene() const { return (path_ / "scene.gltf").string(); }

 private:
  std::filesystem::path path_;
};

void write(const std::string& path, const std::uint8_t* data, std::size_t size) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), std::fclose);
  if (!file || std::fwrite(data, 1, size, file.get()) != size) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  write(folder.scene(), data, size);
  try {
    const render::Scene scene = render::read_gltf(folder.scene());
    if (scene.triangles.size() > 10000) return 0;  // sound, and slow to build again and again
    const render::Bvh4 bvh = render::build_bvh4(scene);
    (void)render::shading_triangles(scene, bvh);
    render::TextureTexels texels(scene);
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
      if (std::size_t{scene.textures[i].width} * scene.textures[i].height > 4096) continue;
      (void)texels.place(static_cast<std::int32_t>(i), render::TexelUse::cut_out);
      (void)texels.place(static_cast<std::int32_t>(i), render::TexelUse::alpha);
    }
    (void)texels.pack();
  } catch (const tracking::InputError&) {
  }
  return 0;
}
