// Paths over normal-mapped surfaces.
#include <gtest/gtest.h>

#include "bake/trace/path.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

const Vec3 kTilt = glm::normalize(Vec3(1, 0, 1));

// A quad in the plane z = 0 facing +z, x along u, tilted by 45 degrees towards +x.
Scene tilted_quad(bool double_sided) {
  SceneParts parts;
  const auto material = parts.diffuse(Vec3(0.5f));
  parts.normal_map(material, 1, [](float, float) { return kTilt; });
  parts.scene().materials[material].double_sided = double_sided;
  parts.quad("quad", material, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  return parts.finish();
}

TEST(NormalMappedPath, TiltsTheShadingNormalOnTheViewersSide) {
  const Scene scene = tilted_quad(true);
  const Hit front{0, 0, Vec2(0.3f), true}, back{0, 0, Vec2(0.3f), false};
  const SurfacePoint a = surface_at(scene, front, {0, 0, -1}), b = surface_at(scene, back, {0, 0, 1});
  EXPECT_LT(glm::length(a.normal - kTilt), 0.01f);
  EXPECT_LT(glm::length(b.normal + a.normal), 1e-6f);
  EXPECT_EQ(geometry_at(scene, front, {0, 0, -1}).normal, Vec3(0, 0, 1)) << "what a texel is baked with";
  // Seen from where the tilted normal turns away: bent until it grazes.
  for (const float x : {0.8f, 1.0f, 1.5f, 100.0f}) {
    const Vec3 direction = glm::normalize(Vec3(x, 0, -0.5f));
    const SurfacePoint s = surface_at(scene, front, direction);
    EXPECT_NEAR(glm::length(s.normal), 1, 1e-5f);
    EXPECT_LT(glm::dot(s.normal, direction), 0) << x;
  }
}

// A closed room under one radiance is a furnace whatever its normals are: the lobes lose nothing.
TEST(NormalMappedPath, BumpyFurnace) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f), Vec3(1));
  parts.normal_map(wall, 16,
                   [](float u, float v) { return Vec3(1.2f * std::sin(13 * u + 5 * v), 0.9f * std::cos(11 * v), 1); });
  parts.quad("x0", wall, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  parts.quad("x1", wall, {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  parts.quad("y0", wall, {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
  parts.quad("y1", wall, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  parts.quad("z0", wall, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.quad("z1", wall, {0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const SurfacePoint texel = geometry_at(scene, {0, 0, Vec2(0.2f, 0.3f), true}, -geometric_normal(scene, 0));
  const SurfacePoint tilted = surface_at(scene, {0, 0, Vec2(0.2f, 0.3f), true}, -geometric_normal(scene, 0));
  ASSERT_LT(glm::dot(tilted.normal, tilted.geometric_normal), 0.95f);
  for (const SurfacePoint& surface : {texel, tilted}) {
    double sum = 0;
    std::uint64_t rays = 0;
    constexpr std::uint32_t kSamples = 16384;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      Sampler sampler(1, 0, i);
      const IrradianceSample e = sample_irradiance({accel, lights, {}}, surface, sampler, rays);
      sum += (e.direct.g + e.indirect.g) / kSamples;
    }
    EXPECT_NEAR(sum / (2 * kPiD), 1, 0.01);
  }
}

// A lamp below a floor whose map tilts as far as it goes: nothing comes through.
TEST(NormalMappedPath, NoLightFromBelow) {
  SceneParts parts;
  const auto floor = parts.diffuse(Vec3(0.5f));
  parts.normal_map(floor, 1, [](float, float) { return Vec3(1, 0, 0.01f); });
  parts.quad("floor", floor, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {6, -1, -5}, {0, 0, 10}, {0, 0.9f, 0});  // beside, below
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  std::uint64_t rays = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    Sampler sampler(1, 0, i);
    const Vec3 wo = glm::normalize(Vec3(std::sin(i * 1.0f), 0.5f, std::cos(i * 1.0f)));
    const SurfacePoint s = surface_at(scene, {0, 0, Vec2(0.4f), true}, -wo);
    EXPECT_EQ(reflected_light({accel, lights, {}}, s, wo, sampler, rays), Vec3(0));
    const IrradianceSample e = sample_irradiance({accel, lights, {}}, s, sampler, rays, true);
    EXPECT_EQ(e.direct + e.indirect, Vec3(0));
    EXPECT_EQ(e.mean, 0);
  }
}

}  // namespace
}  // namespace oriel
