// The preview's light against the path-traced reference and closed forms.
#include <gtest/gtest.h>

#include "bake/reference/reference.h"
#include "formats/image/relative_error.h"
#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "preview/frame/blend_paths.h"
#include "preview/frame/preview_renderer.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/preview/sunlit_room.h"

namespace oriel {
namespace {

constexpr int kLitWidth = 64, kLitHeight = 48;

// A room with a lamp, a box and a ball.
Scene room(const Vec3& wall = Vec3(0.6f), bool furnished = true) {
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(wall), red = parts.diffuse({0.7f, 0.2f, 0.1f});
  parts.box("room", grey, {-2, 0, -2}, {2, 2.5f, 2}, true);
  if (furnished) {
    parts.box("box", red, {-1.2f, 0, -1}, {-0.4f, 0.9f, -0.2f});
    parts.sphere("ball", grey, {0.7f, 0.4f, -0.5f}, 0.4f, 3);
  }
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {-0.4f, 2.45f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f});
  return parts.finish();
}

const Camera kCamera = look_at({0.3f, 1.4f, 1.8f}, {0, 0.8f, -1}, 1.1f);

class PreviewLight : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gpu::HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().text();
    gl_ = std::move(*context);
    renderer_ = *PreviewRenderer::create(*gpu::open_device());
  }

  void take(Scene scene) {
    scene_ = *prepare_preview_scene({std::move(scene), {}}, context_);
    ASSERT_TRUE(renderer_.take(scene_));
  }

  FloatImage draw(const PreviewOptions& options, std::uint32_t passes, const Camera& camera = kCamera) {
    EXPECT_TRUE(renderer_.look(camera, kLitWidth, kLitHeight));
    for (std::uint32_t i = 0; i < passes; ++i) EXPECT_TRUE(renderer_.pass(options, context_));
    return renderer_.read_mean();
  }

  ReferenceFrame reference(std::uint32_t samples, std::uint64_t seed = 7, const Camera& camera = kCamera) {
    Context context;
    context.seed = seed;
    return *render_reference(scene_->transport(), camera,
                             {.width = kLitWidth, .height = kLitHeight, .samples = samples, .antialias = false},
                             context);
  }

  std::unique_ptr<gpu::HeadlessContext> gl_;
  PreviewRenderer renderer_;
  std::shared_ptr<const PreviewScene> scene_;
  Context context_;
};

constexpr PreviewOptions kDirectOnly{.bounce = false, .emission = false, .traced = false, .antialias = false};

double mean_pixel(const FloatImage& image) {
  double sum = 0;
  for (const float v : image.pixels) sum += v;
  return sum / static_cast<double>(image.pixels.size());
}

// How far apart two pictures are, relative.
double apart(const FloatImage& a, const FloatImage& b) {
  return relative_error(a, b)->rel_rmse;
}

TEST_F(PreviewLight, DirectLightIsThatOfTheReference) {
  take(room());
  const ReferenceFrame truth = reference(256);
  const FloatImage direct = draw(kDirectOnly, 64);
  EXPECT_NEAR(mean_pixel(direct), mean_pixel(truth.direct), 0.004 * mean_pixel(truth.direct));
  EXPECT_LT(relative_error(direct, truth.direct, truth.diffuse_noise)->net(), 0.03);
  take(room(Vec3(0.6f), false));  // the check sees that something is wrong
  EXPECT_GT(apart(draw(kDirectOnly, 64), truth.direct), 0.1);
}

