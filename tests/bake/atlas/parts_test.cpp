// Polygons, packing and connectivity: the parts that the atlas is made of.
#include <gtest/gtest.h>

#include "bake/atlas/polygon.h"
#include "bake/atlas/surface_mesh.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

TEST(Polygon, CellsTouched) {
  const auto cells = [](double lo, double hi) {
    const CellRange r = touched_cells(lo, hi, 8);
    return std::pair(r.first, r.last);
  };
  EXPECT_EQ(cells(1, 3), std::pair(1, 2));
  EXPECT_EQ(cells(0.99, 3.01), std::pair(0, 3));
  EXPECT_EQ(cells(3, 3), std::pair(3, 3));
  EXPECT_EQ(cells(8, 8), std::pair(7, 7));
  EXPECT_EQ(cells(-1e300, 1e300), std::pair(0, 7));
}

TEST(Polygon, OverlapOfKnownArea) {
  const OverlapTolerance tolerance{1e-4, 1e-3};
  const std::vector<Triangle2> crossing{{DVec2(0, 0), DVec2(4, 0), DVec2(0, 4)},
                                        {DVec2(1, 1), DVec2(1, -9), DVec2(-9, 1)}};
  const auto found = find_overlap(crossing, tolerance);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->area, 1.0, 1e-12);
  EXPECT_NEAR(found->where.x, 0.5, 0.3);
  const std::vector<Triangle2> adjacent{{DVec2(0, 0), DVec2(4, 0), DVec2(0, 4)},
                                        {DVec2(4, 0), DVec2(4, 4), DVec2(0, 4)}};
  EXPECT_FALSE(find_overlap(adjacent, tolerance).has_value());
  const std::vector<Triangle2> same{adjacent[0], adjacent[0]};
  EXPECT_TRUE(find_overlap(same, tolerance).has_value());
  EXPECT_FALSE(find_overlap(std::vector<Triangle2>{adjacent[0]}, tolerance).has_value());
}

TEST(Polygon, TinyTrianglesThatOverlapAreFound) {
  const Triangle2 tiny{DVec2(5, 5), DVec2(5.004, 5), DVec2(5, 5.004)};  // of less area than the tolerance
  EXPECT_TRUE(find_overlap(std::vector<Triangle2>{tiny, tiny}, {1e-4, 1e-3}).has_value());
}

TEST(Polygon, OverlapAmongMany) {
  std::vector<Triangle2> grid;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      const DVec2 a(x, y);
      grid.push_back({a, a + DVec2(1, 0), a + DVec2(1, 1)});
      grid.push_back({a, a + DVec2(1, 1), a + DVec2(0, 1)});
    }
  EXPECT_FALSE(find_overlap(grid, {1e-4, 1e-3}).has_value());
  grid.push_back({DVec2(33.4, 20.5), DVec2(33.5, 20.5), DVec2(33.4, 20.6)});
  const auto found = find_overlap(grid, {1e-4, 1e-3});
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->b, grid.size() - 1);
  EXPECT_EQ(found->a, 2u * (20 * 60 + 33) + 1);
}

std::vector<OutlineEdge> loops(const std::vector<std::vector<DVec2>>& corners) {
  std::vector<OutlineEdge> edges;
  for (const auto& loop : corners) {
    const auto base = static_cast<std::uint32_t>(edges.size()), n = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < n; ++i) edges.push_back({loop[i], loop[(i + 1) % n], base + (i + 1) % n});
  }
  return edges;
}

std::vector<DVec2> square(double x, double y, double side) {
  return {DVec2(x, y), DVec2(x + side, y), DVec2(x + side, y + side), DVec2(x, y + side)};
}

