// Reference frames against closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bake/reference/reference.h"
#include "tests/bake/support/glass_slab.h"

namespace oriel {
namespace {

constexpr Vec3 kAlbedo{0.5f, 0.3f, 0.7f}, kEmission{2, 1, 3};

// A closed room whose surfaces all reflect and emit alike: the light is the same in every direction.
Scene furnace() {
  test::SceneParts parts;
  parts.box("room", parts.diffuse(kAlbedo, kEmission), Vec3(-1), Vec3(1), true);
  return parts.finish();
}

// A lamp over a floor, without anything around.
Scene lamp() {
  test::SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-1, -1, 1}, {2, 0, 0}, {0, 0, -2});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), {-0.3f, 0, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f});
  return parts.finish();
}

const Camera kCamera{.name = "", .eye = {0, 0.2f, 0.9f}, .forward = {0, -0.3f, -1}};

ReferenceFrame render(const Scene& scene, const ReferenceOptions& options, int threads = 0, std::uint64_t seed = 1,
                      const Camera& camera = kCamera) {
  Context context;
  context.threads = threads;
  context.seed = seed;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  return *render_reference({accel, lights, {}}, camera, options, context);
}

void expect_color(const FloatImage& image, const Vec3& color, double tolerance, const char* what) {
  DVec3 mean(0);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    mean[static_cast<int>(i % 3)] += image.pixels[i] * 3.0 / static_cast<double>(image.pixels.size());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], color[c], tolerance * color[c] + 1e-6) << what << " " << c;
}

TEST(Reference, SplitsAFurnaceIntoItsSeries) {
  const ReferenceFrame frame = render(furnace(), {.width = 16, .height = 9, .samples = 4096});
  const Vec3 all = kEmission / (1.0f - kAlbedo), once = kAlbedo * kEmission;
  expect_color(frame.emission, kEmission, 1e-5, "emission");
  expect_color(frame.direct, once, 1e-3, "direct");
  expect_color(frame.indirect, all - kEmission - once, 0.01, "indirect");
  expect_color(frame.specular, Vec3(0), 0, "specular");
  expect_color(frame.total, all, 0.01, "total");
}

// Around the eye a ball of glass under an even sky: straight on and back, whatever the direction.
TEST(Reference, AnEyeInGlassSeesThroughIt) {
  constexpr float kAbsorption = 0.5f;
  test::SceneParts parts;
  parts.sphere("ball", parts.add(test::solid_glass(1.5f, {0, 0, kAbsorption})), {0, 0.2f, 0.9f}, 1, 4);
  parts.scene().sky = Vec3(1);
  const ReferenceFrame frame = render(parts.finish(), {.width = 16, .height = 9, .samples = 1024});
  const float r = 0.04f, once = std::exp(-kAbsorption);
  expect_color(frame.total, 2.25f * Vec3(1, 1, (1 - r) * once / (1 - r * once * once)), 0.005, "total");
}

// The share of GGX's facets that send a ray from above, through a thin pane, to more than `slope` beside its way.
double spread_beyond(double alpha, double slope) {
  constexpr int kSteps = 400;
  int beyond = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const double u = (i + 0.5) / kSteps, phi = 2 * std::numbers::pi * (k + 0.5) / kSteps;
      const double s = alpha * std::sqrt(u / (1 - u)), c = 1 / (1 + s * s);  // c: the square of the facet's cosine
      beyond += 2 * c * s * std::cos(phi) > slope * std::abs(2 * c - 1);
    }
  return static_cast<double>(beyond) / (kSteps * kSteps);
}

// An eye before a pane of roughness 0.4, a board that shines on one side of an edge 1 m behind it. Straight on, and in
// a mirror that turns the view around.
TEST(Reference, FrostedPanesSpreadWhatEyesSee) {
  constexpr float kAlpha = 0.16f;
  for (const bool mirrored : {false, true})
    for (const float edge : {-0.3f, 0.0f, 0.1f, 0.4f}) {
      SceneMaterial pane, mirror;
      pane.metallic = 0, pane.transmission = 1, pane.specular = 0, pane.roughness = 0.4f, pane.double_sided = true;
      pane.base_color = Vec3(1, 0.5f, 1);
      mirror.metallic = 1, mirror.roughness = 0, mirror.double_sided = true;
      test::SceneParts parts;
      const float side = mirrored ? 1.0f : -1.0f;  // where the pane is, along z
      parts.quad("pane", parts.add(pane), {-50, -50, side}, {100, 0, 0}, {0, 100, 0});
      if (mirrored) parts.quad("mirror", parts.add(mirror), {-50, -50, -1}, {100, 0, 0}, {0, 100, 0});
      const Vec3 right(100, 0, 0), up(0, 100, 0);
      parts.quad("board", parts.diffuse(Vec3(0), Vec3(1)), {edge, -50, 2 * side}, mirrored ? up : right,
                 mirrored ? right : up);
      Camera camera;
      camera.eye = Vec3(0, 0, mirrored ? 0.9f : 0.0f);
      camera.forward = Vec3(0, 0, -1);
      camera.vertical_fov_rad = 1e-3f;
      const ReferenceFrame frame = render(parts.finish(), {.width = 4, .height = 4, .samples = 8192}, 0, 1, camera);
      const auto share = static_cast<float>(spread_beyond(kAlpha, edge));
      expect_color(frame.total, Vec3(share, 0.5f * share, share), 0.02, mirrored ? "in a mirror" : "straight");
    }
}

