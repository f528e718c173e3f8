#include "app/output_place.hpp"

#include <unistd.h>

#include <filesystem>

#include "render/image/output_error.hpp"

namespace app {

void check_place(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw render::OutputError(file, "", "cannot be written: there is no folder " + folder.string());
  }
  if (::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0 || std::filesystem::is_directory(file)) {
    throw render::OutputError(file, "", "cannot be written: a file in a writable folder is expected");
  }
}

}  // namespace app
