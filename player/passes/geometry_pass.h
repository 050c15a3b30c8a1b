// M by drawing the mirrored scene (Diefenbach & Badler 1997, section 3): what radiance maps stand for, at the cost of
// the scene's triangles.
#pragma once

#include "player/passes/scene_pass.h"
#include "player/reflections/image_target.h"

namespace oriel {

// `clip` with its near plane moved to where dot(plane, point) = 0, so that what lies on the negative side is clipped
// (Lengyel 2005, "Oblique View Frustum Depth Projection and Clipping"). clip is regular; the plane crosses its
// frustum or lies before it.
Mat4 with_near_plane(const Mat4& clip, const Vec4& plane);

// Fills the image with the scene mirrored in the reflector's plane: the light that radiance maps hold, without the
// emitters that the reflector leaves out of them. Reflectors in it show their undirected light. white: as FrameOptions.
void draw_geometry(const ScenePass& pass, const GpuScene& scene, const GpuReflector& reflector, const View& view,
                   const ImageRect& rect, const ImageTarget& target, float white, FrameStats& stats);

}  // namespace oriel
