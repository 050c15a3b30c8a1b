#include "study/herf1997/shadow_light.h"

#include <algorithm>

#include "formats/core/check.h"

namespace oriel::study {
namespace {

// In [0,1), always the same for k (SplitMix64, Steele et al. 2014).
double jitter(std::uint64_t k) {
  std::uint64_t z = (k + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

std::uint32_t interleave(const DVec2& p) {
  std::uint32_t code = 0;
  const auto x = static_cast<std::uint32_t>(p.x * 1024), y = static_cast<std::uint32_t>(p.y * 1024);
  for (unsigned bit = 0; bit < 10; ++bit) code |= (x >> bit & 1) << (2 * bit) | (y >> bit & 1) << (2 * bit + 1);
  return code;
}

// The square onto a triangle, areas kept.
DVec3 on_triangle(const LightTriangle& t, const DVec2& u) {
  const double root = std::sqrt(u.x);
  return t.a * (1 - root) + t.b * (root * (1 - u.y)) + t.c * (root * u.y);
}

double area(const LightTriangle& t) {
  return 0.5 * glm::length(glm::cross(t.b - t.a, t.c - t.a));
}

}  // namespace

std::vector<DVec2> jittered_pattern(int count) {
  ORIEL_CHECK(count >= 1 && count <= kMaxLightSamples);
  const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(count))));
  std::vector<DVec2> points;
  for (int column = 0; column < columns; ++column) {
    // Columns are as wide as they have points, so that all cells are of one area.
    const int first = count * column / columns, rows = count * (column + 1) / columns - first;
    for (int row = 0; row < rows; ++row) {
      const auto k = static_cast<std::uint64_t>(first + row) * 2;
      points.emplace_back((first + rows * jitter(k)) / count, (row + jitter(k + 1)) / rows);
    }
  }
  std::ranges::stable_sort(points, {}, interleave);
  return points;
}

ShadowLight sample_parallelogram(const LightParallelogram& light, float radiance, int samples) {
  const DVec3 normal = glm::cross(light.x, light.y);
  const double area = glm::length(normal);
  ORIEL_CHECK(area > 0);
  ShadowLight out{.samples = {}, .normal = normal / area, .double_sided = light.double_sided};
  for (const DVec2& u : jittered_pattern(samples))
    out.samples.push_back(
        {light.corner + u.x * light.x + u.y * light.y, radiance * static_cast<float>(area / samples)});
  return out;
}

ShadowLight sample_triangles(const std::vector<LightTriangle>& triangles, float radiance, int samples) {
  double total = 0;
  for (const LightTriangle& t : triangles) total += area(t);
  ORIEL_CHECK(total > 0);
  const LightTriangle& first = *std::ranges::max_element(triangles, {}, area);
  ShadowLight out{.samples = {}, .normal = glm::normalize(glm::cross(first.b - first.a, first.c - first.a))};
  double done = 0;
  for (const LightTriangle& t : triangles) {
    if (!(area(t) > 0)) continue;
    const auto before = std::lround(samples * done / total);
    done += area(t);
    const int own = std::max(1, static_cast<int>(std::lround(samples * done / total) - before));
    for (const DVec2& u : jittered_pattern(std::min(own, kMaxLightSamples)))
      out.samples.push_back({on_triangle(t, u), radiance * static_cast<float>(area(t) / own)});
  }
  return out;
}

}  // namespace oriel::study
