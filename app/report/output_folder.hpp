// Where a report goes.
#pragma once

#include <filesystem>
#include <string>

namespace app {

// A folder for what a run writes, said to be impossible before minutes of work; where the run fails, one made for it
// goes again as long as it is empty.
class OutputFolder {
 public:
  // Throws InputError, with the option's name, where nothing can be written.
  OutputFolder(const std::string& option, const std::string& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool is_new_;
};

// All or nothing; throws OutputError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace app
