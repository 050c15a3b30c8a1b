// A lamp that is not where it was baked, as surround maps show it.
#pragma once

#include <algorithm>
#include <optional>

#include "formats/pack/pack.h"
#include "formats/query/mesh_rays.h"
#include "formats/query/mover_pose.h"

namespace oriel {

class MovedLamp {
 public:
  // The parts of a light group that shine, as they do now; the pose takes them from where the mesh has them.
  MovedLamp(const Pack& pack, const LightGroup& group, const MoverPose& pose);
  MovedLamp(const MovedLamp&) = delete;
  MovedLamp& operator=(const MovedLamp&) = delete;

  struct Seen {
    Vec3 radiance{0};  // cd/m²; of its back 0
    float distance = 0;
  };
  // Along a unit direction, nearer than `farthest`.
  std::optional<Seen> along(const Vec3& from, const Vec3& direction, float farthest) const;
  bool has(std::uint32_t material) const { return std::ranges::find(materials_, material) != materials_.end(); }

 private:
  struct Surface {
    Vec3 emission{0};
    bool two_sided = false;
  };
  std::vector<std::uint32_t> materials_;
  std::vector<Surface> surfaces_;  // by part of mesh_
  Mesh mesh_;                      // positions, indices and parts, where the lamp is
  Vec3 centre_{0};
  float radius_ = 0;
  std::optional<MeshRays> rays_;
};

}  // namespace oriel
