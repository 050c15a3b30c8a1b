// Shadow volumes against rays, pixel by pixel, on scenes made of anything, and the hybrid's light against references.
#include <gtest/gtest.h>

#include <random>

#include "bake/reference/reference.h"
#include "formats/core/file.h"
#include "formats/image/relative_error.h"
#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "study/rooms.h"
#include "study/udeshi1999/ray_check.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/fuzz/scenes/random_scene.h"

namespace oriel::study {
namespace {

constexpr int kWidth = 160, kHeight = 120;

struct Random {
  std::mt19937 engine;
  float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine); }
  Vec3 inside(float reach) { return {(*this)(-reach, reach), (*this)(-reach, reach), (*this)(-reach, reach)}; }
};

// Boxes, spheres and loose triangles that cut each other, in a room or on nothing.
Scene random_scene(std::uint32_t seed) {
  Random random{std::mt19937(seed)};
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  if (seed % 3 != 0) parts.box("room", grey, Vec3(-3), Vec3(3), true);
  parts.quad("floor", grey, {-2.5f, -2, 2.5f}, {5, 0, 0}, {0, 0, -5});
  for (int i = 0; i < 4; ++i) {
    const Vec3 at = random.inside(1.5f);
    parts.box("box", grey, at, at + Vec3(random(0.1f, 0.8f), random(0.1f, 0.8f), random(0.1f, 0.8f)), i == 3);
    parts.sphere("sphere", grey, random.inside(1.8f), random(0.1f, 0.5f), 2);
  }
  for (int i = 0; i < 12; ++i) {  // no two share an edge
    const Vec3 at = random.inside(1.8f);
    parts.quad("sheet", grey, at, random.inside(0.6f), random.inside(0.6f));
  }
  return parts.finish();
}

class Udeshi1999 : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { gpu::add_shader_sources(shader_sources()); }
  void SetUp() override {
    auto context = gpu::HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().text();
    gl_ = std::move(*context);
    device_ = *gpu::open_device();
    renderer_ = *HybridRenderer::create(device_);
  }

  void take(Scene scene) {
    auto prepared = prepare_preview_scene({std::move(scene), {}}, context_);
    ASSERT_TRUE(prepared) << prepared.error().text();
    scene_ = *prepared;
    const Status taken = renderer_.take(scene_);
    ASSERT_TRUE(taken) << taken.error().text();
  }

  // forget_eye: the checker's own check, as if no volume held the eye.
  RayCheck compare(const Camera& camera, const LampPoint& light, bool forget_eye = false) {
    EXPECT_TRUE(renderer_.look(camera, kWidth, kHeight));
    return *check_by_rays(renderer_, *scene_, {&light, 1}, 0, context_, forget_eye);
  }

  std::unique_ptr<gpu::HeadlessContext> gl_;
  gpu::Device device_;
  HybridRenderer renderer_;
  std::shared_ptr<const PreviewScene> scene_;
  Context context_;
};

LampPoint lamp_at(const Vec3& place) {
  return {LampKind::kPunctual, Vec4(place, 1), {0, -1, 0}, Vec3(1), ~0u};
}

// Of a random scene: a light, near or afar, and three eyes, some of them orthographic.
struct Views {
  LampPoint light;
  std::array<Camera, 3> cameras;
};
Views random_views(std::uint32_t seed) {
  Random random{std::mt19937(1000 + seed)};
  Views views{lamp_at(random.inside(1.9f)), {}};
  if (seed % 4 == 1)
    views.light = {LampKind::kAfar, Vec4(glm::normalize(random.inside(1) + Vec3(0, 1, 0)), 0), {}, Vec3(1), ~0u};
  for (Camera& camera : views.cameras) {
    camera = look_at(random.inside(2), random.inside(0.5f), 1.2f);
    if (seed % 5 == 4) camera.vertical_fov_rad = 0, camera.half_height = 2.5f;
  }
  return views;
}

