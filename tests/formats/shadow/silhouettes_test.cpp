// Shadows by silhouettes beside exact rays, and beside those that are drawn face by face.
#include <gtest/gtest.h>

#include "formats/shadow/silhouettes.h"
#include "tests/formats/shadow/exact_rays.h"
#include "tests/formats/shadow/test_lights.h"

namespace oriel {
namespace {

// The bits of a scene's only body, in a window that holds all of the receiver.
BlockedRows by_silhouettes(const ShadowScene& scene, const OccluderView& view, Simd simd, bool& added) {
  const ShadowBody body(Occluders(scene.points, scene.triangles));
  std::vector<DVec3> samples;
  for (const std::uint32_t s : view.apex_of) samples.push_back(scene.light.samples[s].position);
  BlockedRows rows;
  rows.reset(scene.texels.x, scene.texels.y, static_cast<int>(view.apexes.size()));
  const BodyPlace place{ReceiverSpace(scene.receiver()), samples, view.apexes, 0};
  added = SilhouetteShadows().add(body, place, {0, 0, scene.texels.x / 32, scene.texels.y}, simd, rows);
  return rows;
}

void check(const ShadowScene& scene, std::size_t least_blocked) {
  SoftShadows shadows;
  const OccluderView view = shadows.view(Occluders(scene.points, scene.triangles), scene.receiver(), scene.light);
  std::vector<std::uint16_t> first;
  for (const Simd simd : {Simd::kBaseline, Simd::kAvx2, Simd::kAvx512}) {
    if (simd > best_simd()) continue;
    bool added = false;
    const BlockedRows rows = by_silhouettes(scene, view, simd, added);
    ASSERT_TRUE(added);
    const Compared compared = compare_with_rays(scene, rows, view);
    EXPECT_EQ(compared.wrong, 0u) << "of " << compared.rays << ", touched " << compared.touched;
    EXPECT_GE(compared.blocked, least_blocked);
    const std::vector<std::uint16_t> counts = count_blocked(rows);
    if (first.empty()) first = counts;
    EXPECT_EQ(counts, first) << static_cast<int>(simd);
  }
}

// A closed body with dents, its corners at whole units.
void add_ball(ShadowScene& scene, const DVec3& middle, double radius, int around, int down) {
  const auto at = [&](int i, int j) {
    const double theta = 2 * kPiD * (i % around) / around, phi = kPiD * j / down;
    const double r = radius * (1 + 0.35 * std::sin(3 * theta) * std::sin(phi));
    return middle + round(r * DVec3(std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi), std::cos(phi)));
  };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < down; ++j)
      for (const auto& t :
           {std::array{at(i, j), at(i, j + 1), at(i + 1, j + 1)}, std::array{at(i, j), at(i + 1, j + 1), at(i + 1, j)}})
        if (glm::cross(t[1] - t[0], t[2] - t[0]) != DVec3(0)) scene.add(t[0], t[1], t[2]);
}

TEST(Silhouettes, AreThoseThatRaysSee) {
  for (int run = 0; run < 2; ++run) {
    ShadowScene scene{.texels = {96, 70}};
    scene.light_over({20, 15, 90}, {30.0 + 30 * run, 25, 0}, 11);
    add_ball(scene, {44 + 3 * run, 33, 34}, 14, 16, 12);
    check(scene, 1000);
  }
}

TEST(Silhouettes, CountOverlappingPartsOnce) {
  ShadowScene scene;
  scene.light_over({10, 10, 80}, {40, 20, 0}, 9);
  add_ball(scene, {25, 20, 30}, 9, 12, 8);
  add_ball(scene, {33, 24, 14}, 9, 12, 8);
  scene.add_box({20, 18, 40}, {40, 21, 47});
  check(scene, 2000);
}

