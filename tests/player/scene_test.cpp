// What the player decides without a GPU: views, culling, the choice of maps, taps of kernels.
#include <gmock/gmock.h>

#include "player/images/map_choice.h"
#include "player/navigation/culling.h"
#include "player/navigation/view.h"
#include "player/scene/check.h"
#include "player/scene/kernel_taps.h"

namespace oriel {
namespace {

Bounds box(float low, float high) {
  Bounds b;
  b.extend(Vec3(low));
  b.extend(Vec3(high));
  return b;
}

Vec3 project(const Mat4& clip, const Vec3& p) {
  const Vec4 c = clip * Vec4(p, 1);
  return Vec3(c) / c.w;
}

TEST(MakeView, ProjectsTheFrustumsCorners) {
  Camera camera;
  camera.eye = {1, 2, 3};
  camera.forward = {1, 0, 0};
  camera.vertical_fov_rad = 2 * std::atan(0.5f);
  const View view = make_view(camera, 200, 100, box(-10, 10));
  const Vec3 corner = project(view.clip_from_pack, {3, 3, 5});
  EXPECT_NEAR(corner.x, 1, 1e-5f);
  EXPECT_NEAR(corner.y, 1, 1e-5f);
  EXPECT_NEAR(view.tangents.x, 1, 1e-6f);
}

TEST(MakeView, KeepsTheSceneBetweenItsPlanes) {
  for (const float scale : {1e-5f, 1.0f, 1e7f}) {
    Camera camera;
    camera.eye = Vec3(0, 0, 20) * scale;
    const View view = make_view(camera, 4, 4, box(-10 * scale, 10 * scale));
    EXPECT_GE(project(view.clip_from_pack, Vec3(0, 0, 10) * scale).z, -1) << scale;
    EXPECT_LE(project(view.clip_from_pack, Vec3(0, 0, -10) * scale).z, 1) << scale;
  }
}

TEST(MakeView, IsFiniteWhateverTheCamera) {
  Camera camera;
  for (const Vec3& forward : {Vec3(0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(1e-30f, 0, 0), Vec3(NAN, 0, 0)}) {
    for (const float fov : {0.0f, 1e-9f, 3.2f, 100.0f}) {
      for (const Bounds& bounds : {Bounds{}, box(0, 0), box(-1e18f, 1e18f)}) {
        camera.forward = forward;
        camera.vertical_fov_rad = fov;
        const View view = make_view(camera, 1, 4096, bounds);
        for (int c = 0; c < 4; ++c) {
          for (int r = 0; r < 4; ++r) EXPECT_TRUE(std::isfinite(view.clip_from_pack[c][r])) << fov;
        }
      }
    }
  }
}

TEST(Culling, KeepsWhatMayBeSeen) {
  Camera camera;  // at the origin, along -z
  const View view = make_view(camera, 10, 10, box(-100, 100));
  const Frustum frustum = make_frustum(view.clip_from_pack);
  const auto seen = [&](const Vec3& at, float half) {
    Bounds b;
    b.extend(at - half);
    b.extend(at + half);
    return may_be_visible(frustum, b);
  };
  EXPECT_TRUE(seen({0, 0, -5}, 1));
  EXPECT_TRUE(seen({0, 0, 0}, 1));      // around the eye
  EXPECT_TRUE(seen({0, 0, -5}, 1000));  // around everything
  EXPECT_FALSE(seen({0, 0, 5}, 1));
  EXPECT_FALSE(seen({20, 0, -5}, 1));
  EXPECT_FALSE(may_be_visible(frustum, Bounds{}));
}

TEST(Culling, PolygonsAreClippedToTheView) {
  const View view = make_view(Camera{}, 10, 10, box(-100, 100));
  const float t = std::tan(0.5f);
  const auto rect = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return project_polygon(view.clip_from_pack, {a, b, c, d});
  };
  const NdcRect whole = rect({-1, -1, -4}, {1, -1, -4}, {1, 1, -4}, {-1, 1, -4});
  EXPECT_NEAR(whole.lower.x, -0.25f / t, 1e-5f);
  EXPECT_NEAR(whole.upper.y, 0.25f / t, 1e-5f);
  EXPECT_TRUE(rect({-1, -1, 4}, {1, -1, 4}, {1, 1, 4}, {-1, 1, 4}).empty);
  // A floor from behind the eye to the horizon covers the lower half.
  const NdcRect floor = rect({-50, -1, 50}, {50, -1, 50}, {50, -1, -50}, {-50, -1, -50});
  ASSERT_FALSE(floor.empty);
  EXPECT_NEAR(floor.lower.x, -1, 1e-4f);
  EXPECT_NEAR(floor.lower.y, -1, 1e-4f);
  EXPECT_LT(floor.upper.y, 0);
  EXPECT_GT(floor.upper.y, -0.1f);
}

std::vector<RadianceMap> maps_from(const std::vector<Vec3>& eyes) {
  std::vector<RadianceMap> maps;
  for (const Vec3& eye : eyes) {
    RadianceMap map;
    map.eye = eye;
    map.lower = {-1, -1};
    map.upper = {1, 1};
    map.width = map.height = 8;
    maps.push_back(map);
  }
  return maps;
}

TEST(SelectMaps, ByAngle) {
  const auto maps = maps_from({{0, 0, -10}, {1, 0, -1}, {-1, 0, -1}, {0.9f, 0, -1}});
  Reflector reflector;
  reflector.map_count = 4;
  const auto elements = group_by_element(reflector, maps);
  ASSERT_EQ(elements.size(), 1u);
  const Vec4 eye(0.1f, 0, -1, 1);
  using Indices = std::vector<std::uint32_t>;
  EXPECT_EQ(maps_by_angle(elements[0], maps, eye), (Indices{0, 3, 1, 2}));
  EXPECT_EQ(maps_by_angle(elements[0], maps, Vec4(-1, 0, -1, 0))[0], 2u);
}

TEST(SelectMaps, MapsKnowTheirElements) {
  auto maps = maps_from({{0, 0, -1}, {0, 0, -2}, {0, 0, -1}});
  maps[2].element = 1;
  maps[2].lower = {1, -1};
  maps[2].upper = {3, 1};
  Reflector reflector;
  reflector.first_map = 0;
  reflector.map_count = 3;
  const auto elements = group_by_element(reflector, maps);
  ASSERT_EQ(elements.size(), 2u);
  EXPECT_EQ(elements[0].maps.size(), 2u);
  EXPECT_EQ(elements[1].maps, std::vector<std::uint32_t>{2});
  std::swap(maps[1], maps[2]);
  const auto apart = group_by_element(reflector, maps);
  ASSERT_EQ(apart.size(), 2u) << "maps of an element are one's, even where others lie between";
  EXPECT_EQ(apart[0].maps, (std::vector<std::uint32_t>{0, 2}));
}

TEST(KernelTaps, HaveTheKernelsMoments) {
  BrdfKernel kernel;
  kernel.size = 33;
  kernel.half_extent = 0.5f;
  double sum = 0, second = 0;
  for (int y = 0; y < 33; ++y) {
    for (int x = 0; x < 33; ++x) {
      const double tx = ((x + 0.5) / 33 * 2 - 1) * 0.5, ty = ((y + 0.5) / 33 * 2 - 1) * 0.5;
      kernel.weights.push_back(static_cast<float>(std::exp(-(tx * tx + ty * ty) / (2 * 0.01))));
      sum += kernel.weights.back();
      second += kernel.weights.back() * tx * tx;
    }
  }
  for (float& w : kernel.weights) w = static_cast<float>(w / sum);
  const KernelTaps taps = make_kernel_taps(kernel, 48);
  ASSERT_EQ(taps.taps.size(), std::size_t{48} * static_cast<std::size_t>(taps.rows));
  Vec2 mean(0), variance(0);
  for (const KernelTap& tap : std::span(taps.taps).last(48)) {  // normal incidence
    const Vec2 tangent = tap.at / (1 - 0.25f * glm::dot(tap.at, tap.at));
    mean += tangent / 48.0f;
    variance += tangent * tangent / 48.0f;
    EXPECT_GT(tap.width, 0);
  }
  EXPECT_NEAR(mean.x, 0, 0.005f);
  EXPECT_NEAR(mean.y, 0, 0.005f);
  EXPECT_NEAR(variance.x, second / sum, 0.1 * second / sum);
  EXPECT_NEAR(variance.y, second / sum, 0.1 * second / sum);
  EXPECT_NEAR(taps.median, 0.1f * 1.177f, 0.02f);
}

// A lobe of two slices: as wide as a pixel, at the mirror direction when seen from above and off it at grazing angles.
BrdfKernel leaning_kernel() {
  BrdfKernel kernel;
  kernel.alpha = 0.1f;
  kernel.size = 3;
  kernel.half_extent = 0.1f;
  kernel.weights.assign(9, 1.0f / 9);
  kernel.slice_size = 1;
  for (const float cos_theta : {0.0f, 1.0f}) {
    KernelSlice slice;
    slice.cos_theta = cos_theta;
    slice.shift = 0.4f * (1 - cos_theta);
    slice.width = {0.1f, 0.2f};
    slice.lower = {-1, -1};
    slice.upper = {1, 1};
    slice.radial = {0, 1};
    slice.weights = {1};
    kernel.slices.push_back(slice);
  }
  return kernel;
}

TEST(KernelTaps, FollowTheLobeBetweenIncidences) {
  BrdfKernel kernel = leaning_kernel();
  const KernelTaps taps = make_kernel_taps(kernel, 48);
  EXPECT_EQ(taps.rows, 2);
  ASSERT_EQ(taps.taps.size(), 96u);
  for (std::size_t row = 0; row < 2; ++row) {
    Vec2 mean(0), low(1e9f), high(-1e9f);
    for (const KernelTap& tap : std::span(taps.taps).subspan(48 * row, 48)) {
      mean += tap.at / 48.0f;
      low = glm::min(low, tap.at);
      high = glm::max(high, tap.at);
    }
    EXPECT_NEAR(mean.x, 0, 2e-3f);
    EXPECT_NEAR(mean.y, row == 0 ? 0.4f : 0.0f, 2e-3f);
    EXPECT_NEAR(high.x - low.x, 2 * std::sinh(1.0f) * 0.1f, 0.03f);
    EXPECT_NEAR(high.y - low.y, 2 * std::sinh(1.0f) * 0.2f, 0.04f);
  }
  const RowPosition half = kernel_row(0.25f, 2);
  EXPECT_EQ(half.row, 0);
  EXPECT_FLOAT_EQ(half.next, 0.5f);
  EXPECT_EQ(kernel_row(1, 9).row, 7);
  EXPECT_EQ(kernel_row(1, 9).next, 1);
  EXPECT_EQ(kernel_row(-1, 9).row, 0);
  EXPECT_EQ(kernel_row(0.3f, 1).row, 0);
  kernel.slices.clear();
  for (const KernelTap& tap : make_kernel_taps(kernel, 48).taps)
    EXPECT_LE(std::abs(tap.at.y), 0.1f) << "a kernel without slices stays at the mirror ray";
}

TEST(KernelTaps, WeighByFresnelOfTheHalfVector) {
  KernelTaps
      taps;  // at normal incidence and at 60 degrees: the mirror direction, and one 60 degrees up or down from it
  taps.count = 3;
  taps.rows = 2;
  const float up = 2 * std::tan(0.5f * 1.0471976f);
  taps.taps = {{{0, 0}, 0}, {{0, 0.5f}, 0}, {{0, -0.5f}, 0}, {{0, 0}, 0}, {{0, up}, 0}, {{0, -up}, 0}};
  FresnelMap map;
  for (int i = 0; i <= 1024; ++i)
    map.factor.push_back(Vec3(1 - std::pow(static_cast<float>(i) / 1024, 2.0f)));  // 1 - cosine
  const std::vector<float> means = weigh_by_fresnel(taps, map);
  ASSERT_EQ(means.size(), 2u);
  // Row 1 is normal incidence, where the half vector leans by 30 degrees to the directions at 60.
  const float leaning = 1 - std::cos(0.5235988f), mean = 2 * leaning / 3;
  EXPECT_NEAR(means[1], mean, 1e-5);
  EXPECT_NEAR(taps.taps[3].weight, 0, 1e-4);
  EXPECT_NEAR(taps.taps[4].weight, leaning / mean, 1e-4);
  EXPECT_NEAR(taps.taps[5].weight, taps.taps[4].weight, 1e-5);
  // Row 0 is grazing: the mirror direction goes straight on along the surface, and only the upper tap is above it.
  EXPECT_NEAR(fresnel_factor(map, 0), 1, 1e-6);
  EXPECT_NEAR(means[0], 1 - std::sin(std::atan(0.25f)), 1e-4);
  EXPECT_GT(taps.taps[0].weight, taps.taps[1].weight) << "what goes straight on reflects most";
  weigh_by_fresnel(taps, FresnelMap{});
  for (const KernelTap& tap : taps.taps) EXPECT_EQ(tap.weight, 1);
}

TEST(CheckDrawable, KernelsAndReflectancesFitTheDevice) {
  gpu::Device device;
  device.texture_size = 4;
  const auto found = [&](auto change) {
    Pack pack;
    pack.kernels = {leaning_kernel()};
    pack.fresnel_maps.resize(1);
    pack.fresnel_maps[0].table = {Vec3(0), Vec3(1)};
    change(pack);
    const Status status = check_drawable(pack, device);
    return status ? "" : status.error().text();
  };
  EXPECT_EQ(found([](Pack&) {}), "");
  const auto has = [](const std::string& text) { return ::testing::HasSubstr(text); };
  EXPECT_THAT(found([](Pack& p) { p.kernels[0].slice_size = 5; }), has("kernel 0: found 5 texels, expected at most 4"));
  EXPECT_THAT(found([](Pack& p) { p.kernels[0].slices.resize(5, p.kernels[0].slices[0]); }),
              has("kernel 0: found 5 slices, expected at most 4"));
  EXPECT_THAT(found([](Pack& p) { p.fresnel_maps[0].table.resize(5); }), has("Fresnel map 0: found 5 texels"));
  EXPECT_THAT(found([](Pack& p) { p.fresnel_maps.resize(5, p.fresnel_maps[0]); }), has("Fresnel maps: found 5"));
  EXPECT_THAT(found([](Pack& p) {
                p.surround_maps.resize(1);
                p.surround_maps[0].size = 2;
              }),
              has("surround map 0: found 7 texels"));
  EXPECT_THAT(found([](Pack& p) {
                p.lightmaps.resize(2);
                p.lightmaps[1].height = 8;
              }),
              has("lightmap 1: found 8 texels"));
}

TEST(KernelTaps, AMirrorIsOneTap) {
  const KernelTaps taps = make_kernel_taps(BrdfKernel{}, 48);
  ASSERT_EQ(taps.taps.size(), 1u);
  EXPECT_EQ(taps.taps[0].at, Vec2(0));
  EXPECT_EQ(taps.median, 0);
}

}  // namespace
}  // namespace oriel
