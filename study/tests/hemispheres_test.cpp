// Hemispheres of viewpoints, the memory they may take, and what a bake makes of them.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>

#include "bake/radiance/reproject.h"
#include "bake/radiance/views.h"
#include "bake/run/option_table.h"
#include "study/bastos1999/baked_method.h"
#include "tests/bake/radiance/mirror_room.h"
#include "tests/support/temporary_folder.h"

namespace oriel::study {
namespace {

TEST(Hemispheres, EyesLieOnHemispheresThatTheElementsInscribe) {
  const test::MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
  std::vector<std::string> omitted;
  const auto maps = plan_hemispheres(room.scene, reflectors, {.views = 16, .map_side = 256}, omitted);
  const Reflector& r = reflectors[0].reflector;
  EXPECT_EQ(r.elements_x * r.elements_y, 1u) << "no side is longer than 3 m";
  EXPECT_EQ(r.first_map, 0u);
  ASSERT_EQ(r.map_count, maps.size());
  ASSERT_EQ(maps.size(), 16u);
  for (const RadianceMap& map : maps) {
    const Vec3 centre(0.5f * (map.lower + map.upper), 0);
    EXPECT_LT(map.eye.z, 0);
    EXPECT_NEAR(glm::length(map.eye - centre), 0.5f * glm::length(map.upper - map.lower), 1e-5);
    EXPECT_EQ(map.width, 256u);
    EXPECT_EQ(map.height, 192u);  // 2 x 1.5
  }
  EXPECT_TRUE(omitted.empty());
}

TEST(Hemispheres, ElementsWithoutReflectorAndEyesOutsideTheSceneAreSkipped) {
  test::SceneParts parts;
  parts.add(SceneMaterial{});
  parts.diffuse(Vec3(0.5f));
  parts.quad("panes", 0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.quad("panes", 0, {9, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.quad("ground", 1, {-5, -0.2f, -5}, {0, 0, 10.0f}, {20, 0, 0});
  parts.quad("far", 1, {-5, -0.2f, 5}, {20, 0, 0}, {0, 2, 0});
  const Scene scene = parts.finish();
  auto accel = Accel::build(scene);
  ASSERT_TRUE(accel);
  const std::vector<ReflectorMaterial> materials{{.roughness = 0, .f0 = Vec3(0.9f), .f90 = 1},
                                                 {.roughness = 1, .f0 = Vec3(0), .f90 = 0}};
  ReflectorOptions options;
  options.min_open_share = 0;
  auto reflectors = find_reflectors(*accel, materials, options).reflectors;
  ASSERT_EQ(reflectors.size(), 1u);
  std::vector<std::string> omitted;
  const auto maps = plan_hemispheres(scene, reflectors, {.views = 16}, omitted);
  EXPECT_EQ(reflectors[0].reflector.elements_x, 4u);
  EXPECT_EQ(maps.size(), 2u * 16u);
  for (const RadianceMap& map : maps) EXPECT_GT(std::abs(map.lower.x + map.upper.x), 7);

  Scene cropped = scene;
  cropped.upper.z = 0.0f;  // as if the scene ended at the pane: its pole view mirrors to one radius outside
  cropped.lower.z = -0.1f;
  cropped.upper.y = 0.2f;
  const auto fewer = plan_hemispheres(cropped, reflectors, {.views = 16}, omitted);
  EXPECT_LT(fewer.size(), maps.size());
  ASSERT_EQ(omitted.size(), 1u);
  EXPECT_NE(omitted[0].find("outside the scene"), std::string::npos);
}

TEST(Hemispheres, MemoryIsNeverExceededAndWhatWasReducedIsSaid) {
  const test::MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  std::size_t before = std::size_t{1} << 30;
  for (const std::uint64_t memory : {std::uint64_t{64} << 20, std::uint64_t{4} << 20, std::uint64_t{1} << 20,
                                     std::uint64_t{100000}, std::uint64_t{100}, std::uint64_t{0}}) {
    auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
    std::vector<std::string> omitted;
    const auto maps =
        plan_hemispheres(room.scene, reflectors, {.views = 16, .map_side = 256, .memory_bytes = memory}, omitted);
    std::uint64_t bytes = 0;
    for (const RadianceMap& map : maps) bytes += kMapBytesPerPixel * map.width * map.height;
    EXPECT_LE(bytes, memory);
    EXPECT_LE(bytes, before);
    EXPECT_EQ(omitted.empty(), maps.size() == 16) << memory;
    EXPECT_EQ(reflectors[0].reflector.map_count, maps.size());
    before = bytes;
  }
}

// The sample gallery: a hemisphere of 64 behind each element, all maps of one size with the lamps in them, Beckmann's
// D·G, and a pack without maps of its own.
TEST(BakedMethod, IsAsThePaperHasIt) {
  const testing::TemporaryFolder folder;
  const std::string line =
      "cd '" + folder.path().string() + "' && '" + ORIEL_BIN_DIR + "'/oriel-scenes gallery -o g.glb";
  ASSERT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
  BakeOptions bake = command_line_defaults();
  bake.scene = folder.path() / "g.glb";
  bake.choose_texel = false;
  bake.atlas.texel_m = 1;
  bake.radiosity.samples = 4;
  ASSERT_TRUE(settle(bake, {}));
  const auto baked = bake_method(bake, {.map_side = 16});
  ASSERT_TRUE(baked) << baked.error().text();
  EXPECT_TRUE(baked->pack.radiance_maps.empty() && baked->pack.curved_reflectors.empty());
  ASSERT_EQ(baked->reflectors.size(), 3u);
  int glossy = 0;
  for (const BakedReflector& r : baked->reflectors) {
    EXPECT_GT(r.mean_distance, 0.5f);
    EXPECT_EQ(r.sphere.side, 64u);
    EXPECT_TRUE(r.kernel.slices.empty());
    glossy += r.kernel.size > 1;
    for (const ReflectorElement& element : r.elements) {
      EXPECT_EQ(element.maps.size(), 64u);
      for (const std::uint32_t m : element.maps) {
        const RadianceMap& map = baked->maps[m];
        EXPECT_EQ(std::max(map.width, map.height), 16u);
        EXPECT_EQ(map.valid.size(), std::size_t{map.width} * map.height);
        EXPECT_TRUE(map.has_emission);
      }
    }
  }
  EXPECT_EQ(glossy, 2);
}

}  // namespace
}  // namespace oriel::study
