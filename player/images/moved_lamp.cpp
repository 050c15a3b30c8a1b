#include "player/images/moved_lamp.h"

#include "player/navigation/lamps.h"

namespace oriel {

MovedLamp::MovedLamp(const Pack& pack, const LightGroup& group, const MoverPose& pose) : materials_(group.materials) {
  const Mat4 pack_from_lamp(pack_from_object(pose));
  Vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower);
  for (const std::uint32_t p : shape_of_lamp(pack, group).parts) {
    MeshPart part = pack.mesh.parts[p];
    const std::uint32_t first = std::exchange(part.first_index, static_cast<std::uint32_t>(mesh_.indices.size()));
    for (std::uint32_t i = first; i < first + part.index_count; ++i) {
      const Vec3 at(pack_from_lamp * Vec4(pack.mesh.positions[pack.mesh.indices[i]], 1));
      lower = glm::min(lower, at), upper = glm::max(upper, at);
      mesh_.indices.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.positions.push_back(at);
    }
    const Material& material = pack.materials[part.material];
    surfaces_.push_back({material.emission, material.double_sided});
    mesh_.parts.push_back(std::move(part));
  }
  if (mesh_.positions.empty()) return;
  centre_ = 0.5f * (lower + upper), radius_ = 0.5f * glm::length(upper - lower);
  rays_.emplace(mesh_);
}

std::optional<MovedLamp::Seen> MovedLamp::along(const Vec3& from, const Vec3& direction, float farthest) const {
  if (!rays_) return std::nullopt;
  const Vec3 to = centre_ - from;
  const float ahead = glm::dot(to, direction);
  if (ahead < -radius_ || ahead - radius_ > farthest || length2(to) - ahead * ahead > radius_ * radius_)
    return std::nullopt;
  const auto hit = rays_->first(from, direction, farthest);
  if (!hit) return std::nullopt;
  const Surface& surface = surfaces_[rays_->part(hit->first_index).value_or(0)];
  return Seen{hit->front || surface.two_sided ? surface.emission : Vec3(0), hit->distance};
}

}  // namespace oriel
