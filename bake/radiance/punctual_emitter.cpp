#include "bake/radiance/punctual_emitter.h"

#include <algorithm>
#include <numeric>

#include "bake/trace/punctual.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr float kSide = 0.01f;   // of its distance from the plane
constexpr float kLeast = 0.01f;  // metres from the plane: what is nearer lies on it
// Cosine at the square from which on it may be darker than the light: a far corner of a long floor would leave nothing
// of the 8 bits of a share for what is near.
constexpr float kGrazing = 1 / 16.0f;

}  // namespace

std::optional<PolygonLight> punctual_square(const Scene& scene, const Light& light, const LitPlane& plane) {
  if (light.type == LightType::kDirectional || plane.nodes.empty()) return std::nullopt;
  const float over = glm::dot(light.position - plane.nodes[0], plane.normal);
  if (!(over > kLeast)) return std::nullopt;
  Vec3 most(0);
  for (const Vec3& node : plane.nodes) {
    const Vec3 towards = glm::normalize(node - light.position);
    const float cosine = plane.turns ? 1 : std::max(kGrazing, -glm::dot(plane.normal, towards));
    const Vec3 needed = punctual_intensity(scene, light, towards) / cosine;
    if (luminance(needed) > luminance(most)) most = needed;
  }
  if (!(luminance(most) > 0)) return std::nullopt;
  const float half = 0.5f * kSide * over;
  const Mat3 frame = frame_from_normal(-plane.normal);
  const auto corner = [&](float u, float v) { return light.position + half * (u * frame[0] + v * frame[1]); };
  const Vec3 a = corner(-1, -1), b = corner(1, -1), c = corner(1, 1), d = corner(-1, 1);
  PolygonLight square;
  square.radiance = most / (4 * half * half);
  square.normal = -plane.normal;
  square.corners = {{a, b, c}, {a, c, d}};
  square.boundary = {{a, b}, {b, c}, {c, d}, {d, a}};
  square.cumulative_area = {2 * double{half} * half, 4 * double{half} * half};
  square.center = light.position;
  square.radius = std::sqrt(2.0f) * half;
  square.magnitude = max_component(glm::abs(square.center)) + square.radius;
  return square;
}

float fade_of_square(const Scene& scene, const Light& light, const PolygonLight& square, const Vec3& point,
                     bool turns) {
  const Vec3 towards = glm::normalize(point - square.center);
  const float cosine = glm::dot(square.normal, towards);
  if (!(cosine > 0)) return 0;
  const Vec3 has = punctual_intensity(scene, light, towards);
  const float shown = luminance(square.radiance) * static_cast<float>(square.area_m2()) * (turns ? 1 : cosine);
  return std::clamp(luminance(has) / shown, 0.0f, 1.0f);
}

std::uint32_t punctual_of_corners(const Scene& scene, std::span<const Vec3> corners) {
  const Vec3 centre = std::accumulate(corners.begin(), corners.end(), Vec3(0)) /
                      static_cast<float>(std::max<std::size_t>(1, corners.size()));
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    if (light.type == LightType::kDirectional || corners.empty()) continue;
    if (glm::distance(centre, light.position) < 0.1f * glm::distance(corners[0], light.position)) return l;
  }
  return ~0u;
}

}  // namespace oriel
