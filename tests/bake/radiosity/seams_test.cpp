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
  std::printf(
      "%-24s steps before: mean %.2f %% max %.2f %%  after: mean %.3f %% max %.2f %%  energy %+.4f %%  pairs %zu\n",
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

class SeamsOfRooms : public ::testing::TestWithParam<Estimator> {};
INSTANTIATE_TEST_SUITE_P(Estimators, SeamsOfRooms, ::testing::Values(Estimator::kReference, Estimator::kCached));

// Where later stages are foretold to need what is left of --time they are, until it is over: that takes little.
TEST(SeamsInTime, AreStitchedUntilItIsOver) {
  const Scene scene = tiled_floor();
  for (const bool over : {false, true}) {
    RadiosityOptions options = options_of(Estimator::kCached, 16, true);
    options.left = [] { return -1.0; };
    options.left_of_all = [over] { return over ? 0.0 : 1.0; };
    EXPECT_EQ(bake(scene, 0.1f, options).radiosity.report.seams.pairs > 0, !over);
  }
}

TEST_P(SeamsOfRooms, TilesOfAFloorMeetWithoutSteps) {
  const Scene scene = tiled_floor();
  const Baked raw = bake(scene, 0.1f, options_of(GetParam(), 256, false));
  const Baked b = bake(scene, 0.1f, options_of(GetParam(), 256, true));
  const Steps before = floor_steps(raw), after = floor_steps(b);
  print("tiled floor", before, after, b.radiosity.report.seams);
  EXPECT_GT(before.max, 0.05);
  EXPECT_LE(after.max, 0.02);
}

// Light moves towards the truth, not away from it: the same floor with texels a fifth the size.
TEST(SeamsOnce, StitchedLightIsNearerToTheTruth) {
  const Scene scene = tiled_floor();
  const Baked raw = bake(scene, 0.1f, options_of(Estimator::kReference, 256, false));
  const Baked b = bake(scene, 0.1f, options_of(Estimator::kReference, 256, true));
  const Baked fine = bake(scene, 0.02f, options_of(Estimator::kReference, 64, false));
  double before = 0, after = 0;
  for (int x = 0; x < 3; ++x)
    for (int k = 0; k < 40; ++k)
      for (const int side : {0, 1}) {
        const Vec3 p(kLines[x] + (kLines[x + 1] - kLines[x]) * (static_cast<float>(k) + 0.5f) / 40, 0, kLines[1]);
        const std::uint32_t t = triangle_at(scene, tile(x, side), p);
        const double truth = shown(fine, t, p);
        before += std::pow(shown(raw, t, p) / truth - 1, 2);
        after += std::pow(shown(b, t, p) / truth - 1, 2);
      }
  std::printf("rms error on a seam: %.2f %% before, %.2f %% after\n", 100 * std::sqrt(before / 240),
              100 * std::sqrt(after / 240));
  EXPECT_LT(after, before);
}

// One long edge against two short ones, under a penumbra of some texels: two grids that do not line up cannot both bend
// within one texel.
TEST_P(SeamsOfRooms, LongEdgeMeetsTwoShortOnes) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.quad("long", white, {0, 0, 1}, {2, 0, 0}, {0, 0, -1});
  parts.quad("short a", white, {0, 0, 0}, {0.83f, 0, 0}, {0, 0, -1});
  parts.quad("short b", white, {2, 0, 0}, {0, 0, -1}, {-1.17f, 0, 0});
  parts.box("box", white, {0.6f, 0, 0.2f}, {0.9f, 0.5f, 0.4f});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(30)), {0.2f, 1.5f, 0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f});
  parts.scene().sky = Vec3(0.3f);
  const Scene scene = parts.finish();
  Steps steps[2];
  Baked b;
  for (const bool stitched : {false, true}) {
    b = bake(scene, 0.06f, options_of(GetParam(), 256, stitched));
    measure(b, "long", "short a", {0, 0, 0}, {0.83f, 0, 0}, steps[stitched]);
    measure(b, "long", "short b", {0.83f, 0, 0}, {2, 0, 0}, steps[stitched]);
    measure(b, "short a", "short b", {0.83f, 0, 0}, {0.83f, 0, -1}, steps[stitched]);
  }
  print("T-junction", steps[0], steps[1], b.radiosity.report.seams);
  EXPECT_GT(steps[0].max, 0.02);
  EXPECT_LE(steps[1].max, 0.02);
  EXPECT_EQ(b.radiosity.report.seams.pairs, 3u);
}

