// Textures at a point, and their means over what a pixel shows of them.
#include "bake/scene/texture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bake/scene/shade.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

TEST(Texture, NearestBilinearAndWraps) {
  Scene s;
  s.images.push_back({"", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255}});
  TextureSlot slot{0};
  const auto r = [&](float u) { return sample_texture(s, slot, Vec2(u, 0.5f), false).r; };
  EXPECT_FLOAT_EQ(r(0.25f), 0);  // texel centres
  EXPECT_FLOAT_EQ(r(0.75f), 1);
  EXPECT_FLOAT_EQ(r(0.5f), 0.5f);
  EXPECT_FLOAT_EQ(r(0.0f), 0.5f);  // repeats: between the last and the first
  EXPECT_FLOAT_EQ(r(-3.25f), 1);
  EXPECT_FLOAT_EQ(r(7.25f), 0);
  slot.wrap_s = Wrap::kClamp;
  EXPECT_FLOAT_EQ(r(0), 0);
  EXPECT_FLOAT_EQ(r(-9), 0);
  EXPECT_FLOAT_EQ(r(9), 1);
  slot.wrap_s = Wrap::kMirror;
  EXPECT_FLOAT_EQ(r(1.25f), 1);
  EXPECT_FLOAT_EQ(r(1.75f), 0);
  EXPECT_FLOAT_EQ(r(-0.25f), 0);
  EXPECT_FLOAT_EQ(r(0), 0);
  slot.nearest = true;
  EXPECT_FLOAT_EQ(r(0.49f), 0);
  EXPECT_FLOAT_EQ(r(0.51f), 1);
  for (const float far : {1e9f, -1e9f, 1e30f, -1e-30f}) {
    EXPECT_GE(r(far), 0) << far;
    EXPECT_LE(r(far), 1) << far;
  }
  EXPECT_NEAR(sample_texture(s, slot, Vec2(0.75f, 0.5f), true).g, 1, 1e-6);
}

// A scene of one image, grey(x, y) of its texels, with its levels; colour: a material reads it as such.
Scene with_image(std::uint32_t width, std::uint32_t height,
                 const std::function<int(std::uint32_t, std::uint32_t)>& grey, bool colour = false, int threads = 1) {
  Scene s;
  Image image{"", width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      std::fill_n(&image.texels[std::size_t{4} * (y * width + x)], 3, static_cast<std::uint8_t>(grey(x, y)));
  s.images.push_back(std::move(image));
  SceneMaterial material;
  (colour ? material.base_color_texture : material.normal_texture).image = 0;
  s.materials.push_back(material);
  Context context;
  context.threads = threads;
  EXPECT_TRUE(make_mips(s, context));
  return s;
}

constexpr TextureSlot kFirst{0};

TEST(Mips, AreHalvesDownToATexelForAnyNumberOfThreads) {
  const auto noise = [](std::uint32_t x, std::uint32_t y) { return static_cast<int>((x * 97 + y * 57) % 256); };
  const Scene one = with_image(37, 5, noise), two = with_image(37, 5, noise, false, 2);
  ASSERT_EQ(one.images[0].mips.size(), 5u);
  const UVec2 sizes[] = {{18, 2}, {9, 1}, {4, 1}, {2, 1}, {1, 1}};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(UVec2(one.images[0].mips[i].width, one.images[0].mips[i].height), sizes[i]);
    EXPECT_EQ(one.images[0].mips[i].texels, two.images[0].mips[i].texels);
  }
  EXPECT_TRUE(with_image(1, 1, noise).images[0].mips.empty());
}

// Of light, where the image is a colour: the mean of black and white is 188 in sRGB.
TEST(Mips, OfAFineCheckerboardAreItsMean) {
  const auto checker = [](std::uint32_t x, std::uint32_t y) { return (x + y) % 2 ? 255 : 0; };
  for (const bool colour : {false, true}) {
    const Scene s = with_image(64, 64, checker, colour);
    for (const float radius : {2.0f / 64, 0.1f, 0.5f, 30.0f, 1e9f})
      for (const Vec2& at : {Vec2(0.5f), Vec2(0.123f, 0.77f), Vec2(-3.2f, 1e4f)})
        EXPECT_NEAR(sample_texture(s, kFirst, at, colour, {Vec2(radius, 0), Vec2(0, radius)}).g, 0.5, 0.005) << radius;
  }
}

// White leaves with nothing between them, which is stored as black: the mean has no black in it.
TEST(Mips, OfCutOutsHaveTheColourOfWhatIsThere) {
  Scene s = with_image(
      16, 16, [](auto x, auto) { return x % 2 ? 255 : 0; }, true);
  s.materials[0].alpha_mode = AlphaMode::kMask;
  for (std::size_t i = 0; i < s.images[0].texels.size(); i += 4) s.images[0].texels[i + 3] = s.images[0].texels[i];
  Context context;
  ASSERT_TRUE(make_mips(s, context));
  const Vec4 mean = sample_texture(s, kFirst, Vec2(0.4f), true, {Vec2(0.2f, 0), Vec2(0, 0.2f)});
  EXPECT_NEAR(mean.g, 1, 1e-6);
  EXPECT_NEAR(mean.a, 0.5, 0.01);
}

TEST(Mips, OfOneColourAreThatColour) {
  for (const UVec2& size : {UVec2(1, 1), UVec2(1, 7), UVec2(37, 5), UVec2(256, 3)}) {
    const Scene s = with_image(size.x, size.y, [](auto, auto) { return 100; });
    for (const float shorter : {0.0f, 1e-30f, 1e-3f, 1.0f, 1e30f})
      for (const float longer : {0.0f, 1e-3f, 7.0f, 1e30f})
        EXPECT_NEAR(sample_texture(s, kFirst, Vec2(0.3f, 0.7f), false, {Vec2(shorter, 0), Vec2(0, longer)}).r,
                    100.0f / 255, 1e-5)
            << shorter << " " << longer;
  }
}