TEST_F(Udeshi1999, VolumesAreRaysButForSilhouettes) {
  RayCheck all;
  int eyes_inside = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    take(random_scene(seed));
    const auto [light, cameras] = random_views(seed);
    for (int i = 0; i < 3; ++i) {
      const Camera& camera = cameras[static_cast<std::size_t>(i)];
      const RayCheck c = compare(camera, light);
      const std::uint32_t around_eye = renderer_.volumes_around_eye(light);
      all.lit += c.lit, all.dark += c.dark, all.silhouettes += c.silhouettes;
      all.wrong += c.wrong, all.wrong_on_silhouettes += c.wrong_on_silhouettes;
      eyes_inside += around_eye > 0;
      EXPECT_LE(c.wrong, 2u) << "scene " << seed << " eye " << i << ", volumes around it: " << around_eye;
    }
  }
  std::printf(
      "lit %zu, in shadow %zu, silhouettes %zu; wrong elsewhere %zu, on silhouettes %zu; eyes in volumes %d of 60\n",
      all.lit, all.dark, all.silhouettes, all.wrong, all.wrong_on_silhouettes, eyes_inside);
  EXPECT_GT(all.lit, 50000u);
  EXPECT_GT(all.dark, 50000u);
  EXPECT_GT(eyes_inside, 10);
}

// The approximate capping: what no ray from the view plane meets is missed, and then all pixels of that shadow are
// wrong.
TEST_F(Udeshi1999, CapsBySampledRaysMissSome) {
  constexpr std::array<std::uint32_t, 4> kRays{1, 4, 16, 64};
  std::array<double, kRays.size()> wrong{}, wrong_near{}, eyes{};
  double pixels = 0;
  int orthographic = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    take(random_scene(seed));
    const auto [light, cameras] = random_views(seed);
    for (const Camera& camera : cameras) {
      ASSERT_TRUE(renderer_.look(camera, kWidth, kHeight));
      renderer_.seen(0);
      orthographic += camera.vertical_fov_rad == 0;
      const std::vector<std::uint8_t> exact = renderer_.count_volumes(light);
      pixels += static_cast<double>(exact.size());
      for (std::size_t k = 0; k < kRays.size(); ++k) {
        const std::vector<std::uint8_t> sampled = renderer_.count_volumes(light, kRays[k]);
        double off = 0;
        for (std::size_t p = 0; p < exact.size(); ++p) off += (exact[p] == 0) != (sampled[p] == 0);
        (camera.vertical_fov_rad > 0 ? wrong_near : wrong)[k] += off;
        eyes[k] += off > 0;
      }
    }
  }
  for (std::size_t k = 0; k < kRays.size(); ++k) {
    std::printf(
        "caps by %u rays: %.0f of 60 eyes are wrong; of the pixels of perspective frames %.2f %%, of all %.2f %%\n",
        kRays[k], eyes[k], 100 * wrong_near[k] / pixels * 60 / (60 - orthographic),
        100 * (wrong[k] + wrong_near[k]) / pixels);
    EXPECT_LT(wrong_near[k], 0.002 * pixels) << "the view plane is small beside what casts shadows";
  }
  EXPECT_GT(wrong.front(), 0);
  EXPECT_LT(wrong.back(), wrong.front());
}

TEST_F(Udeshi1999, AnEyeInsideThatIsForgottenIsSeen) {
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", grey, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  parts.box("cover", grey, {-1, 2, -1}, {1, 2.2f, 1});
  take(parts.finish());
  const Camera below = look_at({0.1f, 1, 0.2f}, {1, 0, -3}, 1.2f);
  const LampPoint above = lamp_at({0.01f, 4, 0.02f});
  EXPECT_LE(compare(below, above).wrong, 2u);
  EXPECT_EQ(renderer_.volumes_around_eye(above), 1u);  // a closed box counts once
  EXPECT_GT(compare(below, above, true).wrong, 1000u);
}

FloatImage picture_of(const std::vector<Vec4>& texels, int width) {
  FloatImage out{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(texels.size()) / width, 3, {}};
  for (std::size_t y = out.height; y-- > 0;)
    for (std::size_t x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) out.pixels.push_back(texels[y * out.width + x][c]);
  return out;
}

double mean_of(const FloatImage& image) {
  double sum = 0;
  for (const float v : image.pixels) sum += v;
  return sum / static_cast<double>(image.pixels.size());
}

// A room with a lamp, a box and a ball, and a dark one beside it.
Scene two_rooms() {
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.6f)), red = parts.diffuse({0.7f, 0.2f, 0.1f});
  parts.box("bright", grey, {-2, 0, -2}, {2, 2.5f, 2}, true);
  parts.box("dark", grey, {2.1f, 0, -2}, {6.1f, 2.5f, 2}, true);
  parts.box("box", red, {-1.2f, 0, -1}, {-0.4f, 0.9f, -0.2f});
  parts.sphere("ball", grey, {0.7f, 0.4f, -0.5f}, 0.4f, 3);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {-0.4f, 2.45f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f});
  return parts.finish();
}
const Camera kInBright = look_at({0.3f, 1.4f, 1.8f}, {0, 0.8f, -1}, 1.1f),
             kInDark = look_at({4, 1.4f, 1.8f}, {4, 0.8f, -1}, 1.1f);

