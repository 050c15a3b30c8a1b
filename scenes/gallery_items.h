// What stands and hangs in the gallery's three rooms (gallery.cpp). Each adds its nodes, meshes, materials and
// textures.
#pragma once

#include "scenes/kit/scene_builder.h"
#include "scenes/kit/textures.h"

namespace oriel::sample {

inline constexpr float kGalleryHeight = 3.4f;  // of the rooms

// Four in room A, two in room C.
void add_columns(SampleScene& scene, std::uint32_t stone);
void add_pictures(SampleScene& scene, std::uint32_t frame);
// The plane mirror on B's south wall and the brushed metal panel on A's north wall.
void add_mirror_and_panel(SampleScene& scene, std::uint32_t frame);
void add_benches(SampleScene& scene, std::uint32_t wood);
// A ball on a plinth in C, a vase on B's platform, a ring stack in A.
void add_sculptures(SampleScene& scene, std::uint32_t stone);

}  // namespace oriel::sample
