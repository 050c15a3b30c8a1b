// The forms that baked light is shown in: textures, bilinear or bicubic, and vertex colours.
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {

using namespace testing;
using LightmapForms = FrameTest;

constexpr std::uint32_t kFormTexels = 16;
constexpr float kShown = 0.5f / kPi;                                // of a lux, cd/m²
const Camera kCamera{"c", {0, 0, 2}, {0, 0, -1}, {0, 1, 0}, 0, 1};  // all of the wall, and nothing else
const FrameOptions kBicubic{.lightmap_filter = LightmapFilter::kBicubic};

// Of 2 m, its lower left corner at (-1, -1).
Pack lit_wall(const std::function<float(std::uint32_t x, std::uint32_t y)>& lux) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = Vec3(0.5f);
  add_quad(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0, 0);
  pack.lightmaps = {page_of(kFormTexels, [&](auto x, auto y) { return Vec3(lux(x, y)); })};
  return pack;
}

TEST_F(LightmapForms, AConstantIsTheSameInAll) {
  Pack pack = lit_wall([](auto, auto) { return 512.0f; });
  const Picture texture = draw(pack, kCamera, 32, 32), bicubic = draw(pack, kCamera, 32, 32, kBicubic);
  for (std::size_t i = 0; i < texture.rgb.size(); ++i) {
    EXPECT_NEAR(texture.rgb[i], 512 * kShown, 1e-4f * 512);
    EXPECT_NEAR(bicubic.rgb[i], texture.rgb[i], 1e-5f * 512);
  }
}

float spline(float t) {
  t = std::fabs(t);
  return t < 1 ? 2.0f / 3 - t * t + 0.5f * t * t * t : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0;
}

// One lit texel: 4/9 of it at its centre, 1/9 at those beside it, 1/36 across; and the spline between.
TEST_F(LightmapForms, BicubicIsABSpline) {
  const Pack pack = lit_wall([](auto x, auto y) { return x == 8 && y == 8 ? 3600.0f : 0.0f; });
  const Picture centres = draw(pack, kCamera, 16, 16, kBicubic);
  EXPECT_NEAR(centres.at(8, 7).r, 1600 * kShown, 0.2f);
  EXPECT_NEAR(centres.at(9, 7).r, 400 * kShown, 0.1f);
  EXPECT_NEAR(centres.at(7, 6).r, 100 * kShown, 0.1f);
  EXPECT_NEAR(centres.at(10, 7).r, 0, 0.1f);
  const Picture between = draw(pack, kCamera, 48, 48, kBicubic);
  for (int y = 12; y < 36; ++y)
    for (int x = 12; x < 36; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / 3 - 0.5f, v = (static_cast<float>(47 - y) + 0.5f) / 3 - 0.5f;
      EXPECT_NEAR(between.at(x, y).r, 3600 * spline(u - 8) * spline(v - 8) * kShown, 0.2f) << x << " " << y;
    }
}

// Two charts beside each other, one lit. Neither of them reads the other by the spline.
TEST_F(LightmapForms, BicubicKeepsToItsChart) {
  Pack pack = lit_wall([](auto x, auto) { return x < 8 ? 10.0f : 9000.0f; });
  pack.mesh = {};
  add_quad(pack, {-1, -1, 0}, {1, 0, 0}, {0, 2, 0}, 0, 0);
  add_quad(pack, {0, -1, 0}, {1, 0, 0}, {0, 2, 0}, 0, 0);
  for (std::size_t i = 0; i < 8; ++i)  // a texel that both touch lies between
    pack.mesh.lightmap_uvs[i].x = (i < 4 ? 0.0f : 0.53125f) + 0.46875f * pack.mesh.lightmap_uvs[i].x;
  const Picture bicubic = draw(pack, kCamera, 64, 64, kBicubic);
  for (int x = 0; x < 64; ++x) {
    const float lux = x < 32 ? 10.0f : 9000.0f;
    EXPECT_NEAR(bicubic.at(x, 32).r, lux * kShown, 1e-4f * lux) << x;
  }
}

// As without it where cells have light of their own.
TEST_F(LightmapForms, FinerCellsStayWhatTheyAre) {
  Pack pack = lit_wall([](auto x, auto y) { return static_cast<float>(100 * ((x + y) % 3)); });
  LightmapPage& page = pack.lightmaps[0];
  page.cell.assign(kFormTexels * kFormTexels, 0);
  page.detail_width = page.detail_height = 3;
  page.detail.assign(9, Vec3(70));
  for (std::uint32_t y = 0; y + 1 < kFormTexels; ++y)
    for (std::uint32_t x = 0; x + 1 < kFormTexels; ++x) page.cell[y * kFormTexels + x] = DetailBlock{0, 0, 1}.code();
  EXPECT_EQ(draw(pack, kCamera, 64, 64).rgb, draw(pack, kCamera, 64, 64, kBicubic).rgb);
  page.cell.assign(kFormTexels * kFormTexels, 0);
  EXPECT_NE(draw(pack, kCamera, 64, 64).rgb, draw(pack, kCamera, 64, 64, kBicubic).rgb) << "no cell";
}

}  // namespace
}  // namespace oriel
