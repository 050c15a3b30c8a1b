#include "bake/run/view_demand.h"

#include <cmath>

#include "bake/visibility/divide.h"
#include "bake/visibility/view_importance.h"

namespace oriel {
namespace {

constexpr float kTooFar = 2.5f;  // times as far at one end as at the other
constexpr float kLeastEdge = 8;  // m: nothing is cut that is no longer

std::array<Vec3, 4> places_on(const std::array<Vec3, 3>& corners) {
  return {corners[0], corners[1], corners[2], (corners[0] + corners[1] + corners[2]) / 3.0f};
}

// The point of a triangle next to a place (Ericson 2005, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_on(const std::array<Vec3, 3>& t, const Vec3& p) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return t[0];
  const Vec3 bp = p - t[1];
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return t[1];
  if (const float c = d1 * d4 - d3 * d2; c <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  const Vec3 cp = p - t[2];
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return t[2];
  if (const float b = d5 * d2 - d1 * d6; b <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  const float a = d3 * d6 - d5 * d4;
  if (a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  const float b = d5 * d2 - d1 * d6, c = d1 * d4 - d3 * d2, sum = a + b + c;
  return sum > 0 ? t[0] + b / sum * ab + c / sum * ac : t[0];
}

// Metres from a triangle to the nearest eyes, by their boxes.
float nearest_eyes(std::span<const EyeBox> boxes, const std::array<Vec3, 3>& corners) {
  float nearest = std::numeric_limits<float>::max();
  for (const Vec3& place : places_on(corners)) nearest = std::min(nearest, distance_to(boxes, place));
  for (const EyeBox& box : boxes) {
    const Vec3 beside = nearest_on(corners, 0.5f * (box.lower + box.upper));
    nearest = std::min(nearest, glm::distance(beside, glm::clamp(beside, box.lower, box.upper)));
  }
  return nearest;
}

std::array<Vec3, 3> corners_of(const Scene& scene, std::uint32_t triangle) {
  const UVec3& v = scene.triangles[triangle];
  return {scene.positions[v.x], scene.positions[v.y], scene.positions[v.z]};
}

}  // namespace

bool divide_for_eyes(const EyeRegion& region, Scene& scene) {
  const std::vector<EyeBox> boxes = eye_boxes(region);
  return divide_triangles(scene, kLeastEdge, [&](const std::array<Vec3, 3>& corners) {
    float far = 0;
    for (const Vec3& corner : corners) far = std::max(far, distance_to(boxes, corner));
    return far > TexelDemand().even_m && far > kTooFar * std::max(nearest_eyes(boxes, corners), kLeastEdge);
  });
}

Result<TexelDemand> find_demand(const Accel& accel, const EyeRegion& region, Context& context) {
  const Scene& scene = accel.scene();
  ORIEL_TRY(const ViewImportance seen, find_view_importance(accel, region, {}, context));
  const std::vector<EyeBox> boxes = eye_boxes(region);
  TexelDemand demand;
  demand.angle_rad = kTexelAngle;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    demand.triangles.push_back(
        {seen.triangles[t].pixels, seen.triangles[t].inverse_square, nearest_eyes(boxes, corners_of(scene, t))});
  return demand;
}

float choose_texel(const Scene& scene, float otherwise, TexelDemand& demand) {
  double pixels = 0, inverse = 0, area = 0;
  for (std::uint32_t t = 0; t < demand.triangles.size(); ++t) {
    pixels += demand.triangles[t].pixels, inverse += demand.triangles[t].inverse_square;
    if (demand.triangles[t].pixels > 0) area += triangle_area(scene, t);
  }
  if (!(inverse > 0)) return otherwise;
  const double distance = std::sqrt(pixels / inverse);
  const double texel = std::min(demand.angle_rad * distance, std::sqrt(area / kLeastSeenTexels));
  // Two digits: nobody wants to read more, and a bake of a changed scene keeps its texel.
  const double digit = std::pow(10.0, std::floor(std::log10(texel)) - 1), rounded = std::round(texel / digit) * digit;
  demand.angle_rad = rounded / distance;
  return static_cast<float>(rounded);
}

}  // namespace oriel
