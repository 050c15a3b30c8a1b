// The baked light of one part of a mesh, at points spread over its area.
#pragma once

#include <algorithm>
#include <cmath>

#include "formats/pack/pack.h"

namespace oriel {

// By channel, lux; the squared standard error.
struct SampledLight {
  DVec3 light{0}, variance{0};
};

// A part that has a lightmap page, of a pack that validate() finds no error in.
class PartSampler {
 public:
  PartSampler(const Pack& pack, const MeshPart& part) : pack_(pack), part_(part) {}

  std::size_t triangles() const { return part_.index_count / 3; }
  Vec3 corner(std::size_t t, std::size_t c) const { return pack_.mesh.positions[vertex(t, c)]; }
  double area(std::size_t t) const {
    return 0.5 * glm::length(glm::cross(DVec3(corner(t, 1) - corner(t, 0)), DVec3(corner(t, 2) - corner(t, 0))));
  }
  double area() const {
    double sum = 0;
    for (std::size_t t = 0; t < triangles(); ++t) sum += area(t);
    return sum;
  }
  SampledLight at(std::size_t t, const Vec3& barycentric) const;

 private:
  std::uint32_t vertex(std::size_t t, std::size_t c) const { return pack_.mesh.indices[part_.first_index + 3 * t + c]; }
  const Pack& pack_;
  const MeshPart& part_;
};

// Point i of a triangle as barycentric coordinates, by the golden ratio in two dimensions (Roberts 2018), folded into
// the triangle.
Vec3 point_of(std::size_t i);

// Visits (triangle, barycentric coordinates, share of the area): about `points` of them, at least one a triangle.
template <class F>
void for_points(const PartSampler& part, std::size_t points, F&& visit) {
  const double area = part.area();
  for (std::size_t t = 0; t < part.triangles(); ++t) {
    const double share = area > 0 ? part.area(t) / area : 0;
    const auto n = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(share * static_cast<double>(points))));
    for (std::size_t i = 0; i < n; ++i) visit(t, point_of(i), share / static_cast<double>(n));
  }
}

// Over a part's area, in lux.
struct PartLight {
  double area_m2 = 0;
  double lowest = 0, mean = 0, highest = 0;  // illuminance
  double variance = 0;                       // mean of the squared standard error
};
PartLight light_of(const PartSampler& part, std::size_t points);

}  // namespace oriel
