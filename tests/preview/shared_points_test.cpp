// Points on lamps that pixels share, and what classes of blocks spare.
#include <gtest/gtest.h>

#include "formats/query/camera.h"
#include "player/gpu/headless.h"
#include "preview/frame/preview_renderer.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

constexpr int kWidth = 160, kHeight = 120;

// A lamp of 6 by 6 points over a floor, with a box on it or without; light by pixel.
class SharedPointsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = gpu::HeadlessContext::create();
    if (!context) GTEST_SKIP() << context.error().text();
    gl_ = std::move(*context);
    renderer_ = *PreviewRenderer::create(*gpu::open_device());
  }

  void take(Scene scene) {
    auto prepared = prepare_preview_scene({std::move(scene), {}}, context_);
    ASSERT_TRUE(prepared) << prepared.error().text();
    scene_ = *prepared;
    const Status taken = renderer_.take(scene_);
    ASSERT_TRUE(taken) << taken.error().text();
  }

  void look_at_floor(bool box) {
    test::SceneParts parts;
    const std::uint32_t grey = parts.diffuse(Vec3(0.5f));
    parts.quad("floor", grey, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
    if (box) parts.box("box", grey, {-1, 0, -1}, {1, 1.5f, 1});
    take(parts.finish());
    ASSERT_TRUE(renderer_.look(look_at({1, 6, 7}, {0, 0, 0}, 0.9f), kWidth, kHeight));
    ASSERT_TRUE(renderer_.pass({.direct = false, .bounce = false, .antialias = false}, context_));
    for (int i = 0; i < 36; ++i)
      lamp_.push_back({LampKind::kFlat,
                       Vec4(0.2f * static_cast<float>(i % 6), 4, 0.2f * static_cast<float>(i / 6), 1),
                       {0, -1, 0},
                       Vec3(1),
                       ~0u});
  }
  std::vector<Vec4> light(int side, std::size_t points = 36) {
    return *lamps_by_rays(renderer_.points(), std::span(lamp_).first(points), *scene_->accel, {side, 4}, context_);
  }
  static double relative_rmse(const std::vector<Vec4>& a, const std::vector<Vec4>& truth) {
    double error = 0, all = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double apart = a[i].x - truth[i].x, is = truth[i].x;
      error += apart * apart, all += is * is;
    }
    return std::sqrt(error / all);
  }
  std::unique_ptr<gpu::HeadlessContext> gl_;
  PreviewRenderer renderer_;
  std::shared_ptr<const PreviewScene> scene_;
  Context context_;
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
  const SeenPoints seen = renderer_.points();
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
  const SeenPoints floor = renderer_.points();
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
    EXPECT_TRUE(renderer_.pass({.samples = 36, .bounce = bounce, .emission = false, .shared = shared}, context_));
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
