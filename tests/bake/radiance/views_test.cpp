// Elements, hemispheres and the memory they may take.
#include "bake/radiance/views.h"

#include <gtest/gtest.h>

#include "bake/radiance/reproject.h"

namespace oriel {
namespace {

constexpr RingArc kToRim{0.5 * kPiD, 0.5};

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
    const bool to_rim = k % 2 != 0;
    const std::vector<Vec3> d = hemisphere_directions(count, to_rim ? kToRim : RingArc());
    ASSERT_EQ(d.size(), std::max(1u, count));
    EXPECT_EQ(d[0], Vec3(0, 0, -1));
    float nearest = 4;
    for (std::size_t i = 0; i < d.size(); ++i) {
      EXPECT_NEAR(glm::length(d[i]), 1, 1e-6);
      EXPECT_LE(d[i].z, to_rim ? -0.05f : -0.258f);
      for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, glm::length(d[i] - d[j]));
    }
    if (count > 1) {
      EXPECT_GT(nearest * nearest * static_cast<float>(count), 1.2f) << count;  // of at most about 2π · 2/√3
    }
  }
}

// The mean of a direction over a hemisphere is half its axis. Rings that end at 75° are turned towards the pole.
TEST(Views, HemispheresToTheRimAreEven) {
  const auto mean = [](const RingArc& rings, std::uint32_t count) {
    DVec3 sum(0);
    for (const Vec3& d : hemisphere_directions(count, rings)) sum += DVec3(d) / double{1.0f * count};
    return sum;
  };
  for (const std::uint32_t count : {16u, 64u, 256u, 1000u}) {
    const DVec3 m = mean(kToRim, count);
    EXPECT_NEAR(m.z, -0.5, 0.6 / std::sqrt(count)) << count;
    EXPECT_NEAR(glm::length(DVec2(m)), 0, 0.02) << count;
  }
  EXPECT_NEAR(mean(kToRim, 1000).z, -0.5, 0.01);
  EXPECT_LT(mean({}, 1000).z, -0.6);
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
