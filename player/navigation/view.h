// A camera and a picture size as the matrices that passes draw with.
#pragma once

#include "formats/assets/camera.h"
#include "player/navigation/culling.h"

namespace oriel {

struct View {
  Mat4 view_from_pack{1};  // rigid; looks along -z, y up
  Mat4 clip_from_view{1};
  Mat4 clip_from_pack{1};
  // The eye (w = 1), or the direction towards it (w = 0) of an orthographic camera. Pack space.
  Vec4 eye{0, 0, 0, 1};
  // View-space x and y over -z at the edge of the picture; half its size in metres for an orthographic camera.
  Vec2 tangents{1};
  Vec2 centre{0};  // the same of the picture's middle: not 0 where it is part of a larger one
  bool orthographic = false;
  bool mirrored = false;            // clip_from_pack turns left into right
  float near = 0.1f, far = 100.0f;  // metres along the view, near may be negative for an orthographic camera
  int width = 1, height = 1;
};

// Near and far planes enclose `bounds` as seen from the eye; what is nearer than closest_m may be cut off, in a small
// scene nearer than a 64th of its radius. People's eyes keep 25 cm from walls, and at 90° the corners of a wide picture
// are 2.3 times as far as its near plane. Any camera whose numbers are finite gives finite matrices: a direction or
// field of view that means nothing is replaced by the nearest one that does.
inline constexpr float kNearest_m = 0.1f;  // of people's size
View make_view(const Camera& camera, int width, int height, const Bounds& bounds, float closest_m = kNearest_m);

// The view's projection with another far plane, at least 0.1 % behind the near one.
Mat4 clip_from_view_to(const View& view, float far);

// What the view shows in a rectangle of its picture's plane, which may reach beyond it: lower left corner and size in
// pixels. near and far stay.
View part_of(const View& view, const Vec2& origin, int width, int height);

}  // namespace oriel
