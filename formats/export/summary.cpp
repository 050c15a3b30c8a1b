#include "formats/export/summary.h"

#include <algorithm>

#include "formats/core/color.h"

namespace oriel {

LightmapSummary summarise(const LightmapPage& page) {
  LightmapSummary summary;
  double sum = 0, squared_error = 0, low = 0, high = 0, direction = 0;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < page.state.size(); ++i) {
    ++summary.states[static_cast<std::size_t>(page.state[i]) / 85];
    if (page.state[i] != TexelState::kValid) continue;
    const double lux = luminance(page.irradiance[i]), error = luminance(page.standard_error[i]);
    low = count == 0 ? lux : std::min(low, lux);
    high = std::max(high, lux);
    sum += lux;
    squared_error += error * error;
    if (!page.direction.empty()) direction += glm::length(page.direction[i]);
    ++count;
  }
  if (count == 0) return summary;
  summary.min_lux = low;
  summary.max_lux = high;
  summary.mean_lux = sum / static_cast<double>(count);
  summary.mean_direction = direction / static_cast<double>(count);
  if (summary.mean_lux > 0) summary.error = std::sqrt(squared_error / static_cast<double>(count)) / summary.mean_lux;
  return summary;
}

namespace {

// RadianceMap or SurroundMap.
template <class Map>
RadianceMapSummary summarise_radiance(const Map& map) {
  RadianceMapSummary summary;
  double sum = 0;
  for (std::size_t i = 0; i < map.valid.size(); ++i) {
    ++summary.pixels[map.valid[i]];
    if (map.valid[i] != 1) continue;
    const double value = luminance(map.radiance[i]);
    sum += value;
    summary.max = std::max(summary.max, value);
  }
  if (summary.pixels[1] > 0) summary.mean = sum / static_cast<double>(summary.pixels[1]);
  return summary;
}

}  // namespace

RadianceMapSummary summarise(const RadianceMap& map) {
  return summarise_radiance(map);
}
RadianceMapSummary summarise(const SurroundMap& map) {
  return summarise_radiance(map);
}

MeshBounds bounds_of(const Mesh& mesh) {
  if (mesh.positions.empty()) return {};
  MeshBounds bounds{mesh.positions[0], mesh.positions[0]};
  for (const Vec3& p : mesh.positions) {
    bounds.lower = glm::min(bounds.lower, p);
    bounds.upper = glm::max(bounds.upper, p);
  }
  return bounds;
}

}  // namespace oriel
