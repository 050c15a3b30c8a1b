// A bumpy wall lit from the side: the player's frames against path-traced ones, with and without directions.
#include <gtest/gtest.h>
#include <unistd.h>

#include "bake/radiosity/radiosity.h"
#include "bake/run/assemble.h"
#include "formats/pack/writer.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/frames/frames.h"
#include "tests/support/exr.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

constexpr int kReliefWidth = 160, kReliefHeight = 90;
constexpr int kReliefSupersampling =
    4;  // player frames are rendered larger and averaged, as the reference's pixels are

// A room's wall with round bumps whose sides are up to 35 degrees steep; a tall lamp stands on its left.
Scene bumpy_wall() {
  test::SceneParts parts;
  const auto wall = parts.diffuse({0.7f, 0.6f, 0.5f}), white = parts.diffuse(Vec3(0.6f));
  parts.normal_map(wall, 256, [](float u, float v) {
    return Vec3(0.7f * std::sin(24 * kPi * u) * std::abs(std::cos(12 * kPi * v)),
                0.7f * std::sin(24 * kPi * v) * std::abs(std::cos(12 * kPi * u)), 1);
  });
  parts.quad("wall", wall, {-1.6f, 0, 0}, {3.2f, 0, 0}, {0, 1.8f, 0});
  parts.quad("floor", white, {-1.6f, 0, 2}, {3.2f, 0, 0}, {0, 0, -2});
  parts.quad("right", white, {1.6f, 0, 0}, {0, 1.8f, 0}, {0, 0, 2});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(40)), {-1.9f, 0.3f, 1}, {0, 1.2f, 0}, {0, 0, 0.3f});  // faces +x
  return parts.finish();
}

Camera facing_wall() {
  Camera camera;
  camera.eye = {0, 0.9f, 1.6f};
  camera.vertical_fov_rad = 0.9f;
  return camera;
}

class NormalMappedFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("oriel-normals-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    if (!HasFailure()) fs::remove_all(folder_);
  }

  FloatImage bake_and_play(const Scene& scene, bool directional, const std::string& name) {
    Context context;
    AtlasOptions options;
    options.texel_m = 0.05f;
    const Atlas atlas = *build_atlas(scene, options, context);
    const auto map = *build_texel_map(atlas, context);
    const Accel accel = *Accel::build(scene);
    const LightSet lights(scene);
    Pack pack;
    pack.provenance = "{}";
    pack.lightmaps =
        bake_radiosity({{accel, lights, {}}, atlas, map}, {.samples = 512, .directional = directional}, context)->pages;
    pack.mesh = assemble_mesh(scene, atlas).mesh;
    assemble_materials(scene, *bake_materials(scene, {}, context), pack);
    pack.cameras = {facing_wall()};
    const auto written = write_pack(folder_ / (name + ".oriel"), pack);
    EXPECT_TRUE(written) << written.error().text();
    EXPECT_EQ(test::run(folder_, "oriel-play " + name + ".oriel --offscreen --size " +
                                     std::to_string(kReliefSupersampling * kReliefWidth) + "x" +
                                     std::to_string(kReliefSupersampling * kReliefHeight) + " --camera 0 --show D -o " +
                                     name + ".exr"),
              0);
    const auto image = read_exr(folder_ / (name + ".exr"));
    EXPECT_TRUE(image) << (image ? "" : image.error().text());
    return image ? shrink(*image, kReliefSupersampling) : FloatImage{};
  }

  fs::path folder_;
};

TEST_F(NormalMappedFrames, BumpyWallAgreesWithTheReference) {
  const Scene scene = bumpy_wall();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  Context context;
  const ReferenceFrame reference =
      *render_reference({accel, lights, {}}, facing_wall(), {kReliefWidth, kReliefHeight, 256}, context);
  const FloatImage directional = bake_and_play(scene, true, "directional"),
                   plain = bake_and_play(scene, false, "plain");
  const RelativeError with = *relative_error(directional, test::diffuse(reference), reference.diffuse_noise);
  const RelativeError without = *relative_error(plain, test::diffuse(reference), reference.diffuse_noise);
  std::printf("bumpy wall D: nRMSE %.1f %% with directions, %.1f %% without; bias %+.1f %% and %+.1f %%\n",
              100 * with.n_rmse, 100 * without.n_rmse, 100 * with.bias, 100 * without.bias);
  EXPECT_LE(with.n_rmse, 0.05);
  EXPECT_LE(std::abs(with.bias), 0.01);
  EXPECT_GT(without.n_rmse, 0.2) << "the scene must need them";
}

}  // namespace
}  // namespace oriel
