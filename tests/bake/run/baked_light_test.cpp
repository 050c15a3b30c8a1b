// What surfaces show of the baked light.
#include "bake/run/baked_light.h"

#include <gtest/gtest.h>

#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

// A room whose walls send out 3.5 cd/m² wherever one looks: 3 of their own, and half of π lux.
struct EvenRoom : test::MirrorRoom {
  Atlas atlas;
  std::vector<LightmapPage> pages{1};

  explicit EvenRoom(float roughness) : MirrorRoom(1, roughness) {
    for (std::size_t m = 1; m < scene.materials.size(); ++m) {
      scene.materials[m].specular = 0;
      scene.materials[m].emission = Vec3(3);
    }
    atlas.page.assign(scene.triangles.size(), 0);
    atlas.uv.assign(scene.triangles.size(), {});
    pages[0].width = pages[0].height = 1;
    pages[0].irradiance.assign(1, Vec3(kPi));
  }
};

// So a reflector sends out its reflectance times that, whatever its lobe and the direction.
TEST(BakedLight, LobesShowTheirReflectanceInAnEvenRoom) {
  for (const float roughness : {0.15f, 0.35f, 0.7f}) {
    const EvenRoom room(roughness);
    const auto accel = Accel::build(room.scene);
    ASSERT_TRUE(accel);
    const LightSet lights(room.scene);
    const BakedScene baked{*accel, lights, room.atlas, room.pages};
    for (const float cosine : {1.0f, 0.6f, 0.2f}) {
      const Vec3 towards_eye(std::sqrt(1 - cosine * cosine), 0, cosine);
      double sum = 0;
      std::uint64_t rays = 0;
      constexpr int kPoints = 64;
      for (int i = 0; i < kPoints; ++i) {
        const Vec3 on(1.2f + 0.02f * static_cast<float>(i), 1.5f, test::kMirrorInset);
        const Hit hit = accel->intersect({on + 0.1f * towards_eye, -towards_eye});
        ASSERT_TRUE(hit);
        SeenSurface seen{hit, towards_eye};
        seen.glossy = true;
        sum += baked_radiance_with_lobes(baked, seen, 32, 7, rays).g;
      }
      const Vec3 r = reflectance(shade_point(room.scene, room.scene.triangles.size() - 1, Vec2(0.3f)), cosine);
      EXPECT_NEAR(sum / kPoints, 3.5 * r.g, 0.01 * 3.5) << roughness << " " << cosine;
      EXPECT_GE(rays, std::uint64_t{kPoints} * 32);
    }
  }
}

// A wall of a room as it is seen along its normal.
struct SeenWall {
  const EvenRoom& room;
  const Accel accel = *Accel::build(room.scene);
  const LightSet lights{room.scene};
  const BakedScene baked{accel, lights, room.atlas, room.pages};
  const Hit hit = accel.intersect({{2, 1.5f, 1}, {0, 0, -1}});
  SeenSurface seen{hit, Vec3(0, 0, 1)};
};

// What a reflector hardly shows of a lobe needs few paths, and below 1 % of the light none.
TEST(BakedLight, LobesHavePathsByWhatCountsOfThem) {
  const EvenRoom room(0.35f);
  SeenWall wall{room};
  const BakedScene& baked = wall.baked;
  SeenSurface& seen = wall.seen;
  ASSERT_TRUE(wall.hit);
  seen.glossy = true;
  const float wide = baked_radiance(baked, seen).g;  // even light shows 3.5 cd/m², its irradiance 1
  std::vector<double> rays;
  for (const float counts : {1.0f, 0.25f, 0.0112f, 0.011f}) {
    seen.throughput = Vec3(counts);
    std::uint64_t traced = 0;
    const float shown = baked_radiance_with_lobes(baked, seen, 4096, 7, traced).g;
    EXPECT_NEAR(shown, traced > 0 ? 3.5f * wide : wide, 0.03f * 3.5f) << counts;
    rays.push_back(static_cast<double>(traced));
  }
  EXPECT_NEAR(rays[1], rays[0] / 4, 0.02 * rays[0]);
  EXPECT_GT(rays[2], 0);
  EXPECT_EQ(rays[3], 0);
  seen.throughput = Vec3(1);
  seen.averaged = 16;
  std::uint64_t traced = 0;
  baked_radiance_with_lobes(baked, seen, 4096, 7, traced);
  EXPECT_NEAR(static_cast<double>(traced), rays[0] / 16, 0.01 * rays[0]);
}

// Planar ones that are followed add nothing of their lobe, those at the end of a chain show it as wide: R E/π.
TEST(BakedLight, PlanarMirrorsTraceNothing) {
  const EvenRoom room(0);
  SeenWall wall{room};
  const BakedScene& baked = wall.baked;
  SeenSurface& seen = wall.seen;
  ASSERT_TRUE(wall.hit);
  std::uint64_t rays = 0;
  seen.planar = true;
  EXPECT_NEAR(baked_radiance_with_lobes(baked, seen, 32, 7, rays).g, 0.9f, 0.01f);
  seen.mirror = true;
  EXPECT_EQ(baked_radiance_with_lobes(baked, seen, 32, 7, rays), Vec3(0));
  EXPECT_EQ(rays, 0u);
}

// What is no planar reflector: traced where it reflects more by its lobe than diffusely, as wide where less.
TEST(BakedLight, SurfacesThatMostlyShineShowTheirLobe) {
  for (const bool shines : {true, false}) {
    EvenRoom room(0.9f);
    room.scene.materials[0].metallic = 0;
    room.scene.materials[0].base_color = Vec3(shines ? 0.01f : 0.5f);
    const auto accel = Accel::build(room.scene);
    ASSERT_TRUE(accel);
    const LightSet lights(room.scene);
    const BakedScene baked{*accel, lights, room.atlas, room.pages};
    const Hit hit = accel->intersect({{2, 1.5f, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    const ShadePoint point = shade_point(room.scene, room.scene.triangles.size() - 1, Vec2(0.3f));
    const float r = reflectance(point, 1).g, diffuse = point.diffuse.g * (1 - r);
    std::uint64_t rays = 0;
    const float shown = baked_radiance_with_lobes(baked, SeenSurface{hit, Vec3(0, 0, 1)}, 100000, 7, rays).g;
    EXPECT_NEAR(shown, shines ? diffuse + 3.5f * r : diffuse + r, shines ? 0.05f * 3.5f * r : 1e-4f) << shines;
    EXPECT_EQ(rays > 0, shines);
  }
}

}  // namespace
}  // namespace oriel
