// Texels in colours: the scales, and frames drawn in them.
#include "formats/core/color.h"
#include "formats/query/camera.h"
#include "player/passes/charts.h"
#include "player/passes/survey_colors.h"
#include "tests/player/frame_fixture.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {
using namespace testing;

TEST(SurveyColors, ScalesAreLogarithmicAndClamped) {
  EXPECT_EQ(share_of(kLuxScale, 10), 0);
  EXPECT_FLOAT_EQ(share_of(kLuxScale, 10000), 1);
  EXPECT_NEAR(share_of(kLuxScale, 316.2278f), 0.5f, 1e-5f);
  for (const float odd : {0.0f, -1.0f, std::nanf(""), 1e-30f}) EXPECT_EQ(share_of(kLuxScale, odd), 0);
  EXPECT_EQ(share_of(kLuxScale, 1e30f), 1);
  float last = -1;
  for (float share = 0; share <= 1.0f; share += 1 / 64.0f) {
    const Vec3 c = heat(share);
    EXPECT_GE(glm::min(c.r, glm::min(c.g, c.b)), 0);
    EXPECT_LE(glm::max(c.r, glm::max(c.g, c.b)), 1);
    last = std::max(last, luminance(c));
  }
  EXPECT_EQ(heat(-3), heat(0));
  EXPECT_EQ(heat(7), heat(1));
}

TEST(SurveyColors, OfEachTexel) {
  const LightmapPage page = tiny_pack().lightmaps[0];
  for (const Show show : {Show::kLux, Show::kError, Show::kTexels}) {
    const std::vector<std::uint8_t> colors = survey_colors(page, show);
    ASSERT_EQ(colors.size(), 4 * page.state.size());
    EXPECT_EQ(colors[0] + colors[1] + colors[2], 0) << "no surface";
    const Vec3 valid(colors[12], colors[13], colors[14]);
    if (show == Show::kTexels) {
      EXPECT_EQ(valid.r, valid.b);
      EXPECT_GT(colors[4 + 2], colors[4]) << "filled: blue";
      EXPECT_GT(colors[8], colors[8 + 2]) << "buried: red";
      continue;
    }
    const float lux = luminance(page.irradiance[3]);
    const float value = show == Show::kLux ? lux : luminance(page.standard_error[3]) / lux;
    const Vec3 expected = heat(share_of(heat_scale(show), value)) * 255.0f;
    EXPECT_LT(glm::length(valid - expected), 1.5f);
  }
}

class SurveyFrames : public FrameTest {};

// A wall of one illuminance fills the view: its colour, whatever the exposure; no reflection over it.
TEST_F(SurveyFrames, AWallOfOneIlluminanceHasItsColour) {
  Pack pack;
  pack.materials.resize(1);
  pack.lightmaps.push_back(flat_page(Vec3(316.2278f)));
  add_quad(pack, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 0, 0);
  FrameOptions options;
  options.show = Show::kLux;
  const Picture lux = draw(pack, look_at({0, 0, 3}, {0, 0, 0}, 1), 8, 8, options);
  const Vec3 expected = linear_from_srgb(heat(0.5f));
  EXPECT_LT(glm::length(lux.at(4, 4) - expected), 0.01f);
  options.show = Show::kError;
  EXPECT_LT(
      glm::length(draw(pack, look_at({0, 0, 3}, {0, 0, 0}, 1), 8, 8, options).at(4, 4) - linear_from_srgb(heat(0))),
      0.01f);
  pack.mesh.parts[0].lightmap_page = -1;
  EXPECT_LT(glm::length(draw(pack, look_at({0, 0, 3}, {0, 0, 0}, 1), 8, 8, options).at(4, 4) - Vec3(0.1f)), 0.01f);
}

// Two triangles that share an edge are a chart, a third one apart from them another; a page of its own is another too.
TEST(Charts, AreWhatHangsTogetherOnAPage) {
  Mesh mesh;
  const auto add = [&](std::initializer_list<Vec2> uvs, std::int32_t page) {
    MeshPart part;
    part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
    part.index_count = static_cast<std::uint32_t>(uvs.size());
    part.lightmap_page = page;
    for (const Vec2& uv : uvs) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.emplace_back(uv, 0);
      mesh.lightmap_uvs.push_back(uv);
    }
    mesh.parts.push_back(part);
  };
  add({{0, 0}, {0.25f, 0}, {0, 0.25f}}, 0);
  add({{0.75f, 0.75f}, {1, 0.75f}, {0.75f, 1}}, 0);
  add({{0.25f, 0}, {0.25f, 0.25f}, {0, 0.25f}}, 0);
  add({{0, 0}, {0.25f, 0}, {0, 0.25f}}, 1);
  add({{0, 0}, {0.25f, 0}, {0, 0.25f}}, -1);
  EXPECT_EQ(charts_of(mesh), (std::vector<std::uint32_t>{0, 1, 0, 2, kNoChart}));

  Pack pack;
  pack.mesh = mesh;
  pack.lightmaps.assign(2,
                        LightmapPage{8, 8, std::vector<Vec3>(64), std::vector<Vec3>(64), std::vector<TexelState>(64)});
  const auto colors = chart_colors(pack);
  ASSERT_EQ(colors.size(), 2u);
  const auto at = [&](std::size_t page, std::size_t x, std::size_t y) {
    const std::uint8_t* c = &colors[page][4 * (8 * y + x)];
    return Vec3(c[0], c[1], c[2]) / 255.0f;
  };
  EXPECT_LT(glm::length(at(0, 0, 0) - chart_color(0)), 0.01f);
  EXPECT_EQ(at(0, 1, 1), at(0, 0, 0));
  EXPECT_LT(glm::length(at(0, 6, 6) - chart_color(1)), 0.01f);
  EXPECT_LT(glm::length(at(0, 6, 7) - chart_color(1)), 0.01f) << "touched";
  EXPECT_EQ(at(0, 4, 4), Vec3(0)) << "no chart";
  EXPECT_LT(glm::length(at(1, 1, 0) - chart_color(2)), 0.01f);
  for (std::uint32_t i = 0; i < 50; ++i)
    for (std::uint32_t j = 0; j < i; ++j)
      EXPECT_GT(glm::length(chart_color(i) - chart_color(j)), 0.02f) << i << " " << j;
}

}  // namespace
}  // namespace oriel
