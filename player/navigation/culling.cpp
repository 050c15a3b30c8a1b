#include "player/navigation/culling.h"

#include <vector>

namespace oriel {

Frustum make_frustum(const Mat4& clip_from_pack) {
  const Mat4 rows = glm::transpose(clip_from_pack);
  return {{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1], rows[3] + rows[2],
           rows[3] - rows[2]}};
}

bool may_be_visible(const Frustum& frustum, const Bounds& bounds) {
  if (bounds.empty()) return false;
  for (const Vec4& plane : frustum.planes) {
    const Vec3 farthest(plane.x >= 0 ? bounds.upper.x : bounds.lower.x, plane.y >= 0 ? bounds.upper.y : bounds.lower.y,
                        plane.z >= 0 ? bounds.upper.z : bounds.lower.z);
    if (glm::dot(Vec3(plane), farthest) + plane.w < 0) return false;
  }
  return true;
}

NdcRect project_polygon(const Mat4& clip_from_pack, const std::array<Vec3, 4>& corners) {
  std::vector<Vec4> polygon;
  for (const Vec3& corner : corners) polygon.push_back(clip_from_pack * Vec4(corner, 1));
  // Sutherland–Hodgman against near (z >= -w) and the four sides, so that w > 0 for all that is left.
  const Vec4 planes[] = {{0, 0, 1, 1}, {1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}};
  for (const Vec4& plane : planes) {
    std::vector<Vec4> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec4& a = polygon[i];
      const Vec4& b = polygon[(i + 1) % polygon.size()];
      const float da = glm::dot(plane, a), db = glm::dot(plane, b);
      if (da >= 0) kept.push_back(a);
      if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    polygon = std::move(kept);
  }
  NdcRect rect;
  for (const Vec4& p : polygon) {
    if (!(p.w > 0)) continue;
    const Vec2 ndc = glm::clamp(Vec2(p) / p.w, Vec2(-1), Vec2(1));
    rect.lower = rect.empty ? ndc : glm::min(rect.lower, ndc);
    rect.upper = rect.empty ? ndc : glm::max(rect.upper, ndc);
    rect.empty = false;
  }
  return rect;
}

NdcRect project_box(const Mat4& clip_from_pack, const Bounds& box) {
  NdcRect all;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Vec3, 4> corners;
    for (int c = 0; c < 4; ++c) {
      Vec3 p = side % 2 == 0 ? box.lower : box.upper;
      p[u] = c == 1 || c == 2 ? box.upper[u] : box.lower[u];
      p[v] = c >= 2 ? box.upper[v] : box.lower[v];
      corners[static_cast<std::size_t>(c)] = p;
    }
    const NdcRect face = project_polygon(clip_from_pack, corners);
    if (face.empty) continue;
    if (all.empty) all = face;
    all.lower = glm::min(all.lower, face.lower), all.upper = glm::max(all.upper, face.upper);
  }
  return all;
}

float share_of_picture(const NdcRect& rect) {
  const Vec2 size = glm::max(glm::min(rect.upper, Vec2(1)) - glm::max(rect.lower, Vec2(-1)), Vec2(0));
  return 0.25f * size.x * size.y;
}

}  // namespace oriel
