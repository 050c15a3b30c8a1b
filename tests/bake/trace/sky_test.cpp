// The image of a sky: its sampler, and the light that it gives.
#include <gtest/gtest.h>

#include <cstdlib>

#include "bake/import/images.h"
#include "bake/trace/path.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"
#include "formats/image/exr.h"
#include "tests/bake/support/chi2.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

// The unit direction of sky_uv's coordinates.
Vec3 sky_direction(const SkyImage& image, const Vec2& uv) {
  const float phi = (uv.x - 0.5f) * 2 * kPi - image.rotation_rad, theta = uv.y * kPi;
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

SkyImage image_of(std::uint32_t width, std::uint32_t height) {
  return {width, height, std::vector<Vec3>(std::size_t{width} * height, Vec3(0)), 0};
}

SkyImage patchy_sky() {
  SkyImage image = image_of(24, 12);
  for (std::size_t i = 0; i < image.texels.size(); ++i)
    image.texels[i] = Vec3(test::independent(3 * i), test::independent(3 * i + 1), 0.2f) * (i % 7 == 0 ? 6.0f : 1.0f);
  image.rotation_rad = 0.7f;
  return image;
}

// Radiance 1, and a sun of one texel, 1e5 times as bright, 45° high in the direction of +X.
SkyImage sunny_sky() {
  SkyImage image = image_of(512, 256);
  for (Vec3& texel : image.texels) texel = Vec3(1);
  image.texels[std::size_t{64} * 512 + 256] = Vec3(1e5f);
  return image;
}

TEST(SkyImage, DirectionsFollowTheConvention) {
  SkyImage image = image_of(64, 32);
  const auto expect = [&](const Vec3& direction, const Vec2& uv) {
    EXPECT_NEAR(glm::length(sky_uv(image, direction) - uv), 0, 1e-5);
    EXPECT_NEAR(glm::length(sky_direction(image, uv) - direction), 0, 1e-5);
  };
  expect({1, 0, 0}, {0.5f, 0.5f});
  expect({0, 0, 1}, {0.75f, 0.5f});
  expect({0, 0, -1}, {0.25f, 0.5f});
  expect(glm::normalize(Vec3(1, 1, 0)), {0.5f, 0.25f});
  image.rotation_rad = kPi / 2;
  expect({0, 0, -1}, {0.5f, 0.5f});
  // Texel centres give texels.
  Scene scene;
  scene.sky_image = patchy_sky();
  for (const auto& [x, y] : {std::pair{0u, 0u}, {5u, 3u}, {23u, 11u}}) {
    const Vec2 uv((static_cast<float>(x) + 0.5f) / 24, (static_cast<float>(y) + 0.5f) / 12);
    const Vec3 got = sky_radiance(scene, sky_direction(scene.sky_image, uv));
    EXPECT_NEAR(glm::length(got - scene.sky_image.texels[y * 24 + x]), 0, 1e-3);
  }
}

TEST(SkySampler, MatchesItsPdf) {
  const SkyImage image = patchy_sky();
  const SkySampler sampler(image);
  const auto draw = [&](float, const Vec2& v) {
    const SkySampler::Sample s = sampler.sample(v);
    EXPECT_NEAR(s.pdf, sampler.pdf(s.direction), 2e-3f * s.pdf + 1e-5f);
    EXPECT_NEAR(glm::length(s.direction), 1, 1e-5);
    return std::optional<Vec3>(s.direction);
  };
  EXPECT_LT(test::chi2_excess(
                draw, [&](const Vec3& w) { return sampler.pdf(w); }, -1),
            5);
  EXPECT_GT(test::chi2_excess(
                draw, [](const Vec3&) { return 1 / (4 * kPi); }, -1),
            20)
      << "must see a wrong pdf";
}

// By the midpoint rule within each cell; a grid of texels' multiples has cells' edges on its own.
double integral_of_pdf(const SkyImage& image) {
  const SkySampler sampler(image);
  const int columns = static_cast<int>(image.width) * 4, rows = static_cast<int>(image.height) * 4;
  double sum = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const DVec2 uv((x + 0.5) / columns, (y + 0.5) / rows);
      sum += sampler.pdf(sky_direction(image, Vec2(uv))) * std::sin(kPiD * uv.y);
    }
  return sum * 2 * kPiD * kPiD / (static_cast<double>(columns) * rows);
}

TEST(SkySampler, PdfIntegratesToOne) {
  EXPECT_NEAR(integral_of_pdf(patchy_sky()), 1, 2e-3);
  EXPECT_NEAR(integral_of_pdf(sunny_sky()), 1, 2e-3);
  SkyImage one = image_of(1, 1);
  one.texels[0] = Vec3(3);
  const SkySampler sampler(one);
  EXPECT_NEAR(sampler.pdf({0, 1, 0}) * 4 * kPi, 1, 1e-5);
  EXPECT_TRUE(SkySampler(image_of(8, 4)).empty()) << "black";
}

