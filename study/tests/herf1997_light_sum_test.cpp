// Weights of samples and texels, in closed form and one by one in double precision.
#include <gtest/gtest.h>

#include "study/herf1997/equal_weights.h"
#include "study/tests/herf1997_exact_rays.h"

namespace oriel::study {
namespace {

double weight(const ShadowReceiver& receiver, const ShadowLight& light, std::size_t s, const DVec3& p) {
  const DVec3 to = light.samples[s].position - p;
  double cosine = -glm::dot(light.normal, to);
  if (light.double_sided) cosine = std::abs(cosine);
  const double r2 = glm::dot(to, to);
  return std::max(0.0, cosine) * std::max(0.0, glm::dot(receiver.normal, to)) / (r2 * r2);
}

// The largest difference from the sum over samples in double precision, over the largest light without shadows.
double error_of(const ShadowReceiver& receiver, const ShadowLight& light, const Occluders& occluders, Simd simd) {
  SoftShadows shadows({.simd = simd});
  std::vector<float> out;
  shadows.run(occluders, receiver, light, out);
  const OccluderView view = shadows.view(occluders, receiver, light);
  const BlockedRows& rows = shadows.block(view, receiver);
  double worst = 0, most = 0;
  for (int y = 0; y < receiver.height; ++y)
    for (int x = 0; x < receiver.width; ++x) {
      double sum = 0, open = 0;
      for (std::size_t s = 0; s < view.apexes.size(); ++s) {
        const double part = double{light.samples[view.apex_of[s]].power} *
                            weight(receiver, light, view.apex_of[s], receiver.center_of(x, y));
        open += part;
        if (!rows.blocked(static_cast<int>(s), x, y)) sum += part;
      }
      worst = std::max(worst, std::abs(double{out[y * receiver.width + x]} - sum)), most = std::max(most, open);
    }
  return worst / most;
}

Occluders some_boxes(double size) {
  ShadowScene scene;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0.1, 0.9);
  for (int k = 0; k < 12; ++k) {
    const DVec3 at = DVec3(u(random), u(random), u(random)) * size;
    scene.add_box(at, at + DVec3(0.06 * size));
  }
  return {scene.points, scene.triangles};
}

class LightSums : public ::testing::TestWithParam<double> {};

TEST_P(LightSums, AreThoseOfEverySample) {
  const double scale = GetParam();
  for (const int samples : {1, 7, 64, 65}) {
    // A skewed receiver away from the origin and a tilted light over it.
    const ShadowReceiver receiver = make_shadow_receiver(scale * DVec3(-0.1, 0.05, 0.0), scale * DVec3(1.0, 0.1, 0.02),
                                                         scale * DVec3(0.2, 0.9, -0.01), {100, 70}, DVec3(0, 0, 1));
    ShadowLight light = sample_parallelogram(
        {scale * DVec3(0.4, 0.3, 1.0), scale * DVec3(0.1, 0.3, 0.1), scale * DVec3(0.3, -0.1, 0.05)}, 3, samples);
    const Occluders boxes = some_boxes(scale);
    for (const Simd simd : {Simd::kBaseline, Simd::kAvx2, Simd::kAvx512}) {
      if (simd > best_simd()) continue;
      EXPECT_LT(error_of(receiver, light, boxes, simd), 2e-6) << samples;
      EXPECT_LT(error_of(receiver, light, {}, simd), 2e-6) << samples;
    }
    std::mt19937 random(5);  // samples of their own strength
    for (ShadowLightSample& s : light.samples) s.power *= static_cast<float>(random() % 7);
    EXPECT_LT(error_of(receiver, light, boxes, best_simd()), 2e-6) << samples;
  }
}
INSTANTIATE_TEST_SUITE_P(Scales, LightSums, ::testing::Values(1e-4, 1.0, 1e6));

// Herf 1997, section 3.2: the projective matrix that takes the pyramid from `apex` over the receiver to a box. Along x
// and y it is 0 to 1 over the receiver. z is 1 in its plane, grows towards the apex and is infinite there. All apexes
// share the image of the receiver, so that hard shadows of many lights lie upon each other.
DMat4 pyramid_to_box(const ShadowReceiver& receiver, const DVec3& apex) {
  const DVec3 ex = receiver.x * static_cast<double>(receiver.width), &b = receiver.corner;
  const DVec3 ey = receiver.y * static_cast<double>(receiver.height), ew = b - apex;
  const DVec3 nx = glm::cross(ew, ey), ny = glm::cross(ex, ew), nw = glm::cross(ey, ex);
  const auto row = [](const DVec3& n, double length, const DVec3& zero) {
    return DVec4(n / length, -glm::dot(n, zero) / length);
  };
  return glm::transpose(DMat4(row(nx, glm::dot(nx, ex), b), row(ny, glm::dot(ny, ey), b), DVec4(0, 0, 0, 1),
                              row(nw, glm::dot(nw, ew), apex)));
}

TEST(LightSum, OfALowLightIsSummedInFull) {
  const ShadowReceiver receiver =
      make_shadow_receiver(DVec3(0), DVec3(4, 0, 0), DVec3(0, 4, 0), {64, 64}, DVec3(0, 0, 1));
  const ShadowLight light = sample_parallelogram({{1, 1, 0.02}, {0, 1, 0}, {1, 0, 0.3}}, 1, 16);
  EXPECT_LT(error_of(receiver, light, {}, best_simd()), 4e-6);
}

TEST(LightSum, IsTheSameOnEveryInstructionSet) {
  const ShadowReceiver receiver =
      make_shadow_receiver(DVec3(0), DVec3(4, 0, 0), DVec3(0, 4, 0), {70, 50}, DVec3(0, 0, 1));
  const ShadowLight light = sample_parallelogram({{1, 1, 3}, {0, 1, 0}, {1, 0, 0.3}, true}, 1, 40);
  const Occluders boxes = some_boxes(3);
  std::vector<float> first, now;
  SoftShadows({.simd = Simd::kBaseline}).run(boxes, receiver, light, first);
  for (const Simd simd : {Simd::kAvx2, Simd::kAvx512}) {
    if (simd > best_simd()) continue;
    SoftShadows({.simd = simd}).run(boxes, receiver, light, now);
    EXPECT_EQ(now, first);
  }
}

// Lambert's form of the whole light is what samples converge to.
TEST(LightSum, ConvergesToTheClosedForm) {
  const ShadowReceiver receiver =
      make_shadow_receiver(DVec3(0), DVec3(4, 0, 0), DVec3(0, 4, 0), {64, 64}, DVec3(0, 0, 1));
  const std::array<DVec3, 4> corners{DVec3(1, 1, 2), {1, 3, 2}, {3, 3, 2}, {3, 1, 2}};  // shines down
  const std::vector<float> exact = form_factor_light(receiver, corners, 1);
  std::array<double, 2> error{};
  for (int k = 0; k < 2; ++k) {
    const ShadowLight light = sample_parallelogram({corners[0], {0, 2, 0}, {2, 0, 0}}, 1, k == 0 ? 16 : 1024);
    std::vector<float> out;
    SoftShadows().run({}, receiver, light, out);
    for (std::size_t i = 0; i < exact.size(); ++i) error[k] = std::max(error[k], std::abs(out[i] / exact[i] - 1.0));
  }
  EXPECT_LT(error[0], 0.1);
  EXPECT_LT(error[1], 3e-3);
  // A corner of the cube that a unit square over a point makes: 0.1385 · π (form factor of two parallel squares'
  // corner).
  const std::array<DVec3, 4> unit{DVec3(0, 0, 1), {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const ShadowReceiver point =
      make_shadow_receiver(DVec3(-0.5, -0.5, 0), DVec3(1, 0, 0), DVec3(0, 1, 0), {1, 1}, DVec3(0, 0, 1));
  EXPECT_NEAR(form_factor_light(point, unit, 1)[0], std::atan(1 / std::sqrt(2.0)) / std::sqrt(2.0), 1e-6);
}

// Halves of the distance between its points take the error of a bilinear surface to a quarter.
TEST(LightSum, FormFactorsBetweenTexelsAreOfSecondOrder) {
  const ShadowReceiver receiver =
      make_shadow_receiver(DVec3(0), DVec3(4, 0, 0), DVec3(0, 4, 0), {67, 64}, DVec3(0, 0, 1));
  const std::array<DVec3, 4> corners{DVec3(1, 1, 2), {1, 3, 2}, {3, 3, 2}, {3, 1, 2}};
  const std::vector<float> exact = form_factor_light(receiver, corners, 1);
  const auto error = [&](int every) {
    const std::vector<float> coarse = form_factor_light(receiver, corners, every);
    double worst = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) worst = std::max(worst, std::abs(coarse[i] / exact[i] - 1.0));
    return worst;
  };
  EXPECT_GT(error(8), 0.001);
  EXPECT_NEAR(error(8) / error(4), 4, 1);
  EXPECT_NEAR(error(4) / error(2), 4, 1);
}

TEST(Receiver, PyramidToBoxIsThePapersAndTheSpacesOwn) {
  const ShadowReceiver r = make_shadow_receiver({1, 2, 3}, {2, 0.5, 0}, {0.3, 3, 1}, {10, 20}, {0, 0, 1});
  const DVec3 apex(2, 1, 9);
  const DMat4 m = pyramid_to_box(r, apex);
  const ReceiverSpace space(r);
  for (const DVec3& p : {DVec3(1, 2, 3), DVec3(2, 3, 5), DVec3(-1, 4, 6)}) {
    const DVec4 q = m * DVec4(p, 1);
    const DVec2 seen = seen_at(space(apex), space(p));
    EXPECT_NEAR(q.x / q.w * 10, seen.x, 1e-12);
    EXPECT_NEAR(q.y / q.w * 20, seen.y, 1e-12);
  }
  EXPECT_NEAR((m * DVec4(apex, 1)).w, 0, 1e-12);
  const DVec4 far = m * DVec4(r.corner + 10.0 * r.x + 20.0 * r.y, 1);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(far[k], 1, 1e-12);
}

TEST(LightPattern, CellsHoldOnePointEach) {
  for (const int n : {1, 4, 16, 64, 65, 1024}) {
    const std::vector<DVec2> points = jittered_pattern(n);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(points, jittered_pattern(n));  // fixed
    DVec2 mean(0);
    for (const DVec2& p : points) mean += p / static_cast<double>(n);
    EXPECT_NEAR(mean.x, 0.5, 0.5 / std::sqrt(n));
    EXPECT_NEAR(mean.y, 0.5, 0.5 / std::sqrt(n));
    if (const int side = static_cast<int>(std::sqrt(n)); side * side == n) {
      std::vector<int> cells(static_cast<std::size_t>(n));
      for (const DVec2& p : points) ++cells[static_cast<int>(p.x * side) * side + static_cast<int>(p.y * side)];
      EXPECT_EQ(cells, std::vector<int>(static_cast<std::size_t>(n), 1));
    }
  }
}

TEST(LightPattern, TrianglesShareTheAreaOfTheLight) {
  const ShadowLight light =
      sample_triangles({{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}}, {{0, 0, 1}, {2, 2, 1}, {0, 2, 1}}}, 5, 33);
  EXPECT_EQ(light.samples.size(), 33u);
  double sum = 0;
  for (const ShadowLightSample& s : light.samples) sum += double{s.power};
  EXPECT_NEAR(sum, 20, 1e-4);
}

}  // namespace
}  // namespace oriel::study
