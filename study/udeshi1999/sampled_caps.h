// Which triangles may hold the eye in their shadow volumes, as a few rays tell: the approximate capping of Udeshi &
// Hansen 1999, section 2.1.
#pragma once

#include "bake/trace/accel.h"
#include "bake/trace/sampler.h"
#include "player/navigation/view.h"

namespace oriel::study {

// Triangles between the view plane and a light: those that `rays` rays meet, from jittered samples of the view plane.
// Into Scene::triangles, in order. What no ray meets is missed. light: as ShadowMesh::volumes().
std::vector<std::uint32_t> sampled_occluders(const Accel& accel, const View& view, const Vec4& light,
                                             std::uint32_t rays, Sampler& sampler);

}  // namespace oriel::study
