// Values of command-line options. An option's error is an InputError whose file is the option's name.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace app {

// "a,b,c" as finite numbers; anything but `count` of them is an error that shows the expected form.
[[nodiscard]] std::vector<double> numbers_of(const std::string& option, const std::string& text, std::size_t count,
                                             const std::string& form);

// "1024x768"; each side 1 to 16384.
[[nodiscard]] std::array<int, 2> size_of(const std::string& option, const std::string& text);

// Throws unless lo <= value <= hi.
void check_range(const std::string& option, double value, double lo, double hi, const std::string& unit);

// A file of assets/ that the build puts beside the program ("wearers/presbyopia.json"). Throws with its name if it is
// not there.
[[nodiscard]] std::filesystem::path built_in_asset(const std::string& name);

// The cars of assets/fetch_scenes.sh if they have been fetched for this build, else an empty path.
[[nodiscard]] std::filesystem::path fetched_car_scene();

// The built-in scene, beside the program in the build or in an installation.
[[nodiscard]] std::filesystem::path built_in_scene();

// Where the renderer keeps which traversal is faster; empty where there is no place for it.
[[nodiscard]] std::filesystem::path traversal_file();

// Where converged pictures are kept between runs; empty where there is no place for them.
[[nodiscard]] std::filesystem::path reference_folder();

// Where compiled pipelines are kept between runs; empty where there is no place for them.
[[nodiscard]] std::filesystem::path pipeline_cache_file();

}  // namespace app
