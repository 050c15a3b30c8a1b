#include "player/navigation/lamps.h"

#include <algorithm>

#include "player/navigation/culling.h"

namespace oriel {

LampShape shape_of_lamp(const Pack& pack, const LightGroup& group) {
  LampShape out;
  Bounds bounds;
  for (std::uint32_t p = 0; p < pack.mesh.parts.size(); ++p) {
    const MeshPart& part = pack.mesh.parts[p];
    if (std::ranges::find(group.materials, part.material) == group.materials.end()) continue;
    out.parts.push_back(p);
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i)
      bounds.extend(pack.mesh.positions[pack.mesh.indices[i]]);
  }
  for (const std::uint32_t l : group.bright_lights) {
    const BrightLight& light = pack.light_field.lights[l];
    if (light.kind != BrightLightKind::kPoint && light.kind != BrightLightKind::kSpot) continue;
    out.lights.push_back(l);
    bounds.extend(light.position);
  }
  if (!bounds.empty()) out.centre = bounds.center();
  return out;
}

// Empty: none is elsewhere than it was baked.
static std::vector<MoverPose> animated(const Pack& pack, double time_s) {
  std::vector<MoverPose> poses;
  for (std::size_t g = 0; g < pack.light_groups.size(); ++g) {
    const LightGroup& group = pack.light_groups[g];
    if (group.keys.empty() || shape_of_lamp(pack, group).empty()) continue;
    const MoverPose motion = motion_between(group.rest, pose_at(group.rest, group.keys, time_s));
    if (is_rest(motion)) continue;
    poses.resize(pack.light_groups.size());
    poses[g] = motion;
  }
  return poses;
}

Result<std::vector<MoverPose>> lamps_at(const Pack& pack, std::span<const MoverMove> moves, double time_s) {
  std::vector<MoverPose> poses = animated(pack, time_s);
  for (const MoverMove& move : moves) {
    if (std::ranges::find(pack.movers, move.node, &Mover::name) != pack.movers.end()) continue;
    const auto group = std::ranges::find(pack.light_groups, move.node, &LightGroup::name);
    if (group == pack.light_groups.end()) continue;
    const LampShape lamp = shape_of_lamp(pack, *group);
    if (lamp.empty())
      return fail(ErrorCode::kUsage, "--move",
                  "found the light group \"{}\", which has no shining surface and no point light that the pack knows; "
                  "expected one with a lamp that can be moved",
                  move.node);
    poses.resize(pack.light_groups.size());
    MoverPose& pose = poses[static_cast<std::size_t>(group - pack.light_groups.begin())];
    pose = moved({}, move, pack.mesh.origin);  // whatever the animation says
    const Mat3 turn(pack_from_object(pose));
    pose.position -= turn * lamp.centre;
    // What is moved to where it is stays to the bit.
    if (length2(pose.position) < 1e-12f && pose.rotation == Vec4(0, 0, 0, 1)) pose = {};
  }
  return poses;
}

}  // namespace oriel
