// Questions that tests ask of a sample scene.
#pragma once

#include <array>
#include <optional>

#include "scenes/kit/scene_builder.h"

namespace oriel::sample::testing {

struct Triangle {
  std::array<Vec3, 3> p;        // world
  std::array<Vec3, 3> normals;  // shading
  std::uint32_t node = 0;
  std::uint32_t material = 0;

  DVec3 cross() const { return glm::cross(DVec3(p[1]) - DVec3(p[0]), DVec3(p[2]) - DVec3(p[0])); }
};

std::vector<Triangle> flatten(const SampleScene& scene);

// What is wrong with a triangle: no area, a normal that is not unit or on its back. Empty where nothing is.
std::string fault(const Triangle& triangle);

// The first triangle along a ray (direction unit), and whether it shows its front.
struct Seen {
  std::uint32_t triangle = 0;
  double distance = 0;
  bool front = false;
};
std::optional<Seen> cast(const std::vector<Triangle>& triangles, const Vec3& origin, const Vec3& direction);

// m.
double distance_to(const Triangle& triangle, const Vec3& point);
double clearance(const std::vector<Triangle>& triangles, const Vec3& point);

// Pairs of nodes with triangles in one plane (within 0.1 mm) that overlap by more than 1 mm², as "a / b".
std::vector<std::string> coplanar_overlaps(const SampleScene& scene);

// Directed edges without their reverse, vertices being equal where their coordinates are: 0 for closed surfaces.
std::size_t open_edges(const std::vector<Triangle>& triangles);

// Directions spread evenly over the sphere (Fibonacci).
std::vector<Vec3> directions(int count);

}  // namespace oriel::sample::testing
