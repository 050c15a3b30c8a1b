// bake/transfer/transfer.h: against closed forms of what spheres hide and cavities reflect.
#include "bake/transfer/transfer.h"

#include <gtest/gtest.h>

#include "formats/core/sh.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

VertexTransfer transfer_of(const Scene& scene, const TransferOptions& options, int threads = 2) {
  const auto accel = Accel::build(scene);
  Context context;
  context.threads = threads;
  return bake_transfer(accel.value(), options, context).value();
}

// Σ T_i L_i under radiance 1 from everywhere.
float in_even_light(const VertexTransfer& transfer, std::size_t vertex, std::size_t channel = 0) {
  return std::sqrt(4 * kPi) * transfer.coefficients[(vertex * static_cast<std::size_t>(transfer.channels) + channel) *
                                                    static_cast<std::size_t>(sh_count(transfer.bands))];
}

// A corner of the plane z = 0 at the origin, a black sphere over it.
Scene under_sphere(const Vec3& centre, float radius) {
  SceneParts parts;
  const std::uint32_t black = parts.diffuse(Vec3(0));
  parts.quad("plane", black, Vec3(0), {0.1f, 0, 0}, {0, 0.1f, 0});
  parts.sphere("sphere", black, centre, radius, 4);
  return parts.finish();
}

TEST(Transfer, APlaneUnderASphereIsShadedByItsSolidAngle) {
  const VertexTransfer t = transfer_of(under_sphere({0, 0, 2}, 1), {.bounces = 0, .samples = 4096});
  EXPECT_EQ(t.channels, 1);
  EXPECT_NEAR(in_even_light(t, 0), 0.75, 0.0075);  // 1 - (R/d)²
  // Zonal about z: unshadowed part less the cap's, ∫ cosθ P_l / π from cos 30° to 1.
  const double expected_2 = 0.029567959;  // (2, 0), by quadrature
  EXPECT_NEAR(t.coefficients[6], expected_2, 0.001);
  EXPECT_NEAR(t.coefficients[3], 0, 0.001);
}

TEST(Transfer, ASphereToTheSideShadesThatSide) {
  const VertexTransfer t = transfer_of(under_sphere({1, 0, 1.5f}, 0.8f), {.bounces = 0, .samples = 4096});
  EXPECT_NEAR(in_even_light(t, 0), 0.8361501, 0.0083);
  EXPECT_NEAR(t.coefficients[3], -0.039795941, 0.001);  // (1, 1), by quadrature
  EXPECT_NEAR(t.coefficients[1], 0, 0.001);
  EXPECT_LT(t.standard_error, 0.02);
}

TEST(Transfer, ConvexObjectsHaveExactlyTheUnshadowedTransfer) {
  for (const bool box : {false, true}) {
    SceneParts parts;
    const std::uint32_t red = parts.diffuse({0.9f, 0.1f, 0.1f});
    if (box)
      parts.box("box", red, {-1, -2, -3}, {1, 2, 3});
    else
      parts.sphere("sphere", red, {100, 0, 0}, 1, 3);
    const Scene scene = parts.finish();
    const VertexTransfer shadowed = transfer_of(scene, {.samples = 256});
    const auto count = static_cast<std::size_t>(sh_count(shadowed.bands));
    std::vector<float> y(count);
    for (std::size_t v = 0; v < shadowed.vertices(); ++v) {
      evaluate_sh(scene.normals[v], y);
      for (std::size_t i = 0; i < shadowed.stride(); ++i) {
        const auto band = static_cast<int>(std::sqrt(i % count));
        const double bare = cosine_factor(band) / kPiD * y[i % count];
        EXPECT_NEAR(shadowed.coefficients[v * shadowed.stride() + i], bare, 1e-4);
      }
    }
  }
}

