// Finer cells: which are chosen, that nothing steps between them, and that shadows come nearer to the truth.
#include "bake/radiosity/estimators/blocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bake/radiosity/estimators/cells.h"
#include "bake/radiosity/radiosity.h"
#include "bake/radiosity/texels/texel_paths.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

Scene bare_floor() {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
  return parts.finish();
}

// The floor's page with that light at each texel's centre, in texels from the chart's corner.
template <class Light>
LightmapPage lit(const Listed& floor, const Light& light, float standard_error) {
  const TexelMapPage& map = floor.map[0];
  const std::size_t size = std::size_t{map.width} * map.height;
  LightmapPage page{map.width, map.height, std::vector<Vec3>(size), std::vector<Vec3>(size, Vec3(standard_error)),
                    std::vector<TexelState>(size)};
  for (const std::uint32_t t : map.texel) {
    page.state[t] = TexelState::kValid;
    page.irradiance[t] = Vec3(light(static_cast<float>(t % map.width), static_cast<float>(t / map.width)));
  }
  return page;
}

CellLevels chosen(const Listed& floor, const LightmapPage& page, const CellGoal& goal,
                  const std::vector<std::vector<bool>>& at_seam = {}) {
  const std::vector<float> importance(floor.map[0].texel.size(), 1.0f);
  Radiosity light;
  light.at_seam = at_seam;
  light.pages.push_back(page);
  light.visible.emplace_back(importance.size(), 1.0f);
  const std::vector<char> occlusion_heavy(importance.size());
  return choose_cells(light.pages,
                      find_cells(floor.atlas, floor.map, light, {importance, occlusion_heavy, {}, {}}, goal), goal);
}

std::size_t count(const CellLevels& levels, std::uint8_t level) {
  return static_cast<std::size_t>(std::count(levels[0].begin(), levels[0].end(), level));
}

TEST(DetailCells, AreChosenAlongEdgesAndNotOnSlopes) {
  const Listed floor(bare_floor(), 0.1f);
  const CellGoal goal{.error = 0.02, .floor = 10, .most_points = 1 << 20};
  const auto slope = lit(
      floor, [](float x, float y) { return 100 + 20 * x + 10 * y; }, 0);
  EXPECT_EQ(count(chosen(floor, slope, goal), 0), slope.state.size()) << "linear light needs no more";
  const auto edge = lit(
      floor, [](float x, float) { return x < 16 ? 100.0f : 400.0f; }, 0);
  const CellLevels levels = chosen(floor, edge, goal);
  EXPECT_GT(count(levels, 3), 60) << "two rows of thirty cells and more beside the edge";
  for (std::uint32_t place = 0; place < levels[0].size(); ++place)
    if (levels[0][place] > 0) {
      EXPECT_NEAR(static_cast<double>(place % edge.width), 15, 2.01);
    }
  const auto noisy = lit(
      floor, [](float x, float) { return x < 16 ? 100.0f : 400.0f; }, 150);
  EXPECT_EQ(count(chosen(floor, noisy, goal), 0), noisy.state.size()) << "which may be noise";
}

TEST(DetailCells, AlongAnEdgeHaveAsManySteps) {
  const Listed floor(bare_floor(), 0.1f);
  const CellGoal goal{.error = 0.02, .floor = 1, .most_points = 1 << 20};
  const auto edge = lit(
      floor, [](float x, float y) { return x < 16                   ? 100.0f
                                           : std::fmod(y, 8.0f) < 4 ? 132.0f
                                                                    : 122.0f; }, 0);
  const CellLevels levels = chosen(floor, edge, goal);
  for (std::uint32_t y = 3; y < 27; ++y) EXPECT_EQ(levels[0][y * edge.width + 15], 2) << y;
}

TEST(DetailCells, KeepToTheirPoints) {
  const Listed floor(bare_floor(), 0.1f);
  const auto edge = lit(
      floor, [](float x, float) { return x < 16 ? 100.0f : 400.0f; }, 0);
  CellGoal goal{.error = 0.02, .floor = 10, .most_points = 1000};
  const CellLevels few = chosen(floor, edge, goal);
  EXPECT_EQ(count(few, 3), 0) << "rather all of the edge coarsely than some of it finely";
  EXPECT_GT(count(few, 1) + count(few, 2), 60);
  goal.most_points = 1 << 20, goal.most_side = 2;
  EXPECT_EQ(count(chosen(floor, edge, goal), 3), 0);
  EXPECT_GT(count(chosen(floor, edge, goal), 1), 60);
}

