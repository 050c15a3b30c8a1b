// Sharp light against closed forms.
#include "formats/query/sharp_light.h"

#include <gtest/gtest.h>

#include "formats/core/half.h"

namespace oriel {
namespace {

constexpr Vec3 kUp(0, 1, 0);

SharpLamp bulb_above() {
  SharpLamp lamp;
  lamp.position = {0, 4, 0};
  lamp.intensity = {160, 80, 16};
  return lamp;
}

SharpLamp sun_above(float radius_rad) {
  SharpLamp lamp;
  lamp.sun = true;
  lamp.direction = -kUp;
  lamp.intensity = Vec3(1000);
  lamp.angular_radius_rad = radius_rad;
  return lamp;
}

// A page of one texel, whose record is that.
struct Lit {
  SharpLight light;
  LightmapPage page;

  Lit(const SharpLamp& lamp, std::vector<std::uint32_t> record) {
    light.lamps = {lamp};
    light.words = {0};
    light.words.insert(light.words.end(), record.begin(), record.end());
    page.width = page.height = 1;
    page.sharp_at = {1};
  }
  Vec3 at(const Vec3& p, const Vec2& uv = Vec2(0.5f), std::span<const Vec3> factors = {}) const {
    return sharp_irradiance(light, page, {uv, p, kUp}, factors);
  }
};

// A lamp behind a horizontal rectangle of two triangles 2 m above the floor, which share a diagonal.
Lit behind_rectangle(const SharpLamp& lamp, const Vec2& lower, const Vec2& upper) {
  const std::uint32_t first = 1, second = 2, third = 4;  // edges
  Lit lit(lamp, {1, SharpShine{0, false, 2}.code(), (first | second) << kSharpEdgeShift | 0,
                 (second | third) << kSharpEdgeShift | 1});
  const Vec3 a(lower.x, 2, lower.y), b(upper.x, 2, lower.y), c(upper.x, 2, upper.y), d(lower.x, 2, upper.y);
  lit.light.triangles = {{a, b, c}, {a, c, d}};
  return lit;
}

TEST(SharpLight, OfAPointEndsWhereItsShadowBegins) {
  const Lit lit = behind_rectangle(bulb_above(), Vec2(-0.5f), Vec2(0.5f));  // its shadow is twice as large
  for (float x = -1.505f; x < 1.5f; x += 0.01f)
    for (const float z : {-1.002f, -0.999f, -0.5f, 0.0f, x, 0.999f, 1.002f}) {
      const float r2 = 16 + x * x + z * z;
      const bool shaded = std::max(std::abs(x), std::abs(z)) < 1;
      const Vec3 expected = shaded ? Vec3(0) : bulb_above().intensity * (4 / (r2 * std::sqrt(r2)));
      EXPECT_LT(max_component(glm::abs(lit.at({x, 0, z}) - expected)), 1e-4f) << x << ", " << z;
    }
  EXPECT_EQ(lit.at({0, 3, 0}), Vec3(160, 80, 16));  // above it
  EXPECT_EQ(lit.at({0, 5, 0}), Vec3(0));            // the lamp is below
}

TEST(SharpLight, OfASunFadesAsItsDiskIsCovered) {
  const float radius = 0.05f, half_width = 2 * std::tan(radius);
  const Lit lit = behind_rectangle(sun_above(radius), Vec2(-50, -50), Vec2(0, 50));
  for (float s = -1.5f; s <= 1.5f; s += 0.05f) {
    const float t = std::clamp(s, -1.0f, 1.0f);
    const float visible = 0.5f + (t * std::sqrt(1 - t * t) + std::asin(t)) / kPi;
    EXPECT_NEAR(lit.at({s * half_width, 0, 3}).x, 1000 * visible, 60) << s;
  }
  EXPECT_EQ(lit.at({-1, 0, 1}), Vec3(0));
  EXPECT_FLOAT_EQ(lit.at({1, 0, 1}).x, 1000);
}

TEST(SharpLight, OfSpotsFollowsTheirCone) {
  SharpLamp spot = bulb_above();
  spot.direction = -kUp;
  spot.cos_outer = 0.8f, spot.inverse_falloff = 1 / (0.9f - 0.8f);
  const Lit lit(spot, {1, SharpShine{0, false, 0}.code()});
  EXPECT_FLOAT_EQ(lit.at(Vec3(0)).x, 10);
  const float cosine = 0.85f, x = 4 * std::sqrt(1 - cosine * cosine) / cosine;
  EXPECT_NEAR(lit.at({x, 0, 0}).x, 160 * 0.25f * cosine / (16 / (cosine * cosine)), 1e-3f);
  EXPECT_EQ(lit.at({4, 0, 0}), Vec3(0));
}

TEST(SharpLight, RecordsAreOfQuarters) {
  const std::uint32_t shines = SharpShine{0, false, 0}.code();
  // Dark but in the quarter (x + ½, y), and there in the quarter (x, y + ½).
  const Lit lit(sun_above(0), {kSharpSplit, 11, 6, 11, 11, kSharpSplit, 11, 11, 12, 11, 0, 1, shines});
  for (const float x : {0.1f, 0.3f, 0.6f, 0.9f})
    for (const float y : {0.1f, 0.3f, 0.6f, 0.9f})
      EXPECT_EQ(lit.at(Vec3(0), {x, y}), Vec3(x == 0.6f && y == 0.3f ? 1000.0f : 0.0f)) << x << ", " << y;
  EXPECT_EQ(lit.at(Vec3(0), {1, 1}), Vec3(0));
}

TEST(SharpLight, IsTintedAndFollowsItsGroup) {
  SharpLamp sun = sun_above(0);
  sun.light_group = 1;
  const Lit lit(sun, {1, SharpShine{0, true, 0}.code(), rgb9e5_from_rgb({0.5f, 0.25f, 1})});
  EXPECT_EQ(lit.at(Vec3(0)), Vec3(500, 250, 1000));
  const std::vector<Vec3> factors = {Vec3(7), Vec3(2, 1, 0)};
  EXPECT_EQ(lit.at(Vec3(0), Vec2(0.5f), factors), Vec3(1000, 250, 0));
}

}  // namespace
}  // namespace oriel