TEST(Polygon, SimpleOutlines) {
  const auto reversed = [](std::vector<DVec2> v) { return std::vector<DVec2>(v.rbegin(), v.rend()); };
  EXPECT_TRUE(is_simple_outline(loops({square(0, 0, 4)})));
  EXPECT_TRUE(is_simple_outline(loops({square(0, 0, 4), reversed(square(1, 1, 1))})));             // a hole
  EXPECT_FALSE(is_simple_outline(loops({square(0, 0, 4), square(1, 1, 1)})));                      // two sheets
  EXPECT_FALSE(is_simple_outline(loops({square(0, 0, 4), reversed(square(3, 3, 3))})));            // crossing
  EXPECT_FALSE(is_simple_outline(loops({reversed(square(0, 0, 4))})));                             // the back
  EXPECT_FALSE(is_simple_outline(loops({{DVec2(0, 0), DVec2(4, 4), DVec2(4, 0), DVec2(0, 3)}})));  // a figure of eight
  // Twice around: the inner turn lies within the outer one.
  EXPECT_FALSE(is_simple_outline(loops(
      {{DVec2(0, 0), DVec2(9, 0), DVec2(9, 9), DVec2(1, 9), DVec2(1, 1), DVec2(8, 1), DVec2(8, 8), DVec2(0, 8)}})));
}

int neighbours(const SurfaceMesh& mesh, int face) {
  int count = 0;
  for (auto h : mesh.fh_range(SurfaceMesh::FaceHandle(face))) count += mesh.opposite_face_handle(h).is_valid();
  return count;
}

TEST(SurfaceMesh, ClosedBoxHasThreeNeighboursEverywhere) {
  Scene scene = shapes::empty_scene();
  const Surface box = shapes::add_box(scene, "box", Vec3(0), Vec3(1, 2, 3));
  const SurfaceMesh mesh = build_surface_mesh(scene, box);
  EXPECT_EQ(mesh.n_vertices(), 8u);
  for (int f = 0; f < 12; ++f) EXPECT_EQ(neighbours(mesh, f), 3);
}

TEST(SurfaceMesh, ThreeFacesOnAnEdgeJoinTheMostAlike) {
  Scene scene = shapes::empty_scene();
  // 0 and 1 are coplanar; 2 stands on their common edge.
  const Surface s = shapes::add(scene, "fan", {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}},
                                {{1, 0, 2}, {0, 1, 3}, {0, 1, 4}});
  const SurfaceMesh mesh = build_surface_mesh(scene, s);
  EXPECT_EQ(neighbours(mesh, 0), 1);
  EXPECT_EQ(neighbours(mesh, 1), 1);
  EXPECT_EQ(neighbours(mesh, 2), 0);
}

TEST(SurfaceMesh, AnySoupIsTaken) {
  std::uint32_t state = 5;
  const auto random = [&](std::uint32_t n) { return (state = state * 1664525u + 1013904223u) % 65536u * n / 65536u; };
  for (int n = 0; n < 50; ++n) {  // dense random triangles on few vertices: every kind of non-manifold place
    Scene scene = shapes::empty_scene();
    std::vector<Vec3> p;
    for (int i = 0; i < 12; ++i) p.push_back(Vec3(random(100), random(100), random(100)) * 0.1f);
    std::vector<UVec3> t;
    while (t.size() < 300) {
      const UVec3 f(random(12), random(12), random(12));
      if (f.x != f.y && f.y != f.z && f.z != f.x) t.push_back(f);
    }
    t.push_back({0, 0, 1});
    const Surface s = shapes::add(scene, "soup", p, t);
    EXPECT_EQ(build_surface_mesh(scene, s).n_faces(), 301u);
  }
}

TEST(SurfaceMesh, FrameOfSlivers) {
  Scene scene = shapes::empty_scene();
  shapes::add(scene, "s", {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-7f, 0}, {1e-30f, 0, 0}, {0, 1e-30f, 0}, {2, 0, 0}},
              {{0, 1, 2}, {2, 0, 1}, {0, 3, 4}, {0, 1, 5}});
  for (std::uint32_t t = 0; t < 3; ++t) EXPECT_EQ(triangle_frame(scene, t).normal, DVec3(0, 0, 1)) << t;
  EXPECT_NEAR(triangle_frame(scene, 0).area, 0.5e-7, 1e-13);
  EXPECT_EQ(triangle_frame(scene, 3).area, 0);
  EXPECT_EQ(triangle_frame(scene, 3).normal, DVec3(0));
}

}  // namespace
}  // namespace oriel
