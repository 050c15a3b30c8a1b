#include "player/reflections/reflected_view.h"

#include <algorithm>

namespace oriel {
namespace {

// How far along the view the mirrored scene reaches: beyond the scene itself.
float mirrored_far(const Bounds& bounds, const Mat4& view_from_mirrored, const Mat4& reflector_from_pack) {
  float far = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner(i & 1 ? bounds.upper.x : bounds.lower.x, i & 2 ? bounds.upper.y : bounds.lower.y,
                      i & 4 ? bounds.upper.z : bounds.lower.z);
    far = std::max(far, -(view_from_mirrored * reflector_from_pack * Vec4(corner, 1)).z);
  }
  return 1.01f * far;
}

}  // namespace

Vec4 eye_in_reflector(const GpuReflector& reflector, const View& view) {
  return reflector.reflector_from_pack * view.eye;
}

ReflectedView reflect_view(const GpuReflector& reflector, const View& view, const ImageRect& rect,
                           const Bounds& scene) {
  ReflectedView out;
  out.mirrored_eye = eye_in_reflector(reflector, view);
  out.mirrored_eye.z = -out.mirrored_eye.z;
  Mat4 mirror(1);
  mirror[2][2] = -1;
  out.view_from_reflector = view.view_from_pack * reflector.pack_from_reflector;
  out.view_from_mirrored = out.view_from_reflector * mirror;
  out.far = std::max(view.far, mirrored_far(scene, out.view_from_mirrored, reflector.reflector_from_pack));
  out.image_from_view = clip_from_view_to(part_of(view, rect.origin, rect.width, rect.height), out.far);
  return out;
}

}  // namespace oriel
