// Broken models, those of Debian's assimp-testmodels and a few of our own, given to the program: it draws them or says
// in one line what is wrong and ends with 2; it never crashes, hangs or takes more than 2 GiB.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/unit/gltf_fixture.hpp"

namespace {

namespace fs = std::filesystem;
using gltf_fixture::Folder;
using support::ProgramResult;

constexpr const char* kModels = "/usr/share/assimp/models";

ProgramResult render(const fs::path& scene, const Folder& out) {
  return support::run_program({.arguments = {"render", "--scene", scene.string(), "--size", "8x8", "--eye", "right",
                                             "--output", (out.path() / "out.png").string()},
                               .time_limit = std::chrono::seconds(60)});
}

// True when it was drawn.
bool expect_drawn_or_refused(const fs::path& scene, const Folder& out) {
  SCOPED_TRACE(scene.string());
  const ProgramResult result = render(scene, out);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0);
  EXPECT_TRUE(result.exit_status == 0 || result.exit_status == 2) << result.exit_status;
  if (result.exit_status != 0) {
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.starts_with("vergence: " + scene.string() + ": ")) << result.err;
    EXPECT_FALSE(fs::exists(out.path() / "out.png")) << "a failed command leaves nothing";
  }
  fs::remove(out.path() / "out.png");
  return result.exit_status == 0;
}

class HostileScenes : public ::testing::Test {
 protected:
  void TearDown() override {
    rusage usage{};  // of the largest run
    ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &usage), 0);
    EXPECT_LT(usage.ru_maxrss, 2L << 20) << "KiB";
    std::cout << "largest run: " << usage.ru_maxrss / 1024 << " MiB\n";
  }
};

TEST_F(HostileScenes, ModelsOfAssimp) {
  ASSERT_TRUE(fs::exists(kModels)) << "the package assimp-testmodels is missing; cmake/packages.sh installs it";
  std::set<std::string> drawn, refused;
  const Folder out;
  for (const char* folder : {"invalid", "glTF", "glTF2"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(kModels) / folder)) {
      const std::string kind = entry.path().extension().string();
      const bool is_model = kind == ".gltf" || kind == ".glb" || std::string(folder) == "invalid";
      if (!entry.is_regular_file() || !is_model) continue;
      const bool ok = expect_drawn_or_refused(entry.path(), out);
      (ok ? drawn : refused).insert(entry.path().filename().string());
    }
  }
  EXPECT_GT(drawn.size(), 10U) << "sound ones among them are drawn";
  for (const char* broken :
       {"IndexOutOfRange.gltf", "AllIndicesOutOfRange.gltf", "BoxWithInfinites.glb", "RecursiveNodes.gltf",
        "badArray.gltf", "badExtension.gltf", "badNumber.gltf", "badObject.gltf", "badUint.gltf", "sceneWrongType.gltf",
        "Cube.gltf", "Cube_v1.gltf", "empty.obj", "OutOfMemory.off", "malformed.obj"}) {
    EXPECT_TRUE(refused.contains(broken)) << broken;
    EXPECT_FALSE(drawn.contains(broken)) << broken;
  }
}

TEST_F(HostileScenes, TruncatedAndForeignFiles) {
  const Folder folder, out;
  const gltf_fixture::Bytes good = gltf_fixture::textured().glb();
  const std::string scene = folder.write("scene.glb", good.data(), good.size());
  EXPECT_TRUE(expect_drawn_or_refused(scene, out));
  for (std::size_t i = 0; i < 8; ++i) {
    fs::resize_file(scene, good.size() * (7 - i) / 8);
    EXPECT_FALSE(expect_drawn_or_refused(scene, out));
  }
  const Folder other;
  (void)other.write("secret.bin", "0123456789");
  for (const std::string& uri : {(other.path() / "secret.bin").string(), std::string("../secret.bin"),
                                 std::string("%2e%2e/secret.bin"), std::string("file:///etc/passwd")}) {
    gltf_fixture::Gltf g = gltf_fixture::square();
    g.root["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    const std::string path = folder.write("scene.gltf", g.text());
    const ProgramResult result = render(path, out);
    EXPECT_EQ(result.exit_status, 2) << uri;
    EXPECT_NE(result.err.find("buffers[0].uri"), std::string::npos) << result.err;
  }
}

}  // namespace
