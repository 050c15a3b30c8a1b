// Shapes appended to a mesh. All face outwards and have unit normals; none makes a degenerate triangle for positive
// sizes.
#pragma once

#include <span>

#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// Faces of a box, to leave out those that other geometry hides.
enum BoxFace : unsigned {
  kLeft = 1,    // -x
  kRight = 2,   // +x
  kBottom = 4,  // -y
  kTop = 8,     // +y
  kBack = 16,   // -z
  kFront = 32,  // +z
  kSides = kLeft | kRight | kBack | kFront,
  kAllFaces = kSides | kBottom | kTop,
};

// The rectangle origin, +u, +u+v, +v; its front is the side that u × v points to.
struct Quad {
  Vec3 origin, u, v;
};
void add_quad(SampleMesh& mesh, const Quad& quad);
// One alone, as a mesh used once.
void place_quad(SampleScene& scene, std::string name, std::uint32_t material, const Quad& quad);
// Four corners, counter-clockwise from the front; flat shaded, also where they are not quite in a plane.
void add_corners(SampleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
// Shares of a rectangle's u and v in (0, 1).
struct Hole {
  Vec2 low, high;
};
// The rectangle around a hole: four faces without T-junctions.
void add_quad_around(SampleMesh& mesh, const Quad& quad, const Hole& hole);
// Axis-aligned, lower < upper in each axis.
void add_box(SampleMesh& mesh, const Vec3& lower, const Vec3& upper, unsigned faces = kAllFaces);
// Tables and seats: a box from lower to upper on four legs down to y = 0, square in section and flush with its corners.
// Six rectangles and sixteen: where legs end nobody sees.
void add_slab(SampleMesh& slab, SampleMesh& legs, const Vec3& lower, const Vec3& upper, float leg);
// A box whose edges and corners are rounded by `radius` (clamped to half the smallest size): 12 n² triangles. n = 1
// gives the plain box.
void add_rounded_box(SampleMesh& mesh, const Vec3& centre, const Vec3& size, float radius, int n);

// A surface of revolution about the vertical through base: profile points are (radius, height), bottom to top for an
// outer surface. Corners flatter than 35° are smooth. A radius of 0 is allowed at both ends.
void add_lathe(SampleMesh& mesh, const Vec3& base, std::span<const Vec2> profile, int around);
void add_sphere(SampleMesh& mesh, const Vec3& centre, float radius, int around, int along);
// A column's shaft with concave flutes that meet in sharp arrises; no caps. `segments` a flute across, `rings` upwards.
struct FlutedShaft {
  float bottom_radius = 0.22f, top_radius = 0.19f;
  float height = 2.5f;
  float flute_depth = 0.014f;
  int flutes = 20, segments = 6, rings = 8;
};
void add_fluted_shaft(SampleMesh& mesh, const Vec3& base, const FlutedShaft& shaft);

// A picture frame about the rectangle |x| <= size.x/2, |y| <= size.y/2 in the plane z = 0, facing +z: border wide, from
// z = -sunk to z = depth, its inner sides down to z = 0. No back.
void add_frame(SampleMesh& mesh, const Vec2& size, float border, float depth, float sunk);

// uv = (dot(p - origin, u), dot(p - origin, v)) for all vertices: u and v in 1/m.
void project_uvs(SampleMesh& mesh, const Vec3& origin, const Vec3& u, const Vec3& v);

}  // namespace oriel::sample
