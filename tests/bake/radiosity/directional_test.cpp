// The L1 moments that a directional lightmap holds, against closed forms.
#include <gtest/gtest.h>

#include <cstring>

#include "bake/radiosity/dilate.h"
#include "bake/radiosity/radiosity.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/baked.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

struct DirectionalBake {
  Scene scene;
  Radiosity radiosity;
  std::vector<TexelMapPage> texel_map;
};

DirectionalBake bake(Scene scene, float texel_m, std::uint32_t samples, bool directional = true, int threads = 0) {
  DirectionalBake b;
  b.scene = std::move(scene);
  Context context;
  context.threads = threads;
  AtlasOptions options;
  options.texel_m = texel_m;
  const Atlas atlas = *build_atlas(b.scene, options, context);
  b.texel_map = *build_texel_map(atlas, context);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  b.radiosity = *bake_radiosity({{accel, lights, {}}, atlas, b.texel_map},
                                {.samples = samples, .dilation = 2, .directional = directional}, context);
  return b;
}

// Calls visit(irradiance, direction) for every texel of a surface.
template <class Visit>
int each_texel(const DirectionalBake& b, const std::string& surface, const Visit& visit) {
  int seen = 0;
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const std::uint32_t triangle = b.texel_map[p].fragments[b.texel_map[p].first[i]].triangle;
      if (b.scene.surfaces[b.scene.triangle_surface[triangle]].name != surface) continue;
      const std::uint32_t texel = b.texel_map[p].texel[i];
      visit(b.radiosity.pages[p].irradiance[texel], b.radiosity.pages[p].direction[texel]);
      ++seen;
    }
  return seen;
}

// L from every direction above: m = L/2 and v = L/4 g, so d = g/2.
TEST(Directional, EvenSkyIsHalfTheNormal) {
  SceneParts parts;
  const Vec3 u = glm::normalize(Vec3(2, 1, 0.5f)), v = glm::normalize(glm::cross(Vec3(1, -2, 0.3f), u));
  parts.quad("plane", parts.diffuse(Vec3(0.5f)), Vec3(1, 2, 3), u, v);
  parts.scene().sky = Vec3(3, 2, 1);
  const DirectionalBake b = bake(parts.finish(), 0.2f, 1024);
  const Vec3 g = glm::normalize(glm::cross(u, v));
  double squares = 0;
  const int texels = each_texel(b, "plane", [&](const Vec3& e, const Vec3& d) {
    EXPECT_NEAR(e.g / (2 * kPi), 1, 2e-3);
    // The length of d - g/2 of independent samples has a standard deviation of 0.03.
    EXPECT_LT(glm::length(d - 0.5f * g), 4 * 0.03f);
    squares += length2(d - 0.5f * g);
    EXPECT_NEAR(directional_ratio(0.5f * g, u, g), 1, 1e-5f) << "an even sky shows no tilt";
  });
  EXPECT_LT(std::sqrt(squares / texels), 0.03);
}

// All light from one direction: d is that direction.
TEST(Directional, DistantLightIsItsDirection) {
  for (const float height : {0.05f, 0.5f, 1.0f}) {
    SceneParts parts;
    parts.quad("plane", parts.diffuse(Vec3(0)), {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
    Light sun;
    sun.type = LightType::kDirectional;
    const Vec3 towards = glm::normalize(Vec3(0.3f, height, -0.8f));
    sun.direction = -towards;
    sun.intensity = Vec3(100, 50, 20);
    parts.scene().lights.push_back(sun);
    const DirectionalBake b = bake(parts.finish(), 0.5f, 4);
    each_texel(b, "plane", [&](const Vec3& e, const Vec3& d) {
      EXPECT_NEAR(e.r, 100 * towards.y, 1e-3f);
      EXPECT_LT(glm::length(d - towards), 1e-5f);
      // A normal that the map turns by 30 degrees, towards the light or away from it: the ratio of the cosines, with
      // what of the lobe is below the surface mirrored above it.
      const Vec3 g(0, 1, 0), across = glm::normalize(towards - towards.y * g);
      for (const float side : {1.0f, -1.0f}) {
        const Vec3 n = std::cos(kPi / 6) * g + side * std::sin(kPi / 6) * across, mirrored(n.x, -n.y, n.z);
        const float truth = std::max(glm::dot(towards, n), 0.0f) + std::max(glm::dot(towards, mirrored), 0.0f);
        EXPECT_NEAR(directional_ratio(d, n, g), truth / towards.y, 1e-3f * truth / towards.y) << height;
      }
      EXPECT_EQ(directional_ratio(d, g, g), 1);
    });
  }
}

// A lamp of 1 m² half a metre over a point, seen by both kinds of samples, against quadrature over the lamp.
TEST(Directional, LampAgreesWithQuadrature) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(5)), {-0.2f, 0.5f, -0.5f}, {1, 0, 0}, {0, 0, 1});  // faces down
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const SurfacePoint point = geometry_at(scene, {0, 0, Vec2(0, 0.5f), true}, Vec3(0, -1, 0));
  DVec3 vector(0);
  double mean = 0, irradiance = 0;
  std::uint64_t rays = 0;
  constexpr std::uint32_t kSamples = 1 << 18;
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Sampler sampler(1, 0, i);
    const IrradianceSample e = sample_irradiance({accel, lights, {}}, point, sampler, rays, true);
    mean += e.mean / double{kSamples};
    vector += DVec3(e.vector) / double{kSamples};
    irradiance += e.direct.g / double{kSamples};
  }
  DVec3 v(0);
  double m = 0, e = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const DVec3 to = DVec3(-0.2 + (i + 0.5) / kSteps, 0.5, -0.5 + (k + 0.5) / kSteps) - DVec3(point.position);
      const double r = glm::length(to), light = 5 * to.y / (r * r * r) / (kSteps * kSteps);  // L dω
      m += light / (4 * kPiD);
      v += light / (4 * kPiD) * to / r;
      e += light * to.y / r;
    }
  EXPECT_NEAR(mean / m, 1, 0.002);
  EXPECT_NEAR(irradiance / e, 1, 0.002);
  EXPECT_LT(glm::length(vector - v) / m, 0.002);
}