TEST(Mips, OfAPointAreTheTexture) {
  const auto steps = [](std::uint32_t x, std::uint32_t y) { return static_cast<int>(x * 13 + y * 7) % 256; };
  const Scene s = with_image(16, 16, steps);
  TextureSlot nearest = kFirst;
  nearest.nearest = true;
  for (float u = -1; u < 2; u += 0.037f) {
    const Vec2 at(u, 0.4f * u);
    const Vec2 little(0.4f / 16, 0);  // less than a texel in all
    EXPECT_EQ(sample_texture(s, kFirst, at, false, {little, Vec2(0)}), sample_texture(s, kFirst, at, false));
    EXPECT_EQ(sample_texture(s, nearest, at, false, {Vec2(1, 0), Vec2(0, 1)}), sample_texture(s, nearest, at, false));
  }
}

// Stripes of eight texels, looked at along them: one wide level would be grey all over.
TEST(Mips, KeepWhatIsSharpAcrossALongEllipse) {
  const Scene s = with_image(256, 256, [](auto, std::uint32_t y) { return y / 8 % 2 ? 255 : 0; });
  for (const float stripe : {10.0f, 11.0f})
    EXPECT_NEAR(
        sample_texture(s, kFirst, Vec2(0.5f, (8 * stripe + 4) / 256), false, {Vec2(0, 1.0f / 256), Vec2(8.0f / 256, 0)})
            .g,
        static_cast<int>(stripe) % 2, 1e-6);
  EXPECT_NEAR(sample_texture(s, kFirst, Vec2(0.5f), false, {Vec2(0, 32.0f / 256), Vec2(32.0f / 256, 0)}).g, 0.5, 0.01);
}

// A quad of 4 m by 2 m whose coordinates go once over it.
Scene quad() {
  test::SceneParts parts;
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  return parts.finish();
}

// Radii in metres: steps of the barycentric weights along the triangle's sides.
Vec3 metres(const Scene& s, std::uint32_t triangle, const Vec2& step) {
  const UVec3& t = s.triangles[triangle];
  return step.x * (s.positions[t.y] - s.positions[t.x]) + step.y * (s.positions[t.z] - s.positions[t.x]);
}

TEST(Footprint, IsTheConesSectionWithTheTriangle) {
  const Scene s = quad();
  for (std::uint32_t t = 0; t < 2; ++t) {
    const Footprint straight = cone_footprint(s, t, Vec3(0, 0, -1), 0.2f);
    EXPECT_NEAR(glm::length(metres(s, t, straight.shorter)), 0.1, 1e-6);
    EXPECT_NEAR(glm::length(metres(s, t, straight.longer)), 0.1, 1e-6);
    EXPECT_NEAR(glm::dot(metres(s, t, straight.shorter), metres(s, t, straight.longer)), 0, 1e-7);
    const Footprint slanted = cone_footprint(s, t, glm::normalize(Vec3(std::sqrt(3.0f), 0, -1)), 0.2f);
    EXPECT_NEAR(glm::length(metres(s, t, slanted.shorter) - Vec3(0, 0.1f, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::length(metres(s, t, slanted.longer) - Vec3(0.2f, 0, 0)), 0, 1e-6) << "at 60°";
  }
}

TEST(Footprint, IsFiniteAtTheExtremes) {
  Scene s = quad();
  for (const Vec3& grazing : {Vec3(1, 0, 0), Vec3(0, 1, 0), glm::normalize(Vec3(1, 1, -1e-20f))}) {
    const Footprint f = cone_footprint(s, 0, grazing, 1e-3f);
    EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(f.longer), Vec2(1)))) << "a bound of its own";
  }
  EXPECT_TRUE(cone_footprint(s, 0, Vec3(0, 0, -1), 0).is_point());
  EXPECT_TRUE(cone_footprint(s, 0, Vec3(0, 0, -1), -1).is_point());
  EXPECT_TRUE(cone_footprint(s, 0, Vec3(0, 0, -1), std::nanf("")).is_point());
  s.positions.assign(s.positions.size(), Vec3(1, 2, 3));
  EXPECT_TRUE(cone_footprint(s, 0, Vec3(0, 0, -1), 1).is_point()) << "a triangle without area";
}

// A checkerboard on a wall, by a cone as wide as many of its fields and by a point.
TEST(Footprint, ShadesWithTheMeanOfWhatItShows) {
  test::SceneParts parts;
  SceneMaterial checked;
  checked.base_color_texture.image = 0;
  parts.quad("wall", parts.add(checked), {0, 0, 0}, {4, 0, 0}, {0, 2, 0});
  Scene s = parts.finish();
  const auto fields = [](std::uint32_t x, std::uint32_t y) { return (x / 2 + y / 2) % 2 ? 255 : 0; };
  s.images = with_image(64, 64, fields, true).images;
  const Vec2 middle(0.30f, 0.35f);
  const Footprint wide = cone_footprint(s, 0, Vec3(0, 0, -1), 0.5f);
  EXPECT_NEAR(shade_point(s, 0, middle, wide).base_color.g, 0.5, 0.03);
  double most = 0;
  for (float at = 0.2f; at < 0.4f; at += 0.003f)
    most = std::max(most, std::abs(double{shade_point(s, 0, Vec2(at, 0.3f)).base_color.g} - 0.5));
  EXPECT_GT(most, 0.4) << "the point alone is black or white: the test shows something";
}

}  // namespace
}  // namespace oriel