// A point light over a floor: E = I cos / d².
TEST_F(PreviewLight, PointSpotAndSunAreTheirClosedForms) {
  test::SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  Scene scene = parts.finish();
  Light light;
  light.intensity = Vec3(100, 50, 25);
  light.position = {0, 2, 0};
  light.direction = {0, -1, 0};
  const auto centre = [&](const Light& of) {
    Scene lit = scene;
    lit.lights = {of};
    take(lit);
    const FloatImage image = draw(kDirectOnly, 4, look_at({0, 3, 0.001f}, {0, 0, 0}, 0.02f));
    const std::size_t i = std::size_t{3} * (kLitHeight / 2 * kLitWidth + kLitWidth / 2);
    return Vec3(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
  };
  const Vec3 point = 0.5f / kPi * light.intensity / 4.0f;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(centre(light)[c], point[c], 1e-3f * point[c]);
  light.type = LightType::kSpot;
  light.inner_cone_rad = 0.1f, light.outer_cone_rad = 0.5f;
  EXPECT_NEAR(centre(light).r, point.r, 1e-3f * point.r);
  light.direction = glm::normalize(Vec3(1, -1, 0));  // 45° beside: beyond the cone
  EXPECT_EQ(centre(light).r, 0);
  light.type = LightType::kDirectional;
  EXPECT_NEAR(centre(light).r, 0.5f / kPi * 100 * std::sqrt(0.5f), 0.01f);
}

// Skies reach a floor under them with π L.
TEST_F(PreviewLight, AnEvenSkyIsItsClosedForm) {
  test::SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  Scene scene = parts.finish();
  scene.sky = Vec3(3);
  take(std::move(scene));
  EXPECT_NEAR(mean_pixel(draw(kDirectOnly, 64, look_at({0, 2, 0.001f}, {0, 0, 0}, 0.5f))), 1.5, 0.02);
}

// Near disks are not surfaces. More of them come nearer, up to some hundred.
TEST_F(PreviewLight, ReflectedLightComesNearerWithMoreElements) {
  PreviewOptions options = kDirectOnly;
  options.direct = false;
  options.bounce = true;
  take(room());
  options.elements = 0;
  EXPECT_EQ(mean_pixel(draw(options, 1)), 0);
  const FloatImage truth = reference(64).indirect;
  std::vector<double> errors;
  for (const std::uint32_t elements : {4u, 32u, 256u, 512u}) {
    options.elements = elements;
    errors.push_back(apart(draw(options, 64), truth));
    std::printf("%u elements: relative RMSE of the indirect light %.3f\n", elements, errors.back());
  }
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_LT(errors[2], 0.9 * errors[1]);
  EXPECT_NEAR(errors[3], errors[2], 0.1 * errors[2]);
}

constexpr PreviewOptions kBouncesOnly{
    .direct = false, .bounce = true, .emission = false, .traced = false, .antialias = false};

// After any number of bounces, in dark rooms and in white ones: as bright as paths.
TEST_F(PreviewLight, ElementsHaveAllBounces) {
  for (const float wall : {0.3f, 0.85f}) {
    take(room(Vec3(wall)));
    const FloatImage truth = reference(128).indirect, shown = draw(kBouncesOnly, 64);
    std::printf("walls of %.2f: mean of 512 elements %+.3f, relative RMSE %.3f\n", double{wall},
                mean_pixel(shown) / mean_pixel(truth) - 1, apart(shown, truth));
    EXPECT_NEAR(mean_pixel(shown) / mean_pixel(truth), 1, 0.05);
  }
}

TEST_F(PreviewLight, ElementsShineIntoTheirRoomAlone) {
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.6f));
  parts.box("bright", grey, {-2, 0, -2}, {2, 2.5f, 2}, true);
  parts.box("dark", grey, {2.1f, 0, -2}, {6.1f, 2.5f, 2}, true);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {-0.4f, 2.45f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f});
  take(parts.finish());
  const Camera inside = look_at({4, 1.4f, 1.8f}, {4, 0.8f, -1}, 1.1f);
  EXPECT_EQ(mean_pixel(draw(kBouncesOnly, 8, inside)), 0);
  const PreviewOptions shared{.emission = false, .traced = false, .shared = true};
  EXPECT_EQ(mean_pixel(draw(shared, 1, inside)), 0);
  EXPECT_GT(mean_pixel(draw(shared, 1)), 0);
}

// Of the sun's light nearly all lands outside. What comes in by the window is found all the same, with any seed.
TEST_F(PreviewLight, ARoomInTheSunIsLitWithAnySeed) {
  take(test::sunlit_room(Vec3(0.6f)));
  const Camera inside = look_at({1.5f, 1.4f, 1.5f}, {-1, 0.8f, -1}, 1.1f);
  const double truth = mean_pixel(reference(512, 7, inside).indirect);
  std::printf("a room in the sun, six seeds: reflected light over that of paths");
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    context_.seed = seed;
    const double ratio = mean_pixel(draw(kBouncesOnly, 16, inside)) / truth;
    std::printf(" %.3f", ratio);
    EXPECT_NEAR(ratio, 1, 0.2) << seed;
  }
  std::printf("\n");
}

