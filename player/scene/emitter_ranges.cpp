#include "player/scene/emitter_ranges.h"

#include <algorithm>

namespace oriel {
namespace {

DVec3 unit(const DVec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : DVec3(0);
}

// The polygon's plane and those through its edges, inside where the distances are not negative.
class Prism {
 public:
  explicit Prism(const std::vector<Vec3>& corners) : corner_(corners[0]) {
    const auto at = [&](std::size_t i) { return DVec3(corners[i % corners.size()]); };
    DVec3 normal(0);
    double size = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      normal += glm::cross(at(i) - at(0), at(i + 1) - at(0));
      size = std::max(size, glm::length(at(i + 1) - at(i)));
    }
    normal_ = unit(normal);
    tolerance_ = normal_ == DVec3(0) ? -1 : 1e-3 * size;  // nothing lies in a polygon without an area
    for (std::size_t i = 0; i < corners.size(); ++i)
      sides_.push_back({at(i), unit(glm::cross(normal_, at(i + 1) - at(i)))});
  }
  bool holds(const DVec3& p) const {
    return std::fabs(glm::dot(p - corner_, normal_)) <= tolerance_ &&
           std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return glm::dot(p - side.corner, side.inwards) >= -tolerance_; });
  }

 private:
  struct Side {
    DVec3 corner, inwards;
  };
  DVec3 corner_, normal_{0};
  double tolerance_ = 0;
  std::vector<Side> sides_;
};

}  // namespace

std::vector<EmitterTriangles> triangles_of(const Emitter& emitter, const Pack& pack) {
  const Prism prism(emitter.corners);
  const Mesh& mesh = pack.mesh;
  std::vector<EmitterTriangles> out;
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    const Material& material = pack.materials[part.material];
    if (material.unlit || material.emission == Vec3(0)) continue;
    EmitterTriangles found{p, {}};
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      const auto corners = std::span(mesh.indices).subspan(i, 3);
      if (!std::all_of(corners.begin(), corners.end(), [&](std::uint32_t v) { return prism.holds(mesh.positions[v]); }))
        continue;
      found.indices.insert(found.indices.end(), corners.begin(), corners.end());
    }
    if (!found.indices.empty()) out.push_back(std::move(found));
  }
  return out;
}

}  // namespace oriel
