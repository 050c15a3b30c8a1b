#include "player/navigation/view.h"

#include <algorithm>

namespace oriel {
namespace {

struct DepthRange {
  float near = 0.1f, far = 100.0f;
};

// Distances along `forward` that the box spans, cut so that 24 bits of depth tell apart what meets at an edge: a step
// at distance d is d² / (near 2^24), in a building of 7 m's radius no more than a 256th of a pixel, to which edges are
// placed.
DepthRange depth_range(const Bounds& bounds, const Vec3& eye, const Vec3& forward, bool orthographic, float closest_m) {
  if (bounds.empty()) return {};
  const double radius = std::max(static_cast<double>(bounds.radius()), 1e-12);
  const double center = glm::dot(DVec3(bounds.center()) - DVec3(eye), DVec3(forward));
  double far = center + radius * 1.01;
  double near = center - radius * 1.01;
  if (orthographic) return {static_cast<float>(near), static_cast<float>(std::max(far, near + radius * 1e-3))};
  far = std::max(far, radius * 1e-2);
  near = std::max({near, std::min<double>(closest_m, radius / 64), far * 1e-5});
  return {static_cast<float>(near), static_cast<float>(std::max(far, near * 1.001))};
}

}  // namespace

View make_view(const Camera& camera, int width, int height, const Bounds& bounds, float closest_m) {
  View view;
  view.width = std::max(width, 1);
  view.height = std::max(height, 1);
  view.orthographic = camera.vertical_fov_rad == 0;
  const Vec3 forward = normalize_or(camera.forward, Vec3(0, 0, -1));
  Vec3 up = normalize_or(camera.up, Vec3(0, 1, 0));
  if (length2(glm::cross(forward, up)) < 1e-10f) up = std::fabs(forward.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
  const Vec3 right = normalize_or(glm::cross(forward, up), Vec3(1, 0, 0));
  up = glm::cross(right, forward);
  const Mat3 pack_from_view(right, up, -forward);
  view.view_from_pack = Mat4(glm::transpose(pack_from_view));
  view.view_from_pack[3] = Vec4(-(glm::transpose(pack_from_view) * camera.eye), 1);

  const DepthRange range = depth_range(bounds, camera.eye, forward, view.orthographic, closest_m);
  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  view.near = range.near;
  view.far = range.far;
  if (view.orthographic) {
    const float half = camera.half_height > 0 ? camera.half_height : std::max(bounds.radius(), 1e-6f);
    view.tangents = Vec2(half * aspect, half);
    view.eye = Vec4(-forward, 0);
  } else {
    const float half = std::tan(0.5f * std::clamp(camera.vertical_fov_rad, 1e-3f, 3.1f));
    view.tangents = Vec2(half * aspect, half);
    view.eye = Vec4(camera.eye, 1);
  }
  view.clip_from_view = clip_from_view_to(view, view.far);
  view.clip_from_pack = view.clip_from_view * view.view_from_pack;
  return view;
}

Mat4 clip_from_view_to(const View& view, float far) {
  far = std::max(far, view.near + 1e-3f * std::max(std::fabs(view.near), 1e-20f));
  const float depth = far - view.near;
  Mat4 clip(0);
  clip[0][0] = 1 / view.tangents.x;
  clip[1][1] = 1 / view.tangents.y;
  const Vec2 aside = view.centre / view.tangents;
  if (view.orthographic) {
    clip[3][0] = -aside.x;
    clip[3][1] = -aside.y;
    clip[2][2] = -2.0f / depth;
    clip[3][2] = -(far + view.near) / depth;
    clip[3][3] = 1;
  } else {
    clip[2][2] = -(far + view.near) / depth;
    clip[3][2] = -2.0f * far * (view.near / depth);
    clip[2][3] = -1;
    clip[2][0] = aside.x;
    clip[2][1] = aside.y;
  }
  return clip;
}

View part_of(const View& view, const Vec2& origin, int width, int height) {
  View part = view;
  const Vec2 whole(static_cast<float>(view.width), static_cast<float>(view.height));
  const Vec2 size(static_cast<float>(width), static_cast<float>(height));
  part.width = width;
  part.height = height;
  part.tangents = view.tangents * size / whole;
  part.centre = view.centre + view.tangents * ((2.0f * origin + size) / whole - 1.0f);
  part.clip_from_view = clip_from_view_to(part, part.far);
  part.clip_from_pack = part.clip_from_view * part.view_from_pack;
  return part;
}

}  // namespace oriel