TEST_F(PreviewLight, PathsAreTheReferenceToTheBit) {
  take(room());
  PathFrame paths(2);
  const ReferenceOptions frame{.width = kLitWidth, .height = kLitHeight, .samples = 32, .antialias = false};
  paths.hold(true);
  paths.start({scene_, kCamera, frame, 7});
  EXPECT_FALSE(paths.wait(0.05));
  for (int i = 0; i < 20; ++i) {  // rests change nothing
    paths.hold(i % 2 == 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(paths.wait(60));
  const auto mean = paths.newer(0);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->samples, 32u);
  const ReferenceFrame truth = reference(32);
  for (std::size_t i = 0; i < truth.total.pixels.size(); ++i)
    EXPECT_NEAR(mean->mean.pixels[i], truth.total.pixels[i], 1e-4f * truth.total.pixels[i] + 1e-6f) << i;
  EXPECT_NEAR(mean->relative_noise, truth.relative_noise, 1e-3 * truth.relative_noise);
}

// Other random numbers: both means lie within both noises of each other.
TEST_F(PreviewLight, TheConvergedPreviewIsTheReferenceWithinBothNoises) {
  take(room());
  const FloatImage passes = draw({.antialias = false}, 4);
  PathFrame paths(2);
  paths.start({scene_, kCamera, {.width = kLitWidth, .height = kLitHeight, .samples = 128, .antialias = false}, 11});
  ASSERT_TRUE(paths.wait(120));
  const PathMean mean = *paths.newer(0);
  const FloatImage blended = *blend_paths(mean, passes, context_);
  const auto frame = renderer_.frame(&blended);
  ASSERT_TRUE(frame) << frame.error().text();
  std::vector<float> shown(std::size_t{3} * kLitWidth * kLitHeight);
  (*frame)->framebuffer.bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, kLitWidth, kLitHeight, GL_RGB, GL_FLOAT, shown.data());
  const ReferenceFrame truth = reference(128);
  double z2 = 0, count = 0;
  for (std::size_t y = 0; y < kLitHeight; ++y)
    for (std::size_t x = 0; x < 3 * kLitWidth; ++x) {
      const std::size_t i = y * 3 * kLitWidth + x;
      const double noise2 =
          double{mean.noise.pixels[i]} * mean.noise.pixels[i] + double{truth.noise.pixels[i]} * truth.noise.pixels[i];
      const double off = double{shown[(kLitHeight - 1 - y) * 3 * kLitWidth + x]} - truth.total.pixels[i];
      if (noise2 > 0) z2 += off * off / noise2, ++count;
    }
  std::printf("mean z² of the converged preview: %.3f over %.0f values\n", z2 / count, count);
  EXPECT_LT(z2 / count, 1.1);  // below 1: stratified samples err less than their own scatter tells
  EXPECT_GT(z2 / count, 0.1);  // and the noise is no empty claim
  EXPECT_GT(apart(passes, truth.total), 2 * truth.relative_noise);  // passes alone are not
}

// What is known of the passes' error decides: few noisy paths spoil nothing, and more of them are never worse.
TEST_F(PreviewLight, MorePathsAreNeverWorse) {
  for (const float wall : {0.0f, 0.6f}) {  // with black walls all light is direct: passes are right
    take(room(Vec3(wall)));
    const FloatImage passes = draw({.antialias = false}, 16);
    const FloatImage truth = reference(512).total;
    double last = apart(passes, truth);
    std::printf("walls of %.1f: relative RMSE of passes %.4f; blended, and paths alone:", double{wall}, last);
    for (const std::uint32_t samples : {2u, 4u, 8u, 16u, 64u, 256u}) {
      PathFrame paths(2);
      paths.start(
          {scene_, kCamera, {.width = kLitWidth, .height = kLitHeight, .samples = samples, .antialias = false}, 3});
      ASSERT_TRUE(paths.wait(60));
      const PathMean mean = *paths.newer(0);
      const FloatImage blended = *blend_paths(mean, passes, context_);
      FloatImage shown = passes;
      for (std::size_t i = 0; i < shown.pixels.size(); ++i) shown.pixels[i] = blended.pixels[4 * (i / 3) + i % 3];
      const double error = apart(shown, truth);
      std::printf(" %u: %.4f, %.4f", samples, error, apart(mean.mean, truth));
      EXPECT_LE(error, 1.001 * last) << samples;
      EXPECT_LE(error, 1.001 * apart(mean.mean, truth)) << samples;
      last = std::min(last, error);
    }
    std::printf("\n");
  }
}

}  // namespace
}  // namespace oriel
