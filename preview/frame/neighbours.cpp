#include "preview/frame/neighbours.h"

#include <cmath>

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr float kFlat = 0.02f;        // of the distance between two pixels' points: off each other's plane
constexpr float kTurned = 0.85f;      // cosine between their normals, at least
constexpr std::size_t kFarthest = 3;  // pixels that are looked at on each side

}  // namespace

bool Neighbours::same_surface(std::size_t i, std::size_t j) const {
  if (i == j) return true;
  if (seen_.place[j].w == 0) return false;
  const Vec3 n(seen_.normal[i]), m(seen_.normal[j]);
  if (glm::dot(n, m) < kTurned) return false;
  if (seen_.place[i].w == seen_.place[j].w) return true;
  const Vec3 apart = Vec3(seen_.place[j]) - Vec3(seen_.place[i]), f(seen_.face[i]), g(seen_.face[j]);
  const float off = std::max(std::abs(glm::dot(apart, f)), std::abs(glm::dot(apart, g)));
  const float turn2 = std::max(length2(n - m), length2(f - g));
  return off * off <= length2(apart) * (kFlat * kFlat + turn2);
}

Vec4 Neighbours::around(std::size_t x, std::size_t y, const std::vector<Vec4>& sums, float all, bool even) const {
  const auto width = static_cast<std::size_t>(seen_.width), height = static_cast<std::size_t>(seen_.height);
  const std::size_t i = y * width + x;
  Vec4 sum(0);
  float points = 0;
  for (std::size_t reach = 1; reach <= kFarthest; ++reach) {
    for (std::size_t v = y - std::min(y, reach); v < std::min(height, y + reach + 1); ++v)
      for (std::size_t u = x - std::min(x, reach); u < std::min(width, x + reach + 1); ++u) {
        const std::size_t from = std::max(u > x ? u - x : x - u, v > y ? v - y : y - v);
        const std::size_t j = v * width + u;
        if ((from != reach && reach > 1) || !same_surface(i, j)) continue;
        const float weight = even ? 1.0f : (u == x ? 2.0f : 1.0f) * (v == y ? 2.0f : 1.0f);
        sum += weight * sums[j];
        points += weight * sums[j].w;
      }
    if (points >= all * (even ? 1.0f : 4.0f) * 0.99f) break;
  }
  return points > 0 ? sum * (all / points) : Vec4(0);
}

Result<std::vector<Vec4>> Neighbours::gathered(const std::vector<Vec4>& sums, float all, bool even,
                                               Context& context) const {
  std::vector<Vec4> light(sums.size(), Vec4(0));
  const auto width = static_cast<std::size_t>(seen_.width);
  ORIEL_TRY_VOID(parallel_for(context, "", static_cast<std::size_t>(seen_.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x)
      if (seen_.place[y * width + x].w != 0) light[y * width + x] = around(x, y, sums, all, even);
  }));
  return light;
}

Result<std::vector<Vec4>> Neighbours::smoothed(const std::vector<Vec4>& light, std::size_t step,
                                               Context& context) const {
  std::vector<Vec4> out(light.size(), Vec4(0));
  const auto width = static_cast<std::size_t>(seen_.width), height = static_cast<std::size_t>(seen_.height);
  ORIEL_TRY_VOID(parallel_for(context, "", height, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      if (seen_.place[i].w == 0) continue;
      Vec4 sum(0);
      float weights = 0;
      for (std::size_t v = y < step ? y : y - step; v < std::min(height, y + step + 1); v += step)
        for (std::size_t u = x < step ? x : x - step; u < std::min(width, x + step + 1); u += step) {
          const std::size_t j = v * width + u;
          if (!same_surface(i, j)) continue;
          const float weight = (u == x ? 2.0f : 1.0f) * (v == y ? 2.0f : 1.0f);
          sum += weight * light[j];
          weights += weight;
        }
      out[i] = sum / weights;
    }
  }));
  return out;
}

}  // namespace oriel
