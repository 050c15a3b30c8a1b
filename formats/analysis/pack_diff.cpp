#include "formats/analysis/pack_diff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "formats/analysis/leaves.h"
#include "formats/analysis/part_light.h"

namespace oriel {
namespace {

constexpr float kOtherTexels = 1.1f;   // times as large: another size
constexpr float kBlockTexels = 4;      // of the larger ones, a block's side
constexpr double kDarkSurface = 0.01;  // of the scene's mean: darker surfaces are measured by it
using PartKey = std::tuple<std::string, std::string, std::size_t>;  // name, material, how many of these came before

bool same_shape(const PartSampler& a, const PartSampler& b, const DVec3& offset) {
  if (a.triangles() != b.triangles()) return false;
  const double close = 1e-4 * (1 + std::sqrt(a.area()));
  for (std::size_t t = 0; t < a.triangles(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      if (glm::length(DVec3(a.corner(t, c)) - DVec3(b.corner(t, c)) + offset) > close) return false;
  return true;
}

std::map<PartKey, const MeshPart*> parts_of(const Pack& pack) {
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  std::map<PartKey, const MeshPart*> parts;
  for (const MeshPart& part : pack.mesh.parts) {
    if (part.lightmap_page < 0 || part.index_count == 0) continue;
    const std::string& material = pack.materials[part.material].name;
    parts[{part.name, material, counts[{part.name, material}]++}] = &part;
  }
  return parts;
}

// Root of the area that a texel of the part has, metres; 0 where that is nothing.
float texel_side(const Pack& pack, const MeshPart& part) {
  const LightmapPage& page = pack.lightmaps[static_cast<std::size_t>(part.lightmap_page)];
  double area = 0, texels = 0;
  for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
    const std::uint32_t* c = &pack.mesh.indices[i];
    const Vec3 a = pack.mesh.positions[c[0]];
    area += glm::length(glm::cross(pack.mesh.positions[c[1]] - a, pack.mesh.positions[c[2]] - a));
    const Vec2 uv = pack.mesh.lightmap_uvs[c[0]], u = pack.mesh.lightmap_uvs[c[1]] - uv,
               v = pack.mesh.lightmap_uvs[c[2]] - uv;
    texels += std::fabs(double{u.x} * v.y - double{u.y} * v.x) * page.width * page.height;
  }
  return texels > 0 ? static_cast<float>(std::sqrt(area / texels)) : 0;
}

// Over what blocks two parts are compared, metres; 0: point by point. Of other texel sizes what differs within a texel
// is no change of light: neither shows it right.
float block_of(float before, float after) {
  const float larger = std::max(before, after), smaller = std::min(before, after);
  return smaller > 0 && larger > kOtherTexels * smaller ? kBlockTexels * larger : 0;
}

// Means over blocks of a lattice.
class Blocks {
 public:
  explicit Blocks(float side) : side_(side) {}
  void add(const Vec3& at, double difference, double weight) {
    const Vec3 cell = glm::floor(at / side_);
    auto& [sum, of] = sums_[{static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                             static_cast<std::int64_t>(cell.z)}];
    sum += weight * difference;
    of += weight;
  }
  double mean_square() const {
    double squares = 0;
    for (const auto& [cell, sums] : sums_)
      if (sums.second > 0) squares += sums.first * sums.first / sums.second;
    return squares;
  }

 private:
  float side_;
  std::map<std::array<std::int64_t, 3>, std::pair<double, double>> sums_;
};

SurfaceChange compare(const Pack& before, const MeshPart& a, const Pack& after, const MeshPart& b, std::size_t points) {
  const PartSampler first(before, a), second(after, b);
  const PartLight was = light_of(first, points), is = light_of(second, points);
  SurfaceChange change;
  change.same_shape = same_shape(first, second, before.mesh.origin - after.mesh.origin);
  change.area_m2 = was.area_m2;
  change.before_lux = was.mean;
  change.after_lux = is.mean;
  change.before_error_lux = std::sqrt(was.variance);
  change.after_error_lux = std::sqrt(is.variance);
  if (!change.same_shape) {
    change.rms_lux = std::abs(is.mean - was.mean);
    return change;
  }
  change.block_m = block_of(texel_side(before, a), texel_side(after, b));
  Blocks blocks(std::max(change.block_m, 1e-6f));
  double squares = 0, noise = 0;
  for_points(first, points, [&](std::size_t t, const Vec3& at, double weight) {
    const SampledLight x = first.at(t, at), y = second.at(t, at);
    const double difference = x.lux - y.lux;
    if (change.block_m > 0)
      blocks.add(at.x * first.corner(t, 0) + at.y * first.corner(t, 1) + at.z * first.corner(t, 2), difference, weight);
    squares += weight * difference * difference;
    noise += weight * (x.variance + y.variance);
  });
  change.rms_lux = std::sqrt(change.block_m > 0 ? blocks.mean_square() : squares);
  change.noise_lux = std::sqrt(noise);
  return change;
}

SurfaceChange only(const Pack& pack, const MeshPart& part, SurfaceState state, std::size_t points) {
  const PartSampler sampler(pack, part);
  const PartLight light = light_of(sampler, points);
  SurfaceChange change;
  change.state = state;
  change.area_m2 = light.area_m2;
  (state == SurfaceState::kOnlyInFirst ? change.before_lux : change.after_lux) = light.mean;
  (state == SurfaceState::kOnlyInFirst ? change.before_error_lux : change.after_error_lux) = std::sqrt(light.variance);
  change.rms_lux = light.mean;
  return change;
}

std::vector<OptionChange> diff_options(const std::string& before, const std::string& after) {
  const auto a = leaves_of(before), b = leaves_of(after);
  std::vector<OptionChange> changes;
  for (const auto& [name, value] : a)
    if (const auto at = b.find(name); at == b.end() || at->second != value)
      changes.push_back({name, value, at == b.end() ? "" : at->second});
  for (const auto& [name, value] : b)
    if (!a.contains(name)) changes.push_back({name, "", value});
  return changes;
}

}  // namespace

double SurfaceChange::change_lux() const {
  return std::sqrt(std::max(0.0, rms_lux * rms_lux - noise_lux * noise_lux));
}

double PackDiff::share(const SurfaceChange& surface) const {
  const double by = std::max({surface.before_lux, surface.after_lux, kDarkSurface * mean_lux});
  return by > 0 ? surface.change_lux() / by : 0;
}

double PackDiff::largest() const {
  double most = 0;
  for (const SurfaceChange& surface : surfaces) most = std::max(most, share(surface));
  return most;
}

PackDiff diff_packs(const Pack& before, const Pack& after, std::size_t points) {
  PackDiff diff;
  const auto first = parts_of(before), second = parts_of(after);
  const auto add = [&](const PartKey& key, SurfaceChange change) {
    std::tie(change.name, change.material) = std::pair(std::get<0>(key), std::get<1>(key));
    diff.surfaces.push_back(std::move(change));
  };
  for (const auto& [key, part] : first) {
    const auto at = second.find(key);
    add(key, at == second.end() ? only(before, *part, SurfaceState::kOnlyInFirst, points)
                                : compare(before, *part, after, *at->second, points));
  }
  for (const auto& [key, part] : second)
    if (!first.contains(key)) add(key, only(after, *part, SurfaceState::kOnlyInSecond, points));
  double area = 0;
  for (const SurfaceChange& s : diff.surfaces)
    if (s.state != SurfaceState::kOnlyInSecond) diff.mean_lux += s.area_m2 * s.before_lux, area += s.area_m2;
  if (area > 0) diff.mean_lux /= area;
  std::stable_sort(diff.surfaces.begin(), diff.surfaces.end(), [](const SurfaceChange& a, const SurfaceChange& b) {
    return a.change_lux() * a.area_m2 > b.change_lux() * b.area_m2;
  });
  diff.options = diff_options(before.provenance, after.provenance);
  return diff;
}

}  // namespace oriel
