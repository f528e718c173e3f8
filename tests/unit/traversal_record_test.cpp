// The text file that says which traversal is faster.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "render/traversal.hpp"

namespace {

using render::RayKind;
using render::Traversal;
using render::TraversalRecord;

class TraversalFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "vergence_traversal_record_test";
  std::filesystem::path file_ = folder_ / "traversal.txt";
};

TEST_F(TraversalFile, KeepsOneChoiceADeviceAndKind) {
  const TraversalRecord one(file_, "llvmpipe (LLVM 15, 256 bits)"), other(file_, "GeForce");
  EXPECT_FALSE(one.find(RayKind::bare));
  one.keep(RayKind::bare, Traversal::tile);
  other.keep(RayKind::bare, Traversal::per_ray);
  one.keep(RayKind::refracted, Traversal::per_ray);
  EXPECT_EQ(one.find(RayKind::bare), Traversal::tile);
  EXPECT_EQ(other.find(RayKind::bare), Traversal::per_ray);
  EXPECT_EQ(one.find(RayKind::refracted), Traversal::per_ray);
  EXPECT_FALSE(other.find(RayKind::refracted));
  one.keep(RayKind::bare, Traversal::ray_query);
  EXPECT_EQ(one.find(RayKind::bare), Traversal::ray_query);
  one.keep(RayKind::bare, Traversal::per_ray);
  EXPECT_EQ(one.find(RayKind::bare), Traversal::per_ray);
  std::ifstream in(file_);
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_EQ(std::ranges::count(text.str(), '\n'), 3) << text.str();
}

TEST_F(TraversalFile, DamageIsSilence) {
  std::filesystem::create_directories(folder_);
  std::ofstream(file_) << "tile\nbare GeForce\nper_ray  bare GeForce\n" << std::string(100000, 'x');
  EXPECT_FALSE(TraversalRecord(file_, "GeForce").find(RayKind::bare));
}

TEST_F(TraversalFile, NoPlaceKeepsNothing) {
  const TraversalRecord nowhere({}, "GeForce");
  nowhere.keep(RayKind::bare, Traversal::tile);
  EXPECT_FALSE(nowhere.find(RayKind::bare));
  const TraversalRecord impossible("/proc/no/such/place", "GeForce");
  EXPECT_NO_THROW(impossible.keep(RayKind::bare, Traversal::tile));
  EXPECT_FALSE(impossible.find(RayKind::bare));
}

}  // namespace
