// Shadow volumes against rays, pixel by pixel, on scenes made of anything.
#include <gtest/gtest.h>

#include <random>

#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "preview/frame/preview_renderer.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
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

// What the volumes and the rays of a light say of what a camera sees.
struct Compared {
  int lit = 0, dark = 0, silhouettes = 0, wrong = 0, wrong_on_silhouettes = 0;
  std::uint32_t around_eye = 0;
};

class ShadowVolumesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gpu::HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().text();
    gl_ = std::move(*context);
    device_ = *gpu::open_device();
    renderer_ = *PreviewRenderer::create(device_);
  }

  void take(Scene scene) {
    auto prepared = prepare_preview_scene({std::move(scene), {}}, context_);
    ASSERT_TRUE(prepared) << prepared.error().text();
    scene_ = *prepared;
    const Status taken = renderer_.take(scene_);
    ASSERT_TRUE(taken) << taken.error().text();
  }

  // forget_eye: the checker's own check, as if no volume held the eye.
  Compared compare(const Camera& camera, const LampPoint& light, bool forget_eye = false) {
    Compared out;
    EXPECT_TRUE(renderer_.look(camera, kWidth, kHeight));
    const auto stats = renderer_.pass({.shadows = ShadowMethod::kNone, .antialias = false}, context_);
    EXPECT_TRUE(stats) << stats.error().text();
    const SeenPoints points = renderer_.read_points();
    const std::vector<std::uint8_t> counts = renderer_.read_in_shadow(light);
    const std::vector<Vec4> light_there = *lamps_by_rays(points, {{light}}, *scene_->accel, {}, context_);
    const Vec4 eye = camera.vertical_fov_rad > 0 ? Vec4(camera.eye, 1) : Vec4(-camera.forward, 0);
    out.around_eye = scene_->shadows->volumes(light.place, eye).around_eye;
    const auto passes = [&](int x, int y) { return light_there[static_cast<std::size_t>(y * kWidth + x)].x > 0; };
    const auto faces = [&](int x, int y) { return light_there[static_cast<std::size_t>(y * kWidth + x)].w > 0; };
    for (int y = 1; y + 1 < kHeight; ++y)
      for (int x = 1; x + 1 < kWidth; ++x) {
        if (!faces(x, y)) continue;
        bool edge = false;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) edge |= passes(x + dx, y + dy) != passes(x, y) || !faces(x + dx, y + dy);
        std::uint8_t count = counts[static_cast<std::size_t>(y * kWidth + x)];
        if (forget_eye) count = static_cast<std::uint8_t>(count - out.around_eye);
        const bool wrong = (count == 0) != passes(x, y);
        ++(passes(x, y) ? out.lit : out.dark);
        out.silhouettes += edge;
        if (wrong) ++(edge ? out.wrong_on_silhouettes : out.wrong);
      }
    return out;
  }

  std::unique_ptr<gpu::HeadlessContext> gl_;
  gpu::Device device_;
  PreviewRenderer renderer_;
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

TEST_F(ShadowVolumesTest, AreRaysButForSilhouettes) {
  Compared all;
  int eyes_inside = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    take(random_scene(seed));
    const auto [light, cameras] = random_views(seed);
    for (int i = 0; i < 3; ++i) {
      const Camera& camera = cameras[static_cast<std::size_t>(i)];
      const Compared c = compare(camera, light);
      all.lit += c.lit, all.dark += c.dark, all.silhouettes += c.silhouettes;
      all.wrong += c.wrong, all.wrong_on_silhouettes += c.wrong_on_silhouettes;
      eyes_inside += c.around_eye > 0;
      EXPECT_LE(c.wrong, 2) << "scene " << seed << " eye " << i << ", volumes around it: " << c.around_eye;
    }
  }
  std::printf("lit %d, in shadow %d, silhouettes %d; wrong elsewhere %d, on silhouettes %d; eyes in volumes %d of 60\n",
              all.lit, all.dark, all.silhouettes, all.wrong, all.wrong_on_silhouettes, eyes_inside);
  EXPECT_GT(all.lit, 50000);
  EXPECT_GT(all.dark, 50000);
  EXPECT_GT(eyes_inside, 10);
}

