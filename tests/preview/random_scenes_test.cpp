// Scenes that nobody made: the preview draws them, in every way, without a pixel that is no number.
#include <gtest/gtest.h>

#include "formats/core/file.h"
#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "preview/frame/paths.h"
#include "preview/frame/preview_renderer.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/fuzz/scenes/random_scene.h"

namespace oriel {
namespace {

struct Drawn {
  double mean = 0;
  int no_number = 0;
};

Drawn mean_of(const FloatImage& image) {
  Drawn out;
  for (const float v : image.pixels) std::isfinite(v) ? out.mean += v : ++out.no_number;
  out.mean /= static_cast<double>(image.pixels.size());
  return out;
}

// The same by paths, a few a pixel: what is lit at all.
double light_by_paths(const PreviewScene& scene, const Camera& camera) {
  const ReferenceOptions frame{.width = 48, .height = 36, .samples = 4};
  double sum = 0;
  for (std::uint32_t y = 0; y < 36; ++y)
    for (std::uint32_t x = 0; x < 48; ++x)
      for (std::uint32_t i = 0; i < 4; ++i) {
        const Vec3 light = trace_sample(scene.transport(), camera, frame, {1, x, y, i});
        sum += (light.x + light.y + light.z) / 3;
      }
  return sum / (48 * 36 * 4);
}

TEST(RandomScenes, AreDrawnInEveryWay) {
  auto gl = gpu::HeadlessContext::create();
  if (!gl) GTEST_SKIP() << gl.error().text();
  PreviewRenderer renderer = *PreviewRenderer::create(*gpu::open_device());
  test::TempFolder folder;
  Context context;
  ImportOptions sky;
  sky.sky = Vec3(100);
  int lit = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto file = folder.path() / "random.glb";
    ASSERT_TRUE(write_file_atomically(file, fuzz::random_scene(seed).glb));
    const auto loaded = load_preview_scene({.file = file, .import = sky}, context);
    ASSERT_TRUE(loaded) << "seed " << seed << ": " << loaded.error().text();
    const Scene& scene = (*loaded)->scene();
    ASSERT_TRUE(renderer.take(*loaded)) << seed;
    const Camera camera = scene.cameras.empty() ? look_at(1.2f * scene.upper, Vec3(0), 1) : scene.cameras.front();
    const double paths = light_by_paths(**loaded, camera);
    lit += paths > 0;
    for (const bool shared : {false, true}) {
      ASSERT_TRUE(renderer.look(camera, 96, 72)) << seed;
      for (int pass = 0; pass < 3; ++pass) {
        const auto stats = renderer.pass({.samples = 8, .shared = shared}, context);
        ASSERT_TRUE(stats) << "seed " << seed << ": " << stats.error().text();
      }
      const Drawn drawn = mean_of(renderer.read_mean());
      EXPECT_EQ(drawn.no_number, 0) << "seed " << seed << " shared " << shared;
      std::printf("seed %d, %s: %.3g by paths, %.3g by passes\n", static_cast<int>(seed), shared ? "shared" : "alone",
                  paths, drawn.mean);
      if (paths > 0) {
        EXPECT_GT(drawn.mean, 0.05 * paths) << "seed " << seed << " shared " << shared;
      }
    }
  }
  EXPECT_GT(lit, 3);  // the others look at what no light reaches
}

}  // namespace
}  // namespace oriel
