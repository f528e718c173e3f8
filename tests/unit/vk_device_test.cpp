// The device layer on whatever device is there, with validation and its synchronisation checks on throughout: at the
// end of each test the layers must have had nothing to say.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "render/vk/commands.hpp"
#include "shaders/doubling.hpp"
#include "shaders/texels.hpp"

namespace render::vk {
namespace {

constexpr std::uint32_t kGroup = 64;
constexpr std::uint32_t kCount = 1000;  // not a multiple of the group

struct DoublingPush {
  std::uint32_t count = kCount;
  std::uint32_t add = 0;
};

constexpr std::array kTwoStorageBuffers{Binding::storage_buffer, Binding::storage_buffer};

std::vector<std::uint32_t> counting(std::uint32_t count) {
  std::vector<std::uint32_t> values(count);
  std::iota(values.begin(), values.end(), 0U);
  return values;
}

std::uint32_t groups() {
  return (kCount + kGroup - 1) / kGroup;
}

Kernel multiplying_kernel(const Device& device, std::uint32_t factor) {
  return {device, shaders::doubling, kTwoStorageBuffers, sizeof(DoublingPush), std::array{kGroup, factor}, "doubling"};
}

class VkDevice : public testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& message : device.validation_messages()) ADD_FAILURE() << message;
  }

  Device device{DeviceConfig{.validation = true}};
};

TEST_F(VkDevice, TellsItsNameAndLimits) {
  EXPECT_FALSE(device.name().empty());
  const DeviceLimits& limits = device.limits();
  // The least that Vulkan 1.2 promises.
  EXPECT_GE(limits.max_storage_buffer_bytes, std::size_t{1} << 27);
  EXPECT_GE(limits.max_texel_elements, 65536U);
  EXPECT_GE(limits.max_push_constant_bytes, 128U);
  EXPECT_GE(limits.max_workgroup_invocations, 128U);
  EXPECT_GE(limits.shared_bytes, 16384U);
  EXPECT_GE(limits.subgroup_size, 1U);
}

TEST_F(VkDevice, KernelReadsAndWritesEveryKindOfMemory) {
  const Kernel kernel = multiplying_kernel(device, 2);
  for (const Memory from : {Memory::device, Memory::upload, Memory::readback}) {
    for (const Memory to : {Memory::device, Memory::upload, Memory::readback}) {
      Buffer in(device, kCount * 4, from), out(device, kCount * 4, to);
      in.write(counting(kCount));
      Commands commands(device);
      commands.dispatch(kernel, {&in, &out}, bytes_of(DoublingPush{.add = 5}), groups());
      device.run(commands);
      const auto values = out.read<std::uint32_t>(kCount);
      for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(values[i], 2 * i + 5);
    }
  }
}

// As on a GPU whose memory the host cannot reach.
TEST_F(VkDevice, UnmappedMemoryIsStaged) {
  Device staged({.validation = true, .map_device_memory = false});
  const Kernel kernel = multiplying_kernel(staged, 2);
  Buffer in(staged, kCount * 4, Memory::device), out(staged, kCount * 4, Memory::device);
  in.write(counting(kCount));
  in.write(std::vector<std::uint32_t>{70, 80}, 40);
  Commands commands(staged);
  commands.dispatch(kernel, {&in, &out}, bytes_of(DoublingPush{}), groups());
  staged.run(commands);
  EXPECT_EQ(out.read<std::uint32_t>(4, 36), (std::vector{18U, 140U, 160U, 24U}));
  EXPECT_EQ(out.read<std::uint32_t>(kCount).back(), 2 * (kCount - 1));
  for (const std::string& message : staged.validation_messages()) ADD_FAILURE() << message;
}

TEST_F(VkDevice, SpecialisationConstantsReachTheShader) {
  Buffer in(device, kCount * 4, Memory::upload), out(device, kCount * 4, Memory::readback);
  in.write(counting(kCount));
  for (const std::uint32_t factor : {3U, 7U}) {
    const Kernel kernel = multiplying_kernel(device, factor);
    Commands commands(device);
    commands.dispatch(kernel, {&in, &out}, bytes_of(DoublingPush{}), groups());
    device.run(commands);
    EXPECT_EQ(out.read<std::uint32_t>(1, 999 * 4).front(), 999 * factor);
  }
}

