// Captured maps against the closed form of a room's walls.
#include "bake/radiance/capture.h"

#include <gtest/gtest.h>

#include <limits>

#include "bake/radiance/reproject.h"
#include "bake/trace/sampler.h"
#include "tests/bake/radiance/mirror_room.h"
#include "tests/bake/radiance/splat.h"

namespace oriel {
namespace {

using test::Captured;
using test::height_of;
using test::MirrorRoom;

ViewOptions small_maps(std::uint32_t resolution = 32) {
  ViewOptions options;
  options.map_resolution = resolution;
  return options;
}

class CaptureAtScale : public ::testing::TestWithParam<float> {};

// Every pixel of every map: its colour is that of the wall its ray meets, its reprojected point lies there.
TEST_P(CaptureAtScale, MapsHoldTheWallsThatTheirRaysMeet) {
  const MirrorRoom room(GetParam());
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  ViewOptions options = small_maps();
  options.element_m = 1 * room.scale;
  const Captured c = capture(*accel, room, options);
  ASSERT_EQ(c.plan.maps.size(), 64u);
  const Reflector& r = c.reflectors[0].reflector;
  const DMat4 to_pack(r.pack_from_reflector);
  double worst = 0;
  std::size_t wrong = 0, pixels = 0;
  for (const RadianceMap& map : c.plan.maps)
    for (std::uint32_t y = 0; y < map.height; ++y)
      for (std::uint32_t x = 0; x < map.width; ++x, ++pixels) {
        const std::size_t at = y * map.width + x;
        const DVec3 q(map_point(map, Vec2(x, y) + 0.5f), 0);
        std::uint32_t material = 0;
        const DVec3 expected =
            room.exit_point(DVec3(to_pack * DVec4(q, 1)), DMat3(to_pack) * (q - DVec3(map.eye)), material);
        ASSERT_EQ(map.valid[at], 1);
        const Vec4 h = unproject(map, Vec2(x, y) + 0.5f, map.disparity[at]);
        const DVec3 found(pack_from_reflector(r, Vec3(h) / h.w));
        worst = std::max(worst, glm::length(found - expected) / room.scale);
        wrong += map.radiance[at] != MirrorRoom::colour(material);
      }
  EXPECT_LT(worst, 1e-4 * 5);       // relative to the room
  EXPECT_LE(wrong, pixels / 2000);  // rays that meet an edge of the room
}
INSTANTIATE_TEST_SUITE_P(Scales, CaptureAtScale, ::testing::Values(1e-3f, 1.0f, 1e3f));

TEST(Capture, SameBytesForOneAndTwoThreads) {
  const MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const Captured a = capture(*accel, room, small_maps(), 1), b = capture(*accel, room, small_maps(), 2);
  ASSERT_EQ(a.plan.maps.size(), 16u);
  ASSERT_EQ(a.plan.maps.size(), b.plan.maps.size());
  for (std::size_t i = 0; i < a.plan.maps.size(); ++i) {
    EXPECT_EQ(a.plan.maps[i].radiance, b.plan.maps[i].radiance);
    EXPECT_EQ(a.plan.maps[i].disparity, b.plan.maps[i].disparity);
    EXPECT_EQ(a.plan.maps[i].valid, b.plan.maps[i].valid);
  }
}

TEST(Capture, StopsWhenAskedAndCountsItsRays) {
  const MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
  ViewPlan plan = plan_views(room.scene, reflectors, small_maps());
  Context context;
  std::atomic<std::uint64_t> rays{0};
  ASSERT_TRUE(
      capture_maps({ReflectedSurroundings(*accel, reflectors, {}), room.outgoing()}, {context, &rays}, plan.maps));
  EXPECT_GE(rays.load(), 16u * 32 * 24);
  EXPECT_LE(rays.load(), 16u * 32 * 24 + 10);
  context.stop = true;
  const Status stopped =
      capture_maps({ReflectedSurroundings(*accel, reflectors, {}), room.outgoing()}, context, plan.maps);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kStopped);
}

// A pane before the mirror and something behind it: what the one map of the middle view sees.
RadianceMap one_map(const std::function<void(test::SceneParts&)>& furnish, const OutgoingRadiance& outgoing,
                    const Vec3& sky = Vec3(0), bool sky_image = false) {
  test::SceneParts parts;
  parts.add(SceneMaterial{});
  parts.diffuse(Vec3(0.5f));
  parts.quad("mirror", 0, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  furnish(parts);
  Scene scene = parts.finish();
  scene.sky = sky;
  if (sky_image) scene.sky_image = {2, 1, {sky, sky}};
  scene.lower = Vec3(-10);
  scene.upper = Vec3(10);
  auto accel = Accel::build(scene);
  EXPECT_TRUE(accel);
  std::vector<ReflectorMaterial> materials(scene.materials.size(), ReflectorMaterial{1, Vec3(0), 0});
  materials[0] = {0, Vec3(0.9f), 1};
  ReflectorOptions options;
  options.min_open_share = 0;
  auto reflectors = find_reflectors(*accel, materials, options).reflectors;
  EXPECT_EQ(reflectors.size(), 1u);
  ViewOptions views = small_maps(16);
  views.views_per_element = 1;
  ViewPlan plan = plan_views(scene, reflectors, views);
  EXPECT_EQ(plan.maps.size(), 1u);
  Context context;
  context.threads = 1;  // `outgoing` may count
  EXPECT_TRUE(capture_maps({ReflectedSurroundings(*accel, reflectors, {}), outgoing}, context, plan.maps));
  return plan.maps[0];
}

Vec3 white(const SeenSurface&) {
  return Vec3(1);
}

// One of one colour stands around the scene, here 10 m from its middle, an image at infinity.
TEST(Capture, ASkyImageIsAtInfinityAndAPlainSkyAroundTheScene) {
  const Vec3 sky(3, 4, 5);
  for (const bool image : {false, true}) {
    const RadianceMap map = one_map([](test::SceneParts&) {}, white, sky, image);
    for (std::size_t i = 0; i < map.valid.size(); ++i) {
      EXPECT_EQ(map.valid[i], image ? 2 : 1);
      EXPECT_EQ(map.radiance[i], sky);
      if (image) {
        EXPECT_EQ(map.disparity[i], 0);
        continue;
      }
      const Vec3 along = Vec3(map_point(map, Vec2(i % map.width, i / map.width) + 0.5f), 0) - map.eye;
      const float edge = 10 * (1 + 1e-3f * 2 * std::sqrt(3.0f));  // outside of it by a thousandth of its diagonal
      const float z = std::min(
          {edge, edge * along.z / std::abs(along.x) + map.eye.z, edge * along.z / std::abs(along.y) + map.eye.z});
      EXPECT_NEAR(map.disparity[i], disparity_of(map, z), 1e-4f);
    }
  }
}

// What a pixel shows of the wall: as wide as neighbouring pixels' places on it are apart, whatever lies between.
TEST(Capture, SurfacesAreSeenAsWideAsPixelsAreApart) {
  constexpr float kWall = 4;
  double least = 1e9, most = 0;
  std::size_t count = 0;
  const RadianceMap map = one_map(
      [](test::SceneParts& parts) {
        parts.quad("wall", 1, {400, -400, kWall}, {-800, 0, 0}, {0, 800, 0});
      },
      [&](const SeenSurface& seen) {
        // A pixel of the plane, from the eye that is as far behind it: its image on the wall is larger by so much.
        const float cosine = std::abs(seen.towards_eye.z);
        const double width = seen.width_m / std::sqrt(cosine);  // the mean over both ways of what is slanted in one
        least = std::min(least, width), most = std::max(most, width), ++count;
        return Vec3(1);
      });
  const Vec2 pixel = glm::abs(map_point(map, Vec2(1)) - map_point(map, Vec2(0)));
  const double apart = std::sqrt(pixel.x * pixel.y) * (kWall - map.eye.z) / -map.eye.z;
  EXPECT_GT(count, 50u);
  EXPECT_NEAR(least, apart, 1e-4 * apart);
  EXPECT_NEAR(most, apart, 1e-4 * apart);
}

TEST(Capture, APixelIsOneRay) {
  std::size_t looks = 0;
  const RadianceMap map = one_map(
      [](test::SceneParts& parts) {
        SceneMaterial textured;
        textured.base_color_texture.image = 0;
        parts.quad("wall", parts.add(textured), {400, -400, 4}, {-800, 0, 0}, {0, 800, 0});
      },
      [&](const SeenSurface&) {
        ++looks;
        return Vec3(1);
      });
  EXPECT_EQ(looks, map.valid.size());
}

TEST(Capture, BacksOfOneSidedSurfacesAreSeenButNotValid) {
  const auto wall = [](const Vec3& u, const Vec3& v) {
    return [u, v](test::SceneParts& p) { p.quad("wall", 1, {-30, -30, 2}, u, v); };
  };
  const RadianceMap back = one_map(wall({60, 0, 0}, {0, 60, 0}), white),
                    front = one_map(wall({0, 60, 0}, {60, 0, 0}), white);
  for (std::size_t i = 0; i < back.valid.size(); ++i) {
    EXPECT_EQ(back.valid[i], 0);
    EXPECT_EQ(back.radiance[i], Vec3(0));
    EXPECT_EQ(front.valid[i], 1);
    EXPECT_EQ(front.radiance[i], Vec3(1));
    EXPECT_NEAR(height_of(front, front.disparity[i]), 2, 1e-5);
    EXPECT_EQ(front.disparity[i], back.disparity[i]);
  }
}

TEST(Capture, CutOutsAndGlassAreWalkedThroughAndVeilsAdd) {
  const auto pane = [](const SceneMaterial& material) {
    return [material](test::SceneParts& p) {
      const std::uint32_t m = p.add(material);
      p.quad("pane", m, {-30, -30, 1}, {0, 60, 0}, {60, 0, 0});
      p.quad("wall", 1, {-30, -30, 2}, {0, 60, 0}, {60, 0, 0});
    };
  };
  const auto coloured = [](const SeenSurface& s) { return s.hit.triangle < 4 ? Vec3(0, 0, 4) : Vec3(1, 2, 0); };
  SceneMaterial cut_out, veil, glass;
  cut_out.alpha_mode = AlphaMode::kMask;
  cut_out.alpha = 0.1f;
  veil.alpha_mode = AlphaMode::kBlend;
  veil.alpha = 0.25f;
  glass.metallic = 0;
  glass.transmission = 1;
  glass.base_color = Vec3(1, 0.5f, 1);
  glass.specular = 0;
  const RadianceMap a = one_map(pane(cut_out), coloured), b = one_map(pane(veil), coloured),
                    c = one_map(pane(glass), coloured);
  for (std::size_t i = 0; i < a.valid.size(); ++i) {
    EXPECT_EQ(a.valid[i] * b.valid[i] * c.valid[i], 1);
    EXPECT_NEAR(height_of(a, a.disparity[i]), 2, 1e-5);
    EXPECT_NEAR(height_of(b, b.disparity[i]), 2, 1e-5);
    EXPECT_NEAR(height_of(c, c.disparity[i]), 2, 1e-5);
    EXPECT_NEAR(a.radiance[i].g, 2, 1e-5);
    EXPECT_NEAR(b.radiance[i].g, 1.5f, 1e-5);
    EXPECT_NEAR(b.radiance[i].b, 1, 1e-5);  // the veil's own light by its coverage
    EXPECT_NEAR(c.radiance[i].r, 1, 1e-5);
    EXPECT_NEAR(c.radiance[i].g, 1, 1e-5);
  }
}

TEST(Capture, RadianceThatIsNoNumberBecomesBlack) {
  const auto bad = [](const SeenSurface&) {
    return Vec3(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1);
  };
  const RadianceMap map = one_map(
      [](test::SceneParts& p) {
        p.quad("wall", 1, {-30, -30, 2}, {0, 60, 0}, {60, 0, 0});
      },
      bad);
  for (const Vec3& c : map.radiance) EXPECT_EQ(c, Vec3(0));
}

TEST(Capture, TheCallbackIsAskedForLightTowardsTheEye) {
  const auto towards = [](const SeenSurface& s) {
    return Vec3(-s.towards_eye.z, std::abs(glm::length(s.towards_eye) - 1) < 1e-5f, 0);
  };
  const RadianceMap map = one_map(
      [](test::SceneParts& p) {
        p.quad("wall", 1, {-30, -30, 2}, {0, 60, 0}, {60, 0, 0});
      },
      towards);
  for (std::size_t i = 0; i < map.radiance.size(); ++i) {
    const Vec3 q(map_point(map, Vec2(i % map.width, i / map.width) + 0.5f), 0);
    EXPECT_NEAR(map.radiance[i].x, glm::normalize(q - map.eye).z, 1e-5);
    EXPECT_EQ(map.radiance[i].y, 1);
  }
}

// A second mirror on the opposite wall. Its images are those of the room mirrored in it: the unfolded point of a ray
// that meets it lies where that ray, mirrored, leaves the room, and its colour is R of the wall's there.
struct FacingMirrors : MirrorRoom {
  float z = 5 - test::kMirrorInset;  // of the second mirror

  FacingMirrors() {
    test::SceneParts parts;
    parts.scene() = scene;
    parts.quad("far mirror", 0, {1.5f, 1, z}, {0, 1, 0}, {1, 0, 0});
    scene = parts.finish();
  }
};

TEST(Orders, AMirrorInAMirrorShowsItsImageWhereItIs) {
  const FacingMirrors room;
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
  ASSERT_EQ(reflectors.size(), 2u);
  ViewOptions options = small_maps(256);
  options.views_per_element = 8;
  ViewPlan plan = plan_views(room.scene, reflectors, options);
  Context context;
  ASSERT_TRUE(capture_maps({ReflectedSurroundings(*accel, reflectors, {}), room.outgoing()}, context, plan.maps));
  std::size_t mirrored_pixels = 0, wrong = 0;
  double worst = 0;
  for (const RadianceMap& map : plan.maps) {
    const Reflector& r = reflectors[map.reflector].reflector;
    if (r.name != "mirror") continue;
    for (std::uint32_t i = 0; i < map.width * map.height; ++i) {
      const Vec2 pixel = Vec2(i % map.width, i / map.width) + 0.5f;
      const DVec3 q(pack_from_reflector(r, Vec3(map_point(map, pixel), 0)));
      const DVec3 d = glm::normalize(q - DVec3(pack_from_reflector(r, map.eye)));
      const DVec3 p = q + d * ((room.z - q.z) / d.z);
      if (p.x < 1.51 || p.x > 2.49 || p.y < 1.01 || p.y > 1.99) continue;
      ++mirrored_pixels;
      std::uint32_t material = 0;
      DVec3 expected = room.exit_point(p, DVec3(d.x, d.y, -d.z), material);
      // The first mirror hangs there: the order ends with it.
      const bool own = expected.z < 0.1 && std::abs(expected.x - 2) < 1.01 && std::abs(expected.y - 1.5) < 0.76;
      if (own) continue;
      expected.z = 2 * room.z - expected.z;
      const Vec4 h = unproject(map, pixel, map.disparity[i]);
      worst = std::max(worst, glm::length(DVec3(pack_from_reflector(r, Vec3(h) / h.w)) - expected));
      const Vec3 colour = MirrorRoom::colour(0) + 0.9f * MirrorRoom::colour(material);  // the mirror's own and R of it
      wrong += glm::length(map.radiance[i] - colour) > 0.02f * glm::length(colour);
    }
  }
  EXPECT_GT(mirrored_pixels, 200u);
  EXPECT_LT(worst, 1e-3);
  EXPECT_LE(wrong, mirrored_pixels / 100);  // rays that meet an edge of the room
}

// White mirrors that face each other, the only light a unit from every surface's own: each order adds one more.
TEST(Orders, EndAtTheOrderThatIsAskedFor) {
  test::SceneParts parts;
  SceneMaterial mirror;
  mirror.base_color = Vec3(1);
  mirror.metallic = 1;
  mirror.roughness = 0;
  parts.add(mirror);
  parts.quad("a", 0, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
  parts.quad("b", 0, {-50, -50, 1}, {0, 100, 0}, {100, 0, 0});
  const Scene scene = parts.finish();
  const auto accel = Accel::build(scene);
  ASSERT_TRUE(accel);
  ReflectorOptions found;
  found.min_open_share = 0;
  const auto reflectors = find_reflectors(*accel, std::vector{ReflectorMaterial{0, Vec3(1), 1}}, found).reflectors;
  ASSERT_EQ(reflectors.size(), 2u);
  for (const std::uint32_t orders : {1u, 2u, 5u, 16u}) {
    const ReflectedSurroundings surroundings(*accel, reflectors, {.orders = orders});
    std::uint32_t surfaces = 0, mirrors = 0;
    const Sight sight =
        surroundings.look(0, pack_from_reflector(reflectors[0].reflector, Vec3(0)),
                          Vec3(reflectors[0].reflector.pack_from_reflector[2]), [&](const SeenSurface& s) {
                            ++surfaces;
                            mirrors += s.mirror;
                            EXPECT_NEAR(s.throughput.r, 1, 1e-3);
                            return true;
                          });
    EXPECT_EQ(surfaces, orders);
    EXPECT_EQ(mirrors, orders - 1) << "the last shows its own light only";
    EXPECT_EQ(sight.state, Sight::kSurface);
    EXPECT_NEAR(glm::length(sight.offset), static_cast<float>(orders), 1e-4f * static_cast<float>(orders));
  }
}

}  // namespace
}  // namespace oriel
