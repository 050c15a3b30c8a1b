#include "player/movers/light_samples.h"

namespace oriel {
namespace {

constexpr int kEasily = 256;  // points of all pairs of a mover and a light: so many are affordable
// Tangents of half a light's width: from where it takes 4, 8, and all points.
constexpr float kPointLike = 0.01f, kWide = 0.4f, kVeryWide = 1;

// Hammersley's set.
Vec2 hammersley(int i, int count) {
  float y = 0, half = 0.5f;
  for (int bits = i; bits > 0; bits >>= 1, half *= 0.5f)
    if ((bits & 1) != 0) y += half;
  return {(static_cast<float>(i) + 0.5f) / static_cast<float>(count), y + 0.5f / static_cast<float>(count)};
}

// Of a set of points, by which look `look` moves them (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom
// Sequences").
Vec2 shift_of(std::uint32_t look) {
  const auto part = [&](double step) { return static_cast<float>(glm::fract(step * look)); };
  return {part(0.7548776662466927), part(0.5698402909980532)};
}

void sample_polygon(const BrightLight& light, int points, std::uint32_t look, LightSamples& out) {
  std::vector<float> areas;
  float area = 0;
  for (std::size_t t = 0; t + 2 < light.corners.size(); t += 3) {
    const Vec3 *c = light.corners.data() + t, normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    area += 0.5f * glm::length(normal);
    areas.push_back(area);
  }
  if (!(area > 0)) return;
  for (int i = 0; i < points; ++i) {
    Vec2 u = glm::fract(hammersley(i, points) + shift_of(look));
    const float at = u.x * area;
    std::size_t t = 0;
    while (t + 1 < areas.size() && areas[t] <= at) ++t;
    const float below = t > 0 ? areas[t - 1] : 0;
    u.x = std::sqrt(std::clamp((at - below) / std::max(areas[t] - below, 1e-30f), 0.0f, 1.0f));
    const Vec3* c = light.corners.data() + 3 * t;
    out.at.emplace_back((1 - u.x) * c[0] + u.x * (1 - u.y) * c[1] + u.x * u.y * c[2], 1);
  }
  out.intensity = light.intensity * area;
  out.cosine = true;
  out.cones = {1, light.two_sided ? -1 : 0};
}

// Points of the disk of directions, as even as they come (Vogel 1979, "A Better Way to Construct the Sunflower Head").
void sample_disk(const BrightLight& light, int points, std::uint32_t look, LightSamples& out) {
  const float tangent = std::tan(std::min(light.angular_radius_rad, 1.5f));
  const int count = tangent > 0 ? points : 1;
  const Mat3 frame = frame_from_normal(-light.direction);
  const Vec2 shift = shift_of(look);
  const float in_ring = glm::fract(0.5f + shift.x);
  for (int i = 0; i < count; ++i) {
    const bool alone = count == 1 && look == 0;
    const float r = alone ? 0 : tangent * std::sqrt((static_cast<float>(i) + in_ring) / static_cast<float>(count));
    const float angle = 2.3999632f * static_cast<float>(i) + 2 * kPi * shift.y;
    out.at.emplace_back(glm::normalize(frame * Vec3(r * std::cos(angle), r * std::sin(angle), 1)), 0);
  }
}

}  // namespace

LightSamples sample_light(const BrightLight& light, int points, std::uint32_t look) {
  LightSamples out;
  out.intensity = light.intensity;
  out.axis = light.direction;
  if (light.kind == BrightLightKind::kPolygon) {
    sample_polygon(light, points, look, out);
  } else if (light.kind == BrightLightKind::kDirectional) {
    sample_disk(light, points, look, out);
  } else {
    out.at.emplace_back(light.position, 1);
    if (light.kind == BrightLightKind::kSpot) {
      const float outer = std::cos(light.outer_cone_rad);
      out.cones = {outer + std::max(kSharpestCone, std::cos(light.inner_cone_rad) - outer), outer};
    }
  }
  for (const Vec4& at : out.at) out.center += Vec3(at) / static_cast<float>(out.at.size());
  if (light.kind == BrightLightKind::kDirectional) {
    out.center = -light.direction;
    out.radius = std::tan(std::min(light.angular_radius_rad, 1.5f));
  } else {
    for (const Vec4& at : out.at) out.radius = std::max(out.radius, glm::distance(Vec3(at), out.center));
  }
  return out;
}

int choose_points(const BrightLight& light, std::span<const Vec4> spheres, std::size_t pairs, int most) {
  const LightSamples all = sample_light(light, kMaxLightPoints);
  if (light.kind == BrightLightKind::kPoint || light.kind == BrightLightKind::kSpot) return 1;
  float tangent = light.kind == BrightLightKind::kDirectional ? all.radius : 0;
  if (light.kind == BrightLightKind::kPolygon)
    for (const Vec4& sphere : spheres)
      tangent = std::max(tangent, all.radius / std::max(glm::distance(Vec3(sphere), all.center), 1e-6f));
  if (tangent < kPointLike) return 1;
  int wanted = tangent < kWide ? 4 : tangent < kVeryWide ? 8 : kMaxLightPoints;
  while (wanted < kMaxLightPoints && 2 * wanted * static_cast<int>(pairs) <= kEasily) wanted *= 2;
  return std::clamp(most, 1, wanted);
}

Vec3 facing_irradiance(const LightSamples& light, std::size_t i, const Vec3& p, Vec3& towards) {
  const Vec3 to = Vec3(light.at[i]) - p * light.at[i].w;
  const float distance2 = std::max(glm::dot(to, to), 1e-12f);
  towards = to / std::sqrt(distance2);
  if (light.at[i].w == 0) return light.intensity;
  const float forward = -glm::dot(towards, light.axis);
  const float t = std::clamp((forward - light.cones.y) / (light.cones.x - light.cones.y), 0.0f, 1.0f);
  const float shape = !light.cosine ? t * t : light.cones.y < 0 ? std::abs(forward) : std::max(forward, 0.0f);
  return light.intensity * (shape / distance2);
}

}  // namespace oriel
