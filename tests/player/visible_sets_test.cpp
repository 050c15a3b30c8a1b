// What a pack says of visible triangles is what is drawn, and no more than that is left out.
#include <gmock/gmock.h>

#include "player/scene/gpu_mesh.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;
using ::testing::ElementsAre;

// Ranges of three indices each, of groups 0, 1, …, at x = 0, 1, …, by pairs of material and page.
std::vector<DrawRange> row(const std::vector<std::pair<std::uint32_t, std::int32_t>>& looks) {
  std::vector<DrawRange> ranges;
  for (std::uint32_t i = 0; i < looks.size(); ++i) {
    DrawRange range{3 * i, 3, looks[i].first, looks[i].second, {}, i};
    range.bounds.extend(Vec3(static_cast<float>(i), 0, 0));
    ranges.push_back(range);
  }
  return ranges;
}

// Sees x from low to high.
Frustum between(float low, float high) {
  return {{Vec4(1, 0, 0, -low), Vec4(-1, 0, 0, high), Vec4(0, 0, 0, 1), Vec4(0, 0, 0, 1), Vec4(0, 0, 0, 1),
           Vec4(0, 0, 0, 1)}};
}

std::vector<std::size_t> starts(const DrawBatch& batch) {
  std::vector<std::size_t> out;
  for (const void* offset : batch.offsets)
    out.push_back(reinterpret_cast<std::uintptr_t>(offset) / sizeof(std::uint32_t));
  return out;
}

TEST(VisibleBatches, JoinNeighboursOfOneLook) {
  const auto ranges = row({{0, 0}, {0, 0}, {0, 1}, {1, 1}, {1, 1}, {1, 1}});
  const auto all = visible_batches(ranges, between(-1, 10));
  ASSERT_EQ(all.size(), 3u);
  EXPECT_THAT(all[0].counts, ElementsAre(6));
  EXPECT_THAT(all[1].counts, ElementsAre(3));
  EXPECT_THAT(all[2].counts, ElementsAre(9));
  EXPECT_EQ(all[2].material, 1u);
  EXPECT_EQ(all[1].lightmap_page, 1);
}

TEST(VisibleBatches, LeaveOutWhatIsNotSeenOrNotInView) {
  const auto ranges = row({{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}});
  const SeenMask seen = std::vector<std::uint8_t>{1, 0, 1, 1, 1};
  const auto some = visible_batches(ranges, between(-1, 3.5f), seen);
  ASSERT_EQ(some.size(), 1u);
  EXPECT_THAT(some[0].counts, ElementsAre(3, 6));
  EXPECT_THAT(starts(some[0]), ElementsAre(0u, 6u));
  auto ungrouped = ranges;
  ungrouped[1].group = DrawRange::kNoGroup;
  EXPECT_THAT(visible_batches(ungrouped, between(-1, 3.5f), seen)[0].counts, ElementsAre(12));
  EXPECT_TRUE(visible_batches(ranges, between(7, 8), seen).empty());
}

TEST(VisibleBatches, GatheredIndicesAreTheSameTriangles) {
  const auto ranges = row({{0, 0}, {0, 0}, {0, 0}, {1, 0}});
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 12; ++i) indices.push_back(100 + i);
  const SeenMask seen = std::vector<std::uint8_t>{1, 0, 1, 1};
  const ShownTriangles shown = gather(visible_batches(ranges, between(-1, 10), seen), indices);
  EXPECT_THAT(shown.indices, ElementsAre(100, 101, 102, 106, 107, 108, 109, 110, 111));
  ASSERT_EQ(shown.batches.size(), 2u);
  EXPECT_THAT(shown.batches[0].counts, ElementsAre(6));
  EXPECT_THAT(starts(shown.batches[1]), ElementsAre(6u));
}

TEST(VisibleBatches, OnlyKeptTrianglesAreGathered) {
  const auto ranges = row({{0, 0}, {0, 0}, {1, 0}});
  const std::vector<std::uint32_t> indices{0, 1, 2, 3, 4, 5, 6, 7, 8}, kept{0, 1, 0};
  const ShownTriangles shown = gather(visible_batches(ranges, between(-1, 10)), indices, kept);
  EXPECT_THAT(shown.indices, ElementsAre(3, 4, 5));
  ASSERT_EQ(shown.batches.size(), 1u) << "none is left of the other";
  EXPECT_THAT(shown.batches[0].counts, ElementsAre(3));
}

TEST(SortedRanges, AreDividedIntoRuns) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.indices = {0, 0, 0, 1, 1, 1, 2, 2, 2, 0, 1, 2};
  mesh.parts = {{"b", 0, 9, 1, 0}, {"a", 9, 3, 0, 0}};
  const std::vector<TriangleRun> runs{{3, 5}, {6, 6}, {3, 7}};
  std::vector<std::uint32_t> indices;
  const auto ranges = sorted_ranges(mesh, indices, runs);
  ASSERT_EQ(ranges.size(), 3u);
  EXPECT_THAT(indices, ElementsAre(0, 1, 2, 0, 0, 0, 1, 1, 1, 2, 2, 2));
  EXPECT_EQ(std::tie(ranges[0].material, ranges[0].group, ranges[0].index_count), std::tuple(0u, 7u, 3u));
  EXPECT_EQ(std::tie(ranges[2].first_index, ranges[2].group, ranges[2].index_count), std::tuple(6u, 6u, 6u));
  EXPECT_EQ(ranges[2].bounds.lower.x, 1);
  indices.clear();
  EXPECT_EQ(sorted_ranges(mesh, indices, runs, [](std::uint32_t m) { return m == 0; }).size(), 2u);
}