TEST(Transfer, WhereTimeIsOverWhatHidesIsLeftOutWithAWord) {
  const Scene scene = under_sphere({0, 0, 2}, 1);
  Context context;
  std::vector<Warning> warnings;
  const WarningLog log(context, warnings);
  const auto late = bake_transfer(*Accel::build(scene), {.samples = 4096, .enough = [] { return true; }}, context);
  ASSERT_TRUE(late);
  EXPECT_NEAR(in_even_light(*late, 0), 1, 1e-4);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, WarningCode("time-over"));
}

// The part of an inward sphere below a height: every point of it sees the rest by its share of the whole area.
Scene bowl(const Vec3& albedo, float height) {
  SceneParts parts;
  parts.sphere("bowl", parts.diffuse(albedo), Vec3(0), 1, 4, true);
  Scene scene = parts.finish();
  std::vector<UVec3> kept;
  for (const UVec3& t : scene.triangles)
    if (std::max({scene.positions[t.x].z, scene.positions[t.y].z, scene.positions[t.z].z}) < height) kept.push_back(t);
  scene.triangles = kept;
  scene.triangle_surface.resize(kept.size());
  scene.surfaces[0].triangle_count = static_cast<std::uint32_t>(kept.size());
  scene.face_normals.clear();
  return scene;
}

TEST(Transfer, LightInABowlIsAGeometricSeries) {
  const Scene scene = bowl({0.8f, 0.5f, 0.2f}, 0.3f);
  double area = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) area += triangle_area(scene, t);
  const double share = area / (4 * kPiD);
  std::vector<bool> used(scene.positions.size());
  for (const UVec3& t : scene.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  for (const int bounces : {0, 1, 3}) {
    const VertexTransfer t = transfer_of(scene, {.bounces = bounces, .samples = 1024});
    ASSERT_EQ(t.channels, bounces > 0 ? 3 : 1);
    for (std::size_t c = 0; c < static_cast<std::size_t>(t.channels); ++c) {
      const double albedo[3] = {0.8, 0.5, 0.2};
      double expected = 0, term = 1 - share, sum = 0;
      for (int b = 0; b <= bounces; ++b, term *= albedo[c] * share) expected += term;
      int count = 0;
      for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) {
          sum += in_even_light(t, v, c);
          ++count;
        }
      EXPECT_NEAR(sum / count, expected, 0.01 * expected) << bounces << " bounces, channel " << c;
    }
  }
}

TEST(Transfer, TheSameForAnyNumberOfThreads) {
  const Scene scene = bowl({0.8f, 0.5f, 0.2f}, 0.3f);
  EXPECT_EQ(transfer_of(scene, {.samples = 64}, 1).coefficients, transfer_of(scene, {.samples = 64}, 2).coefficients);
}

TEST(Transfer, FarVerticesUnderAShadowsEdgeAreReported) {
  SceneParts ball;
  ball.sphere("ball", ball.diffuse(Vec3(0.5f)), Vec3(0), 1, 4);
  const Scene round = ball.finish();
  EXPECT_EQ(coarse_share(round, transfer_of(round, {.samples = 64})), 0);
  SceneParts parts;  // a plane of two triangles, half of it under a box
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  parts.quad("plane", grey, Vec3(0), {4, 0, 0}, {0, 4, 0});
  parts.box("box", grey, {-2, -2, 0.2f}, {2, 6, 1});
  const Scene scene = parts.finish();
  EXPECT_GT(coarse_share(scene, transfer_of(scene, {.samples = 256})), 0.05f);
}

TEST(Transfer, OptionsOutOfRangeAreErrors) {
  SceneParts parts;
  parts.box("box", parts.diffuse(Vec3(0.5f)), Vec3(-1), Vec3(1));
  const Scene scene = parts.finish();
  const auto accel = Accel::build(scene);
  Context context;
  EXPECT_EQ(bake_transfer(accel.value(), {.bands = 7}, context).error().code, ErrorCode::kUsage);
  EXPECT_EQ(bake_transfer(accel.value(), {.bounces = -1}, context).error().code, ErrorCode::kUsage);
  context.stop = true;
  EXPECT_EQ(bake_transfer(accel.value(), {}, context).error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace oriel
