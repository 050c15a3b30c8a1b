#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "bake/trace/accel.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

TEST(Accel, HitsAQuadWhereGeometrySays) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const Hit hit = accel.intersect({{0.25f, 3, 0.5f}, {0, -1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_FLOAT_EQ(hit.distance, 3);
  EXPECT_TRUE(hit.front);
  const Vec3 p = point_on(scene, hit.triangle, hit.barycentric);
  EXPECT_NEAR(p.x, 0.25f, 1e-6f);
  EXPECT_NEAR(p.z, 0.5f, 1e-6f);
  EXPECT_FALSE(accel.intersect({{0.25f, -3, 0.5f}, {0, 1, 0}}).front);
  EXPECT_FALSE(accel.intersect({{2, 3, 0}, {0, -1, 0}}));
  EXPECT_EQ(accel.transmittance({{0, 1, 0}, {0, -1, 0}, 0.5f}), Vec3(1));
  EXPECT_EQ(accel.transmittance({{0, 1, 0}, {0, -1, 0}, 1.5f}), Vec3(0));
}

// A roof and a ceiling in one plane, of other triangles, as float files bring them: rays meet the front of one of the
// two wherever they come from, and a single sheet's back stays a back.
TEST(Accel, MeetsTheFrontOfSheetsBackToBack) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.5f));
  const auto at = [](float x, float z) { return Vec3(x, 3.1f + 0.137f * x, z); };
  parts.quad("roof", white, at(-4, 4), at(5, 4) - at(-4, 4), {0, 0, -9});
  parts.quad("ceiling", white, at(-3, -3), at(4, -3) - at(-3, -3), {0, 0, 6.5f});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  std::vector<Ray> rays;
  for (std::uint32_t k = 0; k < 4096; ++k) {
    Sampler sampler(7, 0, k);
    const Vec2 u = sampler.next2(), v = sampler.next2();
    const float side = k % 2 == 0 ? 1.0f : -1.0f;
    const Vec3 from(8 * u.x - 3.5f, 3.1f + side * (2 + 3 * u.y), 8 * v.x - 3.5f), to = at(6.9f * v.y - 2.95f, 0.1f);
    rays.push_back({from, glm::normalize(to - from)});
  }
  std::vector<Hit> hits(rays.size());
  accel.intersect(rays, hits);
  for (std::uint32_t k = 0; k < rays.size(); ++k) {
    ASSERT_TRUE(hits[k] && hits[k].front) << k;
    EXPECT_EQ(scene.surfaces[scene.triangle_surface[hits[k].triangle]].name, k % 2 == 0 ? "roof" : "ceiling") << k;
    const Hit alone = accel.intersect(rays[k]);
    EXPECT_EQ(alone.triangle, hits[k].triangle);
    const Vec3 met = rays[k].origin + hits[k].distance * rays[k].direction;
    EXPECT_LT(glm::distance(point_on(scene, hits[k].triangle, hits[k].barycentric), met), 1e-5f);
  }
  const Hit roof_alone = accel.intersect({{4.5f, 0, 0}, {0, 1, 0}});
  EXPECT_TRUE(roof_alone && !roof_alone.front);
}

// The same where the other sheet is lit on both sides: its twin is met.
TEST(Accel, MeetsTheTwinBehindASheet) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.5f));
  parts.quad("ceiling", white, {-3, 3.1f, -3}, {7, 0, 0}, {0, 0, 6.5f});
  parts.quad("slab", white, {-4, 3.1f, -5}, {9, 0, 0}, {0, 0, 9});
  parts.quad("slab's top", white, {-4, 3.1f, -5}, {0, 0, 9}, {9, 0, 0});
  Scene scene = parts.finish();
  for (std::uint32_t k = 0; k < 2; ++k) {  // as twins are: with the second and the third vertex swapped
    const UVec3& t = scene.triangles[2 + k];
    scene.triangles[4 + k] = {t.x, t.z, t.y};
  }
  scene.face_normals.clear();
  scene.twin = {~0u, ~0u, 4, 5, 2, 3};
  const Accel accel = *Accel::build(scene);
  for (std::uint32_t k = 0; k < 256; ++k) {
    Sampler sampler(7, 0, k);
    const Vec2 u = sampler.next2();
    const Vec3 to(6 * u.x - 2.5f, 3.1f, 6 * u.y - 2.9f), from(0.3f, 7, 0.2f);
    const Hit hit = accel.intersect({from, glm::normalize(to - from)});
    ASSERT_TRUE(hit && hit.front) << k;
    EXPECT_EQ(scene.surfaces[scene.triangle_surface[hit.triangle]].name, "slab's top");
    EXPECT_LT(glm::distance(point_on(scene, hit.triangle, hit.barycentric), to), 1e-5f);
  }
}