// Sheets, triangles that share no edge, three on one edge.
TEST(Silhouettes, NeedNoClosedBody) {
  std::mt19937 random(3);
  const auto one = [&](int a, int b) { return static_cast<double>(std::uniform_int_distribution<int>(a, b)(random)); };
  for (int run = 0; run < 6; ++run) {
    ShadowScene scene;
    scene.light_over({5, 5, 60}, {50, 30, 0}, 10);
    for (int k = 0; k < 14; ++k)
      scene.add({one(-10, 70), one(-10, 60), one(1, 50)}, {one(-10, 70), one(-10, 60), one(1, 50)},
                {one(-10, 70), one(-10, 60), one(1, 50)});
    const DVec3 a(20, 10, 20), b(30, 40, 22);
    for (const DVec3& c : {DVec3(10, 20, 20), DVec3(50, 25, 30), DVec3(25, 20, 40)}) scene.add(a, b, c);
    check(scene, 1000);
  }
}

TEST(Silhouettes, StandOnTheReceiver) {
  ShadowScene scene;
  scene.light_over({10, 10, 50}, {20, 20, 0}, 8);
  scene.add_box({20, 15, 0}, {35, 25, 20});
  check(scene, 1000);
}

TEST(Silhouettes, AreCutAtTheReceiver) {
  for (int run = 0; run < 2; ++run) {
    ShadowScene scene;
    scene.light_over({10, 10, 80}, {30, 20, 0}, 9);
    add_ball(scene, {30.0, 24.0, 4.0 - 12 * run}, 14, 16, 12);
    scene.add({5, 5, -9}, {40, 8, 30}, {10, 30, -9});
    scene.add_box({50, 30, -10}, {60, 41, 5});
    check(scene, 1000);
  }
}

TEST(Silhouettes, LeaveBodiesAsHighAsTheLampToOthers) {
  ShadowScene scene;
  scene.light_over({10, 10, 50}, {20, 20, 0}, 8);
  scene.add_box({20, 15, 45}, {35, 25, 65});
  const OccluderView view = SoftShadows().view({}, scene.receiver(), scene.light);
  bool added = true;
  const BlockedRows rows = by_silhouettes(scene, view, best_simd(), added);
  EXPECT_FALSE(added);
  for (const std::uint16_t count : count_blocked(rows)) EXPECT_EQ(count, 0);
}

TEST(Silhouettes, BehindTheReceiverCastNothing) {
  ShadowScene scene;
  scene.light_over({10, 10, 50}, {20, 20, 0}, 8);
  scene.add_box({20, 15, -30}, {35, 25, -10});
  check(scene, 0);
}

// A window sees the same as all of the receiver does there.
TEST(Silhouettes, AreTheSameInAWindow) {
  ShadowScene scene{.texels = {128, 80}};
  scene.light_over({40, 30, 90}, {30, 25, 0}, 9);
  add_ball(scene, {60, 40, 34}, 14, 16, 12);
  for (DVec3& p : scene.points) p += DVec3(0.137, 0.211, 0.053);  // no edge goes through a centre
  const OccluderView view = SoftShadows().view({}, scene.receiver(), scene.light);
  bool added = false;
  const BlockedRows all = by_silhouettes(scene, view, best_simd(), added);
  std::vector<DVec3> samples;
  for (const ShadowLightSample& s : scene.light.samples) samples.push_back(s.position);
  BlockedRows part;
  part.reset(128, 80, 9);
  const ShadowBody body(Occluders(scene.points, scene.triangles));
  ASSERT_TRUE(SilhouetteShadows().add(body, {ReceiverSpace(scene.receiver()), samples, view.apexes, 0}, {1, 21, 2, 40},
                                      best_simd(), part));
  std::size_t blocked = 0;
  for (int s = 0; s < 9; ++s)
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 128; ++x) {
        const bool inside = x >= 32 && x < 96 && y >= 21 && y < 61;
        EXPECT_EQ(part.blocked(s, x, y), inside && all.blocked(s, x, y)) << s << " " << x << " " << y;
        blocked += part.blocked(s, x, y) ? 1 : 0;
      }
  EXPECT_GT(blocked, 1000u);
}

}  // namespace
}  // namespace oriel