TEST_F(VkDevice, EveryBindingDeliversItsFormat) {
  constexpr std::array bindings{Binding::texel_rgba32f,     Binding::texel_rgba32ui, Binding::texel_r32ui,
                                Binding::texel_rgba8_unorm, Binding::uniform_buffer, Binding::storage_buffer};
  const Kernel kernel(device, shaders::texels, bindings, 0, {}, "texels");
  Buffer rgba32f(device, 32, Memory::device), rgba32ui(device, 48, Memory::device), r32ui(device, 8, Memory::device),
      rgba8(device, 12, Memory::device), uniforms(device, 16, Memory::upload), out(device, 96, Memory::readback);
  rgba32f.write(std::vector{0.0F, 0.0F, 0.0F, 0.0F, 1.5F, -2.0F, 1e30F, 0.25F});
  rgba32ui.write(std::vector<std::uint32_t>{0, 0, 0, 0, 1, 0xffffffff, 3, 4, 0, 0, 0, 0});
  r32ui.write(std::vector<std::uint32_t>{0, 0xdeadbeef});
  rgba8.write(std::vector<std::uint8_t>{0, 0, 0, 0, 255, 51, 0, 102, 0, 0, 0, 0});
  uniforms.write(std::vector<std::uint32_t>{9, 8, 7, 6});

  Commands commands(device);
  commands.dispatch(kernel, {&rgba32f, &rgba32ui, &r32ui, &rgba8, &uniforms, &out}, {}, 1);
  device.run(commands);

  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  const auto words = out.read<std::uint32_t>(24);
  EXPECT_EQ(std::vector(words.begin(), words.begin() + 4),
            (std::vector{bits(1.5F), bits(-2.0F), bits(1e30F), bits(0.25F)}));
  EXPECT_EQ(std::vector(words.begin() + 4, words.begin() + 8), (std::vector{1U, 0xffffffffU, 3U, 4U}));
  EXPECT_EQ(words[8], 0xdeadbeefU);
  // A normalised byte is exact to the rounding of a division by 255.
  EXPECT_NEAR(std::bit_cast<float>(words[12]), 1.0F, 1e-6F);
  EXPECT_NEAR(std::bit_cast<float>(words[13]), 0.2F, 1e-6F);
  EXPECT_NEAR(std::bit_cast<float>(words[15]), 0.4F, 1e-6F);
  EXPECT_EQ(std::vector(words.begin() + 16, words.begin() + 20), (std::vector{9U, 8U, 7U, 6U}));
  EXPECT_EQ(std::vector(words.begin() + 20, words.end()), (std::vector{2U, 3U, 2U, 3U}));
}

TEST_F(VkDevice, CopiesZeroesAndChainsWithBarriers) {
  const Kernel kernel = multiplying_kernel(device, 2);
  Buffer a(device, kCount * 4, Memory::device), b(device, kCount * 4, Memory::device),
      c(device, kCount * 4, Memory::device);
  a.write(counting(kCount));
  c.write(counting(kCount));
  Commands commands(device);
  commands.dispatch(kernel, {&a, &b}, bytes_of(DoublingPush{}), groups());
  commands.barrier();
  commands.dispatch(kernel, {&b, &a}, bytes_of(DoublingPush{}), groups());
  commands.fill_zero(c);
  commands.barrier();
  commands.copy(a, c, 8, 40, 16);
  device.run(commands);
  EXPECT_EQ(a.read<std::uint32_t>(1, 4 * 100).front(), 400U);
  EXPECT_EQ(c.read<std::uint32_t>(8), (std::vector{0U, 0U, 0U, 0U, 40U, 44U, 0U, 0U}));
  EXPECT_EQ(c.read<std::uint32_t>(1, 4 * 999).front(), 0U);
}

