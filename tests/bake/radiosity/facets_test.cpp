// Smooth-shaded facets, and texels wider than facets, against closed forms.
#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::SceneParts;

// Vertical facets between the points (x, z) of a line, 1 m high, on a chart that covers the whole page, each facet as
// wide as any other; flat, or with normals interpolated between neighbours along the line, which is closed.
void add_facets(SceneParts& parts, const std::vector<Vec2>& line, bool smooth) {
  const std::size_t count = line.size() - 1;
  std::vector<Vec3> flat, positions, normals;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec2 step = glm::normalize(line[k + 1] - line[k]);
    flat.emplace_back(-step.y, 0, step.x);
  }
  std::vector<UVec3> triangles;
  std::vector<Vec2> uv;
  for (std::size_t k = 0; k < count; ++k) {
    const auto v = static_cast<std::uint32_t>(positions.size());
    for (const std::size_t end : {0u, 1u})
      for (const float top : {0.0f, 1.0f}) {
        positions.emplace_back(line[k + end].x, top, line[k + end].y);
        const Vec3& beside = flat[(k + (end == 0 ? count - 1 : 1)) % count];
        normals.push_back(smooth ? glm::normalize(flat[k] + beside) : flat[k]);
        uv.emplace_back(static_cast<float>(k + end) / static_cast<float>(count), 1 - top);
      }
    triangles.emplace_back(v, v + 2, v + 3);
    triangles.emplace_back(v, v + 3, v + 1);
  }
  parts.mesh("facets", parts.diffuse(Vec3(0.5f)), positions, normals, triangles);
  parts.scene().uv1 = uv;
  parts.scene().surfaces[0].has_uv1 = true;
}

Scene facets(const std::vector<Vec2>& line, bool smooth) {
  SceneParts parts;
  add_facets(parts, line, smooth);
  return parts.finish();
}

LightmapPage bake(const Scene& scene, Estimator estimator, int side) {
  Context context;
  AtlasOptions atlas_options;
  atlas_options.source = AtlasOptions::Source::kUv1;
  atlas_options.resolution = side;
  atlas_options.texel_m = 10;  // of all else
  const Atlas atlas = *build_atlas(scene, atlas_options, context);
  const std::vector<TexelMapPage> map = *build_texel_map(atlas, context);
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  PathOptions paths;
  paths.max_bounces = 0;
  return bake_radiosity({{accel, lights, paths}, atlas, map}, {.estimator = estimator, .samples = 1024}, context)
      ->pages[0];
}

class Facets : public ::testing::TestWithParam<Estimator> {};

// Twelve texels over seventy facets, of which those that face the sun and those that do not differ threefold: a texel
// holds the mean of what lies under it, not the facet under its centre.
TEST_P(Facets, TexelsHoldTheMeanOfAllFacetsUnderThem) {
  constexpr int kFacets = 70, kSide = 12;
  const float slope = 0.5f;
  std::vector<Vec2> line;
  for (int k = 0; k <= kFacets; ++k)
    line.push_back(Vec2(k, k % 2 == 0 ? 0 : std::tan(slope)) / static_cast<float>(kFacets));
  Scene scene = facets(line, false);
  const Vec3 to_sun = glm::normalize(Vec3(0.8f, 0.3f, 0.9f));
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = -to_sun;
  sun.intensity = Vec3(1);
  scene.lights = {sun};
  const LightmapPage page = bake(scene, GetParam(), kSide);
  double sum = 0, sum_expected = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double left = i % kSide, wide = static_cast<double>(kSide) / kFacets;
    double expected = 0;
    for (int k = 0; k < kFacets; ++k) {
      const double share = std::min(left + 1, (k + 1) * wide) - std::max(left, k * wide);
      const double across = k % 2 == 0 ? -std::sin(slope) : std::sin(slope);
      expected += std::max(0.0, share) * (across * to_sun.x + std::cos(slope) * to_sun.z);
    }
    const auto t = static_cast<std::size_t>(i);
    ASSERT_EQ(page.state[t], TexelState::kValid);
    EXPECT_NEAR(page.irradiance[t].g / expected, 1, 0.08) << i;
    sum += page.irradiance[t].g, sum_expected += expected;
  }
  EXPECT_NEAR(sum / sum_expected, 1, 0.005);
}