// Straight on, behind a pane and in a mirror: their colour times the white of a frame whose lit part, of 2 cd/m², is
// middle grey. What is lit does not see them.
TEST(Reference, UnlitSurfacesAreAsBrightAsTheFramesWhite) {
  const Vec3 picture(0.25f, 0.5f, 1);
  SceneMaterial unlit, mirror, pane;
  unlit.unlit = true;
  unlit.base_color = picture;
  mirror.metallic = 1;
  mirror.roughness = 0;
  mirror.double_sided = pane.double_sided = true;
  pane.transmission = 1;
  pane.metallic = pane.specular = 0;
  pane.roughness = 0;
  test::SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f), Vec3(1)), Vec3(-1), Vec3(1), true);
  const auto paper = parts.add(unlit);
  parts.quad("straight on", paper, {-0.9f, -0.9f, -0.9f}, {0.4f, 0, 0}, {0, 1.8f, 0});
  parts.quad("behind a pane", paper, {-0.5f, -0.9f, -0.9f}, {0.4f, 0, 0}, {0, 1.8f, 0});
  parts.quad("pane", parts.add(pane), {-0.5f, -0.9f, -0.85f}, {0.4f, 0, 0}, {0, 1.8f, 0});
  parts.quad("behind the eye", paper, {0.95f, -0.95f, 0.95f}, {-1.9f, 0, 0}, {0, 1.9f, 0});
  parts.quad("mirror", parts.add(mirror), {-0.1f, -0.9f, -0.9f}, {0.4f, 0, 0}, {0, 1.8f, 0});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  Context context;
  const auto frame = render_reference({accel, lights, {}}, {.name = "", .eye = {0, 0, 0.7f}, .forward = {0, 0, -1}},
                                      {.width = 32, .height = 9, .samples = 256}, context);
  ASSERT_TRUE(frame);
  const auto at = [&](std::size_t x) { return &frame->total.pixels[(std::size_t{4} * 32 + x) * 3]; };
  const auto column = [](float x, float z) {  // of a point at the eye's height
    return static_cast<std::size_t>(16 + 16 * x / (0.7f - z) / (std::tan(0.5f * Camera{}.vertical_fov_rad) * 32 / 9));
  };
  for (const std::size_t x : {column(-0.7f, -0.9f), column(-0.3f, -0.9f), column(0.1f, -0.9f)})
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(x)[c], picture[c] * 2 / 0.18f, 0.02f * 2 / 0.18f) << x << " " << c;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(column(0.65f, -1))[c], 2, 0.05f) << c;
}

TEST(Reference, PartsAddUp) {
  const ReferenceFrame frame = render(lamp(), {.width = 16, .height = 9, .samples = 16});
  for (std::size_t i = 0; i < frame.total.pixels.size(); ++i)
    EXPECT_NEAR(frame.total.pixels[i],
                frame.direct.pixels[i] + frame.indirect.pixels[i] + frame.specular.pixels[i] + frame.emission.pixels[i],
                1e-5f * frame.total.pixels[i]);
}

TEST(Reference, DoesNotDependOnThreads) {
  const ReferenceOptions options{.width = 16, .height = 9, .samples = 16};
  EXPECT_EQ(render(lamp(), options, 1).total.pixels, render(lamp(), options, 2).total.pixels);
  EXPECT_NE(render(lamp(), options).total.pixels, render(lamp(), options, 0, 2).total.pixels);
}

TEST(Reference, StopsAtTheErrorAskedFor) {
  const ReferenceOptions rough{.width = 16, .height = 9, .samples = 1u << 20, .error = 0.2};
  ReferenceOptions fine = rough;
  fine.error = 0.02;
  const ReferenceFrame a = render(lamp(), rough), b = render(lamp(), fine);
  EXPECT_LE(a.relative_noise, rough.error);
  EXPECT_LE(b.relative_noise, fine.error);
  EXPECT_LT(a.samples, b.samples);
  EXPECT_EQ(b.samples & (b.samples - 1), 0u);
  ReferenceOptions as_many = fine;
  as_many.error = 0;
  as_many.samples = b.samples;
  EXPECT_EQ(render(lamp(), as_many).total.pixels, b.total.pixels) << "rounds change nothing";
}

// What it says of its noise holds the distance between two frames, whose samples are more even than chance.
TEST(Reference, TellsItsNoise) {
  const ReferenceOptions options{.width = 16, .height = 9, .samples = 64};
  const ReferenceFrame a = render(lamp(), options), b = render(lamp(), options, 0, 2);
  double distance = 0, noise = 0;
  for (std::size_t i = 0; i < a.total.pixels.size(); ++i) {
    distance += std::pow(a.total.pixels[i] - b.total.pixels[i], 2);
    noise += std::pow(a.noise.pixels[i], 2) + std::pow(b.noise.pixels[i], 2);
  }
  EXPECT_GT(distance, 0.02 * noise);
  EXPECT_LT(distance, 1.2 * noise);
}

TEST(Reference, StopsWhenAsked) {
  const Scene scene = lamp();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  Context context;
  context.stop = true;
  const auto frame = render_reference({accel, lights, {}}, {}, {}, context);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace oriel
