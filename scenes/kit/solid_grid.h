// Buildings as solid blocks with rooms hollowed out. Only the boundary between solid and air becomes faces, cut along
// one common grid: no face is hidden or doubled, and neighbouring faces share their vertices (no T-junctions), so that
// a building is closed by construction.
#pragma once

#include <span>

#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

// Later blocks overwrite earlier ones. Coordinates are rounded to whole millimetres.
struct Block {
  Vec3 lower{0}, upper{0};
  bool solid = true;
  int tag = 0;  // >= 0
};

enum class Facing { kLeft, kRight, kDown, kUp, kBack, kFront };  // -x, +x, -y, +y, -z, +z

// All faces between solid cells of one tag and air cells of one tag that face the same way; one or more planes.
struct SolidPatch {
  int solid_tag = 0;
  int air_tag = 0;  // kOutside where no block hollowed the air out
  Facing facing = Facing::kUp;
  SampleMesh mesh;  // without name and material
};
inline constexpr int kOutside = -1;

// Ordered by air tag, solid tag and facing.
std::vector<SolidPatch> boundary_patches(std::span<const Block> blocks);

}  // namespace oriel::sample