// Irradiance of a horizontal floor under a sky: mean and variance of one sample.
struct Estimate {
  double mean, variance;
};
struct UnderSky {
  explicit UnderSky(SkyImage image) {
    parts.quad("floor", parts.diffuse(Vec3(0)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    parts.scene().sky = sky_mean(image);
    parts.scene().sky_image = std::move(image);
  }
  test::SceneParts parts;

  // mis: as baked; else by cosine-distributed rays alone.
  Estimate irradiance(std::uint32_t samples, bool mis) {
    const Scene scene = parts.finish();
    const Accel accel = *Accel::build(scene);
    const LightSet lights(scene);
    const Transport transport{accel, lights, {}};
    const SurfacePoint p = geometry_at(scene, {0, 0, Vec2(0, 0.5f), true}, {0, -1, 0});
    double sum = 0, squares = 0;
    std::uint64_t rays = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
      Sampler sampler(1, 0, i);
      const Vec3 up = frame_from_normal(p.normal) * square_to_cosine_hemisphere(sampler.next2());
      const double e = mis ? sample_irradiance(transport, p, sampler, rays).direct.g
                           : kPi * trace_path(transport, {spawn_origin(p, up), up}, 0, sampler, rays).sky.g;
      sum += e;
      squares += e * e;
    }
    const double mean = sum / samples;
    return {mean, squares / samples - mean * mean};
  }
};

// CIE standard overcast sky (Moon & Spencer): L = Lz (1 + 2 sin γ) / 3 gives the ground 7π/9 Lz. Written to a file and
// read back.
TEST(Sky, OvercastSkyGivesTheGroundItsClosedForm) {
  testing::TemporaryFolder folder;
  FloatImage file{512, 256, 3, {}};
  for (std::uint32_t y = 0; y < file.height; ++y) {
    const double sine = std::cos(kPiD * (y + 0.5) / file.height);
    const auto value = static_cast<float>(sine > 0 ? 1000 * (1 + 2 * sine) / 3 : 0);
    file.pixels.insert(file.pixels.end(), 3 * file.width, value);
  }
  ASSERT_TRUE(write_exr(folder.path() / "overcast.exr", file));
  auto image = read_sky_image(folder.path() / "overcast.exr");
  ASSERT_TRUE(image) << image.error().text();
  UnderSky ground(std::move(*image));
  const double expected = 7 * kPiD / 9 * 1000;
  EXPECT_NEAR(ground.irradiance(16384, true).mean / expected, 1, 3e-3);
  // Stated, since file and lookup could err together: the sky's own mean, ∫ L over the upper half / 4π = Lz / 3.
  EXPECT_NEAR(ground.parts.scene().sky.g / (1000.0 / 3), 1, 3e-3);
}

TEST(Sky, ATinySunConverges) {
  UnderSky ground(sunny_sky());
  // ∫ L cosθ and ∫ L² cosθ of bilinear lookup: by the midpoint rule in the sun's 3 × 3 texels, π both outside.
  double expected = kPiD, squares = kPiD;
  constexpr int kSub = 200;
  const Scene scene = ground.parts.finish();
  for (int i = 0; i < 3 * kSub; ++i)
    for (int k = 0; k < 3 * kSub; ++k) {
      const DVec2 uv((255 + (k + 0.5) / kSub) / 512, (63 + (i + 0.5) / kSub) / 256);
      const double radiance = sky_radiance(scene, sky_direction(scene.sky_image, Vec2(uv))).g;
      const double part = std::cos(kPiD * uv.y) * std::sin(kPiD * uv.y) * 2 * kPiD * kPiD / (512.0 * 256 * kSub * kSub);
      expected += (radiance - 1) * part;
      squares += (radiance * radiance - 1) * part;
    }
  const Estimate sampled = ground.irradiance(4096, true);
  EXPECT_NEAR(sampled.mean / expected, 1, 3e-3);
  // A cosine-distributed ray has ∫ (L cosθ)² / (cosθ/π) - E².
  EXPECT_LT(1000 * sampled.variance, kPiD * squares - expected * expected);
  EXPECT_NEAR(ground.irradiance(4u << 20, false).mean / expected, 1, 0.1) << "in the end they agree";
}

// ∫ L cosθ over the upper half, by the midpoint rule with 3 × 3 points a texel.
double ground_irradiance(const Scene& scene) {
  const int columns = 3 * static_cast<int>(scene.sky_image.width), rows = 3 * static_cast<int>(scene.sky_image.height);
  double sum = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const DVec2 uv((x + 0.5) / columns, (y + 0.5) / rows);
      const Vec3 direction = sky_direction(scene.sky_image, Vec2(uv));
      sum += sky_radiance(scene, direction).g * std::max(0.0f, direction.y) * std::sin(kPiD * uv.y);
    }
  return sum * 2 * kPiD * kPiD / (static_cast<double>(columns) * rows);
}

// Photographed skies: ORIEL_TEST_ASSETS names a folder with some in env/.
TEST(Sky, PhotographsGiveTheirIntegral) {
  const char* root = std::getenv("ORIEL_TEST_ASSETS");
  if (!root || !std::filesystem::exists(std::filesystem::path(root) / "env")) GTEST_SKIP() << "no ORIEL_TEST_ASSETS";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(root) / "env")) {
    if (entry.path().extension() != ".hdr" && entry.path().extension() != ".exr") continue;
    auto image = read_sky_image(entry.path());
    ASSERT_TRUE(image) << image.error().text();
    UnderSky ground(std::move(*image));
    const double expected = ground_irradiance(ground.parts.finish());
    EXPECT_NEAR(ground.irradiance(65536, true).mean / expected, 1, 5e-3) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

// A choice among the sky and lamps stays unbiased.
TEST(Sky, SharesSamplesWithLamps) {
  UnderSky ground(sunny_sky());
  const double alone = ground.irradiance(16384, true).mean;
  Light lamp;
  lamp.position = {0, 2, 0};
  lamp.intensity = Vec3(80);
  ground.parts.scene().lights.push_back(lamp);
  EXPECT_NEAR(ground.irradiance(16384, true).mean / (alone + 20), 1, 5e-3);
}

}  // namespace
}  // namespace oriel
