#include "player/passes/geometry_pass.h"

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

void draw_geometry(const ScenePass& pass, const GpuScene& scene, const GpuReflector& reflector, const View& view,
                   const ImageRect& rect, const ImageTarget& target, float white, FrameStats& stats) {
  const Pack& pack = scene.pack();
  clear_image(target, rect, Vec4(pack.sky, kClosest));
  const ReflectedView reflected = reflect_view(reflector, view, rect, scene.bounds());
  View mirrored = view;
  mirrored.mirrored = true;
  mirrored.view_from_pack = reflected.view_from_mirrored * reflector.reflector_from_pack;
  mirrored.eye = reflector.pack_from_reflector * reflected.mirrored_eye;
  const Reflector& shape = pack.reflectors[reflector.index];
  Vec4 plane = glm::transpose(reflector.reflector_from_pack)[2];  // height over the reflector
  plane.w -= shape.flatness_m + 1e-5f * reflector.size;           // without the reflector itself
  mirrored.clip_from_pack = with_near_plane(reflected.image_from_view * mirrored.view_from_pack, plane);
  const Vec4 depth_row = -glm::transpose(mirrored.view_from_pack)[2];
  pass.draw_reflected(scene, mirrored, depth_row, kClosest, shape.emitters, stats);
  pass.draw_transparent(scene, mirrored, {}, white, stats);
}

}  // namespace oriel
