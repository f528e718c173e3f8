#include "app/report/output_folder.hpp"

#include <unistd.h>

#include <span>
#include <system_error>

#include "render/image/output_file.hpp"
#include "tracking/input_error.hpp"

namespace app {

OutputFolder::OutputFolder(const std::string& option, const std::string& folder)
    : path_(folder), is_new_(!std::filesystem::exists(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error) || ::access(folder.c_str(), W_OK) != 0) {
    throw tracking::InputError(option, "",
                               "'" + folder + "' cannot be made; a folder that can be written to is expected");
  }
}

OutputFolder::~OutputFolder() {
  if (std::error_code error; is_new_ && std::filesystem::is_empty(path_, error) && !error) {
    std::filesystem::remove(path_, error);
  }
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  render::write_file(file, std::as_bytes(std::span(text)));
}

}  // namespace app
