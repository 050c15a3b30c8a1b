// Pixels share light with those on their surface, however small or bent it is, and with no others.
#include <gtest/gtest.h>

#include "preview/frame/neighbours.h"

namespace oriel {
namespace {

constexpr int kSize = 48;

// Seen from above, a pixel a metre, each on a triangle of its own: what place(x, y) and normal(x, y) say.
template <typename Height, typename Normal>
SeenPoints seen(Height height, Normal normal) {
  SeenPoints out{kSize, kSize, {}, {}, {}};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const auto u = static_cast<float>(x), v = static_cast<float>(y);
      out.place.emplace_back(u, v, height(u, v), static_cast<float>(y * kSize + x + 1));
      out.face.emplace_back(normal(u, v), 0);
      out.normal.emplace_back(normal(u, v), 0);
    }
  return out;
}

// Each pixel has taken one of nine points, of which one alone shines: all of the light is 9 of one pixel in nine.
std::vector<Vec4> one_of_nine() {
  std::vector<Vec4> sums;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) sums.emplace_back(x % 3 == 0 && y % 3 == 0 ? 1.0f : 0.0f, 0, 0, 1);
  return sums;
}

// A standing cylinder of so many pixels' radius, seen from the side: what is off its middle by less than 0.9 radii.
void expect_even_on_cylinder(float radius) {
  const float middle = 0.5f * kSize;
  const auto across = [=](float x) { return std::clamp((x - middle) / radius, -0.97f, 0.97f); };
  const SeenPoints points =
      seen([&](float x, float) { return radius * std::sqrt(1 - across(x) * across(x)); },
           [&](float x, float) { return Vec3(across(x), 0, std::sqrt(1 - across(x) * across(x))); });
  Context context;
  const auto light = *Neighbours(points).gathered(one_of_nine(), 9, true, context);
  double sum = 0, squares = 0, count = 0;
  for (int y = 8; y < kSize - 8; ++y)
    for (int x = 0; x < kSize; ++x) {
      if (std::abs(static_cast<float>(x) - middle) > 0.9f * radius) continue;
      const double v = double{light[static_cast<std::size_t>(y * kSize + x)].x};
      sum += v, squares += v * v, ++count;
    }
  const double mean = sum / count, scatter = std::sqrt(squares / count - mean * mean) / mean;
  std::printf("a cylinder of %.0f pixels' radius: mean %.2f, scatter %.2f\n", double{radius}, mean, scatter);
  EXPECT_NEAR(mean, 1, 0.01);
  EXPECT_LT(scatter, 0.05);  // own points alone: 2.8
}

TEST(Neighbours, AreFoundOnSmallColumns) {
  for (const float radius : {4.0f, 8.0f, 20.0f}) expect_even_on_cylinder(radius);
}

TEST(Neighbours, AreExactOnAFloor) {
  const SeenPoints points = seen([](float, float) { return 0.0f; }, [](float, float) { return Vec3(0, 0, 1); });
  Context context;
  const auto light = *Neighbours(points).gathered(one_of_nine(), 9, true, context);
  for (int y = 1; y < kSize - 1; ++y)
    for (int x = 1; x < kSize - 1; ++x) EXPECT_NEAR(light[static_cast<std::size_t>(y * kSize + x)].x, 1, 1e-5f);
}

// A step, and a corner of two walls: no light crosses, neither by sharing nor by smoothing.
TEST(Neighbours, NeverCrossEdges) {
  const auto left = [](float x) { return x < 24; };
  const Vec3 up(0, 0, 1), aslant = glm::normalize(Vec3(-1, 0, 1));
  const SeenPoints step = seen([&](float x, float) { return left(x) ? 0.0f : 0.5f; }, [&](float, float) { return up; });
  const SeenPoints corner = seen([&](float x, float) { return left(x) ? 0.0f : x - 24; },
                                 [&](float x, float) { return left(x) ? up : aslant; });
  Context context;
  for (const SeenPoints* points : {&step, &corner}) {
    std::vector<Vec4> sums;
    for (int i = 0; i < kSize * kSize; ++i) sums.emplace_back(i % kSize < 24 ? 0.0f : 1.0f, 0, 0, 1);
    const Neighbours neighbours(*points);
    auto light = *neighbours.gathered(sums, 9, true, context);
    for (const std::size_t apart : {std::size_t{3}, std::size_t{6}})
      light = *neighbours.smoothed(light, apart, context);
    for (int i = 0; i < kSize * kSize; ++i)
      EXPECT_NEAR(light[static_cast<std::size_t>(i)].x, i % kSize < 24 ? 0.0f : 9.0f, 1e-4f) << i;
  }
}

}  // namespace
}  // namespace oriel
