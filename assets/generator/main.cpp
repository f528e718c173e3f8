// make_assets: writes the built-in scene, and the example spectacles that are committed beside it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>

#include "assets/generator/glb_writer.hpp"
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes the reading room (glTF binary) and the example spectacles.");
  std::string output, spectacles, font = VERGENCE_SERIF_FONT;
  app.add_option("--output", output, "where the scene goes, a .glb file");
  app.add_option("--spectacles", spectacles, "folder whose spectacles/ and lenses/ get the example files");
  app.add_option("--font", font, "outline font with serifs, for texts and charts")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    if (!output.empty()) {
      const std::vector<std::uint8_t> bytes = assets::glb_bytes(assets::make_reading_room(font));
      write_file(output, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
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
