// How long a second start takes and how much memory a frame, on the paper's kind of car scene where
// assets/fetch_scenes.sh has put it, else on the reading room.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.hpp"

namespace {

using nlohmann::json;

std::string scene_file() {
  const std::filesystem::path assets = VERGENCE_BUILT_ASSETS;
  const std::filesystem::path cars = assets.parent_path().parent_path() / "scenes" / "car_scene.glb";
  return (std::filesystem::exists(cars) ? cars : assets / "reading_room.glb").string();
}

// Of all children so far; a wall clock would count what else the machine does.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

json drawn(const std::vector<std::string>& options, const support::TemporaryFolder& folder) {
  std::vector<std::string> arguments{
      "render", "--scene", scene_file(), "--output", (folder.path() / "out.png").string(), "--json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const auto result = support::run_program({.arguments = arguments, .time_limit = std::chrono::seconds(300)});
  EXPECT_EQ(result.exit_status, 0) << result.err;
  return json::parse(result.out);
}

TEST(Start, HoldsTimeAndMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers take their own time and memory";
#endif
  const support::TemporaryFolder folder;
  static_cast<void>(drawn({"--size", "64x64"}, folder));  // leaves compiled kernels behind
  const double before = processor_seconds();
  const json report = drawn({"--size", "64x64"}, folder);
  const double seconds = processor_seconds() - before;
  std::cout << scene_file() << ": " << report.at("triangles") << " triangles, " << seconds << " s of processor time, "
            << report.at("start_up_ms") << " ms by the clock\n";
  // Mesa 22.3 translates every kernel's SPIR-V anew at each start; kernels that grow by copies of inlined code show
  // here.
  EXPECT_LT(seconds, 2.0);
  // Maps keep the most planes and trace the fewest rays.
  const json map = drawn({"--size", "1024x1024", "--mode", "power"}, folder);
  const double mebibytes = map.at("peak_memory_MiB").get<double>();
  std::cout << "a map of 1024x1024 for both eyes: " << mebibytes << " MiB\n";
  EXPECT_LT(mebibytes, 1024.0);
}

}  // namespace
