// Which lights of a pack reach a point, and what keeps the others off.
#pragma once

#include "formats/analysis/why.h"
#include "formats/query/mesh_rays.h"

namespace oriel {

struct SeenPoint {
  Vec3 at{0};      // off the surface, pack space
  Vec3 normal{0};  // unit
  float eps = 0;   // metres that are nothing here
};

// The first surface that light does not pass within `farthest`, as a name with its distance and whether its front was
// met; surfaces that transmit or have an alpha let it pass.
struct Blocker {
  std::string name;
  std::uint32_t part = 0;
  float distance = 0;
  bool front = true;
};
std::optional<Blocker> first_blocker(const Pack& pack, const MeshRays& rays, const Vec3& from, const Vec3& direction,
                                     float farthest);

// Emitting surfaces, punctual lights (those that the pack's plan names) and the sky. left_out: how many are not looked
// at.
std::vector<LightVerdict> judge_lights(const Pack& pack, const MeshRays& rays, const SeenPoint& point,
                                       std::size_t& left_out);

// Unit vectors around a normal, as light counts: by the cosine. The same each time.
std::vector<Vec3> cosine_directions(const Vec3& normal, int count);

}  // namespace oriel
