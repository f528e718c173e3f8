// Where a report goes.
#pragma once

#include <filesystem>
#include <string>

namespace app {

// The folder, made if it is not there. Throws InputError, with the option's name, where nothing can be written.
[[nodiscard]] std::filesystem::path made_folder(const std::string& option, const std::string& folder);

// All or nothing; throws OutputError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace app