// The candidates on a shadow's edge, where reflected light is as told.
template <class Reflected>
std::vector<CellCandidate> on_an_edge(const Listed& floor, const Reflected& of_reflected, bool stands_close) {
  const auto edge = lit(
      floor, [](float x, float) { return x < 16 ? 100.0f : 400.0f; }, 0);
  const std::size_t n = floor.map[0].texel.size();
  std::vector<Vec3> reflected;
  for (const std::uint32_t t : floor.map[0].texel)
    reflected.push_back(Vec3(of_reflected(static_cast<float>(t % edge.width))));
  const std::vector<float> importance(n, 1.0f);
  const std::vector<char> occlusion_heavy(n, stands_close);
  const std::vector<Vec3> exact(n, Vec3(0));
  Radiosity light;
  light.pages.push_back(edge);
  light.visible.emplace_back(n, 1.0f);
  return find_cells(floor.atlas, floor.map, light, {importance, occlusion_heavy, reflected, exact},
                    {.error = 0.02, .floor = 10});
}

TEST(DetailCells, GatherWhereReflectedLightBends) {
  const Listed floor(bare_floor(), 0.1f);
  const auto slope = [](float x) { return 50 + x; };
  const auto bend = [](float x) { return x < 16 ? 50.0f : 100.0f; };
  const auto gathers = [](const CellCandidate& cell) { return cell.gathers; };
  EXPECT_FALSE(on_an_edge(floor, slope, false).empty());
  EXPECT_TRUE(std::ranges::none_of(on_an_edge(floor, slope, false), gathers)) << "a shadow of the sun: direct light";
  EXPECT_TRUE(std::ranges::any_of(on_an_edge(floor, bend, false), gathers));
  EXPECT_TRUE(std::ranges::all_of(on_an_edge(floor, slope, true), gathers)) << "texels do not tell at contacts";
}

TEST(DetailCells, OfDirectLightAloneCostLess) {
  const Listed floor(bare_floor(), 0.1f);
  std::vector<CellCandidate> found = on_an_edge(
      floor, [](float) { return 50.0f; }, false);
  Radiosity light;
  light.pages.push_back(lit(
      floor, [](float, float) { return 100.0f; }, 0));
  const CellGoal goal{.error = 0.02, .floor = 10, .most_points = 2000};
  EXPECT_GT(count(choose_cells(light.pages, found, goal), 3), 20) << "finest all along the edge";
  for (CellCandidate& cell : found) cell.gathers = true;
  EXPECT_EQ(count(choose_cells(light.pages, found, goal), 3), 0) << "for as many points as gather there is no room";
}

TEST(DetailCells, LeaveStitchedSeamsAsTheyAre) {
  const Listed floor(bare_floor(), 0.1f);
  const auto edge = lit(
      floor, [](float x, float) { return x < 16 ? 100.0f : 400.0f; }, 0);
  const CellGoal goal{.error = 0.02, .floor = 10, .most_points = 1 << 20};
  std::vector<std::vector<bool>> at_seam(1, std::vector<bool>(edge.state.size()));
  for (std::uint32_t x = 0; x < edge.width; ++x) at_seam[0][7 * edge.width + x] = true;
  const CellLevels all = chosen(floor, edge, goal), levels = chosen(floor, edge, goal, at_seam);
  for (std::size_t place = 0; place < levels[0].size(); ++place)
    EXPECT_EQ(levels[0][place], place / edge.width == 7 ? 0 : all[0][place]) << place;
  EXPECT_GT(count(all, 0), 0);
  EXPECT_LT(count(all, 3), count(levels, 3) + 10) << "the row alone";
  EXPECT_GT(count(all, 3), count(levels, 3));
}

// Points of a level whose light is anything, so that only joining makes it continuous.
PointLight any_light(const Listed& floor, const CellLevels& levels, std::uint8_t level) {
  Context context;
  const DetailPoints points = *list_points(floor.atlas, levels, level, context);
  PointLight lit;
  lit.texels = *list_texels({floor.transport(), points.atlas, points.map}, context);
  lit.variance.resize(lit.texels.count());
  for (std::uint32_t i = 0; i < lit.texels.count(); ++i)
    lit.light.push_back(Vec3(static_cast<float>(mix64(i * 7 + level) % 1000)));
  return lit;
}

