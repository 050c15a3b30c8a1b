#include "formats/analysis/pack_diff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "formats/analysis/leaves.h"
#include "formats/analysis/part_light.h"
#include "formats/core/color.h"
#include "formats/query/camera.h"
#include "formats/query/mesh_rays.h"

namespace oriel {
namespace {

constexpr float kOtherTexels = 1.1f;   // times as large: another size
constexpr float kBlockTexels = 4;      // of the larger ones, a block's side: within it texels share their noise
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

// Then parts are compared over blocks, not point by point: what differs within a texel is no change of light, neither
// shows it right.
bool other_texels(float before, float after) {
  return std::min(before, after) > 0 && std::max(before, after) > kOtherTexels * std::min(before, after);
}

// Two packs' light in one place, or over a block of the lattice.
struct LightPair {
  DVec3 difference{0}, variance{0};
  double weight = 0;
};

// Means over blocks of a lattice: of each, one sample.
class Blocks {
 public:
  explicit Blocks(float side) : side_(side) {}
  void add(const Vec3& at, const LightPair& pair) {
    const Vec3 cell = glm::floor(at / side_);
    LightPair& sum = sums_[{static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                            static_cast<std::int64_t>(cell.z)}];
    sum.difference += pair.weight * pair.difference, sum.variance += pair.weight * pair.variance;
    sum.weight += pair.weight;
  }
  std::vector<LightPair> means() const {
    std::vector<LightPair> means;
    for (const auto& [cell, sum] : sums_)
      if (sum.weight > 0) means.push_back({sum.difference / sum.weight, sum.variance / sum.weight, sum.weight});
    return means;
  }

