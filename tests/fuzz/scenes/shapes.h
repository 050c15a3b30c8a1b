// Triangles for random scenes: unlike the sample scenes' shapes, some are degenerate.
#pragma once

#include "tests/fuzz/scenes/glb.h"
#include "tests/fuzz/scenes/random.h"

namespace oriel::fuzz {

// The rectangle origin, +u, +u+v, +v, front towards u × v, cut into n × n.
void add_quad(Primitive& p, const Vec3& origin, const Vec3& u, const Vec3& v, int n = 1);
// An axis-aligned box; inwards: a room.
void add_box(Primitive& p, const Vec3& low, const Vec3& high, bool inwards = false);
// A sphere of `around` × around/2 quads, those at the poles triangles without an area; inwards: a dome.
void add_sphere(Primitive& p, const Vec3& centre, float radius, int around, bool inwards = false);
// A sheet bent along a wave: curved, open.
void add_wave(Primitive& p, const Vec3& centre, float size, int steps);
// A tube about the horizontal x axis.
void add_tube(Primitive& p, const Vec3& from, float length, float radius, int around);

// Breaks what importers and bakers count on, each with some chance: triangles doubled (also turned over), slivers,
// points, normals of no or any length, tangents along the normal, coordinates that are all one.
void damage(Primitive& p, Random& random);

}  // namespace oriel::fuzz
