// Samplers, warps and BSDFs: every sampler against its pdf by χ², energy against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bake/trace/albedo.h"
#include "bake/trace/bsdf.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "tests/bake/support/chi2.h"

namespace oriel {
namespace {

using test::chi2_excess;

TEST(Sampler, IsAFunctionOfItsArguments) {
  Sampler a(1, 2, 3), b(1, 2, 3), c(1, 2, 4), d(2, 2, 3);
  EXPECT_EQ(a.next1(), b.next1());
  EXPECT_EQ(a.next2(), b.next2());
  EXPECT_NE(c.next1(), d.next1());
}

// 256 points of a (0,2)-sequence: one in each of 16 × 16 cells, one in each of 256 columns and rows.
template <class Point>
void expect_net(const Point& point) {
  std::set<int> cells, columns, rows;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const Vec2 p = point(i);
    ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    cells.insert(static_cast<int>(p.x * 16) * 16 + static_cast<int>(p.y * 16));
    columns.insert(static_cast<int>(p.x * 256));
    rows.insert(static_cast<int>(p.y * 256));
  }
  EXPECT_EQ(cells.size(), 256u);
  EXPECT_EQ(columns.size(), 256u);
  EXPECT_EQ(rows.size(), 256u);
}

TEST(Sampler, PairsAreStratified) {
  for (int pair = 0; pair < 5; ++pair)
    expect_net([pair](std::uint32_t i) {
      Sampler sampler(7, 9, i);
      for (int skip = 0; skip < pair; ++skip) sampler.next2();
      return sampler.next2();
    });
}

TEST(ShiftedNet, EveryStreamIsANetOfItsOwn) {
  const ShiftedNet net(7, 256);
  for (std::uint64_t stream = 0; stream < 5; ++stream) {
    const UVec2 shift = net.shift(stream);
    expect_net([&](std::uint32_t i) { return net.point(i, shift); });
    EXPECT_NE(shift, net.shift(stream + 1));
  }
}

// Streams share the sequence, not its error: the mean of one point over many streams is that of the square.
TEST(ShiftedNet, StreamsAreIndependent) {
  const ShiftedNet net(3, 1);
  DVec2 mean(0);
  for (std::uint64_t stream = 0; stream < 40000; ++stream) mean += DVec2(net.point(0, net.shift(stream))) / 40000.0;
  EXPECT_NEAR(mean.x, 0.5, 0.006);  // four standard errors
  EXPECT_NEAR(mean.y, 0.5, 0.006);
}

TEST(Warp, CosineHemisphereMatchesItsPdf) {
  const auto draw = [](float, const Vec2& v) { return std::optional<Vec3>(square_to_cosine_hemisphere(v)); };
  EXPECT_LT(chi2_excess(draw, [](const Vec3& w) { return cosine_hemisphere_pdf(w.z); }), 5);
  EXPECT_GT(chi2_excess(draw, [](const Vec3&) { return 1 / (2 * kPi); }), 20) << "the checker must see a wrong pdf";
}

TEST(Warp, TriangleIsUniform) {
  DVec2 mean(0);
  for (std::uint32_t i = 0; i < 4096; ++i) {
    Sampler sampler(3, 4, i);
    const Vec2 b = square_to_triangle(sampler.next2());
    ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
    mean += DVec2(b) / 4096.0;
  }
  EXPECT_NEAR(mean.x, 1.0 / 3, 2e-3);
  EXPECT_NEAR(mean.y, 1.0 / 3, 2e-3);
}

class BsdfAlpha : public ::testing::TestWithParam<std::pair<float, float>> {};

TEST_P(BsdfAlpha, SamplingMatchesPdf) {
  const auto [alpha, cos_o] = GetParam();
  ShadePoint point;
  point.diffuse = Vec3(0.3f);
  point.f0 = Vec3(0.5f);
  point.alpha = alpha;
  const Vec3 wo(std::sqrt(1 - cos_o * cos_o), 0, cos_o);
  const auto draw = [&](float u, const Vec2& v) -> std::optional<Vec3> {
    const auto s = Bsdf(point, wo).sample(u, v);
    if (!s) return std::nullopt;
    EXPECT_NEAR(s->pdf, Bsdf(point, wo).pdf(s->wi), 1e-3f * s->pdf);
    return s->wi;
  };
  EXPECT_LT(chi2_excess(draw, [&](const Vec3& wi) { return Bsdf(point, wo).pdf(wi); }), 6);
}
INSTANTIATE_TEST_SUITE_P(Lobes, BsdfAlpha,
                         ::testing::Values(std::pair{1.0f, 0.9f}, std::pair{0.4f, 0.7f}, std::pair{0.25f, 0.3f}));

// A white surface under uniform light never sends out more than it receives: lobes and albedo table agree.
TEST(Bsdf, FurnaceNeverExceedsOne) {
  for (const float roughness : {0.0f, 0.01f, 0.1f, 0.3f, 0.6f, 1.0f})
    for (const float cos_o : {0.02f, 0.1f, 0.5f, 1.0f})
      for (const float f0 : {0.0f, 0.04f, 1.0f}) {
        ShadePoint point;
        point.diffuse = Vec3(1);
        point.f0 = Vec3(f0);
        point.f90 = f0 > 0 ? 1.0f : 0.0f;
        point.alpha = roughness * roughness;
        const Vec3 wo(std::sqrt(1 - cos_o * cos_o), 0, cos_o);
        double sum = 0;
        constexpr std::uint32_t kSamples = 4096;
        for (std::uint32_t i = 0; i < kSamples; ++i) {
          Sampler sampler(5, 6, i);
          const float u = sampler.next1();
          const auto s = Bsdf(point, wo).sample(u, sampler.next2());
          if (!s) continue;
          ASSERT_TRUE(is_finite(s->weight));
          sum += s->weight.g;
        }
        const double albedo = sum / kSamples;
        const double diffuse_part = 1 - reflectance(point, cos_o).g;
        EXPECT_LE(albedo, 1.005) << roughness << " " << cos_o << " " << f0;
        EXPECT_NEAR(albedo, diffuse_part + reflectance(point, cos_o).g, 0.015)
            << roughness << " " << cos_o << " " << f0;
      }
}

}  // namespace
}  // namespace oriel
