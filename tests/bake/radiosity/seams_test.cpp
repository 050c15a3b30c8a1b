// Light across seams of the lightmap, read as a player reads it: bilinearly, from both sides.
#include <gtest/gtest.h>

#include <cstdio>

#include "formats/core/color.h"
#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::bake;
using test::Baked;
using test::SceneParts;

RadiosityOptions options_of(Estimator estimator, std::uint32_t samples, bool stitched) {
  RadiosityOptions o;
  o.estimator = estimator;
  o.samples = samples;
  o.stitch = stitched;
  return o;
}

float bilinear(const LightmapPage& page, const Vec2& uv) {
  const Vec2 p = uv * Vec2(page.width, page.height) - 0.5f, low = glm::floor(p), f = p - low;
  float sum = 0;
  for (int i = 0; i < 4; ++i) {
    const int right = i & 1, down = i >> 1;
    const int x = std::clamp(static_cast<int>(low.x) + right, 0, static_cast<int>(page.width) - 1),
              y = std::clamp(static_cast<int>(low.y) + down, 0, static_cast<int>(page.height) - 1);
    sum += (right ? f.x : 1 - f.x) * (down ? f.y : 1 - f.y) *
           luminance(page.irradiance[static_cast<std::size_t>(y) * page.width + static_cast<std::size_t>(x)]);
  }
  return sum;
}

// What triangle `t` shows at point p of it.
float shown(const Baked& b, std::uint32_t t, const Vec3& p) {
  const UVec3& v = b.scene.triangles[t];
  const DVec3 o(b.scene.positions[v.x]), e = DVec3(b.scene.positions[v.y]) - o, f = DVec3(b.scene.positions[v.z]) - o,
                                         q = DVec3(p) - o, n = glm::cross(e, f);
  const double s = glm::dot(glm::cross(q, f), n) / glm::dot(n, n), r = glm::dot(glm::cross(e, q), n) / glm::dot(n, n);
  const auto& uv = b.atlas.uv[t];
  const Vec2 at = uv[0] + (uv[1] - uv[0]) * static_cast<float>(s) + (uv[2] - uv[0]) * static_cast<float>(r);
  return bilinear(b.radiosity.pages[static_cast<std::size_t>(b.atlas.page[t])], at);
}

// The triangle of a surface whose rim, or inside, p lies on.
std::uint32_t triangle_at(const Scene& scene, const std::string& name, const Vec3& p) {
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (scene.surfaces[scene.triangle_surface[t]].name != name) continue;
    double area = 0;
    for (int c = 0; c < 3; ++c) {
      const Vec3 &a = scene.positions[scene.triangles[t][c]], &b = scene.positions[scene.triangles[t][(c + 1) % 3]];
      area += 0.5 * glm::length(glm::cross(DVec3(a) - DVec3(p), DVec3(b) - DVec3(p)));
    }
    if (area <= triangle_area(scene, t) * 1.00001) return t;
  }
  ADD_FAILURE() << name << " has no such point";
  return 0;
}

struct Steps {
  double mean = 0, max = 0;
  int count = 0;

  void add(double a, double b) {
    const double step = a + b > 0 ? std::abs(a - b) / (0.5 * (a + b)) : 0;
    mean = (mean * count + step) / (count + 1);
    max = std::max(max, step);
    ++count;
  }
};

// Steps between two surfaces along the segment from a to b.
void measure(const Baked& baked, const std::string& one, const std::string& other, const Vec3& a, const Vec3& b,
             Steps& steps) {
  for (int k = 0; k < 97; ++k) {
    const Vec3 p = a + (b - a) * ((static_cast<float>(k) + 0.5f) / 97);
    steps.add(shown(baked, triangle_at(baked.scene, one, p), p), shown(baked, triangle_at(baked.scene, other, p), p));
  }
}

void print(const char* what, const Steps& before, const Steps& after, const SeamReport& report) {
  std::printf("%-24s steps before: mean %.2f %% max %.2f %%  after: mean %.3f %% max %.2f %%  energy %+.4f %%  pairs %zu\n",
              what, 100 * before.mean, 100 * before.max, 100 * after.mean, 100 * after.max, 100 * report.energy_change,
              report.pairs);
}

std::string tile(int x, int z) {
  return "tile " + std::to_string(x) + std::to_string(z);
}

// 3 x 3 quads that meet exactly, of different sizes and turned differently, so that no texels of two of them line up.
constexpr std::array<float, 4> kLines{0, 0.93f, 2.1f, 3};

Scene tiled_floor() {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  for (int z = 0; z < 3; ++z)
    for (int x = 0; x < 3; ++x) {
      const float x0 = kLines[x], x1 = kLines[x + 1], z0 = kLines[z], z1 = kLines[z + 1];
      if ((x + z) % 2 == 0)
        parts.quad(tile(x, z), white, {x0, 0, z1}, {x1 - x0, 0, 0}, {0, 0, z0 - z1});
      else
        parts.quad(tile(x, z), white, {x1, 0, z1}, {0, 0, z0 - z1}, {x0 - x1, 0, 0});
    }
  parts.box("box", white, {1.5f, 0, 1.2f}, {1.8f, 0.7f, 1.5f});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(30)), {0.4f, 2, 0.9f}, {0.3f, 0, 0}, {0, 0, 0.3f});
  return parts.finish();
}

Steps floor_steps(const Baked& b) {
  Steps steps;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) {
      const float line = kLines[k + 1];
      measure(b, tile(k, i), tile(k + 1, i), {line, 0, kLines[i]}, {line, 0, kLines[i + 1]}, steps);
      measure(b, tile(i, k), tile(i, k + 1), {kLines[i], 0, line}, {kLines[i + 1], 0, line}, steps);
    }
  return steps;
}

class Seams : public testing::TestWithParam<Estimator> {};
INSTANTIATE_TEST_SUITE_P(Estimators, Seams, testing::Values(Estimator::kReference, Estimator::kCached));

TEST_P(Seams, TilesOfAFloorMeetWithoutSteps) {
  const Scene scene = tiled_floor();
  const Baked raw = bake(scene, 0.1f, options_of(GetParam(), 256, false));
  const Baked b = bake(scene, 0.1f, options_of(GetParam(), 256, true));
  const Steps before = floor_steps(raw), after = floor_steps(b);
  print("tiled floor", before, after, b.radiosity.report.seams);
  EXPECT_GT(before.max, 0.05);
  EXPECT_LE(after.max, 0.02);
}

}  // namespace
}  // namespace oriel