// The cached estimator tells the same directions as unbiased paths.
TEST(Directional, CachedAgreesWithPaths) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.6f)), Vec3(-1), Vec3(1), true);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(8)), {0.4f, 0.9f, -0.3f}, {0.4f, 0, 0}, {0, 0, 0.6f});  // faces down
  const Scene scene = parts.finish();
  RadiosityOptions paths{.samples = 2048, .dilation = 0, .directional = true}, cached = paths;
  cached.estimator = Estimator::kCached;
  cached.samples = 512;
  const auto truth = test::bake(scene, 0.25f, paths), baked = test::bake(scene, 0.25f, cached);
  double squares = 0;
  int count = 0;
  truth.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
    const auto p = static_cast<std::size_t>(&page - truth.radiosity.pages.data());
    squares += length2(baked.radiosity.pages[p].direction[t] - page.direction[t]);
    ++count;
  });
  EXPECT_LT(std::sqrt(squares / count), 0.05);
}

// Half of the rays are uniform then: the irradiance stays what it is.
TEST(Directional, IrradianceIsTheSame) {
  SceneParts parts;
  parts.sphere("sphere", parts.diffuse(Vec3(0.8f), Vec3(1)), Vec3(0), 1, 2, true);
  const DirectionalBake b = bake(parts.finish(), 0.1f, 64);
  double area = 0;
  for (std::uint32_t t = 0; t < b.scene.triangles.size(); ++t) area += triangle_area(b.scene, t);
  EXPECT_NEAR(b.radiosity.report.incident_lm.g / area * 0.2 / kPiD, 1, 0.005);
}

TEST(Directional, SameBytesForOneAndTwoThreads) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.6f)), Vec3(0), Vec3(1), true);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), {0.3f, 0.9f, 0.3f}, {0.4f, 0, 0}, {0, 0, 0.4f});
  const Scene scene = parts.finish();
  const DirectionalBake one = bake(scene, 0.1f, 16, true, 1), two = bake(scene, 0.1f, 16, true, 2);
  for (std::size_t p = 0; p < one.radiosity.pages.size(); ++p) {
    const auto &a = one.radiosity.pages[p].direction, &b = two.radiosity.pages[p].direction;
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
    for (const Vec3& d : a) EXPECT_TRUE(is_finite(d) && length2(d) <= 1 + 1e-5f);
  }
}

TEST(Directional, DarknessHasNoDirection) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(1), true);
  const DirectionalBake b = bake(parts.finish(), 0.2f, 4);
  each_texel(b, "room", [](const Vec3&, const Vec3& d) { EXPECT_EQ(d, Vec3(0)); });
}

TEST(Directional, DilationCarriesDirections) {
  LightmapPage page{5, 1, std::vector<Vec3>(5), std::vector<Vec3>(5), std::vector<TexelState>(5), std::vector<Vec3>(5)};
  page.irradiance[0] = Vec3(3);
  page.direction[0] = Vec3(0, 0.5f, 0.1f);
  page.state[0] = TexelState::kValid;
  dilate(2, page);
  EXPECT_EQ(page.direction[2], page.direction[0]);
  EXPECT_EQ(page.direction[3], Vec3(0));
}

}  // namespace
}  // namespace oriel
