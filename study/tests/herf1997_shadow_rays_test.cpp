// Shadows by every method beside exact rays, on what breaks rasterisers.
#include <gtest/gtest.h>

#include "study/herf1997/equal_weights.h"
#include "study/tests/herf1997_exact_rays.h"

namespace oriel::study {
namespace {

constexpr std::array kMethods{CountMethod::kImages, CountMethod::kSpanBuffers, CountMethod::kEdgeFlags,
                              CountMethod::kBitRows};

// All methods alike and, for each instruction set that there is, as rays have it. Texels that an edge touches count as
// neither.
Compared check_volumes(const ShadowScene& scene) {
  const Occluders occluders(scene.points, scene.triangles);
  std::vector<std::uint16_t> first;
  Compared compared;
  for (const CountMethod method : kMethods)
    for (const Simd simd : {Simd::kBaseline, Simd::kAvx2, Simd::kAvx512}) {
      if (simd > best_simd()) continue;
      SoftShadows shadows({.method = method, .touching = 0, .simd = simd});
      const OccluderView view = shadows.view(occluders, scene.receiver(), scene.light);
      const BlockedRows& rows = shadows.block(view, scene.receiver());
      const std::vector<std::uint16_t> counts = count_blocked(rows);
      if (first.empty()) first = counts, compared = compare_with_rays(scene, rows, view);
      EXPECT_EQ(counts, first) << static_cast<int>(method) << " " << static_cast<int>(simd);
    }
  EXPECT_EQ(compared.wrong, 0u) << "of " << compared.rays << ", touched " << compared.touched;
  return compared;
}

DVec3 place(std::mt19937& random, const DVec3& lo, const DVec3& hi) {
  const auto one = [&](double a, double b) {
    return static_cast<double>(std::uniform_int_distribution<int>(static_cast<int>(a), static_cast<int>(b))(random));
  };
  return {one(lo.x, hi.x), one(lo.y, hi.y), one(lo.z, hi.z)};
}

TEST(ShadowRays, TheCheckerFindsAWrongTexel) {
  ShadowScene scene;
  scene.light_over({20, 20, 40}, {8, 8, 0}, 1);
  scene.add({10, 10, 10}, {30, 12, 10}, {20, 30, 10});
  SoftShadows shadows;
  const OccluderView view = shadows.view(Occluders(scene.points, scene.triangles), scene.receiver(), scene.light);
  BlockedRows rows = shadows.block(view, scene.receiver());
  EXPECT_EQ(compare_with_rays(scene, rows, view).wrong, 0u);
  rows.word(0, 0, 0) ^= 1;
  EXPECT_EQ(compare_with_rays(scene, rows, view).wrong, 1u);
}

TEST(ShadowRays, RandomTriangles) {
  std::mt19937 random(1);
  for (int run = 0; run < 6; ++run) {
    ShadowScene scene{.texels = {40 + 11 * run, 33}};
    scene.light_over({10, 5, 60}, {30, 25, 0}, 9);
    for (int k = 0; k < 24; ++k) {
      const DVec3 middle = place(random, {-10, -10, 3}, {80, 50, 50});
      scene.add(middle + place(random, DVec3(-9, -9, -3), DVec3(9, 9, 3)),
                middle + place(random, DVec3(-9, -9, -3), DVec3(9, 9, 3)),
                middle + place(random, DVec3(-9, -9, -3), DVec3(9, 9, 3)));
    }
    EXPECT_GT(check_volumes(scene).blocked, 300u);
  }
}

// Extreme 41: across the plane of the light, behind the receiver, through both.
TEST(ShadowRays, AcrossTheLightsPlaneAndBehindTheReceiver) {
  std::mt19937 random(2);
  for (int run = 0; run < 6; ++run) {
    ShadowScene scene;
    scene.light_over({20, 15, 30}, {20, 20, 0}, 8);
    for (int k = 0; k < 12; ++k)
      scene.add(place(random, DVec3(-20, -20, -40), DVec3(80, 60, 70)),
                place(random, DVec3(-20, -20, -40), DVec3(80, 60, 70)),
                place(random, DVec3(-20, -20, -40), DVec3(80, 60, 70)));
    check_volumes(scene);
  }
}

TEST(ShadowRays, ALightThatStandsOnEdgeToTheReceiver) {
  ShadowScene scene;
  scene.light = sample_parallelogram({{-5, 10, -6}, {0, 20, 0}, {0, 0, 40}}, 1, 16);  // partly behind it
  for (ShadowLightSample& s : scene.light.samples) s.position = round(s.position);
  scene.add_box({10, 10, 4}, {20, 20, 14});
  scene.add_box({-4, 12, 2}, {2, 18, 40});
  EXPECT_GT(check_volumes(scene).blocked, 1000u);
}

TEST(ShadowRays, EdgesThroughCentres) {
  ShadowScene scene;
  scene.light_over({30, 20, 40}, {1, 1, 0}, 1);
  for (ShadowLightSample& s : scene.light.samples) s.position = DVec3(31.5, 20.5, 40);
  // Half-way up: a vertex at 21.5 is seen at 11.5, the centre of a texel; so are whole edges.
  scene.add({21.5, 10.5, 20}, {41.5, 10.5, 20}, {41.5, 30.5, 20});
  scene.add({21.5, 10.5, 20}, {41.5, 30.5, 20}, {21.5, 30.5, 20});
  const Compared c = check_volumes(scene);
  EXPECT_GT(c.touched, 100u);
  // Each centre on the rim belongs to one side: left and upper edges are in, right and lower ones out, and none leaks
  // between the two triangles.
  EXPECT_EQ(c.blocked, 40u * 40u);
}

TEST(ShadowRays, AllNoneAndNoOccluders) {
  for (const int samples : {1, 64, 65, 1024}) {
    ShadowScene scene{.texels = {33, 17}};
    scene.light_over({5, 5, 30}, {20, 8, 0}, samples);
    ASSERT_EQ(scene.light.samples.size(), static_cast<std::size_t>(samples));
    EXPECT_EQ(check_volumes(scene).blocked, 0u);
    ShadowScene beside = scene;
    beside.add_box({200, 200, 5}, {220, 220, 10});
    EXPECT_EQ(check_volumes(beside).blocked, 0u);
    scene.add({-500, -500, 10}, {900, -500, 10}, {0, 900, 10});
    EXPECT_EQ(check_volumes(scene).blocked, static_cast<std::size_t>(33 * 17 * samples));
  }
}

TEST(ShadowRays, OpenMeshesAndMoreThanTwoFacesOnAnEdge) {
  ShadowScene scene;
  scene.light_over({20, 15, 50}, {10, 20, 0}, 12);
  for (const DVec3& tip : {DVec3(30, 30, 12), DVec3(10, 35, 20), DVec3(25, 5, 30), DVec3(50, 20, 15)})
    scene.add({20, 20, 15}, {30, 22, 20}, tip);
  scene.add_box({40, 30, 10}, {50, 40, 20});
  scene.triangles.erase(scene.triangles.end() - 3);  // a box with a hole
  EXPECT_GT(check_volumes(scene).blocked, 1000u);
}

TEST(ShadowRays, TouchingCoplanarAndDoubledOccluders) {
  ShadowScene scene;
  scene.light_over({20, 15, 40}, {10, 20, 0}, 10);
  scene.add_box({10, 10, 0}, {20, 20, 10});         // stands on the receiver
  scene.add_box({30, 10, -5}, {40, 20, 10});        // through it
  scene.add({0, 0, 0}, {50, 0, 0}, {0, 40, 0});     // in its plane
  scene.add({0, 0, -3}, {50, 0, -3}, {0, 40, -3});  // behind it
  scene.add_box({20, 10, 0}, {25, 20, 10});         // shares a face with the first
  scene.add_box({10, 30, 8}, {20, 40, 12}), scene.add_box({10, 30, 8}, {20, 40, 12});
  scene.add({5, 5, 10}, {5, 5, 10}, {9, 9, 10});  // no area
  EXPECT_GT(check_volumes(scene).blocked, 1000u);
}

TEST(ShadowRays, ASampleInsideABody) {
  ShadowScene scene;
  scene.light_over({20, 20, 30}, {12, 1, 0}, 4);
  scene.add_box({24, 10, 20}, {40, 40, 40});  // holds some of the samples
  const Compared c = check_volumes(scene);
  EXPECT_GT(c.blocked, 64u * 48u);
  EXPECT_LT(c.blocked, 4u * 64u * 48u);
}

}  // namespace
}  // namespace oriel::study