// The approximate capping: what no ray from the view plane meets is missed, and then all pixels of that shadow are
// wrong.
TEST_F(ShadowVolumesTest, CapsBySampledRaysMissSome) {
  constexpr std::array<std::uint32_t, 4> kRays{1, 4, 16, 64};
  std::array<double, kRays.size()> wrong{}, wrong_near{}, eyes{};
  double pixels = 0;
  int orthographic = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    take(random_scene(seed));
    const auto [light, cameras] = random_views(seed);
    for (const Camera& camera : cameras) {
      ASSERT_TRUE(renderer_.look(camera, kWidth, kHeight));
      ASSERT_TRUE(renderer_.pass({.shadows = ShadowMethod::kNone, .antialias = false}, context_));
      orthographic += camera.vertical_fov_rad == 0;
      const std::vector<std::uint8_t> exact = renderer_.read_in_shadow(light);
      pixels += static_cast<double>(exact.size());
      for (std::size_t k = 0; k < kRays.size(); ++k) {
        const std::vector<std::uint8_t> sampled = renderer_.read_in_shadow(light, kRays[k]);
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

TEST_F(ShadowVolumesTest, AnEyeInsideThatIsForgottenIsSeen) {
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", grey, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  parts.box("cover", grey, {-1, 2, -1}, {1, 2.2f, 1});
  take(parts.finish());
  const Camera below = look_at({0.1f, 1, 0.2f}, {1, 0, -3}, 1.2f);
  const Compared right = compare(below, lamp_at({0.01f, 4, 0.02f}));
  EXPECT_EQ(right.around_eye, 1u);  // a closed box counts once
  EXPECT_LE(right.wrong, 2);
  EXPECT_GT(compare(below, lamp_at({0.01f, 4, 0.02f}), true).wrong, 1000);
}

// A lamp of 6 by 6 points over a floor, with a box on it or without; light by pixel.
class SharedPointsTest : public ShadowVolumesTest {
 protected:
  void look_at_floor(bool box) {
    test::SceneParts parts;
    const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
    parts.quad("floor", grey, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    if (box) parts.box("box", grey, {-1, 0, -1}, {1, 1.5f, 1});
    take(parts.finish());
    ASSERT_TRUE(renderer_.look(look_at({1, 6, 7}, {0, 0, 0}, 0.9f), kWidth, kHeight));
    ASSERT_TRUE(renderer_.pass({.shadows = ShadowMethod::kNone, .antialias = false}, context_));
    for (int i = 0; i < 36; ++i)
      lamp_.push_back({LampKind::kFlat,
                       Vec4(0.2f * static_cast<float>(i % 6), 4, 0.2f * static_cast<float>(i / 6), 1),
                       {0, -1, 0},
                       Vec3(1),
                       ~0u});
  }
  std::vector<Vec4> light(int side, std::size_t points = 36) {
    return *lamps_by_rays(renderer_.read_points(), std::span(lamp_).first(points), *scene_->accel, {side, 4}, context_);
  }
  static double relative_rmse(const std::vector<Vec4>& a, const std::vector<Vec4>& truth) {
    double error = 0, all = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double apart = a[i].x - truth[i].x, is = truth[i].x;
      error += apart * apart, all += is * is;
    }
    return std::sqrt(error / all);
  }
  std::vector<LampPoint> lamp_;
};

TEST_F(SharedPointsTest, LightWhatIsEvenAsIfNobodyShared) {
  look_at_floor(false);
  const auto truth = light(1);
  EXPECT_GT(relative_rmse(light(1, 35), truth), 0.01);  // a point less is seen
  EXPECT_LT(relative_rmse(light(2), truth), 0.01);
  EXPECT_LT(relative_rmse(light(3), truth), 0.01);
}

TEST_F(SharedPointsTest, ErrAtShadowsAlone) {
  look_at_floor(true);
  const auto truth = light(1), shared = light(3);
  double brighter = 0, all = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) brighter += shared[i].x - truth[i].x, all += truth[i].x;
  std::printf("36 points shared by 3x3 pixels: relative RMSE %.1f %%, mean %+.2f %%\n",
              100 * relative_rmse(shared, truth), 100 * brighter / all);
  EXPECT_LT(relative_rmse(shared, truth), 0.1);
  EXPECT_NEAR(brighter / all, 0, 0.01);
}

double sum_of(const std::vector<Vec4>& light) {
  double sum = 0;
  for (const Vec4& l : light) sum += l.x;
  return sum;
}

TEST_F(SharedPointsTest, ClassesSaveRaysAndLeaveTheMean) {
  look_at_floor(true);
  for (LampPoint& point : lamp_) point.lamp = 0;
  const SeenPoints seen = renderer_.read_points();
  const auto truth = light(1);
  std::vector<Vec4> mean(truth.size(), Vec4(0));
  std::atomic<std::size_t> rays{0}, all{0};
  ASSERT_TRUE(lamps_by_rays(seen, lamp_, *scene_->accel, {1, 0, nullptr, &all}, context_));
  ShadowClasses classes(IVec2(kWidth, kHeight));
  constexpr int kPasses = 16;
  for (int pass = 0; pass < kPasses; ++pass) {
    classes.begin(lamp_, 1, static_cast<std::uint32_t>(pass));
    const auto some = *lamps_by_rays(seen, lamp_, *scene_->accel, {1, 0, &classes, &rays}, context_);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += some[i] / float{kPasses};
  }
  std::printf("classes: %.1f %% of rays are traced, relative RMSE of 16 passes %.2f %%\n",
              100 * static_cast<double>(rays) / (kPasses * static_cast<double>(all)), 100 * relative_rmse(mean, truth));
  EXPECT_LT(static_cast<double>(rays), 0.5 * kPasses * static_cast<double>(all));
  EXPECT_LT(relative_rmse(mean, truth), 0.01);
  EXPECT_NEAR(sum_of(mean) / sum_of(truth), 1, 1e-3);
}

// Whoever believes that the floor is lit learns of the box by the rays that are asked, in the first pass.
TEST_F(SharedPointsTest, ClassesThatAreWrongLeaveTheMean) {
  look_at_floor(true);
  const std::shared_ptr<const PreviewScene> with_box = scene_;
  lamp_.clear();
  look_at_floor(false);
  for (LampPoint& point : lamp_) point.lamp = 0;
  const SeenPoints floor = renderer_.read_points();
  double sum = 0;
  constexpr std::uint32_t kTrials = 32;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    ShadowClasses classes(IVec2(kWidth, kHeight));
    classes.begin(lamp_, trial, 0);
    ASSERT_TRUE(lamps_by_rays(floor, lamp_, *scene_->accel, {1, 0, &classes}, context_));
    classes.begin(lamp_, trial, 1);
    sum += sum_of(*lamps_by_rays(floor, lamp_, *with_box->accel, {1, 0, &classes}, context_)) / kTrials;
  }
  const double assumed = sum_of(light(1)), truth = sum_of(*lamps_by_rays(floor, lamp_, *with_box->accel, {}, context_));
  EXPECT_GT(assumed, 1.05 * truth);
  EXPECT_NEAR(sum / truth, 1, 2e-3);
}

// Nothing is in the way of anything here. Reflected light is shared in both frames.
TEST_F(SharedPointsTest, FramesWithReflectedLightAreTheSame) {
  test::SceneParts parts;
  const std::uint32_t grey = parts.diffuse(Vec3(0.5f)), red = parts.diffuse(Vec3(0.7f, 0.2f, 0.1f));
  parts.quad("floor", grey, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  parts.quad("wall", red, {-5, 0, -5}, {10, 0, 0}, {0, 4, 0});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(1000)), {-1, 4, -1}, {2, 0, 0}, {0, 0, 2});
  take(parts.finish());
  const auto frame = [&](bool shared, bool bounce) {
    EXPECT_TRUE(renderer_.look(look_at({1, 3, 7}, {0, 1, 0}, 0.9f), kWidth, kHeight));
    EXPECT_TRUE(renderer_.pass(
        {.shadows = ShadowMethod::kRays, .samples = 36, .bounce = bounce, .emission = false, .shared = shared},
        context_));
    const FloatImage mean = renderer_.read_mean();
    std::vector<Vec4> light;
    for (std::size_t i = 0; i < mean.pixels.size(); i += 3) light.emplace_back(mean.pixels[i], 0, 0, 0);
    return light;
  };
  const auto truth = frame(false, true);
  EXPECT_GT(relative_rmse(frame(true, false), truth), 0.02);  // without the bounce it is another
  EXPECT_LT(relative_rmse(frame(true, true), truth), 0.02);
}

}  // namespace
}  // namespace oriel
