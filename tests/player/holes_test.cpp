// Which pixels show a reflected image, and how many of them no map has anything for.
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

Pack pack_with_holes(std::uint32_t size = 64) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  add_mirror(pack, {{0, 0, -1}}, size, [](const Vec2&, const Vec3&) { return Seen{Vec3(10), 3}; });
  return pack;
}

class Holes : public FrameTest {
 protected:
  // The eye opposite the map's, so that image and map have the same rays.
  FrameStats count(const Pack& pack) {
    FrameOptions options;
    options.count_holes = true;
    const Camera camera{.name = "", .eye = {0, 0, 1}, .forward = {0, 0, -1}, .up = {0, 1, 0}, .vertical_fov_rad = 2.2f};
    return draw(pack, camera, 120, 90, options).stats;
  }
};

TEST_F(Holes, AreCountedOverTheMirrorsPixels) {
  const Pack whole = pack_with_holes();
  const FrameStats all = count(whole);
  const std::vector<std::int32_t> shown = renderer_->read_reflective();
  ASSERT_EQ(shown.size(), 120u * 90);
  EXPECT_EQ(shown[45 * 120 + 60], 0);
  EXPECT_EQ(shown[0], -1) << "beside the mirror";
  EXPECT_GT(all.reflected_pixels, 1000u);
  EXPECT_EQ(all.reflected_pixels, static_cast<std::uint64_t>(std::count(shown.begin(), shown.end(), 0)));
  EXPECT_EQ(all.holes, 0u);
  // Nothing is known of the map's left half.
  Pack half = pack_with_holes();
  RadianceMap& map = half.radiance_maps[0];
  for (std::uint32_t y = 0; y < map.height; ++y)
    for (std::uint32_t x = 0; x < map.width / 2; ++x) map.valid[y * map.width + x] = 0;
  const FrameStats stats = count(half);
  const double share = static_cast<double>(stats.holes) / static_cast<double>(stats.reflected_pixels);
  EXPECT_NEAR(share, 0.5, 0.03);
}

TEST_F(Holes, MirrorsAreCountedApart) {
  const FrameStats stats = count(pack_with_holes());
  EXPECT_EQ(stats.mirror_pixels, stats.reflected_pixels);
  Pack blurred = pack_with_holes();
  blurred.kernels.resize(1);
  blurred.kernels[0].size = 3;
  blurred.kernels[0].weights.assign(9, 1.0f / 9);
  blurred.kernels[0].half_extent = 0.1f;
  blurred.materials[0].kernel = 0;
  EXPECT_EQ(count(blurred).mirror_pixels, 0u) << "not a mirror";
}

}  // namespace
}  // namespace oriel
