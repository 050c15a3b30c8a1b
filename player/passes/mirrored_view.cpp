#include "player/passes/mirrored_view.h"

#include "player/reflections/reflected_view.h"

namespace oriel {

Mat4 with_near_plane(const Mat4& clip, const Vec4& plane) {
  const DMat4 matrix(clip);
  const DVec4 in_clip = glm::transpose(glm::inverse(matrix)) * DVec4(plane);
  // The corner of the frustum farthest on the plane's positive side stays on the far plane.
  const DVec4 corner(in_clip.x < 0 ? -1.0 : 1.0, in_clip.y < 0 ? -1.0 : 1.0, 1, 1);
  const double reach = glm::dot(in_clip, corner);
  if (!(reach > 0)) return clip;
  DMat4 rows = glm::transpose(matrix);
  rows[2] = DVec4(plane) * (2 / reach) - rows[3];
  return Mat4(glm::transpose(rows));
}

View mirrored_view(const GpuScene& scene, const GpuReflector& reflector, const View& view, const ImageRect& rect) {
  const ReflectedView reflected = reflect_view(reflector, view, rect, scene.bounds());
  View mirrored = part_of(view, rect.origin, rect.width, rect.height);
  mirrored.mirrored = !view.mirrored;
  mirrored.view_from_pack = reflected.view_from_mirrored * reflector.reflector_from_pack;
  mirrored.eye = reflector.pack_from_reflector * reflected.mirrored_eye;
  mirrored.clip_from_view = reflected.image_from_view;
  mirrored.far = reflected.far;
  Vec4 plane = glm::transpose(reflector.reflector_from_pack)[2];  // height over the reflector
  const float flatness = scene.pack().reflectors[reflector.index].flatness_m;
  plane.w -= flatness + 1e-5f * reflector.size;  // without the reflector itself
  mirrored.clip_from_pack = with_near_plane(reflected.image_from_view * mirrored.view_from_pack, plane);
  return mirrored;
}

}  // namespace oriel
