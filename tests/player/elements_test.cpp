// Reflector elements and their radiance maps on the device: several elements, many maps, maps of few pixels, coarse
// levels.
#include "formats/core/half.h"
#include "formats/query/camera.h"
#include "player/images/map_levels.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

const Vec3 kElementGrey(10, 10, 10);

Seen grey_wall(const Vec2&, const Vec3&) {
  return {kElementGrey, 3};
}

Pack pack_of_elements(const std::vector<Vec3>& eyes, std::uint32_t size) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].metallic = 1;
  pack.materials[0].roughness = 0;
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  add_mirror(pack, eyes, size, grey_wall);
  return pack;
}

Camera camera_facing(const Vec3& eye) {
  return look_at(eye, Vec3(0), 1.2f);
}

class Elements : public FrameTest {
 protected:
  Picture draw_m(const Pack& pack, const Camera& camera, int width = 64, int height = 48) {
    FrameOptions options;
    options.show = Show::kM;
    options.count_holes = true;
    return draw(pack, camera, width, height, options);
  }
};

// Two elements side by side; the first has a map without light, which lies after the maps of the second.
TEST_F(Elements, AnEmptyMapWipesNothing) {
  Pack pack = pack_of_elements({{0, 0, -1}, {0, 0, -1}, {0, 0, -1}}, 32);
  pack.reflectors[0].elements_x = 2;
  pack.radiance_maps[0].upper.x = pack.radiance_maps[1].lower.x = pack.radiance_maps[2].upper.x = 0;
  pack.radiance_maps[1].element = 1;
  pack.radiance_maps[2].valid.assign(32 * 32, 0);
  const Picture p = draw_m(pack, camera_facing({0, 0, 1}));
  EXPECT_GT(p.stats.reflected_pixels, 1000u);
  EXPECT_EQ(p.stats.holes, 0u);
  pack.radiance_maps[0].valid.assign(32 * 32, 0);
  EXPECT_GT(draw_m(pack, camera_facing({0, 0, 1})).stats.holes, 500u) << "the counter sees an element without light";
}

TEST_F(Elements, EveryMapThatIsPlannedIsAsked) {
  Pack pack = pack_of_elements(std::vector<Vec3>(kMostMapsPerElement, Vec3(0, 0, -1)), 16);
  for (std::size_t i = 0; i + 1 < kMostMapsPerElement; ++i) pack.radiance_maps[i].valid.assign(16 * 16, 0);
  const Picture p = draw_m(pack, camera_facing({0, 0, 1}));
  EXPECT_GT(p.stats.reflected_pixels, 1000u);
  EXPECT_EQ(p.stats.holes, 0u) << "the last one sees everything";
}

// A small map beside a large one in an array, seen up to its borders, at coarse levels too.
TEST_F(Elements, SmallMapsKeepTheirLightWhenMinified) {
  for (const std::uint32_t size : {1u, 5u, 20u, 37u}) {
    Pack pack = pack_of_elements({{0, 0, -20}, {0, 0, -20}}, 128);
    pack.radiance_maps[0].valid.assign(128 * 128, 0);
    pack.radiance_maps[1] = pack_of_elements({{0, 0, -20}}, size).radiance_maps[0];
    for (const float distance : {1.0f, 2.0f, 4.0f}) {
      const Picture p = draw_m(pack, camera_facing({0, 0, distance}), 16, 16);
      const float half = 8 / (distance * std::tan(0.6f));  // the mirror's, in pixels
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
          if (std::max(std::abs(x - 7.5f), std::abs(y - 7.5f)) > half - 1) continue;
          EXPECT_NEAR(p.at(x, y).x, kElementGrey.x, 0.02f) << size << " from " << distance << " at " << x << "," << y;
        }
    }
  }
}

// A sky of black and white pixels is grey where a pixel of the frame covers many of them.
TEST_F(Elements, TheSkyIsMinified) {
  Pack pack = pack_of_elements({{0, 0, -1}}, 256);
  RadianceMap& map = pack.radiance_maps[0];
  for (std::uint32_t i = 0; i < 256 * 256; ++i) {
    map.radiance[i] = Vec3((i % 256 / 2 + i / 512) % 2 == 0 ? 20.0f : 0.0f);
    map.disparity[i] = 0;
    map.valid[i] = 2;
  }
  const Picture p = draw_m(pack, camera_facing({0.03f, 0.02f, 1}), 32, 24);
  for (int y = 8; y < 16; ++y)
    for (int x = 12; x < 20; ++x) EXPECT_NEAR(p.at(x, y).x, 10, 0.5f) << x << "," << y;
}

// At every level, a filter that is centred on what is seen reads no black.
TEST(LightLevels, HaveLightBesideWhatIsSeen) {
  constexpr int kSize = 64;
  RadianceMap map;
  map.width = map.height = kSize;
  map.radiance.assign(kSize * kSize, kElementGrey);
  map.disparity.assign(kSize * kSize, 0.5f);
  map.valid.assign(kSize * kSize, 0);
  const auto is_seen = [](int x, int y) {
    return (x - 21) * (x - 21) + (y - 30) * (y - 30) < 50 || (x == 50 && y == 9);
  };
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) map.valid[static_cast<std::size_t>(y * kSize + x)] = is_seen(x, y);
  const LightLevels levels = make_light_levels(map);
  for (int level = 0; level < static_cast<int>(levels.rgb9e5.size()); ++level) {
    const int size = kSize >> level;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        if (!is_seen(x, y)) continue;
        for (int v = std::max((y >> level) - 1, 0); v <= std::min((y >> level) + 1, size - 1); ++v)
          for (int u = std::max((x >> level) - 1, 0); u <= std::min((x >> level) + 1, size - 1); ++u) {
            const auto at = static_cast<std::size_t>(v * size + u);
            const float light = rgb_from_rgb9e5(levels.rgb9e5[static_cast<std::size_t>(level)][at]).x * levels.scale;
            ASSERT_NEAR(light, kElementGrey.x, 0.05f) << "level " << level << " at " << u << "," << v;
          }
      }
  }
}

}  // namespace
}  // namespace oriel
