#include "bake/trace/punctual.h"

#include <algorithm>

#include "formats/assets/light_field.h"

namespace oriel {
namespace {

// KHR_lights_punctual's spot falloff: smooth between the cones.
float spot_falloff(const Light& light, const Vec3& direction) {
  const float cos_outer = std::cos(light.outer_cone_rad), cos_inner = std::cos(light.inner_cone_rad);
  const float cosine = glm::dot(light.direction, direction);
  const float t = std::clamp((cosine - cos_outer) / std::max(kSharpestCone, cos_inner - cos_outer), 0.0f, 1.0f);
  return t * t;
}

// ∫ t² over all directions of that falloff.
double falloff_integral(const Light& light) {
  const double ci = std::cos(light.inner_cone_rad), co = std::cos(light.outer_cone_rad);
  const double width = std::max(double{kSharpestCone}, ci - co),
               t = std::min(1.0, (1 - co) / width);  // t reached on the axis
  return 2 * kPiD * (width * t * t * t / 3 + std::max(0.0, 1 - co - width));
}

// An angle in [0, 360) into the range that was measured, by the symmetry that the range implies.
float unfolded(const std::vector<float>& measured, float degrees) {
  const float first = measured.front(), last = measured.back();
  if (last - first >= 360) return degrees;
  if (first == 90) return degrees < 90 ? 180 - degrees : degrees > 270 ? 540 - degrees : degrees;  // about 90-270
  if (degrees > 180) degrees = 360 - degrees;                                                      // about 0-180
  return last == 90 && degrees > 90 ? 180 - degrees : degrees;                                     // and about 90-270
}

// The interval of ascending `angles` that holds `angle`, and where in it.
struct Interval {
  std::size_t index;
  float fraction;
};
Interval find(const std::vector<float>& angles, float angle) {
  const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
  const std::size_t i =
      std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - angles.begin(), 1)), angles.size() - 1);
  return {i - 1, std::clamp((angle - angles[i - 1]) / (angles[i] - angles[i - 1]), 0.0f, 1.0f)};
}

}  // namespace

float profile_candela(const LightProfile& profile, float vertical_deg, float horizontal_deg) {
  // A direction's angle is rounded: what was measured at 90° must still be found there.
  constexpr float kRounding = 1e-4f;
  if (vertical_deg < profile.vertical_deg.front() - kRounding || vertical_deg > profile.vertical_deg.back() + kRounding)
    return 0;
  const Interval v = find(profile.vertical_deg, vertical_deg);
  const auto plane = [&](std::size_t h) {
    const float* row = profile.candela.data() + h * profile.vertical_deg.size() + v.index;
    return row[0] + v.fraction * (row[1] - row[0]);
  };
  if (profile.horizontal_deg.size() == 1) return plane(0);
  const float turns = horizontal_deg / 360;
  const Interval h = find(profile.horizontal_deg, unfolded(profile.horizontal_deg, 360 * (turns - std::floor(turns))));
  return plane(h.index) + h.fraction * (plane(h.index + 1) - plane(h.index));
}

double profile_flux(const LightProfile& profile) {
  // Linear between angles: exact by the trapezoid rule along the horizontal, by parts along the vertical angle.
  const std::size_t rows = profile.vertical_deg.size(), planes = profile.horizontal_deg.size();
  const auto plane_flux = [&](std::size_t h) {
    double flux = 0;
    for (std::size_t i = 0; i + 1 < rows; ++i) {
      const double a = profile.vertical_deg[i] * kPiD / 180, b = profile.vertical_deg[i + 1] * kPiD / 180;
      const double at_a = profile.candela[h * rows + i], at_b = profile.candela[h * rows + i + 1];
      // ∫ (at_a + slope (θ - a)) sin θ dθ
      flux += at_a * std::cos(a) - at_b * std::cos(b) + (at_b - at_a) / (b - a) * (std::sin(b) - std::sin(a));
    }
    return flux;
  };
  if (planes == 1) return 2 * kPiD * plane_flux(0);
  double sum = 0;
  for (std::size_t h = 0; h + 1 < planes; ++h)
    sum += 0.5 * (plane_flux(h) + plane_flux(h + 1)) * (profile.horizontal_deg[h + 1] - profile.horizontal_deg[h]);
  return 2 * kPiD * sum / (profile.horizontal_deg.back() - profile.horizontal_deg.front());
}

Vec3 punctual_intensity(const Scene& scene, const Light& light, const Vec3& direction) {
  if (light.type == LightType::kDirectional) return Vec3(0);
  if (light.profile < 0)
    return light.type == LightType::kSpot ? light.intensity * spot_falloff(light, direction) : light.intensity;
  const float z = glm::dot(light.direction, direction), x = glm::dot(light.right, direction);
  const float y = glm::dot(glm::cross(light.right, light.direction), direction) * (light.mirrored ? -1.0f : 1.0f);
  constexpr float kDegrees = 180 / kPi;
  return light.color * profile_candela(scene.profiles[static_cast<std::size_t>(light.profile)],
                                       std::atan2(std::hypot(x, y), z) * kDegrees, std::atan2(y, x) * kDegrees);
}

DVec3 punctual_power(const Scene& scene, const Light& light) {
  if (light.type == LightType::kDirectional) return DVec3(0);
  if (light.profile >= 0)
    return DVec3(light.color) * profile_flux(scene.profiles[static_cast<std::size_t>(light.profile)]);
  return DVec3(light.intensity) * (light.type == LightType::kSpot ? falloff_integral(light) : 4 * kPiD);
}

Vec3 sample_cone(const Vec3& axis, float radius_rad, const Vec2& v) {
  const float s = std::sin(0.5f * radius_rad), height = 2 * s * s * v.x;  // 1 - cosθ, without cancellation
  const float r = std::sqrt(std::max(0.0f, height * (2 - height))), phi = 2 * kPi * v.y;
  return glm::normalize(frame_from_normal(axis) * Vec3(r * std::cos(phi), r * std::sin(phi), 1 - height));
}

}  // namespace oriel