// Under an even sky all of a smooth body is lit alike, however few facets stand for it: what of the lobe lies below a
// facet is folded above it. Cut off, a seventh of the light would be missing at the edges of a prism of four sides, 5 %
// of all.
TEST_P(Facets, ASmoothBodyUnderAnEvenSkyIsEven) {
  std::vector<Vec2> line;
  for (int k = 0; k <= 4; ++k) line.emplace_back(std::sin(0.5f * kPi * k), std::cos(0.5f * kPi * k));
  Scene scene = facets(line, true);
  scene.sky = Vec3(1);
  const LightmapPage page = bake(scene, GetParam(), 16);
  double sum = 0;
  for (std::size_t t = 0; t < page.state.size(); ++t) {
    ASSERT_EQ(page.state[t], TexelState::kValid);
    EXPECT_NEAR(page.irradiance[t].g / kPi, 1, 0.02) << t;
    sum += page.irradiance[t].g / kPiD / static_cast<double>(page.state.size());
  }
  EXPECT_NEAR(sum, 1, 1e-3);
}

// Lamps all around are an even sky, of which each facet sees some lamps barely over its horizon: few samples meet
// these.
TEST_P(Facets, LampsAllAroundAreAnEvenSky) {
  std::vector<Vec2> line;
  for (int k = 0; k <= 12; ++k) line.emplace_back(std::sin(kPi * k / 6), std::cos(kPi * k / 6));
  SceneParts parts;
  add_facets(parts, line, false);
  parts.box("sky", parts.diffuse(Vec3(0), Vec3(1)), Vec3(-20), Vec3(20), true);
  for (std::size_t k = 1; k < parts.scene().surfaces.size(); ++k) parts.scene().surfaces[k].has_uv1 = false;
  const LightmapPage page = bake(parts.finish(), GetParam(), 24);
  for (std::size_t t = 0; t < page.state.size(); ++t) EXPECT_NEAR(page.irradiance[t].g / kPi, 1, 0.02) << t;
}

INSTANTIATE_TEST_SUITE_P(Estimators, Facets, ::testing::Values(Estimator::kReference, Estimator::kCached));

// A smooth column of 24 sides in a sun. A texel that the end of a chart halves has the mean of its half, and is shown
// as if it were its middle's: a quarter of its width away.
TEST(Facets, SmoothColumnsInASunAreLitAsCylinders) {
  constexpr int kSides = 24;
  constexpr float kRadius = 0.4f, kHeight = 3, kTexel = 0.1f, kSun_lux = 10000;
  SceneParts parts;
  std::vector<Vec3> positions, normals;
  std::vector<UVec3> triangles;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kSides;
    const Vec3 normal(std::cos(angle), 0, std::sin(angle));
    positions.push_back(kRadius * normal), positions.push_back(kRadius * normal + Vec3(0, kHeight, 0));
    normals.insert(normals.end(), 2, normal);
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % kSides);
    triangles.push_back({a, a + 1, b}), triangles.push_back({b, a + 1, b + 1});
  }
  parts.mesh("column", parts.diffuse(Vec3(0.6f)), positions, normals, triangles);
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(Vec3(-0.86f, 0, -0.5f));
  sun.intensity = Vec3(kSun_lux);
  parts.scene().lights.push_back(sun);
  const test::Baked b = test::bake(parts.finish(), kTexel, test::cached_options(0.02));
  float worst = 0;
  int far_off = 0, all = 0;
  for (std::uint32_t t = 0; t < b.scene.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 256; ++k) {
      const SurfacePoint p = point_on_side(b.scene, t, square_to_triangle(Sampler(1, t, k).next2()));
      if (p.position.y < kTexel || p.position.y > kHeight - kTexel) continue;
      const LightmapPage& page = b.radiosity.pages[static_cast<std::size_t>(b.atlas.page[t])];
      const float cosine = -glm::dot(p.normal, sun.direction);
      const auto& corner = b.atlas.uv[t];
      const Vec2 uv = corner[0] + p.barycentric.x * (corner[1] - corner[0]) + p.barycentric.y * (corner[2] - corner[0]);
      const float off = irradiance_at(page, uv).g / kSun_lux - std::max(0.0f, cosine);
      worst = std::max(worst, std::abs(off));
      far_off += std::abs(off) > 0.03f, ++all;
    }
  EXPECT_LT(worst, 0.25f * kTexel / kRadius);
  EXPECT_LT(far_off, 0.02 * all) << "more than 3 % off";
}

}  // namespace
}  // namespace oriel
