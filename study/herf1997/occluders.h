// What casts shadows: triangles with their edges, parts that are closed, and a tree of boxes to leave most of them out.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel::study {

struct OccluderFace {
  std::array<std::uint32_t, 3> points{};  // into Occluders::points
  std::uint32_t part = 0;                 // connected by points
};

struct OccluderPart {
  bool closed = false;  // each edge has two faces of like winding: rays from outside meet as many fronts as backs
  DVec3 lower{0}, upper{0};
};

struct OccluderNode {
  DVec3 lower{0}, upper{0};
  std::uint32_t first = 0, count = 0;  // faces, of which `left` == 0 holds all itself
  std::uint32_t left = 0;              // its children are left and left + 1
};

// Immutable. Points at one place are one point; triangles without area are left out.
class Occluders {
 public:
  Occluders() = default;
  Occluders(std::span<const DVec3> points, std::span<const std::array<std::uint32_t, 3>> triangles);

  std::vector<DVec3> points;
  std::vector<OccluderFace> faces;  // in the order of the tree
  std::vector<OccluderPart> parts;
  std::vector<OccluderNode> nodes;  // the root first; none where there are no faces

 private:
  void weld(std::span<const DVec3> all, std::span<const std::array<std::uint32_t, 3>> triangles);
  void find_parts();
  void split(std::uint32_t node);
};

}  // namespace oriel::study
