// Several samples a pixel: edges are means, everything else stays as it is.
#include "formats/core/color.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

constexpr int kEdgeSize = 64;
constexpr float kLamp = 100, kWall = 0.5f;  // cd/m²

// A lamp, turned by 20°, before a wall that fills the view.
Pack lamp_before_wall() {
  Pack pack;
  pack.materials.resize(2);
  pack.materials[0].emission = Vec3(kWall);
  pack.materials[1].emission = Vec3(kLamp);
  for (Material& m : pack.materials) m.base_color = Vec3(0);
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, -1);
  const Vec3 right(0.94f, 0.34f, 0), up(-0.34f, 0.94f, 0);
  add_quad(pack, Vec3(0, 0, 0.1f) - 0.35f * (right + up), 0.7f * right, 0.7f * up, 1, -1);
  return pack;
}

Camera facing_camera() {
  Camera camera;
  camera.eye = {0, 0, 2};
  return camera;
}

struct Counts {
  int wall = 0, lamp = 0, between = 0;
  float sum = 0;
};
Counts count(const Picture& p) {
  Counts counts;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const float light = p.at(x, y).g;
      counts.sum += light;
      ++(light < 1.001f * kWall ? counts.wall : light > 0.999f * kLamp ? counts.lamp : counts.between);
    }
  return counts;
}

FrameOptions sampled(int samples) {
  FrameOptions options;
  options.samples = samples;
  return options;
}

// A device without several samples a pixel draws as with one.
class Antialias : public FrameTest {
 protected:
  int edge(int pixels) const { return device_.samples < 4 ? -1 : pixels; }
};

TEST_F(Antialias, EdgesAreMeans) {
  const Counts plain = count(draw(lamp_before_wall(), facing_camera(), kEdgeSize, kEdgeSize, sampled(1)));
  const Counts smooth = count(draw(lamp_before_wall(), facing_camera(), kEdgeSize, kEdgeSize, sampled(4)));
  EXPECT_EQ(plain.between, 0);
  EXPECT_GT(plain.lamp, 100);
  EXPECT_GT(smooth.between, edge(40));  // about a pixel for each one that the outline crosses
  EXPECT_GT(smooth.lamp, 100);
  EXPECT_NEAR(smooth.sum / plain.sum, 1, 0.03);
}

TEST_F(Antialias, ALampsEdgeIsShownBetweenWallAndWhite) {
  // 100 cd/m² where 1 is white: were light averaged before the tone curve, every pixel of the edge would be white.
  (void)draw(lamp_before_wall(), facing_camera(), kEdgeSize, kEdgeSize, sampled(4));
  const auto shown = renderer_->read_display(exposure_of_white(1), ToneCurve::kNone);
  ASSERT_TRUE(shown) << shown.error().text();
  const auto wall = static_cast<int>(std::lround(255 * srgb_from_linear(kWall)));
  int between = 0;
  for (std::size_t i = 1; i < shown->size(); i += 3) between += (*shown)[i] > wall + 8 && (*shown)[i] < 247;
  EXPECT_GT(between, edge(40));
}

// A floor of strips that run away from the eye, all in one lit chart of a dark page: wherever a pixel is cut by a
// strip's edge, its light is the chart's.
TEST_F(Antialias, LightIsReadInsideOfCharts) {
  constexpr std::uint32_t kPage = 256, kFirst = 224, kEnd = 232;  // texels of the chart, both ways
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = Vec3(0.5f), pack.materials[0].metallic = 0;
  LightmapPage page = flat_page(Vec3(0));
  page.width = page.height = kPage;
  page.irradiance.assign(kPage * kPage, Vec3(0)), page.standard_error.assign(kPage * kPage, Vec3(0));
  page.state.assign(kPage * kPage, TexelState::kValid);
  for (std::uint32_t y = kFirst; y < kEnd; ++y)
    for (std::uint32_t x = kFirst; x < kEnd; ++x) page.irradiance[y * kPage + x] = Vec3(kPi);
  pack.lightmaps = {page};
  constexpr int kStrips = 50;
  for (int i = 0; i < kStrips; ++i)
    add_quad(pack, {-2.0f + 4.0f * static_cast<float>(i) / kStrips, 0, 3}, {4.0f / kStrips, 0, 0}, {0, 0, -8}, 0, 0);
  for (Vec2& uv : pack.mesh.lightmap_uvs)  // half a texel within the chart
    uv = (static_cast<float>(kFirst) + 0.5f + uv * static_cast<float>(kEnd - kFirst - 1)) / static_cast<float>(kPage);
  Camera camera;
  camera.eye = {0, 0.1f, 2};
  const Picture plain = draw(pack, camera, kEdgeSize, kEdgeSize, sampled(1));
  const Picture smooth = draw(pack, camera, kEdgeSize, kEdgeSize, sampled(4));
  int floor = 0;
  for (int y = 0; y < kEdgeSize; ++y)
    for (int x = 0; x < kEdgeSize; ++x) {
      if (plain.at(x, y).g < 0.49f || y + 1 == kEdgeSize) continue;
      floor += 1;
      if (y == 0 || plain.at(x, y - 1).g < 0.49f || plain.at(x, y + 1).g < 0.49f) continue;  // the horizon
      EXPECT_NEAR(smooth.at(x, y).g, 0.5f, 0.002f) << x << ' ' << y;
    }
  EXPECT_GT(floor, 500);
}

TEST_F(Antialias, NoMoreSamplesThanTheDeviceHas) {
  const Picture most = draw(lamp_before_wall(), facing_camera(), kEdgeSize, kEdgeSize, sampled(64));
  EXPECT_GT(count(most).between, edge(40));
}

TEST_F(Antialias, APictureInTheFramesPlaceIsShownAsItIs) {
  (void)draw(lamp_before_wall(), facing_camera(), 8, 8, sampled(4));
  FloatImage picture;
  picture.width = picture.height = 8;
  picture.channels = 4;
  for (int i = 0; i < 64; ++i) picture.pixels.insert(picture.pixels.end(), {0.25f, 0.5f, 0.75f, 2.0f});
  ASSERT_TRUE(renderer_->take_light(picture));
  const auto shown = renderer_->read_display(exposure_of_white(1), ToneCurve::kNone);
  ASSERT_TRUE(shown) << shown.error().text();
  for (std::size_t i = 0; i < shown->size(); ++i)
    EXPECT_NEAR((*shown)[i], 255 * srgb_from_linear(0.25f * static_cast<float>(i % 3 + 1)), 1.01);
}

}  // namespace
}  // namespace oriel
