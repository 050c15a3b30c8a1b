// What people see of a lightmap, and that effort goes there.
#include "bake/radiosity/texels/frame_error.h"

#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

// Two closed rooms of 2 m side by side, alike, each with its own lamp; nothing is seen from one of the other.
Scene two_rooms() {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.6f)), lamp = parts.diffuse(Vec3(0), Vec3(10, 8, 6));
  for (const float x : {0.0f, 3.0f}) {
    parts.box("room", white, {x, 0, 0}, {x + 2, 2, 2}, true);
    parts.quad("lamp", lamp, {x + 0.7f, 1.99f, 0.7f}, {0.5f, 0, 0}, {0, 0, 0.5f});
  }
  return parts.finish();
}

struct Traced {
  Baked b;
  Accel accel;
  LightSet lights;
  Context context;

  explicit Traced(Scene scene, float texel_m = 0.2f)
      : b(test::bake(std::move(scene), texel_m, {.samples = 1})), accel(*Accel::build(b.scene)), lights(b.scene) {}
  Transport transport() const { return {accel, lights, {}}; }
  std::vector<FramePixel> pixels(const std::vector<Vec3>& eyes, std::uint32_t directions_per_view) {
    return *find_frame_pixels(transport(), b.atlas, {eyes, directions_per_view}, 1, context);
  }
};

TEST(FramePixels, AreWhatAnEyeSees) {
  Traced t(two_rooms());
  const std::vector<Vec3> eyes = {{1, 1, 1}};
  const std::vector<FramePixel> pixels = t.pixels(eyes, 16384);
  EXPECT_GT(pixels.size(), 15000u) << "all but the lamp";
  double floor = 0;
  for (const FramePixel& p : pixels) {
    const Vec3 at = point_on(t.b.scene, p.triangle, p.barycentric);
    EXPECT_LT(at.x, 2.001f) << "the other room is not seen";
    EXPECT_NEAR(p.transfer.g, 0.6f / kPi, 0.02f);
    EXPECT_NEAR(p.share[0] + p.share[1] + p.share[2] + p.share[3], 1, 1e-5);
    floor += at.y < 1e-3f;
  }
  EXPECT_NEAR(floor / 16384, 1.0 / 6, 0.005) << "a cube's face from its middle";
}

// Interpolating texel centres' own places gives a point's place back: shares and texels are those of bilinear
// filtering.
TEST(FramePixels, ReadTheTexelsAroundTheirPoint) {
  Traced t(two_rooms());
  for (const FramePixel& p : t.pixels({{1, 1, 1}}, 1024)) {
    const AtlasPage& page = t.b.atlas.pages[p.page];
    const auto& uv = t.b.atlas.uv[p.triangle];
    const Vec2 size(page.width, page.height);
    const Vec2 point = (uv[0] + p.barycentric.x * (uv[1] - uv[0]) + p.barycentric.y * (uv[2] - uv[0])) * size;
    const Vec2 at = glm::clamp(point, Vec2(0.5f), size - 0.5f);  // beyond the last centres light is that of these
    Vec2 read(0);
    for (std::size_t k = 0; k < 4; ++k)
      read += p.share[k] * (Vec2(p.texel[k] % page.width, p.texel[k] / page.width) + 0.5f);
    EXPECT_LT(glm::length(read - at), 1e-2f);
  }
}

// A pane lets see what is behind it, in its colour; a mirror shows what is before it, once.
TEST(FramePixels, GoThroughPanesAndByOneMirror) {
  SceneParts parts;
  SceneMaterial pane, mirror;
  pane.metallic = 0, pane.transmission = 1, pane.base_color = Vec3(0.5f, 1, 1), pane.roughness = 0;
  mirror.metallic = 1, mirror.roughness = 0, mirror.base_color = Vec3(0.8f);
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
  parts.quad("pane", parts.add(pane), {-5, -5, 1}, {10, 0, 0}, {0, 10, 0});
  parts.quad("mirror", parts.add(mirror), {5, -5, 3}, {-10, 0, 0}, {0, 10, 0});
  parts.scene().sky = Vec3(1);
  Traced t(parts.finish(), 0.5f);
  double by_pane = 0, by_mirror = 0, all = 0;
  for (const FramePixel& p : t.pixels({{0, 0, 2}}, 4096)) {
    ++all;
    if (p.transfer.g < 0.1f) continue;  // the little that a pane reflects diffusely is none
    const float tint = p.transfer.r / p.transfer.g;
    by_pane += tint > 0.4f && p.transfer.g > 0.9f * 0.5f / kPi;
    by_mirror += p.transfer.g < 0.85f * 0.5f / kPi;
    EXPECT_NEAR(point_on(t.b.scene, p.triangle, p.barycentric).z, 0, 1e-3);
  }
  EXPECT_GT(by_pane, 0.4 * all);
  EXPECT_GT(by_mirror, 0.2 * all);
}

