#include "player/navigation/poses.h"

#include <algorithm>

#include "formats/core/text.h"

namespace oriel {

Result<std::vector<MoverPose>> poses_at(const Pack& pack, std::span<const MoverMove> moves, double time_s) {
  std::vector<MoverPose> poses;
  std::vector<std::string> names;
  for (const Mover& mover : pack.movers) {
    poses.push_back(pose_at(mover.rest, mover.keys, time_s));
    names.push_back(mover.name);
  }
  // What is no mover may be a lamp (lamps.h).
  std::vector<MoverMove> of_movers;
  for (const MoverMove& move : moves) {
    if (std::ranges::find(names, move.node) != names.end()) {
      of_movers.push_back(move);
    } else if (std::ranges::find(pack.light_groups, move.node, &LightGroup::name) == pack.light_groups.end()) {
      for (const LightGroup& group : pack.light_groups) names.push_back(group.name);
      return fail(ErrorCode::kUsage, "--move", "found \"{}\", expected a mover or a light group of the pack: {}",
                  move.node, names_like(move.node, names));
    }
  }
  ORIEL_TRY_VOID(apply_moves(of_movers, names, pack.mesh.origin, poses));
  return poses;
}

}  // namespace oriel
