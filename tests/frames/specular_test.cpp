// What glossy floors and mirrors show, beside path-traced frames: bounds on S.
#include <gtest/gtest.h>
#include <unistd.h>
#include <cmath>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "tests/frames/frames.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

class SpecularFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-specular-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }
  int run(const std::string& command) const { return test::run(folder_, command); }

  // The regions of --compare for a camera of a.glb, baked as a.oriel.
  Json compare(const std::string& camera, const std::string& play = "") const {
    EXPECT_EQ(run("oriel-bake render a.glb --camera " + camera + " --size 120x81 --samples 256 -o a.exr"), 0);
    EXPECT_EQ(run("oriel-play a.oriel --offscreen --camera " + camera +
                  " --compare a.exr --size 360x243 --json a.json -o a.png " + play),
              0);
    const Bytes bytes = *read_file(folder_ / "a.json");
    return Json::parse(bytes).value()["regions"];
  }

  fs::path folder_;
};

TEST_F(SpecularFrames, GalleryByMirroredGeometry) {
  ASSERT_EQ(run("oriel-scenes gallery -o a.glb"), 0);
  ASSERT_EQ(run("oriel-bake a.glb -o a.oriel --error 8% --reflections geometry"), 0);
  const auto floor = compare("floor")["glossy"];
  std::printf("floor: S net %.3f, nRMSE %.3f, FLIP %.4f\n", floor["S"]["net"].get<double>(),
              floor["S"]["nRMSE"].get<double>(), floor["flip"].get<double>());
  // Not by the relative error: nearly all of it is that of one pixel at a door, whose S is 1/4000 of the mean.
  EXPECT_LE(std::abs(floor["S"]["bias"].get<double>()), 0.005);  // 0.0084 with rims along the walls' feet
  EXPECT_LE(floor["S"]["nRMSE"].get<double>(), 0.15);
  EXPECT_LE(floor["flip"].get<double>(), 0.05);
  const auto off = compare("floor", "--reflections off");
  EXPECT_GT(off["frame"]["flip"].get<double>(), 0.15) << "the checker can fail";
  EXPECT_FALSE(off.contains("glossy"));
  const auto mirror = compare("mirror")["mirrors"];
  std::printf("mirror: S net %.3f, FLIP %.4f\n", mirror["S"]["net"].get<double>(), mirror["flip"].get<double>());
  EXPECT_LE(mirror["S"]["net"].get<double>(), 0.15);
  EXPECT_LE(mirror["flip"].get<double>(), 0.06);
}

TEST_F(SpecularFrames, AWideLobeByMirroredGeometry) {
  ASSERT_EQ(run("oriel-scenes gallery --floor-roughness 0.316228 -o a.glb"), 0);
  ASSERT_EQ(run("oriel-bake a.glb -o a.oriel --error 8% --reflections geometry"), 0);
  const auto floor = compare("floor")["glossy"];
  std::printf("floor of α 0.1: S net %.3f, nRMSE %.3f, FLIP %.4f\n", floor["S"]["net"].get<double>(),
              floor["S"]["nRMSE"].get<double>(), floor["flip"].get<double>());
  EXPECT_LE(floor["S"]["net"].get<double>(), 0.15);
  EXPECT_LE(floor["flip"].get<double>(), 0.07);
}

}  // namespace
}  // namespace oriel