class VisibleSetsFrame : public FrameTest {
 protected:
  // Two lit quads beside each other at z = 0, in groups 0 and 1; an eye cell over (0 to 1, 1 to 2), whose set has group
  // 1 only.
  static Pack half_seen() {
    Pack pack;
    pack.materials.resize(1);
    pack.lightmaps.push_back(flat_page(Vec3(100)));
    add_quad(pack, {-4, -4, 0}, {4, 0, 0}, {0, 8, 0}, 0, 0);
    add_quad(pack, {0, -4, 0}, {4, 0, 0}, {0, 8, 0}, 0, 0);
    pack.walk_grids = {{{0, 1}, 1, 1, 1, {-1.5f}, 1.5f}};
    VisibleSets& sets = pack.visible_sets;
    sets.groups = 2;
    sets.runs = {{6, 0}, {6, 1}};
    sets.below_m = sets.above_m = 0.5f;
    sets.seen = {2};
    sets.made_for = visibility_hash(pack.mesh, pack.materials, pack.walk_grids);
    return pack;
  }

  static Camera at(const Vec3& eye) {
    Camera camera;
    camera.eye = eye;
    return camera;
  }
};

TEST_F(VisibleSetsFrame, OnlyWhatIsInTheSetIsDrawn) {
  const Pack pack = half_seen();
  const Picture half = draw(pack, at({0, 0, 1.5f}), 8, 8);
  EXPECT_EQ(half.at(1, 4), Vec3(0));
  EXPECT_GT(half.at(6, 4).x, 1);
  EXPECT_EQ(std::pair(half.stats.groups_seen, half.stats.groups), std::pair(1u, 2u));
  FrameOptions all;
  all.visible_sets = false;
  const Picture whole = draw(pack, at({0, 0, 1.5f}), 8, 8, all);
  EXPECT_GT(whole.at(1, 4).x, 1);
  EXPECT_EQ(whole.at(6, 4), half.at(6, 4));
  EXPECT_EQ(whole.stats.groups, 0u);
  EXPECT_EQ(whole.stats.triangles, 2 * half.stats.triangles);
}

TEST_F(VisibleSetsFrame, ElsewhereAllIsDrawn) {
  const Pack pack = half_seen();
  for (const Vec3& eye : {Vec3(0, 0, 3.5f), Vec3(0, 0.6f, 1.5f), Vec3(-1.5f, 0, 1.5f)})
    EXPECT_GT(draw(pack, at(eye), 8, 8).at(1, 4).x, 1) << eye.x << " " << eye.y << " " << eye.z;
  Camera plan = at({0, 0, 1.5f});
  plan.vertical_fov_rad = 0;
  plan.half_height = 2;
  EXPECT_GT(draw(pack, plan, 8, 8).at(1, 4).x, 1) << "an orthographic camera sees from many places";
}

TEST_F(VisibleSetsFrame, SetsOfAnotherMeshAreIgnored) {
  Pack pack = half_seen();
  pack.visible_sets.made_for.low ^= 1;
  EXPECT_GT(draw(pack, at({0, 0, 1.5f}), 8, 8).at(1, 4).x, 1);
}

TEST_F(VisibleSetsFrame, SeeThroughPartsStay) {
  Pack pack = half_seen();
  pack.materials[0].alpha_mode = AlphaMode::kBlend;
  EXPECT_GT(draw(pack, at({0, 0, 1.5f}), 8, 8).at(1, 4).x, 1);
}

class HiddenTriangles : public FrameTest {
 protected:
  // A quad over the left half of the view, a place within it behind which ten more stand, and one to its right.
  static Pack behind(const Material& front) {
    Pack pack;
    pack.materials = {front, Material()};
    pack.lightmaps.push_back(flat_page(Vec3(100)));
    for (int i = 0; i < 10; ++i)
      add_quad(pack, {-1.6f, -0.5f, -2 - 0.01f * static_cast<float>(i)}, {1, 0, 0}, {0, 1, 0}, 1, 0);
    add_quad(pack, {-1, -1, -1}, {1, 0, 0}, {0, 2, 0}, 0, 0);
    add_quad(pack, {0.53f, -0.52f, -2}, {1, 0.1f, 0}, {0, 1, 0}, 1, 0);
    return pack;
  }
  Picture draw_with(bool marks, const Pack& pack, int samples) {
    gpu::Device device = device_;
    device.shades_hidden = marks;
    auto renderer = Renderer::create(device);
    EXPECT_TRUE(renderer);
    renderer_ = std::move(*renderer);
    FrameOptions options;
    options.samples = samples;
    Camera camera;
    camera.vertical_fov_rad = kPi / 2;
    return draw(pack, camera, 64, 64, options);
  }
};

TEST_F(HiddenTriangles, AreNotShadedWhereADeviceWouldShadeThem) {
  if (!device_.shades_hidden) GTEST_SKIP() << "this device shades no hidden triangles";
  Material front;
  const Picture all = draw_with(false, behind(front), 4), seen = draw_with(true, behind(front), 4);
  EXPECT_EQ(seen.rgb, all.rgb);
  EXPECT_EQ(all.stats.triangles, 2 * 24u) << "depth and light";
  EXPECT_EQ(seen.stats.triangles, 2 * 24u + 4u) << "depth, marks, and the light of two quads";
  EXPECT_EQ(draw_with(true, behind(front), 1).stats.triangles, 2 * 24u) << "one sample: tested before it is shaded";
  front.alpha_mode = AlphaMode::kMask;
  front.alpha_cutoff = 0.5f;
  front.alpha = 0.2f;  // cut away: one of the ten is seen
  EXPECT_EQ(draw_with(true, behind(front), 4).rgb, draw_with(false, behind(front), 4).rgb);
}

}  // namespace
}  // namespace oriel
