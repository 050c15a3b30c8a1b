#include "player/navigation/poses.h"

namespace oriel {

Result<std::vector<MoverPose>> poses_at(const Pack& pack, std::span<const MoverMove> moves, double time_s) {
  std::vector<MoverPose> poses;
  std::vector<std::string> names;
  for (const Mover& mover : pack.movers) {
    poses.push_back(pose_at(mover.rest, mover.keys, time_s));
    names.push_back(mover.name);
  }
  ORIEL_TRY_VOID(apply_moves(moves, names, pack.mesh.origin, poses));
  return poses;
}

}  // namespace oriel
