// The eye behind a mirror (Diefenbach & Badler 1997, section 3): what it sees of the scene is what the mirror shows.
#pragma once

#include "player/reflections/image_target.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

// `clip` with its near plane moved to where dot(plane, point) = 0, so that what lies on the negative side is clipped
// (Lengyel 2005, "Oblique View Frustum Depth Projection and Clipping"). clip is regular; the plane crosses its
// frustum or lies before it.
Mat4 with_near_plane(const Mat4& clip, const Vec4& plane);

// The view of the rectangle from behind the reflector, whose plane is its near plane; the far plane lies behind the
// scene. Its picture is as the reflector shows it: left and right stay where they are.
View mirrored_view(const GpuScene& scene, const GpuReflector& reflector, const View& view, const ImageRect& rect);

}  // namespace oriel
