// A view and its image in a reflector's plane.
#pragma once

#include "player/reflections/image_target.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

// The eye of a view in a reflector's space: a point (w = 1), or the direction to it (w = 0).
Vec4 eye_in_reflector(const GpuReflector& reflector, const View& view);

struct ReflectedView {
  Vec4 mirrored_eye{0};         // eye_in_reflector with z negated
  Mat4 view_from_reflector{1};  // as things lie
  Mat4 view_from_mirrored{1};   // reflector space with z negated first: where the mirror shows them
  Mat4 image_from_view{1};      // clip space of the image's rectangle
  float far = 1;                // its far plane, metres along the view: behind the mirrored scene
};
ReflectedView reflect_view(const GpuReflector& reflector, const View& view, const ImageRect& rect, const Bounds& scene);

}  // namespace oriel
