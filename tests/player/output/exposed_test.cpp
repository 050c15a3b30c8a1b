// Pictures out of focus and blurred by motion, against closed forms.
#include "player/output/exposed.h"

#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {

using testing::FrameTest;

constexpr std::uint32_t kExposedFrames = 256;

TEST(Exposed, PointsAreEvenOverPixelLensAndTime) {
  const ExposurePoint alone = exposure_point(0, 1);
  EXPECT_EQ(alone.pixel, Vec2(0));
  EXPECT_EQ(alone.lens, Vec2(0));
  EXPECT_EQ(alone.time, 0);
  Vec2 pixel(0), lens(0), squares(0);
  float time = 0, radius2 = 0;
  for (std::uint32_t i = 0; i < kExposedFrames; ++i) {
    const ExposurePoint p = exposure_point(i, kExposedFrames);
    pixel += p.pixel / float{kExposedFrames}, lens += p.lens / float{kExposedFrames},
        time += p.time / float{kExposedFrames};
    squares += p.pixel * p.pixel / float{kExposedFrames}, radius2 += glm::dot(p.lens, p.lens) / float{kExposedFrames};
    EXPECT_LE(glm::length(p.lens), 1);
  }
  EXPECT_LT(glm::length(pixel), 0.02f);
  EXPECT_LT(glm::length(lens), 0.02f);
  EXPECT_NEAR(time, 0, 1e-6f);
  EXPECT_NEAR(squares.x, 1 / 12.0f, 0.002f);
  EXPECT_NEAR(squares.y, 1 / 12.0f, 0.002f);
  EXPECT_NEAR(radius2, 0.5f, 0.01f);
}

// At z a lens place p moves a point by p (1 / z - 1 / focus) on the plane at distance 1.
TEST(Exposed, WhatIsInFocusStays) {
  const Camera camera = look_at({3, 1, 2}, {4, 5, 3}, 1);
  const Bounds bounds{Vec3(-9), Vec3(9)};
  const IVec2 size(640, 360);
  const View still = lens_view(camera, size, bounds, {});
  const Mat4 pack_from_view = glm::inverse(still.view_from_pack);
  const Vec2 place(0.03f, -0.02f);
  for (const float z : {0.7f, 2.0f, 6.0f}) {
    const Vec4 point = pack_from_view * Vec4(0.3f * z, -0.1f * z, -z, 1);
    const auto pixel = [&](const View& view) {
      const Vec4 clip = view.clip_from_pack * point;
      return Vec2(clip) / clip.w * 0.5f * Vec2(size);
    };
    const Vec2 moved = pixel(lens_view(camera, size, bounds, {place, 2, Vec2(0)})) - pixel(still);
    const Vec2 wanted = -place * (1 / z - 0.5f) / still.tangents * 0.5f * Vec2(size);
    EXPECT_LT(glm::length(moved - wanted), 1e-2f) << z;
  }
  const View beside = lens_view(camera, size, bounds, {Vec2(0), 2, Vec2(0.25f, -0.5f)});
  const Vec4 point = pack_from_view * Vec4(0.3f, -0.1f, -2, 1);
  const auto ndc = [&](const View& view) {
    return Vec2(view.clip_from_pack * point) / (view.clip_from_pack * point).w;
  };
  EXPECT_LT(glm::length((ndc(still) - ndc(beside)) * 0.5f * Vec2(size) - Vec2(0.25f, -0.5f)), 1e-2f);
}

TEST(Exposed, MeansKeepWhatIsShownAsItIs) {
  FrameMean mean;
  mean.add({2, 1, 4, {1, 2, 3, 1, 4, 4, 4, 2}});
  mean.add({2, 1, 4, {3, 2, 1, 0, 4, 4, 4, 2}});
  EXPECT_EQ(mean.mean().pixels, (std::vector<float>{2, 2, 2, 1, 4, 4, 4, 2}));
}

// A lit half of a wall that begins at x = 0; the spread of its edge, pixels: the standard deviation of its derivative.
class ExposedEdge : public FrameTest {
 protected:
  static constexpr float kWall = 4;  // metres before the eye

  double spread(const std::function<View(const ExposurePoint&, const Bounds&)>& view_at) {
    Pack pack;
    pack.materials.emplace_back().emission = Vec3(100);
    testing::add_quad(pack, {0, -3, -kWall}, {9, 0, 0}, {0, 6, 0}, 0, -1);
    auto scene = GpuScene::create(pack, device_);
    EXPECT_TRUE(scene);
    FrameMean mean;
    for (std::uint32_t i = 0; i < kExposedFrames; ++i) {
      EXPECT_TRUE(renderer_->render(**scene, view_at(exposure_point(i, kExposedFrames), (*scene)->bounds()), {}));
      mean.add(renderer_->read_frame());
    }
    const FloatImage picture = mean.mean();
    const float* row = &picture.pixels[static_cast<std::size_t>(4 * (kSize.y / 2) * kSize.x)];
    double sum = 0, first = 0, second = 0;
    for (int x = 1; x < kSize.x; ++x) {
      const double rise = double{row[4 * x]} - double{row[4 * (x - 1)]};
      sum += rise, first += rise * x, second += rise * x * x;
    }
    EXPECT_NEAR(sum, 100, 0.5);
    return std::sqrt(second / sum - first * first / (sum * sum));
  }

  const IVec2 kSize{256, 64};
  const Camera camera_ = look_at({0, 0, 0}, {0, 0, -1}, 0.5f);
  const float pixels_ = 32 / std::tan(0.25f);  // of a tangent of 1
};

// An even disk of radius r has the deviation r / 2 along each axis; pixels and the points in them add 1/12 each.
TEST_F(ExposedEdge, OutOfFocusIsAsWideAsTheCircleOfConfusion) {
  constexpr float kRadius = 0.2f;
  for (const float focus : {1.0f, 2.0f, kWall, 30.0f}) {
    const double found = spread([&](const ExposurePoint& at, const Bounds& bounds) {
      return lens_view(camera_, kSize, bounds, {kRadius * at.lens, focus, at.pixel});
    });
    const double confusion = double{kRadius} * std::abs(1 / double{kWall} - 1 / double{focus}) * double{pixels_};
    if (focus == kWall)
      EXPECT_LE(found, 0.5) << "of two pixels";
    else
      EXPECT_NEAR(found, std::sqrt(confusion * confusion / 4 + 1.0 / 6), 0.02 * found) << focus;
  }
}

// An even way of length w has the variance w² / 12.
TEST_F(ExposedEdge, AnEyeThatMovesAsideBlursByItsWay) {
  for (const float way_m : {0.2f, 0.4f}) {
    const double found = spread([&](const ExposurePoint& at, const Bounds& bounds) {
      Camera camera = camera_;
      camera.eye.x += way_m * at.time;
      return lens_view(camera, kSize, bounds, {Vec2(0), 1, at.pixel});
    });
    const double way = double{way_m / kWall * pixels_};
    EXPECT_NEAR(found, std::sqrt(way * way / 12 + 1.0 / 6), 0.02 * found) << way_m;
  }
}

}  // namespace
}  // namespace oriel
