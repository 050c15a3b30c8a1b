#include "player/passes/glass_window.h"

#include <algorithm>
#include <cmath>

#include "player/passes/mirrored_view.h"

namespace oriel {
namespace {

constexpr float kMostTangent = 4;       // of the view from the apparent eye: what lies farther aside is left to others
constexpr float kMargin = 0.03f;        // of its picture, on each side
constexpr float kLeastOfFrame = 4e-3f;  // that the face covers
constexpr float kMostRise = 8;          // of the apparent eye, times its height
constexpr float kInFront = 1e-4f;       // of the body's radius: by which what lies in the face is cut off

using Polygon = std::vector<Vec3>;

Polygon clipped(const Polygon& in, const Vec4& inside) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Vec3 &a = in[i], &b = in[(i + 1) % in.size()];
    const float da = glm::dot(inside, Vec4(a, 1)), db = glm::dot(inside, Vec4(b, 1));
    if (da >= 0) out.push_back(a);
    if ((da > 0) != (db > 0) && da != db) out.push_back(a + (b - a) * (da / (da - db)));
  }
  return out;
}

// A face of a convex body, counter-clockwise from its front.
Polygon face_of(const GlassBody& body, std::size_t face) {
  const Vec3 n(body.planes[face]);
  const Vec3 x = glm::normalize(glm::cross(std::fabs(n.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0), n));
  const Vec3 y = glm::cross(n, x), middle = body.centre - n * (glm::dot(n, body.centre) + body.planes[face].w);
  const float r = 2 * body.radius;
  Polygon polygon{middle - r * x - r * y, middle + r * x - r * y, middle + r * x + r * y, middle - r * x + r * y};
  for (std::size_t i = 0; i < body.planes.size(); ++i)
    if (i != face) polygon = clipped(polygon, -body.planes[i]);
  return polygon;
}

Vec3 middle_of(const Polygon& polygon) {
  Vec3 sum(0);
  for (const Vec3& p : polygon) sum += p;
  return sum / static_cast<float>(polygon.size());
}

// Of the picture, of a polygon within the view.
float share_of_picture(const Polygon& polygon, const Mat4& clip_from_pack) {
  float sum = 0;
  const auto ndc = [&](const Vec3& p) {
    const Vec4 c = clip_from_pack * Vec4(p, 1);
    return Vec2(c) / std::max(c.w, 1e-20f);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = ndc(polygon[i]), b = ndc(polygon[(i + 1) % polygon.size()]);
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.125f * std::fabs(sum);
}

struct Seen {
  std::size_t face = 0;
  Polygon polygon;  // of it, that is in view
  float share = 0;
};

Seen most_seen(const GlassBody& body, const View& view) {
  const Frustum frustum = make_frustum(view.clip_from_pack);
  Seen best;
  for (std::size_t i = 0; i < body.planes.size(); ++i) {
    if (glm::dot(body.planes[i], view.eye) <= 0) continue;
    Polygon polygon = face_of(body, i);
    for (const Vec4& plane : frustum.planes) polygon = clipped(polygon, plane);
    if (polygon.size() < 3) continue;
    const float share = share_of_picture(polygon, view.clip_from_pack);
    if (share > best.share) best = {i, std::move(polygon), share};
  }
  return best;
}

// Where the ray from the eye to a point of a face leaves the body.
Vec3 leaves_at(const GlassBody& body, const Vec3& n, float ior, const Vec3& eye, const Vec3& point) {
  const Vec3 d = glm::refract(glm::normalize(point - eye), n, 1 / ior);
  float way = 4 * body.radius;
  for (const Vec4& plane : body.planes) {
    const float speed = glm::dot(Vec3(plane), d);
    if (speed > 1e-6f) way = std::min(way, std::max(-glm::dot(plane, Vec4(point, 1)) / speed, 0.0f));
  }
  return point + way * d;
}

// The view that holds all of the points, of so many pixels at most.
View view_of(const Camera& camera, const Polygon& points, const View& frame, const Bounds& scene) {
  View view = make_view(camera, 2, 2, scene);  // a right angle, a pixel a tangent
  Vec2 lower(kMostTangent), upper(-kMostTangent);
  for (const Vec3& p : points) {
    const Vec3 at(view.view_from_pack * Vec4(p, 1));
    const Vec2 tangent = glm::clamp(Vec2(at) / std::max(-at.z, 1e-6f), -kMostTangent, kMostTangent);
    lower = glm::min(lower, tangent), upper = glm::max(upper, tangent);
  }
  const Vec2 margin = glm::max(kMargin * (upper - lower), Vec2(1e-3f)), size(frame.width, frame.height);
  lower -= margin, upper += margin;
  view.tangents = 0.5f * (upper - lower);
  view.centre = 0.5f * (upper + lower);
  view.width = frame.width, view.height = frame.height;
  view.clip_from_view = clip_from_view_to(view, view.far);
  view.clip_from_pack = view.clip_from_view * view.view_from_pack;
  return view;
}

}  // namespace

std::optional<GlassWindow> window_of(const GlassBody& body, float ior, float least_pixels, const View& view,
                                     const Bounds& scene) {
  if (!(view.eye.w > 0) || body.planes.empty()) return std::nullopt;
  const Seen seen = most_seen(body, view);
  if (seen.share < kLeastOfFrame) return std::nullopt;
  const Vec4 plane = body.planes[seen.face];
  const Vec3 n(plane), eye(view.eye), middle = middle_of(seen.polygon);
  const float height = glm::dot(plane, view.eye), away = glm::length(middle - eye);
  const float thick = -2 * glm::dot(plane, Vec4(body.centre, 1));
  const float pixels_per_tangent = 0.5f * static_cast<float>(view.height) / view.tangents.y;
  if (!(thick * (1 - 1 / ior) * pixels_per_tangent >= least_pixels * away)) return std::nullopt;
  // As high as the refracted ray in the middle seems to come from.
  const float cosine = std::clamp(height / away, 1e-3f, 1.0f), sine = std::sqrt(1 - cosine * cosine);
  const float rise = std::sqrt(std::max(ior * ior - sine * sine, 0.0f)) / cosine;
  Camera camera;
  camera.eye = eye + n * height * (std::min(rise, kMostRise) - 1);
  camera.forward = glm::normalize(middle - camera.eye);
  camera.up = Vec3(glm::transpose(view.view_from_pack)[1]);
  camera.vertical_fov_rad = 0.5f * kPi;
  Polygon points = seen.polygon;
  for (const Vec3& p : seen.polygon) points.push_back(leaves_at(body, n, ior, eye, p));
  GlassWindow window;
  window.view = view_of(camera, points, view, scene);
  const Vec4 beyond = -plane - Vec4(0, 0, 0, kInFront * body.radius);
  window.clip = with_near_plane(window.view.clip_from_pack, beyond);
  return window;
}

}  // namespace oriel