// Rim edges of the scene whose two triangles show different places of the lightmap: steps at points of them.
Steps own_steps(const Baked& b) {
  Steps steps;
  const auto place = [&](std::uint32_t t, int c) { return b.atlas.uv[t][c]; };
  for (std::uint32_t t = 0; t < b.scene.triangles.size(); ++t)
    for (std::uint32_t u = t + 1; u < b.scene.triangles.size(); ++u)
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d) {
          const Vec3 &p = b.scene.positions[b.scene.triangles[t][c]],
                     &q = b.scene.positions[b.scene.triangles[t][(c + 1) % 3]];
          if (p != b.scene.positions[b.scene.triangles[u][(d + 1) % 3]] ||
              q != b.scene.positions[b.scene.triangles[u][d]])
            continue;
          if (b.atlas.page[t] == b.atlas.page[u] && glm::distance(place(t, c), place(u, (d + 1) % 3)) < 1e-6f &&
              glm::distance(place(t, (c + 1) % 3), place(u, d)) < 1e-6f)
            continue;
          for (int k = 0; k < 7; ++k) {
            const Vec3 at = p + (q - p) * ((static_cast<float>(k) + 0.5f) / 7);
            steps.add(shown(b, t, at), shown(b, u, at));
          }
        }
  return steps;
}

// A sphere has no flat way onto a page: charts meet in bent seams.
TEST_P(SeamsOfRooms, ChartsOfASphereMeetWithoutSteps) {
  SceneParts parts;
  parts.sphere("sphere", parts.diffuse(Vec3(0.7f)), Vec3(0), 1, 2);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(30)), {1, 3, 1}, {0.5f, 0, 0}, {0, 0, 0.5f});
  parts.scene().sky = Vec3(0.3f);
  const Scene scene = parts.finish();
  const Baked raw = bake(scene, 0.1f, options_of(GetParam(), 256, false)),
              b = bake(scene, 0.1f, options_of(GetParam(), 256, true));
  const Steps before = own_steps(raw), after = own_steps(b);
  print("sphere", before, after, b.radiosity.report.seams);
  EXPECT_GT(before.count, 100);
  EXPECT_GT(before.max, 0.02);
  EXPECT_LE(after.max, 0.02);
}

// A tube of 24 facets with smooth normals, unrolled and so cut open along a line.
TEST_P(SeamsOfRooms, TubeIsClosed) {
  SceneParts parts;
  std::vector<Vec3> positions, normals;
  std::vector<UVec3> triangles;
  constexpr std::uint32_t kSides = 24;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const float a = 2 * kPi * static_cast<float>(i) / kSides;
    for (const float y : {0.0f, 1.5f}) {
      positions.emplace_back(0.5f * std::cos(a), y, 0.5f * std::sin(a));
      normals.emplace_back(std::cos(a), 0, std::sin(a));
    }
    const std::uint32_t v = 2 * i, next = 2 * ((i + 1) % kSides);
    triangles.emplace_back(v, v + 1, next + 1);
    triangles.emplace_back(v, next + 1, next);
  }
  parts.mesh("tube", parts.diffuse(Vec3(0.7f)), positions, normals, triangles);
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(30)), {1, 3, 1}, {0.5f, 0, 0}, {0, 0, 0.5f});
  parts.scene().sky = Vec3(0.3f);
  const Scene scene = parts.finish();
  const Baked raw = bake(scene, 0.1f, options_of(GetParam(), 256, false)),
              b = bake(scene, 0.1f, options_of(GetParam(), 256, true));
  const Steps before = own_steps(raw), after = own_steps(b);
  print("tube", before, after, b.radiosity.report.seams);
  EXPECT_GT(before.max, 0.01);
  EXPECT_LE(after.max, 0.02);
}

void add_lit_corner(SceneParts& parts) {
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(30)), {0.2f, 1.5f, 0.3f}, {0.3f, 0, 0}, {0, 0, 0.3f});
}