TEST(Accel, AnswersImpossibleRaysAsMisses) {
  SceneParts parts;
  parts.box("box", parts.diffuse(Vec3(0.5f)), Vec3(-1), Vec3(1));
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(accel.intersect({Vec3(nan), {0, 0, 1}}));
  EXPECT_FALSE(accel.intersect({Vec3(0), Vec3(inf)}));
  EXPECT_FALSE(accel.intersect({Vec3(1e30f), {0, 0, 1}}));
  EXPECT_FALSE(accel.intersect({Vec3(0), {0, 0, 1}, nan}));
  EXPECT_FALSE(accel.intersect({Vec3(0), {0, 0, 1}, -1}));
}

TEST(Accel, RefusesAnEmptyScene) {
  const Scene scene;
  const auto accel = Accel::build(scene);
  ASSERT_FALSE(accel);
  EXPECT_EQ(accel.error().code, ErrorCode::kInvalid);
}

// Rays that start on a closed sphere and go inwards must all meet its far side, at every scale and far from the centre:
// no self-intersection, no leak.
class AccelScale : public ::testing::TestWithParam<float> {};

TEST_P(AccelScale, NoSelfIntersectionAndNoLeak) {
  const float scale = GetParam();
  SceneParts parts;
  parts.sphere("sphere", parts.diffuse(Vec3(0.5f)), Vec3(0.3f, -2, 0.7f) * scale, scale, 4, true);
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  int self = 0, leaks = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    Sampler sampler(1, 2, i);
    const auto triangle = static_cast<std::uint32_t>(sampler.next1() * static_cast<float>(scene.triangles.size()));
    const Vec2 b = square_to_triangle(sampler.next2());
    const Vec3 n = geometric_normal(scene, triangle);
    const Vec3 d = glm::normalize(frame_from_normal(n) * square_to_cosine_hemisphere(sampler.next2()));
    if (glm::dot(d, n) < 1e-3f) continue;
    const Hit hit = accel.intersect({spawn_origin(scene, triangle, b, d), d});
    leaks += !hit || !hit.front;
    self += hit && hit.triangle == triangle;
  }
  EXPECT_EQ(self, 0);
  EXPECT_EQ(leaks, 0);
}
INSTANTIATE_TEST_SUITE_P(Scales, AccelScale, ::testing::Values(1e-6f, 1e-4f, 1.0f, 1e3f, 1e6f));

TEST(Accel, CutOutsAndGlassLetLightPass) {
  SceneParts parts;
  SceneMaterial glass;
  glass.metallic = 0;
  glass.specular = 0;
  glass.transmission = 1;
  glass.base_color = {0.5f, 0.25f, 1};
  SceneMaterial hole;
  hole.alpha = 0.2f;
  hole.alpha_mode = AlphaMode::kMask;
  parts.quad("glass", parts.add(glass), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("hole", parts.add(hole), {-1, 1, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("glass 2", 0, {-1, 2, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), {-1, -5, 1}, {2, 0, 0}, {0, 0, -2});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const Vec3 t = accel.transmittance({{0.1f, 4, 0.2f}, {0, -1, 0}, 8});
  EXPECT_NEAR(t.r, 0.25f, 1e-6f);
  EXPECT_NEAR(t.g, 0.0625f, 1e-6f);
  EXPECT_NEAR(t.b, 1, 1e-6f);
  EXPECT_EQ(accel.transmittance({{0.1f, 4, 0.2f}, {0, -1, 0}, 100}), Vec3(0));
}

// A pane of some colour in a room, whose opaque triangles are all or not all of the scene.
Scene room_with_pane(const Vec3& tint, bool pane) {
  SceneParts parts;
  SceneMaterial glass;
  glass.metallic = 0;
  glass.specular = 0;
  glass.transmission = 1;
  glass.base_color = tint;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(-2), Vec3(2), true);
  if (pane) parts.quad("pane", parts.add(glass), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  return parts.finish();
}

TEST(Accel, OfAnotherSceneIsThatScenesOwn) {
  for (const bool pane : {false, true}) {
    std::optional<Scene> before = room_with_pane({0.5f, 0.5f, 0.5f}, pane);
    const Scene after = room_with_pane({0.5f, 0.25f, 1}, pane);
    const Accel built = *Accel::build(after);
    std::optional<Accel> first = *Accel::build(*before);
    const Accel accel = first->of(after);
    first.reset();
    before.reset();
    EXPECT_EQ(&accel.scene(), &after);
    for (std::uint32_t i = 0; i < 1000; ++i) {
      Sampler sampler(1, 2, i);
      const Vec3 from(sampler.next1(), 2 * sampler.next1() - 1, sampler.next1());
      const Ray ray{from, square_to_sphere(sampler.next2()), 1.9f};
      EXPECT_EQ(accel.transmittance(ray), built.transmittance(ray));
      EXPECT_EQ(accel.intersect(ray).triangle, built.intersect(ray).triangle);
    }
    const Vec3 down = accel.transmittance({{0.1f, 1, 0.2f}, {0, -1, 0}, 1.5f});
    EXPECT_NEAR(down.g, pane ? 0.25f : 1, 1e-6f);
  }
}

}  // namespace
}  // namespace oriel
