// Triangles in pieces: large ones, so that what is near and what is far can be told apart, and those under walls.
#pragma once

#include <functional>

#include "bake/scene/scene.h"

namespace oriel {

// Cuts triangles across the middle of their longest edges as long as these are longer than shortest_m and
// wanted(corners) says so, and with them every triangle that shares such an edge (by the positions of its ends): no
// gaps open between pieces. For a scene whose sides are not split yet (no twins). Returns whether any was cut.
bool divide_triangles(Scene& scene, float shortest_m, const std::function<bool(const std::array<Vec3, 3>&)>& wanted);

// Cuts triangles of still surfaces where one of Scene::cuts lies in their plane, along it; likewise without gaps.
// Returns whether any was cut.
bool cut_triangles(Scene& scene);

}  // namespace oriel
