// Whether a file can be written where it is wanted, said before minutes of work rather than after.
#pragma once

#include <string>

namespace app {

// Throws render::OutputError.
void check_place(const std::string& file);

}  // namespace app
