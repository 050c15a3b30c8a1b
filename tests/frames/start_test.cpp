// Scenes without a camera, from file to first frame: the player starts where there is something to see.
#include <gtest/gtest.h>
#include <unistd.h>

#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/pack/reader.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/kit/shapes.h"
#include "tests/frames/frames.h"
#include "tests/support/exr.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

class Start : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-start-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  // The first frame of the scene, linear, and the world position of its camera.
  FloatImage first_frame(const sample::SampleScene& scene, const std::string& options, DVec3& eye) {
    EXPECT_TRUE(write_file_atomically(folder_ / "scene.glb", *sample::write_glb(scene)));
    EXPECT_EQ(
        test::run(folder_, "oriel-bake scene.glb -o scene.oriel --only radiosity --verify off --cache off " + options),
        0);
    EXPECT_EQ(test::run(folder_, "oriel-play scene.oriel --offscreen --size 160x90 -o first.exr"), 0);
    const auto pack = read_pack(folder_ / "scene.oriel");
    EXPECT_TRUE(pack);
    EXPECT_EQ(pack->cameras.size(), 1u);
    EXPECT_EQ(pack->cameras[0].name, "start");
    eye = DVec3(pack->cameras[0].eye) + pack->mesh.origin;
    const auto image = read_exr(folder_ / "first.exr");
    EXPECT_TRUE(image);
    return image ? *image : FloatImage{};
  }

  fs::path folder_;
};

// Share of pixels brighter than a twentieth of the mean.
double lit_share(const FloatImage& image) {
  const std::size_t pixels = std::size_t{image.width} * image.height;
  const auto brightness = [&](std::size_t i) {
    const float* p = &image.pixels[i * image.channels];
    return double{luminance(Vec3(p[0], p[1], p[2]))};
  };
  double mean = 0, lit = 0;
  for (std::size_t i = 0; i < pixels; ++i) mean += brightness(i) / static_cast<double>(pixels);
  for (std::size_t i = 0; i < pixels; ++i) lit += brightness(i) > mean / 20;
  return mean > 0 ? lit / static_cast<double>(pixels) : 0;
}

TEST_F(Start, AClosedRoomIsSeenFromInside) {
  DVec3 eye(0);
  const FloatImage image = first_frame(sample::make_room(), "--texel 30cm --error 20%", eye);
  EXPECT_NEAR(eye.y, 1.6, 0.01);
  for (const int axis : {0, 2}) {
    EXPECT_GE(eye[axis], 0.5);
    EXPECT_LE(eye[axis], 5.5);
  }
  EXPECT_GT(lit_share(image), 0.98);
}

TEST_F(Start, AHouseIsSeenFromOneOfItsRooms) {
  auto house = sample::make_house({12'000, 0});
  ASSERT_TRUE(house);
  house->cameras.clear();
  house->paths.clear();
  DVec3 eye(0);
  const FloatImage image = first_frame(*house, "--texel 50cm --error 30%", eye);
  EXPECT_TRUE(std::abs(eye.y - 1.6) < 0.01 || std::abs(eye.y - 4.6) < 0.01) << eye.y;
  EXPECT_GT(eye.x, 0);
  EXPECT_LT(eye.x, 13);
  EXPECT_GT(eye.z, 0);
  EXPECT_LT(eye.z, 9);
  EXPECT_GT(lit_share(image), 0.98);
}

TEST_F(Start, AnObjectAloneIsSeenFromOutside) {
  sample::SampleScene scene;
  scene.name = "vase";
  sample::SampleMesh vase{"vase", sample::add_diffuse(scene, "clay", Vec3(0.6f, 0.4f, 0.3f))};
  sample::add_sphere(vase, Vec3(0, 0.2f, 0), 0.2f, 24, 12);
  sample::place(scene, std::move(vase));
  DVec3 eye(0);
  const FloatImage image = first_frame(scene, "--texel 5cm --error 20% --sky 500", eye);
  EXPECT_GT(glm::length(eye - DVec3(0, 0.2, 0)), 0.3);
  // The ball in the middle, sky all around it.
  const auto red_of = [&](std::uint32_t x, std::uint32_t y) {
    return image.pixels[(y * image.width + x) * image.channels];
  };
  const float sky = red_of(0, 0);
  EXPECT_LT(red_of(80, 45), 0.95f * sky);
  for (std::uint32_t x = 0; x < image.width; ++x)
    for (const std::uint32_t y : {0u, image.height - 1}) EXPECT_EQ(red_of(x, y), sky);
}

}  // namespace
}  // namespace oriel