TEST_F(VkDevice, StagesAreTimedAndCommandsRunAgain) {
  constexpr std::uint32_t kMany = 1U << 20;  // work that takes far longer than a tick of any clock
  const Kernel kernel = multiplying_kernel(device, 2);
  Buffer a(device, kMany * 4, Memory::device);
  a.write(std::vector<std::uint32_t>(kMany, 1));
  Commands commands(device);
  commands.dispatch(kernel, {&a, &a}, bytes_of(DoublingPush{.count = kMany}), kMany / kGroup);
  commands.timestamp("first");
  commands.barrier();
  commands.dispatch(kernel, {&a, &a}, bytes_of(DoublingPush{.count = kMany}), kMany / kGroup);
  commands.timestamp("second");
  for (int run = 1; run <= 3; ++run) {
    const auto begin = std::chrono::steady_clock::now();
    const auto stages = device.run(commands);
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begin;
    EXPECT_EQ(a.read<std::uint32_t>(1, 4 * (kMany - 1)).front(), 1U << (2 * run));
    if (device.limits().timestamp_period_ns == 0.0) continue;
    ASSERT_EQ(stages.size(), 2U);
    EXPECT_EQ(stages[0].name, "first");
    EXPECT_EQ(stages[1].name, "second");
    EXPECT_GT(stages[0].milliseconds, 0.0);
    EXPECT_GT(stages[1].milliseconds, 0.0);
    // Inside the time that the host waited; the two clocks may drift apart by far less than the slack.
    EXPECT_LT(stages[0].milliseconds + stages[1].milliseconds, 1.01 * elapsed.count());
  }
  EXPECT_THROW(commands.timestamp("late"), std::logic_error);
  EXPECT_THROW(commands.barrier(), std::logic_error);
}

TEST_F(VkDevice, HoldsMoreStagesThanOnePoolOfMarks) {
  if (device.limits().timestamp_period_ns == 0.0) GTEST_SKIP() << "the device has no timestamps";
  Commands commands(device);
  for (int i = 0; i < 200; ++i) commands.timestamp(std::to_string(i));
  for (int run = 0; run < 2; ++run) {
    const auto stages = device.run(commands);
    ASSERT_EQ(stages.size(), 200U);
    EXPECT_EQ(stages[199].name, "199");
    for (const StageTime& stage : stages) {
      EXPECT_GE(stage.milliseconds, 0.0);
      EXPECT_LT(stage.milliseconds, 60e3);
    }
  }
}

TEST_F(VkDevice, AnotherDeviceLivesBesideIt) {
  Device other({.validation = true});
  Buffer in(other, 8, Memory::device), out(other, 8, Memory::device);
  in.write(counting(2));
  const Kernel kernel = multiplying_kernel(other, 4);
  Commands commands(other);
  commands.dispatch(kernel, {&in, &out}, bytes_of(DoublingPush{.count = 2}), 1);
  EXPECT_THROW(device.run(commands), std::invalid_argument);
  other.run(commands);
  EXPECT_EQ(out.read<std::uint32_t>(2), (std::vector{0U, 4U}));
  EXPECT_TRUE(other.validation_messages().empty());
}

TEST_F(VkDevice, CommandsKeepWhatTheyUseAlive) {
  Buffer out(device, kCount * 4, Memory::readback);
  Commands commands(device);
  {
    const Kernel kernel = multiplying_kernel(device, 2);
    Buffer in(device, kCount * 4, Memory::upload);
    in.write(counting(kCount));
    commands.dispatch(kernel, {&in, &out}, bytes_of(DoublingPush{}), groups());
  }
  device.run(commands);
  EXPECT_EQ(out.read<std::uint32_t>(1, 4).front(), 2U);
}

