#include "bake/atlas/texel_map.h"

#include <gtest/gtest.h>

#include "bake/atlas/polygon.h"
#include "tests/bake/atlas/checks.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

class Random {
 public:
  float next() {
    return static_cast<float>((state_ = state_ * 6364136223846793005u + 1442695040888963407u) >> 40) * 0x1p-24f;
  }
  Vec3 next3() {
    const float x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  std::uint64_t state_ = 7;
};

// One page of n × n texels with the given triangles, in texels.
Atlas hand_made(std::uint32_t n, const std::vector<Triangle2>& triangles) {
  Atlas atlas;
  atlas.pages.push_back({n, n, false});
  for (const Triangle2& t : triangles) {
    atlas.page.push_back(0);
    atlas.chart.push_back(0);
    atlas.uv.push_back({Vec2(t[0] / static_cast<double>(n)), Vec2(t[1] / static_cast<double>(n)),
                        Vec2(t[2] / static_cast<double>(n))});
  }
  atlas.chart_count = 1;
  return atlas;
}

std::vector<TexelMapPage> map_of(const Atlas& atlas) {
  Context context;
  auto map = build_texel_map(atlas, context);
  EXPECT_TRUE(map.has_value());
  return std::move(*map);
}

DVec2 on_page(const Atlas& atlas, const TexelPoint& point) {
  const Triangle2 t = texel_triangle(atlas, point.triangle);
  const DVec2 w(point.barycentric);
  return t[0] * (1 - w.x - w.y) + t[1] * w.x + t[2] * w.y;
}

TEST(TexelMap, AreasAreThoseOfThePolygons) {
  Random random;
  for (int n = 0; n < 200; ++n) {
    Triangle2 t;
    for (DVec2& p : t) p = DVec2(random.next(), random.next()) * 32.0;
    const Atlas atlas = hand_made(32, {t});
    const auto map = map_of(atlas);
    EXPECT_NEAR(fragment_area(map), std::abs(signed_area(texel_triangle(atlas, 0))), 1e-4);
    for (std::size_t i = 0; i < map[0].texel.size(); ++i) {  // each against the plain clip
      const ConvexPolygon part = clip_to_cell(texel_triangle(atlas, 0), map[0].texel[i] % 32, map[0].texel[i] / 32);
      EXPECT_NEAR(map[0].fragments[i].area, area(part), 1e-6);
    }
  }
}

TEST(TexelMap, NoTouchedTexelIsMissed) {
  Random random;
  for (int n = 0; n < 100; ++n) {
    Triangle2 t;
    const DVec2 middle = DVec2(random.next(), random.next()) * 16.0;
    for (DVec2& p : t)
      p = glm::clamp(middle + DVec2(random.next() - 0.5, random.next() - 0.5) * std::pow(10.0, 1 - n % 5), DVec2(0),
                     DVec2(16));
    const Atlas atlas = hand_made(16, {t});
    const auto map = map_of(atlas);
    const std::set<std::uint32_t> covered(map[0].texel.begin(), map[0].texel.end());
    for (std::uint32_t y = 0; y < 16; ++y)
      for (std::uint32_t x = 0; x < 16; ++x)
        EXPECT_TRUE(covered.contains(y * 16 + x) || area(clip_to_cell(texel_triangle(atlas, 0), x, y)) == 0)
            << n << " " << x << " " << y;
  }
}

TEST(TexelMap, TouchingABorderCoversNothingBeyond) {
  const auto map =
      map_of(hand_made(8, {{DVec2(2, 2), DVec2(4, 2), DVec2(4, 4)}, {DVec2(2, 2), DVec2(4, 4), DVec2(2, 4)}}));
  EXPECT_EQ(map[0].texel, (std::vector<std::uint32_t>{18, 19, 26, 27}));
}

TEST(TexelMap, TrianglesWithoutAreaStillCover) {
  const auto line = map_of(hand_made(8, {{DVec2(1.5, 2.5), DVec2(5.5, 2.5), DVec2(3.5, 2.5)}}));
  EXPECT_EQ(line[0].texel, (std::vector<std::uint32_t>{17, 18, 19, 20, 21}));
  EXPECT_EQ(map_of(hand_made(8, {{DVec2(3, 3), DVec2(3, 3), DVec2(3, 3)}}))[0].texel.size(), 1u);
  EXPECT_EQ(map_of(hand_made(8, {{DVec2(8, 8), DVec2(8, 8), DVec2(8, 8)}}))[0].texel, (std::vector<std::uint32_t>{63}));
  EXPECT_EQ(map_of(hand_made(8, {{DVec2(8, 0), DVec2(8, 8), DVec2(8, 4)}}))[0].texel.size(), 8u);
}

TEST(TexelMap, CheckerOfSharedTexelsCanFail) {
  Atlas atlas = hand_made(8, {{DVec2(0, 0), DVec2(3.5, 0), DVec2(0, 3.5)}, {DVec2(3, 3), DVec2(1, 3), DVec2(3, 1)}});
  atlas.chart = {0, 1};
  EXPECT_GT(shared_texels(atlas, map_of(atlas)), 0u);
}

// Means and covariances of a uniform point in a polygon, from a fan.
struct Moments {
  double area = 0;
  DVec2 mean{0};
};
Moments moments(const ConvexPolygon& polygon) {
  Moments m;
  for (int i = 2; i < polygon.count; ++i) {
    const DVec2 a = polygon.at(0), b = polygon.at(i - 1), c = polygon.at(i);
    const double part = 0.5 * cross2(b - a, c - a);
    m.area += part;
    m.mean += (a + b + c) / 3.0 * part;
  }
  m.mean /= m.area;
  return m;
}

TEST(TexelSample, UniformOverAllFragmentsOfATexel) {
  // Three triangles of different shape share texel (2, 2) with a gap between them.
  const Atlas atlas = hand_made(8, {{DVec2(2, 2), DVec2(2.7, 2), DVec2(2, 2.9)},
                                    {DVec2(2.1, 3), DVec2(3, 2.2), DVec2(5, 5)},
                                    {DVec2(2.75, 2.02), DVec2(2.98, 2.05), DVec2(2.9, 2.15)}});
  const auto map = map_of(atlas);
  const auto it = std::find(map[0].texel.begin(), map[0].texel.end(), 18u);
  ASSERT_NE(it, map[0].texel.end());
  const auto texel = static_cast<std::size_t>(it - map[0].texel.begin());
  DVec2 expected(0);
  double total = 0;
  double share[3] = {};
  for (std::uint32_t t = 0; t < 3; ++t) {
    const Moments m = moments(clip_to_cell(texel_triangle(atlas, t), 2, 2));
    expected += m.mean * std::abs(m.area);
    total += std::abs(m.area);
    share[t] = std::abs(m.area);
  }
  expected /= total;
  Random random;
  DVec2 mean(0);
  double counted[3] = {};
  constexpr int kCount = 200000;
  double bins[4] = {}, bin_area[4] = {};
  for (int n = 0; n < kCount; ++n) {
    const TexelPoint point = sample_texel(atlas, map[0], texel, random.next3());
    const DVec2 p = on_page(atlas, point);
    ASSERT_TRUE(p.x > 2 - 1e-6 && p.x < 3 + 1e-6 && p.y > 2 - 1e-6 && p.y < 3 + 1e-6);
    ASSERT_TRUE(point.barycentric.x >= 0 && point.barycentric.y >= 0 &&
                point.barycentric.x + point.barycentric.y <= 1.000001f);
    mean += p / static_cast<double>(kCount);
    counted[point.triangle] += 1.0 / kCount;
    bins[(p.x > 2.5) + 2 * (p.y > 2.5)] += 1.0 / kCount;
  }
  for (std::uint32_t t = 0; t < 3; ++t) {
    EXPECT_NEAR(counted[t], share[t] / total, 0.005);
    for (int q = 0; q < 4; ++q) {  // quarters of the texel: clip again at half scale
      Triangle2 twice = texel_triangle(atlas, t);
      for (DVec2& p : twice) p *= 2.0;
      // only the part inside the texel: quarter cells are 4..5 in doubled coordinates
      bin_area[q] += area(clip_to_cell(twice, 4 + q % 2, 4 + q / 2)) / 4;
    }
  }
  for (int q = 0; q < 4; ++q) EXPECT_NEAR(bins[q], bin_area[q] / total, 0.005) << q;
  EXPECT_NEAR(mean.x, expected.x, 0.003);
  EXPECT_NEAR(mean.y, expected.y, 0.003);
}

TEST(TexelSample, WholeTexelOfAWall) {
  Scene scene = shapes::empty_scene();
  shapes::add_quad(scene, "wall", {-2, 0, 1}, {4, 0, 0}, {0, 3, 0});
  const Built built = build(scene);
  Random random;
  for (std::size_t i = 0; i < built.map[0].texel.size(); i += 7) {
    const DVec2 cell(built.map[0].texel[i] % built.map[0].width, built.map[0].texel[i] / built.map[0].width);
    DVec2 mean(0);
    for (int n = 0; n < 4000; ++n)
      mean += on_page(built.atlas, sample_texel(built.atlas, built.map[0], i, random.next3())) / 4000.0;
    EXPECT_NEAR(mean.x - cell.x, 0.5, 0.03);
    EXPECT_NEAR(mean.y - cell.y, 0.5, 0.03);
  }
}

TEST(TexelSample, SliversAndSpecks) {
  const std::vector<Triangle2> shapes_{{DVec2(1.5, 2.5), DVec2(5.5, 2.5), DVec2(2.5, 2.5)},
                                       {DVec2(3.3, 3.3), DVec2(3.3, 3.3), DVec2(3.3, 3.3)},
                                       {DVec2(1, 1), DVec2(6, 6), DVec2(3, 3 + 1e-6)},
                                       {DVec2(8, 0), DVec2(8, 8), DVec2(8, 4)}};
  Random random;
  for (const Triangle2& t : shapes_) {
    const Atlas atlas = hand_made(8, {t});
    const auto map = map_of(atlas);
    for (std::size_t i = 0; i < map[0].texel.size(); ++i)
      for (int n = 0; n < 100; ++n) {
        const TexelPoint point = sample_texel(atlas, map[0], i, random.next3());
        const Vec2 w = point.barycentric;
        ASSERT_TRUE(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1.000001f);
        const DVec2 p = on_page(atlas, point);
        const DVec2 cell(map[0].texel[i] % 8, map[0].texel[i] / 8);
        ASSERT_LE(std::max(std::abs(p.x - cell.x - 0.5), std::abs(p.y - cell.y - 0.5)), 0.5 + 1e-5);
      }
  }
}

TEST(TexelSample, EndsOfTheUnitCube) {
  Scene scene = shapes::empty_scene();
  shapes::add_icosphere(scene, "sphere", 1, 3);
  const Built built = build(scene);
  const float top = std::nextafter(1.0f, 0.0f);
  for (std::size_t p = 0; p < built.map.size(); ++p)
    for (std::size_t i = 0; i < built.map[p].texel.size(); ++i)
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 u((corner & 1) ? top : 0, (corner & 2) ? top : 0, (corner & 4) ? top : 0);
        const TexelPoint point = sample_texel(built.atlas, built.map[p], i, u);
        const Vec2 w = point.barycentric;
        ASSERT_TRUE(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1.000001f);
      }
}

}  // namespace
}  // namespace oriel
