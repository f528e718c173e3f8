// A session through its life: opened and closed again and again, watched by the validation layers, and cut off.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "render/live_frame.hpp"
#include "tests/support/headset_program.hpp"
#include "tests/support/lit_scene.hpp"
#include "tests/support/monado.hpp"
#include "tests/support/run_program.hpp"

namespace {

using support::HeadsetProgram;
using tracking::Side;

// Grey pictures without a renderer: what swapchains, session and device cost by themselves.
class GreyPictures {
 public:
  explicit GreyPictures(HeadsetProgram& program)
      : program_(program), grey_(program.device, 4 * 32 * 32, render::vk::Memory::device), work_(program.device) {
    grey_.write(std::vector<std::uint32_t>(32 * 32, 0xff808080U));
  }

  void show(const xr::Frame& frame) {
    const auto images = program_.loop.acquire();
    (void)work_.wait();
    render::vk::Commands copies(program_.device);
    const std::array block{render::vk::PixelBlock{.from = &grey_, .row_pixels = 32, .width = 32, .height = 32}};
    for (const Side side : {Side::right, Side::left}) {
      const auto i = static_cast<std::size_t>(side);
      render::vk::copy_to_image(copies, block, {program_.loop.swapchain(side).images()[images[i]], 32, 32});
    }
    render::vk::Commands* const list = &copies;
    work_.start({&list, 1});
    program_.loop.show(frame);
  }

 private:
  HeadsetProgram& program_;
  render::vk::Buffer grey_;
  render::vk::Submission work_;
};

struct Held {
  std::size_t files = 0;
  double memory_mib = 0.0;
};

Held held() {
  Held now;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator("/proc/self/fd")) {
    ++now.files;
  }
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0;
  double resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  now.memory_mib = resident_pages * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
  return now;
}

void open_and_close() {
  HeadsetProgram program({.size = std::array{32, 32}});
  GreyPictures pictures(program);
  const auto frame = program.next_visible();
  ASSERT_TRUE(frame);
  pictures.show(*frame);
  program.leave();
}

// 50 in all, 500 where VERGENCE_LONG is set.
TEST(SessionLife, ManyOpenedAndClosedLeaveNothingBehind) {
  const int cycles = std::getenv("VERGENCE_LONG") != nullptr ? 500 : 50;
  constexpr int kSettle = 10;  // libraries load, allocators find their size
  const support::Monado monado;
  for (int i = 0; i < kSettle; ++i) {
    open_and_close();
  }
  const Held before = held();
  for (int i = kSettle; i < cycles; ++i) {
    open_and_close();
  }
  const Held after = held();
  EXPECT_EQ(after.files, before.files);
  // A swapchain image that stayed would be 12 KiB, a driver's device some MiB, and that many times over.
  EXPECT_LT(after.memory_mib, before.memory_mib + 4.0);
}

TEST(SessionLife, ValidationLayersHaveNothingToSay) {
  const support::TemporaryFolder folder;
  const std::string log = (folder.path() / "openxr.txt").string();
  ::setenv("XR_ENABLE_API_LAYERS", "XR_APILAYER_LUNARG_core_validation", 1);
  ::setenv("XR_CORE_VALIDATION_EXPORT_TYPE", "text", 1);
  ::setenv("XR_CORE_VALIDATION_FILE_NAME", log.c_str(), 1);
  const support::Monado monado;
  std::vector<std::string> said;
  std::ostringstream text;
  {
    // STAGE: the layer of OpenXR 1.0.20 is older than LOCAL_FLOOR and refuses its number.
    HeadsetProgram program({.space = xr::SpaceChoice::stage, .size = std::array{40, 40}, .readable = true}, true);
    render::Scene scene = support::dark_scene();
    support::add_wall(scene, support::add_material(scene, support::unlit({1, 1, 1, 1})), 0, 1, 3, 0.5F);
    render::Renderer renderer(program.device, scene, {.traversal = render::Traversal::per_ray});
    lenses::LensModel model;
    std::vector<render::ViewSetup> views(4);  // two pairs
    for (render::ViewSetup& view : views) {
      view.lens = lenses::append_lens(model, nullptr, Side::right, 0.00305);
      view.eye = lenses::make_eye_data(lenses::Eye{}, 5.0, 0.003);
      view.view.fov = tracking::FieldOfView::symmetric(1.0, 1.0);
    }
    render::LiveConfig config;
    config.frame.width = config.frame.height = 40;
    config.guard_px = 3;
    config.pairs = 2;
    config.blue_first = true;
    render::LiveFrame live(renderer, model, views, config,
                           {program.loop.swapchain(Side::left).images(), program.loop.swapchain(Side::right).images()});
    for (int i = 0; i < 4; ++i) {
      const auto frame = program.next_visible();
      ASSERT_TRUE(frame);
      const auto images = program.loop.acquire();
      const std::array order{images[1], images[0]};
      live.start(model, views, order);
      if (i == 2) {
        (void)live.read_image(0, order[0]);
      }
      program.loop.show(*frame);
    }
    (void)live.wait();
    text << std::ifstream(log).rdbuf();
    // It is there: what is wrong does not reach the runtime.
    XrReferenceSpaceCreateInfo wrong{};
    wrong.type = XR_TYPE_FRAME_STATE;
    XrSpace none = XR_NULL_HANDLE;
    EXPECT_EQ(xrCreateReferenceSpace(program.session.handle(), &wrong, &none), XR_ERROR_VALIDATION_FAILURE);
    program.leave();
    said = program.device.validation_messages();
  }
  ::unsetenv("XR_ENABLE_API_LAYERS");
  EXPECT_EQ(said, std::vector<std::string>{});
  EXPECT_EQ(text.str(), "");
  EXPECT_GT(std::filesystem::file_size(log), 0U) << "what it says goes elsewhere";
}

TEST(SessionLife, ARuntimeThatDiesEndsTheLoopWithAnError) {
  support::Monado monado;
  HeadsetProgram program({.size = std::array{32, 32}});
  GreyPictures pictures(program);
  for (int i = 0; i < 3; ++i) {
    const auto frame = program.next_visible();
    ASSERT_TRUE(frame);
    pictures.show(*frame);
  }
  monado.kill();
  EXPECT_THROW(
      for (;;) {
        const auto frame = program.next_visible();
        ASSERT_TRUE(frame) << "the loop must not take a dead runtime for an orderly end";
        pictures.show(*frame);
      },
      xr::Error);
}

}  // namespace
