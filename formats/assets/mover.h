// Objects that move through the baked light: rigid, lit by their precomputed transfer.
#pragma once

#include <string>
#include <vector>

#include "formats/assets/mesh.h"
#include "formats/assets/transfer.h"
#include "formats/core/vec.h"

namespace oriel {

// Where a rigid object stands: a point p of it is at position + rotation · p.
struct MoverPose {
  Vec3 position{0};           // metres
  Vec4 rotation{0, 0, 0, 1};  // unit quaternion x, y, z, w

  bool operator==(const MoverPose&) const = default;
};

struct MoverKey {
  float time_s = 0;
  MoverPose pose;
};

struct Mover {
  std::string name;             // of its node
  MoverPose rest;               // pack_from_object where nothing moves it
  std::vector<MoverKey> keys;   // of its animation, pack_from_object; times ascend, equal ones are a jump; may be empty
  Mesh mesh;                    // object space; materials are the pack's; no lightmap
  CompressedTransfer transfer;  // by vertex of the mesh
};

}  // namespace oriel
