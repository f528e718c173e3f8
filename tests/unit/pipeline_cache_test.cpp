// The file of compiled pipelines: what was written comes back, and nothing else reaches the driver.
#include "render/vk/pipeline_cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "render/vk/device.hpp"

namespace render::vk {
namespace {

class PipelineCacheFile : public testing::Test {
 protected:
  PipelineCacheFile() { std::filesystem::create_directory(folder); }
  ~PipelineCacheFile() override { std::filesystem::remove_all(folder); }

  void build_and_save() {
    const Device device({.validation = true, .pipeline_cache = file});
    device.save_pipeline_cache();
    EXPECT_TRUE(device.validation_messages().empty());
  }

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / ("vergence-cache-" + std::to_string(::getpid()));
  const std::filesystem::path file = folder / "pipelines.bin";
};

TEST_F(PipelineCacheFile, IsWrittenAndReadBack) {
  build_and_save();
  const auto size = std::filesystem::file_size(file);
  EXPECT_GE(size, 32U);  // at the least the header that the specification lays down
  build_and_save();
  EXPECT_TRUE(std::filesystem::exists(file));
  // Nothing else is left beside it.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

// Data as driver 7 of vendor 3 would give it: the specification's header (size 32, version 1, vendor, device, UUID) and
// something behind it.
constexpr DriverId kDriver{3, 7, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}};
std::vector<std::uint8_t> driver_data() {
  return {32, 0, 0, 0, 1, 0, 0, 0,  3,  0,  0,  0,  7,  0,  0,   0,   1,  2,
          3,  4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 200, 201, 202};
}

TEST_F(PipelineCacheFile, GivesBackWhatTheDriverGave) {
  write_pipeline_cache(file, driver_data());
  EXPECT_EQ(read_pipeline_cache(file, kDriver), driver_data());
  EXPECT_TRUE(read_pipeline_cache(folder / "missing", kDriver).empty());
}

TEST_F(PipelineCacheFile, AnotherDriversDataIsIgnored) {
  write_pipeline_cache(file, driver_data());
  DriverId vendor = kDriver, device = kDriver, version = kDriver;
  ++vendor.vendor;
  ++device.device;
  ++version.cache_uuid[15];
  for (const DriverId& other : {vendor, device, version}) EXPECT_TRUE(read_pipeline_cache(file, other).empty());
  // Nor is what does not begin with a header of version one.
  for (const std::size_t byte : {0U, 4U}) {
    auto data = driver_data();
    ++data[byte];
    write_pipeline_cache(file, data);
    EXPECT_TRUE(read_pipeline_cache(file, kDriver).empty());
  }
}

TEST_F(PipelineCacheFile, DamageAnywhereIsNoticed) {
  write_pipeline_cache(file, driver_data());
  const auto size = std::filesystem::file_size(file);
  for (std::uintmax_t at = 0; at < size; ++at) {
    write_pipeline_cache(file, driver_data());
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(at));
    const int byte = stream.get();
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(byte ^ 4));
    stream.close();
    EXPECT_TRUE(read_pipeline_cache(file, kDriver).empty()) << "byte " << at;
    std::filesystem::resize_file(file, at);
    EXPECT_TRUE(read_pipeline_cache(file, kDriver).empty()) << "cut at " << at;
  }
}

TEST_F(PipelineCacheFile, DevicesOpenWithDamagedFiles) {
  std::ofstream(file) << "no pipelines here";
  build_and_save();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  build_and_save();
}

TEST_F(PipelineCacheFile, UnwritablePlaceIsAnError) {
  const Device device({.pipeline_cache = folder / "missing" / "pipelines.bin"});
  EXPECT_THROW(device.save_pipeline_cache(), DeviceError);
}

}  // namespace
}  // namespace render::vk