TEST_F(Udeshi1999, DirectLightIsThatOfTheReference) {
  take(two_rooms());
  ASSERT_TRUE(renderer_.look(kInBright, 64, 48));
  const ReferenceFrame truth = *render_reference(
      scene_->transport(), kInBright, {.width = 64, .height = 48, .samples = 256, .antialias = false}, context_);
  const auto frame = renderer_.draw({.points = 512, .elements = 0}, context_);
  ASSERT_TRUE(frame) << frame.error().text();
  std::vector<Vec4> direct = frame->sum;
  for (std::size_t i = 0; i < direct.size(); ++i) direct[i] -= frame->traced[i];
  const FloatImage shown = picture_of(direct, 64);
  FloatImage with_lamp = truth.direct;
  EXPECT_NEAR(mean_of(shown), mean_of(with_lamp), 0.004 * mean_of(with_lamp));
  EXPECT_LT(relative_error(shown, with_lamp, truth.diffuse_noise)->net(), 0.03);
}

// Elements have no shadows: those of one room shine into the next, as the paper's figure 8 has it.
TEST_F(Udeshi1999, ElementsShineThroughWalls) {
  take(two_rooms());
  const auto light_in = [&](const Camera& camera) {
    EXPECT_TRUE(renderer_.look(camera, 64, 48));
    const HybridFrame frame = *renderer_.draw({.points = 16}, context_);
    EXPECT_EQ(frame.elements.size(), 32u);
    return std::pair(mean_of(picture_of(frame.direct, 64)), mean_of(picture_of(frame.indirect, 64)));
  };
  const auto [direct, indirect] = light_in(kInBright);
  const auto [direct_next, indirect_next] = light_in(kInDark);
  EXPECT_GT(direct, indirect);
  EXPECT_GT(indirect, 0);
  EXPECT_EQ(direct_next, 0);
  EXPECT_GT(indirect_next, 0);
}

TEST_F(Udeshi1999, BlocksAreLitUmbraAndPenumbra) {
  take(two_rooms());
  const auto blocks_in = [&](const Camera& camera) {
    EXPECT_TRUE(renderer_.look(camera, kWidth, kHeight));
    const HybridFrame frame = *renderer_.draw({.points = 16}, context_);
    return check_by_rays(renderer_, *scene_, frame.lamps, 0, context_)->blocks;
  };
  const auto [lit, umbra, penumbra] = blocks_in(kInBright);
  EXPECT_GT(penumbra, 10u);
  EXPECT_GT(lit, penumbra);
  EXPECT_LT(umbra, penumbra);
  const auto [lit_next, umbra_next, penumbra_next] = blocks_in(kInDark);
  EXPECT_EQ(lit_next + penumbra_next, 0u);
  EXPECT_GT(umbra_next, 10u);
}

TEST_F(Udeshi1999, RandomFilesAreDrawn) {
  test::TempFolder folder;
  ImportOptions sky;
  sky.sky = Vec3(100);
  int lit = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto file = folder.path() / "random.glb";
    ASSERT_TRUE(write_file_atomically(file, fuzz::random_scene(seed).glb));
    const auto loaded = load_preview_scene({.file = file, .import = sky}, context_);
    ASSERT_TRUE(loaded) << "seed " << seed << ": " << loaded.error().text();
    const Scene& scene = (*loaded)->scene();
    ASSERT_TRUE(renderer_.take(*loaded)) << seed;
    ASSERT_TRUE(renderer_.look(scene.cameras.empty() ? look_at(1.2f * scene.upper, Vec3(0), 1) : scene.cameras.front(),
                               96, 72));
    const auto frame = renderer_.draw({.points = 8}, context_);
    ASSERT_TRUE(frame) << "seed " << seed << ": " << frame.error().text();
    for (const Vec4& v : frame->sum) EXPECT_TRUE(is_finite(Vec3(v))) << seed;
    lit += mean_of(picture_of(frame->sum, 96)) > 0;
  }
  EXPECT_GT(lit, 3);  // the others look at what no light reaches
}

}  // namespace
}  // namespace oriel::study
