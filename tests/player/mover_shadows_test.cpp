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

}  // namespace
}  // namespace oriel
