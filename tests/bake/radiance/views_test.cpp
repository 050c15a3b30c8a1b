// Elements, hemispheres and the memory they may take.
#include "bake/radiance/views.h"

#include <gtest/gtest.h>

#include <set>

#include "bake/radiance/reproject.h"
#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

std::uint64_t bytes(const ViewPlan& plan) {
  std::uint64_t sum = 0;
  for (const RadianceMap& map : plan.maps) sum += kMapBytesPerPixel * map.width * map.height;
  return sum;
}

TEST(Views, GridsAreAsFineAsAskedAndNeverTooMany) {
  const auto grid = [](Vec2 size, float element, std::uint32_t limit) {
    const ElementGrid g = element_grid(size, element, limit);
    return std::pair{g.x, g.y};
  };
  EXPECT_EQ(grid({2, 1.5f}, 3, 16), (std::pair{1u, 1u}));
  EXPECT_EQ(grid({6, 3}, 3, 16), (std::pair{2u, 1u}));
  EXPECT_EQ(grid({6.5f, 3.5f}, 3, 16), (std::pair{3u, 2u}));
  EXPECT_EQ(grid({100, 100}, 3, 16), (std::pair{4u, 4u}));
  EXPECT_EQ(grid({0, 0}, 3, 16), (std::pair{1u, 1u}));
  EXPECT_EQ(grid({1e-3f, 1e-3f}, 3, 0), (std::pair{1u, 1u}));
  for (const Vec2& size : {Vec2(1e6f, 1e-6f), Vec2(1e6f, 1e6f), Vec2(1e-6f, 40), Vec2(33, 7)})
    for (const std::uint32_t limit : {1u, 2u, 7u, 16u}) {
      const ElementGrid g = element_grid(size, 3, limit);
      EXPECT_GE(g.x * g.y, 1u);
      EXPECT_LE(g.x * g.y, limit);
    }
}

TEST(Views, HemispheresHaveExactlyAsManyPointsWellApart) {
  for (std::uint32_t k = 0; k <= 2 * 70; ++k) {
    const std::uint32_t count = k / 2;
    const Rings rings = k % 2 ? Rings::kToRim : Rings::kTo75;
    const std::vector<Vec3> d = hemisphere_directions(count, rings);
    ASSERT_EQ(d.size(), std::max(1u, count));
    EXPECT_EQ(d[0], Vec3(0, 0, -1));
    float nearest = 4;
    for (std::size_t i = 0; i < d.size(); ++i) {
      EXPECT_NEAR(glm::length(d[i]), 1, 1e-6);
      EXPECT_LE(d[i].z, rings == Rings::kTo75 ? -0.258f : -0.05f);
      for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, glm::length(d[i] - d[j]));
    }
    if (count > 1) {
      EXPECT_GT(nearest * nearest * static_cast<float>(count), 1.2f) << count;  // of at most about 2π · 2/√3
    }
  }
}

// The mean of a direction over a hemisphere is half its axis. Rings that end at 75° are turned towards the pole.
TEST(Views, HemispheresToTheRimAreEven) {
  const auto mean = [](Rings rings, std::uint32_t count) {
    DVec3 sum(0);
    for (const Vec3& d : hemisphere_directions(count, rings)) sum += DVec3(d) / double{1.0f * count};
    return sum;
  };
  for (const std::uint32_t count : {16u, 64u, 256u, 1000u}) {
    const DVec3 m = mean(Rings::kToRim, count);
    EXPECT_NEAR(m.z, -0.5, 0.6 / std::sqrt(count)) << count;
    EXPECT_NEAR(glm::length(DVec2(m)), 0, 0.02) << count;
  }
  EXPECT_NEAR(mean(Rings::kToRim, 1000).z, -0.5, 0.01);
  EXPECT_LT(mean(Rings::kTo75, 1000).z, -0.6);
}

