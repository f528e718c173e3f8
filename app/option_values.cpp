#include "app/option_values.hpp"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <system_error>

#include "tracking/input_error.hpp"

namespace app {
namespace {

using tracking::InputError;

constexpr int kLargestSide = 16384;

// build/release, or where the program was installed.
std::filesystem::path program_root() {
  std::error_code none;
  return std::filesystem::read_symlink("/proc/self/exe", none).parent_path().parent_path();
}

std::string short_number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 8);
  return {text.data(), end.ptr};
}

}  // namespace

std::vector<double> numbers_of(const std::string& option, const std::string& text, std::size_t count,
                               const std::string& form) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  const auto refuse = [&] { throw InputError(option, "", "'" + text + "' is not " + form); };
  while (true) {
    if (at != end && *at == '+' && at + 1 != end && at[1] != '-') {
      ++at;
    }
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value)) {
      refuse();
    }
    numbers.push_back(value);
    if (next == end) {
      break;
    }
    if (*next != ',') {
      refuse();
    }
    at = next + 1;
  }
  if (numbers.size() != count) {
    refuse();
  }
  return numbers;
}

std::array<int, 2> size_of(const std::string& option, const std::string& text) {
  std::array<int, 2> size{};
  const char* at = text.data();
  const char* end = at + text.size();
  const auto [middle, first] = std::from_chars(at, end, size[0]);
  bool good = first == std::errc{} && middle != end && *middle == 'x';
  if (good) {
    const auto [last, second] = std::from_chars(middle + 1, end, size[1]);
    good = second == std::errc{} && last == end;
  }
  if (!good || size[0] < 1 || size[1] < 1 || size[0] > kLargestSide || size[1] > kLargestSide) {
    throw InputError(option, "",
                     "'" + text + "' is not WxH with each side from 1 to " + std::to_string(kLargestSide) +
                         " pixels, such as 1024x1024");
  }
  return size;
}

void check_range(const std::string& option, double value, double lo, double hi, const std::string& unit) {
  if (!(value >= lo && value <= hi)) {
    throw InputError(option, "",
                     short_number(value) + " is out of range; from " + short_number(lo) + " to " + short_number(hi) +
                         (unit.empty() ? "" : " " + unit));
  }
}

std::filesystem::path built_in_asset(const std::string& name) {
  std::error_code none;
  for (const char* place : {"assets", "share/vergence"}) {
    if (const auto file = program_root() / place / name; std::filesystem::exists(file, none)) {
      return file;
    }
  }
  throw InputError(name, "", "is missing beside the program; build the target vergence_assets");
}

std::filesystem::path fetched_car_scene() {
  std::error_code none;
  const std::filesystem::path file = program_root().parent_path() / "scenes" / "car_scene.glb";
  return std::filesystem::exists(file, none) ? file : std::filesystem::path();
}

std::filesystem::path built_in_scene() {
  std::error_code none;
  const std::filesystem::path root = program_root();
  for (const char* place : {"assets/reading_room.glb", "share/vergence/reading_room.glb"}) {
    if (std::filesystem::exists(root / place, none)) {
      return root / place;
    }
  }
  throw InputError("--scene", "",
                   "the built-in reading room is missing beside the program; build the target "
                   "vergence_assets, or name a .gltf or .glb file");
}

std::filesystem::path traversal_file() {
  const std::filesystem::path pipelines = pipeline_cache_file();
  return pipelines.empty() ? pipelines : pipelines.parent_path() / "traversal.txt";
}

std::filesystem::path reference_folder() {
  const std::filesystem::path pipelines = pipeline_cache_file();
  return pipelines.empty() ? pipelines : pipelines.parent_path() / "references";
}

std::filesystem::path pipeline_cache_file() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0') {
    return std::filesystem::path(cache) / "vergence" / "pipelines.bin";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return std::filesystem::path(home) / ".cache" / "vergence" / "pipelines.bin";
  }
  return {};
}

}  // namespace app