TEST(EyesInTheOpen, AreEvenlySpreadOverTheAir) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.6f));
  parts.box("room", white, Vec3(0), {4, 2, 2}, true);
  parts.box("plinth", white, {1, 0, 0.5f}, {2, 1, 1.5f});
  parts.box("slit", white, {2.001f, 0, 0.5f}, {3, 1, 1.5f});
  Traced t(parts.finish());
  const std::vector<Vec3> eyes = sample_view_positions(t.transport(), 4096, 3);
  ASSERT_EQ(eyes.size(), 4096u);
  double low = 0, slit = 0;
  for (const Vec3& e : eyes) {
    EXPECT_TRUE(e.x > 0 && e.x < 4 && e.y > 0 && e.y < 2 && e.z > 0 && e.z < 2);
    low += e.y < 1;
    slit += e.x > 1.999f && e.x < 2.002f && e.y < 1 && e.z > 0.5f && e.z < 1.5f;
  }
  EXPECT_NEAR(low / 4096, 6.0 / 14, 0.03) << "the bodies' insides are no air";
  EXPECT_LT(slit / 4096, 0.002) << "gaps count by their volume";
}

// One texel in four pixels, one in none.
TEST(FrameError, IsWhatThePixelsShow) {
  TexelMapPage map{2, 1, {0, 1}, {}, {}};
  std::vector<FramePixel> pixels(4);
  for (FramePixel& p : pixels) p.transfer = Vec3(0.5f / kPi), p.share = {1, 0, 0, 0};
  const FrameError error(pixels, std::span(&map, 1), {true, true});
  EXPECT_FLOAT_EQ(error.importance()[0], 1);
  EXPECT_FLOAT_EQ(error.importance()[1], 0);
  const std::vector<float> squares = error.squares(std::vector{Vec3(10), Vec3(1)}, std::vector{Vec3(4), Vec3(100)});
  EXPECT_NEAR(squares[0], 4 / (100 + 4 + 0.01 * 100), 1e-6) << "light, what is not known of it, and the floor";
  EXPECT_EQ(squares[1], 0);
}

// Half of the frame is a hundred times darker: it is held against a tenth of the mean.
TEST(FrameError, HasAFloorOfATenthOfWhatTheEyeSees) {
  TexelMapPage map{2, 1, {0, 1}, {}, {}};
  std::vector<FramePixel> pixels(2);
  for (std::uint32_t i = 0; i < 2; ++i)
    pixels[i].transfer = Vec3(1), pixels[i].texel[0] = i, pixels[i].share = {1, 0, 0, 0};
  const FrameError error(pixels, std::span(&map, 1), {true, true});
  const std::vector<float> squares = error.squares(std::vector{Vec3(100), Vec3(1)}, std::vector{Vec3(1), Vec3(1)});
  EXPECT_NEAR(squares[1] * 2, 1 / (1 + 1 + std::pow(0.1 * 50.5, 2)), 1e-4);
  // What is not lit by itself takes its light from what is.
  const FrameError one(pixels, std::span(&map, 1), {true, false});
  EXPECT_FLOAT_EQ(one.importance()[0], 1);
}

TEST(FrameError, HoldsWhatIsBlackBesideTheRestAgainstThat) {
  TexelMapPage map{2, 1, {0, 1}, {}, {}};
  std::vector<FramePixel> pixels(2);
  for (std::uint32_t i = 0; i < 2; ++i) {
    pixels[i].view = i, pixels[i].transfer = Vec3(1);
    pixels[i].texel[0] = i, pixels[i].share = {1, 0, 0, 0};
  }
  const FrameError error(pixels, std::span(&map, 1), {true, true});
  const std::vector<float> squares =
      error.squares(std::vector{Vec3(100), Vec3(1e-4f)}, std::vector{Vec3(1), Vec3(1e-8f)});
  EXPECT_NEAR(squares[0] * 2, 1 / (1e4 + 1 + 100), 1e-7);
  EXPECT_NEAR(squares[1] * 2, 1e-8 / std::pow(1e-3 * 50, 2), 1e-8) << "it would be a half beside its own eye's mean";
}

// Of two rooms alike the one that nobody sees gets a few rays a texel, the other is as good as was asked.
TEST(Effort, GoesWherePeopleLook) {
  const auto bake_for = [](std::vector<Vec3> eyes) {
    RadiosityOptions o{.estimator = Estimator::kCached, .samples = 4096, .error = 0.006};
    o.eyes = std::move(eyes);
    return test::bake(two_rooms(), 0.1f, o);
  };
  std::vector<Vec3> here, both;
  for (int i = 0; i < 64; ++i) {
    const Vec3 eye(0.3f + 0.2f * static_cast<float>(i % 8), 1.2f, 0.3f + 0.2f * static_cast<float>(i / 8));
    here.push_back(eye), both.push_back(eye), both.push_back(eye + Vec3(3, 0, 0));
  }
  const Baked one = bake_for(here), two = bake_for(both);
  EXPECT_LE(one.radiosity.report.relative_error, 0.0066);
  EXPECT_LE(two.radiosity.report.relative_error, 0.0066);
  // Points, patches and first rays of both rooms are a fixed part.
  EXPECT_LT(static_cast<double>(one.radiosity.report.rays), 0.9 * static_cast<double>(two.radiosity.report.rays));
  double error[2] = {0, 0}, count[2] = {0, 0};
  one.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t triangle) {
    const int room = one.scene.positions[one.scene.triangles[triangle].x].x > 2.5f;
    if (page.irradiance[t].g > 0)  // a few rays find nothing between lamp and ceiling
      error[room] += page.standard_error[t].g / page.irradiance[t].g, ++count[room];
  });
  EXPECT_GT(error[1] / count[1], 3 * error[0] / count[0]);
  EXPECT_LT(error[1] / count[1], 0.5) << "what nobody sees is light all the same";
}

}  // namespace
}  // namespace oriel