TEST(DetailBlocks, MeetWithoutAStep) {
  const Listed floor(bare_floor(), 0.1f);
  LightmapPage page = lit(
      floor, [](float x, float y) { return 300 + 10 * std::sin(x) + 20 * std::cos(2 * y); }, 0);
  CellLevels levels(1, std::vector<std::uint8_t>(page.state.size()));
  for (std::uint32_t y = 5; y < 20; ++y)
    for (std::uint32_t x = 5; x < 20; ++x)
      levels[0][y * page.width + x] = static_cast<std::uint8_t>(mix64(y * 31 + x) % 4);
  const PointLight one = any_light(floor, levels, 1), two = any_light(floor, levels, 2),
                   three = any_light(floor, levels, 3);
  add_blocks(floor.map[0], levels[0], 0, {&one, &two, &three}, page);
  const Vec2 size(page.width, page.height);
  double largest = 0, varies = 0;
  for (float y = 4; y < 21; y += 0.0625f)
    for (int x = 5; x < 21; ++x) {
      constexpr float kAside = 1e-4f;
      const auto at = [&](float u, float v) { return double{irradiance_at(page, (Vec2(u, v) + 0.5f) / size).g}; };
      const auto fx = static_cast<float>(x);
      largest = std::max(largest, std::fabs(at(fx - kAside, y) - at(fx + kAside, y)));
      largest = std::max(largest, std::fabs(at(y, fx - kAside) - at(y, fx + kAside)));
      varies = std::max(varies, std::fabs(at(fx, y) - at(fx + 0.25f, y)));
    }
  EXPECT_LT(largest, 3) << "1e-4 of a texel at a slope of some 5000 lux a texel";
  EXPECT_GT(varies, 100) << "no cell is finer: the test shows nothing";
}

TEST(DetailBlocks, APointThatDiffersFromAllAroundItIsNoLight) {
  const Listed floor(bare_floor(), 0.1f);
  LightmapPage page = lit(
      floor, [](float, float) { return 100.0f; }, 0);
  CellLevels levels(1, std::vector<std::uint8_t>(page.state.size()));
  for (std::uint32_t y = 8; y < 12; ++y)
    for (std::uint32_t x = 8; x < 12; ++x) levels[0][y * page.width + x] = 3;
  PointLight points = any_light(floor, levels, 3);
  std::ranges::fill(points.light, Vec3(110));
  points.light[points.light.size() / 2] = Vec3(5000);
  add_blocks(floor.map[0], levels[0], 0, {nullptr, nullptr, &points}, page);
  ASSERT_FALSE(page.detail.empty());
  for (const Vec3& light : page.detail) EXPECT_LE(light.g, 110.01f);
}

TEST(DetailBlocks, WithoutCellsThePageStaysAsItIs) {
  const Listed floor(bare_floor(), 0.1f);
  LightmapPage page = lit(
      floor, [](float, float) { return 1.0f; }, 0);
  add_blocks(floor.map[0], std::vector<std::uint8_t>(page.state.size()), 0, {nullptr, nullptr, nullptr}, page);
  EXPECT_TRUE(page.cell.empty() && page.detail.empty() && page.detail_width == 0);
}

// A lamp above a board that stands on the floor: under its edge the shadow is sharp.
Scene shadow_of_a_board() {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {0, 0, 0}, {0, 0, 3}, {3, 0, 0});
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(100)), {1.4f, 2.5f, 1.4f}, {0.2f, 0, 0}, {0, 0, 0.2f});
  parts.box("board", matt, {0.8f, 0.3f, 0.8f}, {1.3f, 0.35f, 2.1f});
  return parts.finish();
}

double profile_error(const Listed& floor, const Radiosity& light) {
  double squares = 0, number = 0;
  for (float x = 0.6f; x < 1.6f; x += 0.013f, ++number) {
    const Vec3 at{x, 0, 1.45f};
    const Hit hit = floor.accel->intersect({at + Vec3(0, 0.01f, 0), {0, -1, 0}, 1});
    const auto& uv = floor.atlas.uv[hit.triangle];
    const Vec2 place = uv[0] + hit.barycentric.x * (uv[1] - uv[0]) + hit.barycentric.y * (uv[2] - uv[0]);
    const double shown = irradiance_at(light.pages[0], place).g;
    constexpr std::uint32_t kPaths = 4096;
    std::uint64_t rays = 0;
    TexelSums sums;
    for (std::uint32_t k = 0; k < kPaths; ++k) {
      Sampler sampler(7, mix64(static_cast<std::uint64_t>(1000 * x)), k);
      sums.add(sample_irradiance(floor.transport(), point_on_side(floor.scene, hit.triangle, hit.barycentric), sampler,
                                 rays));
    }
    const double right = sums.irradiance().g;
    squares += (shown - right) * (shown - right);
  }
  return std::sqrt(squares / number);
}

