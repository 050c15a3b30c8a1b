// Groups of triangles: all are in one, none is large, runs say where they lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bake/visibility/triangle_groups.h"

namespace oriel {
namespace {

// Parts of the given numbers of triangles, each a row along x at a z of its own.
Mesh rows(std::span<const std::uint32_t> counts) {
  Mesh mesh;
  for (std::uint32_t part = 0; part < counts.size(); ++part) {
    MeshPart p;
    p.first_index = static_cast<std::uint32_t>(mesh.indices.size());
    p.index_count = 3 * counts[part];
    mesh.parts.push_back(p);
    for (std::uint32_t t = 0; t < counts[part]; ++t) {
      // Neighbours in space are not neighbours in the list.
      const Vec3 at(static_cast<float>(t * 7 % counts[part]), 0, 100.0f * static_cast<float>(part));
      for (const Vec3& corner : {Vec3(0), Vec3(1, 0, 0), Vec3(0, 0, 1)}) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(at + corner);
      }
    }
  }
  return mesh;
}

TEST(TriangleGroups, EveryTriangleIsInOneAndNoneIsTooLarge) {
  const std::vector<std::uint32_t> counts{1000, 3, 0, 5, 1};
  const Mesh mesh = rows(counts);
  const TriangleGroups groups = group_triangles(mesh, 64);
  ASSERT_EQ(groups.groups.size(), 1009u);
  std::vector<int> sizes(groups.count);
  for (const std::uint32_t g : groups.groups) ++sizes.at(g);
  EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), 64);
  EXPECT_GE(*std::min_element(sizes.begin(), sizes.end()), 1);
  EXPECT_LT(groups.count, 40u) << "they are not much smaller than they may be";
  EXPECT_EQ(std::set(groups.order.begin(), groups.order.end()).size(), 1009u);
}

TEST(TriangleGroups, RunsTileTheParts) {
  const std::vector<std::uint32_t> counts{200, 7, 130};
  const Mesh mesh = rows(counts);
  const TriangleGroups groups = group_triangles(mesh, 50);
  std::size_t triangle = 0, run_end = 0;
  std::set<std::size_t> ends;
  for (const TriangleRun& run : groups.runs) {
    run_end += run.index_count / 3;
    ends.insert(run_end);
    for (; triangle < run_end; ++triangle) EXPECT_EQ(groups.groups[groups.order[triangle]], run.group);
  }
  EXPECT_EQ(run_end, 337u);
  for (const std::size_t part_end : {200u, 207u, 337u}) EXPECT_TRUE(ends.contains(part_end));
  // A part keeps its triangles.
  for (std::size_t i = 0; i < 200; ++i) EXPECT_LT(groups.order[i], 200u);
  for (std::size_t i = 200; i < 207; ++i) EXPECT_TRUE(groups.order[i] >= 200 && groups.order[i] < 207);
}

TEST(TriangleGroups, SmallNeighboursShareOne) {
  Mesh mesh = rows(std::vector<std::uint32_t>(8, 2));
  EXPECT_EQ(group_triangles(mesh, 16).count, 1u);
  EXPECT_EQ(group_triangles(mesh, 4).count, 4u);
  EXPECT_EQ(group_triangles(Mesh{}, 4).count, 0u);
}

}  // namespace
}  // namespace oriel
