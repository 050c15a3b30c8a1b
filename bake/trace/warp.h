// Maps from the unit square to other domains, each beside its pdf. u in [0,1)².
#pragma once

#include <algorithm>

#include "formats/core/vec.h"

namespace oriel {

// Concentric map, Shirley & Chiu 1997. pdf = 1/π per unit area of the unit disk. Sine and cosine by Taylor's series up
// to 45°, where their remainders are below a float's rounding: a fifth of a gather's own time went into libm's.
inline Vec2 square_to_disk(const Vec2& u) {
  const Vec2 o = 2.0f * u - Vec2(1.0f);
  if (o.x == 0 && o.y == 0) return Vec2(0.0f);
  const bool wide = std::abs(o.x) > std::abs(o.y);
  const float r = wide ? o.x : o.y;
  const float phi = kPi / 4 * (wide ? o.y / o.x : o.x / o.y), p2 = phi * phi;
  const float sine = phi * (1 - p2 / 6 * (1 - p2 / 20 * (1 - p2 / 42 * (1 - p2 / 72))));
  const float cosine = 1 - p2 / 2 * (1 - p2 / 12 * (1 - p2 / 30 * (1 - p2 / 56)));
  return wide ? Vec2(r * cosine, r * sine) : Vec2(r * sine, r * cosine);
}

// Directions around +z with density cosθ/π per steradian (Malley).
inline Vec3 square_to_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = square_to_disk(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y))};
}
inline float cosine_hemisphere_pdf(float cos_theta) {
  return std::max(0.0f, cos_theta) / kPi;
}

// Directions around +z with density (1 + 2 cosθ)/4π: half cosine-distributed, half uniform.
inline Vec3 square_to_linear_hemisphere(const Vec2& u) {
  const float z = std::min(0.5f * (std::sqrt(1.0f + 8.0f * u.x) - 1.0f), 1.0f);  // (z² + z) / 2 = u.x
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}
inline float linear_hemisphere_pdf(float cos_theta) {
  return cos_theta > 0 ? (1 + 2 * cos_theta) / (4 * kPi) : 0.0f;
}

// pdf = 1/(4π).
inline Vec3 square_to_sphere(const Vec2& u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
}

// Barycentric weights of the second and third vertex; uniform over the triangle, pdf = 1/area.
// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
inline Vec2 square_to_triangle(const Vec2& u) {
  if (u.y > u.x) {
    const float x = u.x * 0.5f;
    return {x, u.y - x};
  }
  const float y = u.y * 0.5f;
  return {u.x - y, y};
}

}  // namespace oriel