TEST(Views, EyesLieOnHemispheresThatTheElementsInscribe) {
  const test::MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
  ViewOptions options;
  options.element_m = 1;
  const ViewPlan plan = plan_views(room.scene, reflectors, options);
  const Reflector& r = reflectors[0].reflector;
  EXPECT_EQ(r.elements_x, 2u);
  EXPECT_EQ(r.elements_y, 2u);
  EXPECT_EQ(r.first_map, 0u);
  ASSERT_EQ(r.map_count, plan.maps.size());
  ASSERT_EQ(plan.maps.size(), 4u * 16u);
  for (std::size_t i = 0; i < plan.maps.size(); ++i) {
    const RadianceMap& map = plan.maps[i];
    const Vec3 centre(0.5f * (map.lower + map.upper), 0);
    EXPECT_LT(map.eye.z, 0);
    EXPECT_NEAR(glm::length(map.eye - centre), 0.5f * glm::length(map.upper - map.lower), 1e-6);
    EXPECT_EQ(map.width, 256u);
    EXPECT_EQ(map.height, 192u);                                                // 1 x 0.75
    const Vec2 expected = r.lower + Vec2(i / 16 % 2, i / 32) * Vec2(1, 0.75f);  // row by row
    EXPECT_NEAR(glm::length(map.lower - expected), 0, 1e-6);
  }
}

TEST(Views, ElementsWithoutReflectorAndEyesOutsideTheSceneAreSkipped) {
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
  ViewOptions views;
  views.element_m = 1;
  const ViewPlan plan = plan_views(scene, reflectors, views);
  EXPECT_EQ(reflectors[0].reflector.elements_x, 10u);
  EXPECT_EQ(plan.maps.size(), 2u * 16u);
  for (const RadianceMap& map : plan.maps) EXPECT_GT(std::abs(map.lower.x + map.upper.x), 7);

  Scene cropped = scene;
  cropped.upper.z = 0.0f;  // as if the scene ended at the pane: its pole view mirrors to one radius outside
  cropped.lower.z = -0.1f;
  cropped.upper.y = 0.2f;
  const ViewPlan fewer = plan_views(cropped, reflectors, views);
  EXPECT_LT(fewer.maps.size(), plan.maps.size());
  ASSERT_EQ(fewer.omitted.size(), 1u);
  EXPECT_NE(fewer.omitted[0].find("outside the scene"), std::string::npos);
}

TEST(Views, MemoryIsNeverExceededAndWhatWasReducedIsSaid) {
  const test::MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  std::size_t before = 1u << 30;
  for (const std::uint64_t memory :
       {std::uint64_t{64} << 20, std::uint64_t{4} << 20, std::uint64_t{1} << 20, std::uint64_t{100000},
        std::uint64_t{5000}, std::uint64_t{100}, std::uint64_t{0}}) {
    auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
    ViewOptions options;
    options.memory_bytes = memory;
    const ViewPlan plan = plan_views(room.scene, reflectors, options);
    EXPECT_LE(bytes(plan), memory);
    EXPECT_LE(bytes(plan), before);
    EXPECT_EQ(plan.omitted.empty(), plan.maps.size() == 16 && plan.maps[0].width == 256) << memory;
    EXPECT_EQ(plan.maps.empty(), memory < 4000) << memory;
    EXPECT_EQ(reflectors[0].reflector.map_count, plan.maps.size());
    before = bytes(plan);
  }
}

TEST(Views, ResolutionFollowsTheLobe) {
  EXPECT_EQ(resolution_for(0), 256u);
  EXPECT_EQ(resolution_for(0.1f), 192u);
  EXPECT_EQ(resolution_for(0.3f), 128u);
}

// The corners of the element are the map's, from whatever place its eye sees them; heights give their disparity.
TEST(Views, MapsGoThroughTheElement) {
  RadianceMap map;
  map.lower = {-0.3f, 0.2f};
  map.upper = {1.2f, 0.9f};
  map.width = 30;
  map.height = 14;
  for (const Vec3& eye : {Vec3(0.4f, 0.5f, -1), Vec3(-3, 2, -0.2f), Vec3(0.45f, 0.55f, -100)}) {
    map.eye = eye;
    for (int corner = 0; corner < 4; ++corner) {
      const Vec2 sign(corner % 2 ? 1 : -1, corner / 2 ? 1 : -1);
      const Vec3 on_plane(glm::mix(map.lower, map.upper, 0.5f + 0.5f * sign), 0);
      for (const float depth : {1.0f, 2.0f, 50.0f}) {
        const Vec3 p = map.eye + depth * (on_plane - map.eye);
        EXPECT_NEAR(disparity_of(map, p.z), 1 / depth, 1e-5);
        const Vec2 pixel = map_pixel(map, p);
        EXPECT_NEAR(pixel.x, sign.x > 0 ? 30 : 0, 2e-3);
        EXPECT_NEAR(pixel.y, sign.y > 0 ? 14 : 0, 2e-3);
      }
    }
  }
}

}  // namespace
}  // namespace oriel
