// Objects that move through the baked light: rigid, lit by their precomputed transfer.
#pragma once

#include <string>
#include <vector>

#include "formats/assets/mesh.h"
#include "formats/assets/mover_motion.h"
#include "formats/assets/transfer.h"
#include "formats/core/vec.h"

namespace oriel {

struct Mover {
  std::string name;             // of its node
  MoverPose rest;               // pack_from_object where nothing moves it
  std::vector<MoverKey> keys;   // of its animation, pack_from_object; times ascend, equal ones are a jump; may be empty
  Mesh mesh;                    // object space; materials are the pack's; no lightmap
  CompressedTransfer transfer;  // by vertex of the mesh
};

}  // namespace oriel
