// make_assets: writes the built-in scene, the scenes around fetched models, and the example spectacles that are
// committed beside it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>

#include "assets/generator/glb_writer.hpp"
#include "assets/generator/model_scenes.hpp"
#include "assets/generator/reading_room.hpp"
#include "assets/generator/spectacles_writer.hpp"

namespace {

// Written beside its place first, so that a failure leaves no half file.
void write_file(const std::filesystem::path& path, std::span<const char> bytes) {
  std::filesystem::create_directories(path.parent_path().empty() ? "." : path.parent_path());
  const std::filesystem::path part = path.string() + ".part";
  std::ofstream stream(part, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw std::runtime_error(path.string() + ": cannot be written");
  std::filesystem::rename(part, path);
}

// The scenes of models, and what each holds on standard output.
void write_scenes(const std::string& folder, const std::string& models, const std::string& font) {
  const auto write = [&](const std::string& name, const assets::SceneModel& scene) {
    const std::vector<std::uint8_t> bytes = assets::glb_bytes(scene);
    write_file(std::filesystem::path(folder) / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    std::printf("%-16s %7zu triangles, %zu of them the models'\n", name.c_str(), scene.triangle_count(),
                assets::model_triangle_count(scene));
  };
  write("car_scene.glb", assets::make_car_scene(models, font));
  write("chessboard.glb", assets::make_table_scene(models + "/chessboard.glb", 0.30));
  write("engine.glb", assets::make_table_scene(models + "/2CylinderEngine.glb", 0.45));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes the reading room (glTF binary), scenes around models, and the example spectacles.");
  std::string output, spectacles, fine_net, models, scenes, font = VERGENCE_SERIF_FONT;
  app.add_option("--output", output, "where the scene goes, a .glb file");
  app.add_option("--spectacles", spectacles, "folder whose spectacles/ and lenses/ get the example files");
  app.add_option("--fine-net", fine_net, "where the benchmark's pair of 100 x 100 control points goes, a .json file");
  app.add_option("--models", models, "folder with the models that fetch_scenes.sh converts");
  app.add_option("--scenes", scenes, "folder that gets the scenes around those models")->needs("--models");
  app.add_option("--font", font, "outline font with serifs, for texts and charts")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    if (!output.empty()) {
      const std::vector<std::uint8_t> bytes = assets::glb_bytes(assets::make_reading_room(font));
      write_file(output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    if (!fine_net.empty()) write_file(fine_net, assets::fine_net_pair());
    if (!scenes.empty()) write_scenes(scenes, models, font);
    if (!spectacles.empty()) {
      for (const auto& [path, text] : assets::spectacles_files())
        write_file(std::filesystem::path(spectacles) / path, text);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_assets: %s\n", error.what());
    return 1;
  }
  return 0;
}