 private:
  float side_;
  std::map<std::array<std::int64_t, 3>, LightPair> sums_;
};

// Of values with their weights, which are 1 in sum.
double percentile_99(std::vector<std::pair<double, double>> values) {
  std::ranges::sort(values, std::ranges::greater());
  double above = 0;
  for (const auto& [value, weight] : values)
    if ((above += weight) > 0.01) return value;
  return 0;
}

// Of the channel that is farthest beyond its 95 % interval.
double beyond(const DVec3& bias, const DVec3& variance) {
  const DVec3 off = glm::abs(bias) - 1.96 * glm::sqrt(variance);
  return std::max({0.0, off.r, off.g, off.b});
}

// independent: how many of the pairs have noise of their own.
void sum_up(const std::vector<LightPair>& pairs, const std::vector<LightPair>& blocks, double independent,
            SurfaceChange& change) {
  DVec3 squares(0), noise(0);
  for (const LightPair& p : pairs) {
    change.bias_lux += p.weight * p.difference;
    squares += p.weight * p.difference * p.difference, noise += p.weight * p.variance;
  }
  change.bias_variance = noise / std::max(1.0, independent);
  for (int c = 0; c < 3; ++c) {
    if (squares[c] >= change.rms_lux * change.rms_lux)
      change.rms_lux = std::sqrt(squares[c]), change.noise_lux = std::sqrt(noise[c]);
    // The 99th percentile of a normal distribution's square is 6.635 times its variance.
    std::vector<std::pair<double, double>> off;
    for (const LightPair& p : blocks)
      off.emplace_back(std::sqrt(std::max(0.0, p.difference[c] * p.difference[c] - 6.635 * p.variance[c])), p.weight);
    const auto raise = [](double& most, double value) { most = std::max(most, value); };
    raise(change.p99_change_lux, percentile_99(std::move(off)));
    raise(change.rms_change_lux, std::sqrt(std::max(0.0, squares[c] - noise[c])));
  }
  change.mean_change_lux = beyond(change.bias_lux, change.bias_variance);
}

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
    change.bias_lux = DVec3(is.mean - was.mean);
    change.rms_lux = change.mean_change_lux = std::abs(is.mean - was.mean);
    return change;
  }
  const float before_m = texel_side(before, a), after_m = texel_side(after, b);
  const float block_m = std::max(kBlockTexels * std::max(before_m, after_m), 1e-6f);
  Blocks blocks(block_m);
  std::vector<LightPair> pairs;
  for_points(first, points, [&](std::size_t t, const Vec3& at, double weight) {
    const SampledLight x = first.at(t, at), y = second.at(t, at);
    pairs.push_back({y.light - x.light, x.variance + y.variance, weight});
    blocks.add(at.x * first.corner(t, 0) + at.y * first.corner(t, 1) + at.z * first.corner(t, 2), pairs.back());
  });
  const std::vector<LightPair> means = blocks.means();
  if (other_texels(before_m, after_m)) change.block_m = block_m, pairs = means;
  sum_up(pairs, means, was.area_m2 / (double{block_m} * block_m), change);
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
  change.bias_lux = DVec3(state == SurfaceState::kOnlyInFirst ? -light.mean : light.mean);
  change.rms_lux = change.mean_change_lux = light.mean;
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

double PackDiff::share(const SurfaceChange& surface) const {
  const double by = std::max({surface.before_lux, surface.after_lux, kDarkSurface * mean_lux});
  return by > 0 ? surface.change_lux() / by : 0;
}

double PackDiff::largest() const {
  double most = mean_lux > 0 ? bias_lux / mean_lux : 0;
  for (const auto* changes : {&surfaces, &cameras})
    for (const SurfaceChange& change : *changes) most = std::max(most, share(change));
  return most;
}

bool PackDiff::within(double tolerance) const {
  return largest() <= tolerance && (assets.empty() || assets[0].change <= tolerance) &&
         std::ranges::all_of(surfaces,
                             [](const SurfaceChange& s) { return s.state == SurfaceState::kBoth && s.same_shape; });
}

namespace {

// Surfaces of both packs.
struct SurfacePair {
  const MeshPart *first = nullptr, *second = nullptr;
  SurfaceChange change;
};
using SurfacePairs = std::map<std::uint32_t, SurfacePair>;  // by part of the first pack

struct BothPacks {
  const Pack &before, &after;
  const MeshRays& rays;  // of the first
  const SurfacePairs& pairs;
};

// 64 x 48 places of a camera's picture.
SurfaceChange seen_by(const Camera& camera, const BothPacks& packs) {
  const auto& [before, after, rays, pairs] = packs;
  SurfaceChange change;
  change.name = camera.name;
  constexpr int width = 64, height = 48;
  std::vector<LightPair> seen;
  Blocks blocks(kBlockTexels);  // of pixels
  DVec3 was(0), is(0);
  std::map<std::uint32_t, double> of_part;
  for (int i = 0; i < width * height; ++i) {
    const auto x = static_cast<float>(i % width), y = static_cast<float>(i / width);
    const PixelRay ray = pixel_ray(camera, x + 0.5f, y + 0.5f, width, height);
    const auto hit = rays.first(ray.origin, ray.direction);
    const auto part = hit ? rays.part(hit->first_index) : std::nullopt;
    const auto pair = part ? pairs.find(*part) : pairs.end();
    if (pair == pairs.end() || !pair->second.change.same_shape) continue;
    const std::size_t t = (hit->first_index - pair->second.first->first_index) / 3;
    const Vec3 at(1 - hit->u - hit->v, hit->u, hit->v);
    const SampledLight a = PartSampler(before, *pair->second.first).at(t, at),
                       b = PartSampler(after, *pair->second.second).at(t, at);
    seen.push_back({b.light - a.light, a.variance + b.variance, 1});
    blocks.add({x, y, 0}, seen.back());
    was += a.light, is += b.light, of_part[*part] += 1;
  }
  if (seen.empty()) return change;
  const double weight = 1 / static_cast<double>(seen.size());
  std::vector<LightPair> means = blocks.means();
  for (auto* pairs_of : {&seen, &means})
    for (LightPair& pair : *pairs_of) pair.weight *= weight;
  change.before_lux = weight * luminance(was), change.after_lux = weight * luminance(is);
  sum_up(seen, means, 1, change);
  // What a surface's mean is off by, all places on it share.
  change.bias_variance = DVec3(0);
  for (const auto& [part, places] : of_part)
    change.bias_variance += weight * weight * places * places * pairs.at(part).change.bias_variance;
  change.mean_change_lux = beyond(change.bias_lux, change.bias_variance);
  return change;
}

}  // namespace

PackDiff diff_packs(const Pack& before, const Pack& after, std::size_t points) {
  PackDiff diff;
  const auto first = parts_of(before), second = parts_of(after);
  const auto add = [&](const PartKey& key, SurfaceChange change) {
    std::tie(change.name, change.material) = std::pair(std::get<0>(key), std::get<1>(key));
    diff.surfaces.push_back(std::move(change));
  };
  SurfacePairs pairs;
  DVec3 bias(0), variance(0);
  double area = 0, both = 0;
  for (const auto& [key, part] : first) {
    const auto at = second.find(key);
    if (at == second.end()) {
      add(key, only(before, *part, SurfaceState::kOnlyInFirst, points));
      continue;
    }
    const SurfaceChange change = compare(before, *part, after, *at->second, points);
    const double m2 = change.same_shape ? change.area_m2 : 0;
    bias += m2 * change.bias_lux, variance += m2 * m2 * change.bias_variance, both += m2;
    add(key, change);
    pairs[static_cast<std::uint32_t>(part - before.mesh.parts.data())] = {part, at->second, change};
  }
  if (both > 0) diff.bias_lux = beyond(bias, variance) / both;
  for (const auto& [key, part] : second)
    if (!first.contains(key)) add(key, only(after, *part, SurfaceState::kOnlyInSecond, points));
  for (const SurfaceChange& s : diff.surfaces)
    if (s.state != SurfaceState::kOnlyInSecond) diff.mean_lux += s.area_m2 * s.before_lux, area += s.area_m2;
  if (area > 0) diff.mean_lux /= area;
  std::stable_sort(diff.surfaces.begin(), diff.surfaces.end(), [](const SurfaceChange& a, const SurfaceChange& b) {
    return a.change_lux() * a.area_m2 > b.change_lux() * b.area_m2;
  });
  if (const MeshRays rays(before.mesh); !pairs.empty())
    for (const Camera& camera : before.cameras) diff.cameras.push_back(seen_by(camera, {before, after, rays, pairs}));
  diff.assets = diff_assets(before, after);
  diff.options = diff_options(before.provenance, after.provenance);
  return diff;
}

}  // namespace oriel