// A floor and a wall meet at a right angle, and so do the faces of a box: nothing is touched.
TEST_P(SeamsOfRooms, RealCornersAreLeftAlone) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.quad("floor", white, {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  parts.quad("wall", white, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.box("box", white, {0.5f, 0, 0.4f}, {0.8f, 0.3f, 0.7f});
  // A roof of two slopes that meet at 20°, without smooth normals: light does step there.
  parts.quad("slope a", white, {0, 1, -1}, {1, 0, 0}, {0, 0.1f, -0.5f});
  parts.quad("slope b", white, {0, 1.1f, -1.5f}, {1, 0, 0}, {0, -0.1f, -0.5f});
  add_lit_corner(parts);
  const Scene scene = parts.finish();
  const Baked raw = bake(scene, 0.1f, options_of(GetParam(), 64, false)),
              b = bake(scene, 0.1f, options_of(GetParam(), 64, true));
  EXPECT_EQ(b.radiosity.report.seams.pairs, 0u);
  EXPECT_EQ(raw.radiosity.pages[0].irradiance, b.radiosity.pages[0].irradiance);
}

// The floors of two rooms meet under the wall that parts them, thin (one quad) or thick: no light goes through.
TEST_P(SeamsOfRooms, LightDoesNotLeakUnderAWall) {
  for (const float thickness : {0.0f, 0.04f, 0.25f}) {
    SceneParts parts;
    const auto white = parts.diffuse(Vec3(0.7f));
    parts.quad("bright", white, {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
    parts.quad("dark", white, {1, 0, 1}, {1, 0, 0}, {0, 0, -1});
    if (thickness > 0)
      parts.box("wall", white, {1 - 0.5f * thickness, 0, 0}, {1 + 0.5f * thickness, 2, 1});
    else
      parts.quad("wall", white, {1, 0, 0}, {0, 0, 1}, {0, 2, 0});
    add_lit_corner(parts);
    const Scene scene = parts.finish();
    const Baked raw = bake(scene, 0.1f, options_of(GetParam(), 64, false)),
                b = bake(scene, 0.1f, options_of(GetParam(), 64, true));
    EXPECT_EQ(b.radiosity.report.seams.pairs, 0u) << thickness;
    EXPECT_EQ(raw.radiosity.pages[0].irradiance, b.radiosity.pages[0].irradiance) << thickness;
  }
}

// Two sheets on one another, and two that meet but face opposite ways, do not go on into each other.
TEST(SeamsOnce, SheetsThatFaceElsewhereAreLeftAlone) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.quad("up", white, {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  parts.quad("down beside", white, {1, 0, 0}, {1, 0, 0}, {0, 0, 1});
  parts.quad("up above", white, {0, 0.5f, 1}, {1, 0, 0}, {0, 0, -1});
  add_lit_corner(parts);
  const Baked b = bake(parts.finish(), 0.1f, options_of(Estimator::kReference, 64, true));
  EXPECT_EQ(b.radiosity.report.seams.pairs, 0u);
}

TEST_P(SeamsOfRooms, ExtremesStayFinite) {
  for (const float emission : {0.0f, 1e-20f, 1e20f}) {
    SceneParts parts;
    const auto white = parts.diffuse(Vec3(0.7f));
    for (int i = 0; i < 2; ++i) parts.quad(tile(i, 0), white, {static_cast<float>(i), 0, 1}, {1, 0, 0}, {0, 0, -1});
    parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(emission)), {0.7f, 1, 0.5f}, {0.3f, 0, 0}, {0, 0, 0.3f});
    const Baked b = bake(parts.finish(), 0.1f, options_of(GetParam(), 16, true));
    for (const Vec3& e : b.radiosity.pages[0].irradiance) ASSERT_TRUE(is_finite(e) && e.r >= 0 && e.g >= 0 && e.b >= 0);
    EXPECT_TRUE(std::isfinite(b.radiosity.report.seams.energy_change));
  }
}

TEST_P(SeamsOfRooms, OneAndTwoThreadsGiveTheSameBytes) {
  const Scene scene = tiled_floor();
  const Baked a = bake(scene, 0.1f, options_of(GetParam(), 16, true), 1),
              b = bake(scene, 0.1f, options_of(GetParam(), 16, true), 2);
  EXPECT_EQ(a.radiosity.pages[0].irradiance, b.radiosity.pages[0].irradiance);
  EXPECT_EQ(a.radiosity.report.seams.mean_step, b.radiosity.report.seams.mean_step);
  EXPECT_NEAR(a.radiosity.report.seams.energy_change, 0, 0.005);
}

}  // namespace
}  // namespace oriel