// The sun past the edge of a roof: its light steps, what the floor reflects to the roof and back does not.
TEST(Detail, ShowsTheEdgeOfTheSunsShadow) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
  parts.box("roof", matt, {-1, 2, -1}, {2.03f, 2.1f, 5});
  Light sun;
  sun.type = LightType::kDirectional, sun.direction = {0, -1, 0}, sun.intensity = Vec3(1000);
  parts.scene().lights.push_back(sun);
  Listed floor(parts.finish(), 0.2f);
  RadiosityOptions options{.estimator = Estimator::kCached, .samples = 1024, .error = 0.02, .fit_texels = true};
  options.verify = 0, options.detail = kMostCellSide;
  const Radiosity light = *bake_radiosity({floor.transport(), floor.atlas, floor.map}, options, floor.context);
  ASSERT_GT(light.report.detail.points, 1000);
  const auto shown = [&](float x) {
    const Hit hit = floor.accel->intersect({{x, 0.01f, 2.11f}, {0, -1, 0}, 1});
    const auto& uv = floor.atlas.uv[hit.triangle];
    return irradiance_at(light.pages[0],
                         uv[0] + hit.barycentric.x * (uv[1] - uv[0]) + hit.barycentric.y * (uv[2] - uv[0]))
        .g;
  };
  EXPECT_NEAR(shown(2.06f) - shown(2.0f), 1000, 30) << "within a step of 2.5 cm on each side of the edge";
}

// A strip of light 3 cm before a wall, half as far below a ceiling: light on that varies a hundredfold within a point
// of two steps. Behind the strip it is dark, all along.
TEST(Detail, HasNoGapsBesideAStrip) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("ceiling", matt, {0, 2.9f, 0}, {20, 0, 0}, {0, 0, 1});
  parts.quad("wall", matt, {0, 0, 0}, {20, 0, 0}, {0, 2.9f, 0});
  parts.quad("strip", parts.diffuse(Vec3(0), Vec3(12000)), {0.2f, 2.85f, 0.031f}, {19.6f, 0, 0}, {0, 0.03f, 0});
  Listed room(parts.finish(), 0.108f);
  RadiosityOptions options{.estimator = Estimator::kCached, .samples = 64, .error = 0.02, .fit_texels = true};
  options.verify = 0, options.detail = kMostCellSide;
  const Radiosity light = *bake_radiosity({room.transport(), room.atlas, room.map}, options, room.context);
  const auto shown = [&](float x, float z) {
    const Hit hit = room.accel->intersect({{x, 2.89f, z}, {0, 1, 0}, 1});
    const auto& uv = room.atlas.uv[hit.triangle];
    return irradiance_at(light.pages[0],
                         uv[0] + hit.barycentric.x * (uv[1] - uv[0]) + hit.barycentric.y * (uv[2] - uv[0]))
        .g;
  };
  int places = 0, bright = 0;
  for (float x = 0.5f; x < 19.5f; x += 0.1f) ++places, bright += shown(x, 0.015f) > 0.5f * shown(x, 0.06f);
  EXPECT_LE(bright, places / 50);
}

TEST(Detail, BringsShadowsNearerToTheTruth) {
  Listed floor(shadow_of_a_board(), 0.13f);
  RadiosityOptions options{.estimator = Estimator::kCached, .samples = 4096, .error = 0.02, .fit_texels = true};
  options.verify = 0;
  const auto bake = [&] {
    return *bake_radiosity({floor.transport(), floor.atlas, floor.map}, options, floor.context);
  };
  const double texels = profile_error(floor, bake());
  options.detail = kMostCellSide;
  const Radiosity fine = bake();
  EXPECT_GT(fine.report.detail.cells, 10);
  EXPECT_LT(fine.report.detail.points, 8 * (1 << 14)) << "as many as gather, a quarter of one each";
  const double cells = profile_error(floor, fine);
  EXPECT_LT(cells, 0.4 * texels) << cells << " and " << texels << " lux";
  floor.context.threads = 1;
  const Radiosity alone = bake();
  EXPECT_EQ(alone.pages[0].detail, fine.pages[0].detail);
}

}  // namespace
}  // namespace oriel::test