TEST_F(VkDevice, BuffersMindTheirEnds) {
  Buffer buffer(device, 10, Memory::device), empty(device, 0, Memory::device);
  EXPECT_EQ(buffer.bytes(), 10U);
  EXPECT_EQ(empty.bytes(), 0U);
  EXPECT_TRUE(empty.read<int>(0).empty());
  EXPECT_THROW(buffer.write(std::vector<std::uint8_t>(4), 7), std::out_of_range);
  EXPECT_THROW((void)buffer.read<std::uint8_t>(11), std::out_of_range);
  EXPECT_THROW((void)buffer.read<std::uint8_t>(1, SIZE_MAX), std::out_of_range);
  Commands commands(device);
  EXPECT_THROW(commands.copy(buffer, empty, 1), std::out_of_range);
}

TEST_F(VkDevice, SizesBeyondTheDeviceAreNamed) {
  const std::size_t limit = device.limits().max_storage_buffer_bytes;
  try {
    const Buffer buffer(device, limit + 1, Memory::device);
    FAIL() << "a buffer beyond the limit was made";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(limit)), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(std::to_string(limit + 1)), std::string::npos) << error.what();
  }
  EXPECT_THROW(Kernel(device, shaders::doubling, kTwoStorageBuffers, 1U << 20), DeviceError);
}

TEST_F(VkDevice, DispatchMustMatchItsKernel) {
  const Kernel kernel = multiplying_kernel(device, 2);
  const Buffer buffer(device, 16, Memory::device);
  Commands commands(device);
  EXPECT_THROW(commands.dispatch(kernel, {&buffer}, bytes_of(DoublingPush{}), 1), std::invalid_argument);
  EXPECT_THROW(commands.dispatch(kernel, {&buffer, &buffer}, {}, 1), std::invalid_argument);
  const auto& limit = device.limits().max_groups[1];
  if (limit < UINT32_MAX) {
    EXPECT_THROW(commands.dispatch(kernel, {&buffer, &buffer}, bytes_of(DoublingPush{}), 1, limit + 1), DeviceError);
  }
}

TEST_F(VkDevice, ValidationSeesAMissingBarrier) {
  Device careless({.validation = true});
  const Kernel kernel = multiplying_kernel(careless, 2);
  const Buffer a(careless, kCount * 4, Memory::device);
  Buffer b(careless, kCount * 4, Memory::device);
  Commands commands(careless);
  commands.copy(a, b, kCount * 4);
  commands.dispatch(kernel, {&b, &a}, bytes_of(DoublingPush{}), groups());
  EXPECT_FALSE(careless.validation_messages().empty());
}

TEST(VkDeviceChoice, ByIndexNameOrNotAtAll) {
  const auto names = Device::device_names();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(Device({.device = "0"}).name(), names[0]);
  std::string shouted = names[0].substr(0, 5);
  for (char& c : shouted) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(Device({.device = shouted}).name().substr(0, 5), names[0].substr(0, 5));
  for (const char* wanted : {"999", "99999999999999999999999", "no such device"}) {
    try {
      const Device device({.device = wanted});
      FAIL() << "opened " << wanted;
    } catch (const DeviceError& error) {
      EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(names[0]), std::string::npos) << error.what();
    }
  }
}

// In a child process: drivers are looked up from the environment once, before anything else has loaded them.
TEST(VkDeviceDeathTest, NoDriverIsAnErrorNotACrash) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto open_without_driver = [] {
    setenv("VK_ICD_FILENAMES", "/nonexistent", 1);
    setenv("VK_DRIVER_FILES", "/nonexistent", 1);
    try {
      const Device device;
    } catch (const DeviceError& error) {
      std::fprintf(stderr, "DeviceError: %s\n", error.what());
      std::_Exit(3);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(open_without_driver(), testing::ExitedWithCode(3), "DeviceError: .+");
}

TEST(VkDeviceDeathTest, MissingValidationLayerNamesItsPackage) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto open_without_layer = [] {
    setenv("VK_LAYER_PATH", "/nonexistent", 1);
    try {
      const Device device({.validation = true});
    } catch (const DeviceError& error) {
      std::fprintf(stderr, "DeviceError: %s\n", error.what());
      std::_Exit(3);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(open_without_layer(), testing::ExitedWithCode(3), "vulkan-validationlayers");
}

}  // namespace
}  // namespace render::vk
