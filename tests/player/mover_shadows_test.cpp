// Shadows of movers on the scene beside rays.
#include "tests/player/lamp_rays.h"

namespace oriel {
namespace {
using namespace testing;

class MoverShadowsTest : public FrameTest {};

// Sixteen points make steps of a penumbra, four coarser ones; the mean of many looks at them is what rays say.
TEST_F(MoverShadowsTest, OfManyLooksAreAsRays) {
  const Pack pack = lamp_scene();
  Camera camera = above_floor(1.4f, 0.1f);
  camera.vertical_fov_rad = 1;
  constexpr int kShadowSide = 33, kLooks = 64;
  FrameOptions options;
  options.light_points = 4;
  std::vector<double> taken(kShadowSide), first(kShadowSide);
  for (options.look = 0; options.look < kLooks; ++options.look) {
    const Picture picture = draw(pack, camera, kShadowSide, kShadowSide, options);
    for (int x = 0; x < kShadowSide; ++x) {
      const double now = 100 - double{picture.at(x, kShadowSide / 2).g * kPi};
      taken[static_cast<std::size_t>(x)] += now / kLooks;
      if (options.look == 0) first[static_cast<std::size_t>(x)] = now;
    }
  }
  double one = 0, many = 0, open = 0;
  for (int x = 0; x < kShadowSide; ++x) {
    const double at = 1.4 + std::tan(0.5) * (2 * (x + 0.5) / kShadowSide - 1);
    const Lit lit = by_rays(pack, std::vector{pack.movers[0].rest}, {at, -2, 0.1});
    const auto i = static_cast<std::size_t>(x);
    one += (first[i] - lit.taken) * (first[i] - lit.taken), many += (taken[i] - lit.taken) * (taken[i] - lit.taken);
    open += lit.open * lit.open;
  }
  std::printf("penumbra by maps, of the light: %.2f %% by one look of 4 points, %.2f %% by %d\n",
              100 * std::sqrt(one / open), 100 * std::sqrt(many / open), kLooks);
  EXPECT_GT(one, 0.04 * 0.04 * open);
  EXPECT_LT(many, 0.02 * 0.02 * open);  // the maps have texels
}

// The same floor lit by a sun that is computed by the pixel.
TEST_F(MoverShadowsTest, AreTakenOfSharpLightToo) {
  const Pack pack = lamp_scene();
  Pack sharp = pack;
  LightmapPage& page = sharp.lightmaps[0];
  page.sharp = page.irradiance, page.sharp_at.assign(page.sharp.size(), 1);
  SharpLamp sun;
  sun.sun = true, sun.direction = {0, -1, 0}, sun.intensity = page.irradiance[0];
  sharp.sharp_light = {{sun}, {0, 1, SharpShine{0, false, 0}.code()}, {}, {}};
  Camera camera = above_floor(1.4f, 0.1f);
  camera.vertical_fov_rad = 1;
  const Picture wanted = draw(pack, camera, 33, 33), found = draw(sharp, camera, 33, 33);
  float least = 100, most = 0;
  for (std::size_t i = 0; i < wanted.rgb.size(); ++i) {
    EXPECT_NEAR(found.rgb[i], wanted.rgb[i], 1e-3f * wanted.rgb[i] + 1e-3f) << i;
    least = std::min(least, wanted.rgb[i]), most = std::max(most, wanted.rgb[i]);
  }
  EXPECT_LT(least, 0.97f * most) << "there is a shadow";
}

}  // namespace
}  // namespace oriel
