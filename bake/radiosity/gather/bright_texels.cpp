#include "bake/radiosity/gather/bright_texels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/radiosity/gather/cached_light.h"
#include "bake/radiosity/gather/gather_point.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kShineRays = 32;  // of a cluster
constexpr std::uint32_t kDivided = 4;     // times as many points on a texel that a wall or a lamp divides

// The radiance in the gap under a lamp on a texel; 0 without such a gap.
float radiance_in_gap(const InitialLight& light, std::uint32_t i) {
  if (!light.texels.is_cut[i] || !light.texels.cut.at(i).has_lamp()) return 0;
  return light.radiance[light.texels.under_lamp(i)];
}
float radiance_in_open(const InitialLight& light, std::uint32_t i) {
  return light.texels.visible[i] > 0 ? light.radiance[i] : 0.0f;
}

}  // namespace

InitialLight::InitialLight(const Texels& t, const ExtraSamplePoints& s, const CachedLight& cached,
                           std::span<const Vec3> gathered, std::span<const float> of_frames)
    : texels(t), sample_points(s), importance(of_frames), radiance(t.count()) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    radiance[i] = luminance(cached.texels[i].radiance);
    sum += double{importance[i]} * luminance(gathered[i]), all += importance[i];
  }
  if (!(all > 0)) return;
  reflected = static_cast<float>(sum / all);
}

BrightTexels::BrightTexels(const CacheQuery& query, const InitialLight& light, std::uint64_t seed)
    : accel_(&query.transport().accel), texels_(&light.texels), min_importance_(kMinImportance * light.reflected) {
  if (!(light.reflected > 0)) return;
  const std::vector<std::uint32_t> list = find_bright(light);
  if (list.empty()) return;
  open_region_.assign(light.texels.count(), kNoTexel), gap_region_ = open_region_;
  const auto count = std::clamp(kPoints / (kHalves * static_cast<std::uint32_t>(list.size())), kFewest, kMost);
  for (const std::uint32_t i : list) add_regions(light, i, count);
  cluster_regions(light.texels);
  for (std::uint32_t c = 0; c < clusters_.size(); ++c) describe(clusters_[c], c, seed);
  keep_strongest();
  content_hash_ = hash_of(power_until_, texel_of_, min_importance_);
}

// Bright texels in coherent_order.
std::vector<std::uint32_t> BrightTexels::find_bright(const InitialLight& light) const {
  const float least = kBright * light.reflected / kPi;
  const auto sends = [&](std::uint32_t i) {
    return std::max(radiance_in_open(light, i), radiance_in_gap(light, i)) * light.texels.area_m2[i];
  };
  std::vector<std::uint32_t> list = coherent_order(light.texels);
  std::erase_if(list, [&](std::uint32_t i) {
    return !(light.texels.area_m2[i] > 0) || !std::isfinite(sends(i)) || !(sends(i) > least * light.texels.area_m2[i]);
  });
  double seen = 0;
  for (const std::uint32_t i : list) seen += light.importance[i];
  if (seen > kCommon * std::accumulate(light.importance.begin(), light.importance.end(), 0.0)) return {};
  if (list.size() <= kTexels) return list;
  std::vector<std::uint32_t> order(list.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::nth_element(order, order.begin() + kTexels, {},
                           [&](std::uint32_t k) { return std::pair(-sends(list[k]), k); });
  order.resize(kTexels);
  std::ranges::sort(order);
  std::vector<std::uint32_t> most;
  for (const std::uint32_t k : order) most.push_back(list[k]);
  return most;
}

void BrightTexels::add_regions(const InitialLight& light, std::uint32_t texel, std::uint32_t count) {
  const Texels& texels = light.texels;
  Region in_open, in_gap;
  std::size_t open_points = 0, gap_points = 0;
  const std::uint32_t tries = texels.is_cut[texel] ? kDivided * count : count;
  for (int half = 0; half < kHalves; ++half)
    for (std::uint32_t k = 0; k < tries; ++k) {
      const SurfacePoint on = light.sample_points.candidate(texel, half, k);
      const Texels::Place place = texels.place(on.triangle, on.barycentric);
      const bool here = place.lies_on == texel, gap = here && place.in_lit_gap, is_open = here && place.texel == texel;
      in_open.normal += on.geometric_normal;
      in_open.points[half].push_back(is_open && !gap ? std::optional(on.position) : std::nullopt);
      in_gap.points[half].push_back(gap ? std::optional(on.position) : std::nullopt);
      open_points += is_open && !gap, gap_points += gap;
    }
  in_gap.normal = in_open.normal;
  const auto add = [&](Region& region, float radiance, std::size_t points, std::vector<std::uint32_t>& number) {
    region.area_texels2 = light.sample_points.area_texels2(texel);
    region.power =
        kPi * radiance * texels.area_m2[texel] * static_cast<float>(points) / static_cast<float>(kHalves * tries);
    if (!(radiance > kBright * light.reflected / kPi) || !(region.power > 0) || !(region.area_texels2 > 0)) return;
    if (glm::length(region.normal) > 0) region.normal = glm::normalize(region.normal);
    number[texel] = static_cast<std::uint32_t>(regions_.size());
    regions_.push_back(std::move(region)), texel_of_.push_back(texel);
  };
  add(in_open, radiance_in_open(light, texel), open_points, open_region_);
  add(in_gap, radiance_in_gap(light, texel), gap_points, gap_region_);
}

// Clusters are runs of regions on one chart.
void BrightTexels::cluster_regions(const Texels& texels) {
  const std::size_t most = (regions_.size() + kClusters - 1) / kClusters;
  power_until_.resize(regions_.size());
  for (std::uint32_t begin = 0, end; begin < regions_.size(); begin = end) {
    const auto same_chart = [&](std::uint32_t r) {
      return texels.page[texel_of_[r]] == texels.page[texel_of_[begin]] &&
             texels.chart[texel_of_[r]] == texels.chart[texel_of_[begin]];
    };
    Cluster cluster{.first = begin};
    for (end = begin; end < regions_.size() && end - begin < most && same_chart(end); ++end) {
      regions_[end].cluster = static_cast<std::uint32_t>(clusters_.size());
      power_until_[end] = cluster.power += regions_[end].power;
      cluster.normal += regions_[end].power * regions_[end].normal;
    }
    cluster.end = end;
    clusters_.push_back(cluster);
  }
}

void BrightTexels::describe(Cluster& cluster, std::uint64_t stream, std::uint64_t seed) const {
  if (glm::length(cluster.normal) > 0) cluster.normal = glm::normalize(cluster.normal);
  std::vector<Vec3> points;
  for (std::uint32_t r = cluster.first; r < cluster.end; ++r)
    for (const auto& half : regions_[r].points)
      for (const std::optional<Vec3>& p : half)
        if (p) points.push_back(*p);
  for (const Vec3& p : points) cluster.centre += p / static_cast<float>(points.size());
  for (const Vec3& p : points) cluster.radius_m = std::max(cluster.radius_m, glm::distance(p, cluster.centre));
  const Mat3 frame = frame_from_normal(cluster.normal);
  for (std::uint32_t k = 0; k < kShineRays; ++k) {
    Sampler sampler(seed + seeds::kBright, stream, k);
    const Vec3& from = points[k * points.size() / kShineRays];
    const Hit hit =
        accel_->intersect(Ray{from + 1e-3f * cluster.normal, frame * square_to_cosine_hemisphere(sampler.next2())});
    if (!hit || hit.distance > kFar_m) cluster.shines_far += 1.0f / kShineRays;
  }
}

// The other clusters are left to cosine-distributed rays.
void BrightTexels::keep_strongest() {
  if (clusters_.size() <= kClusters) return;
  std::vector<std::uint32_t> order(clusters_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t c) { return std::pair(-clusters_[c].power, c); });
  order.resize(kClusters);
  std::ranges::sort(order);
  std::vector<Cluster> strongest;
  std::vector<std::uint32_t> number(clusters_.size(), kNoTexel);
  for (const std::uint32_t c : order)
    number[c] = static_cast<std::uint32_t>(strongest.size()), strongest.push_back(clusters_[c]);
  for (Region& region : regions_) region.cluster = number[region.cluster];
  clusters_ = std::move(strongest);
}

BrightTexels::ImportanceCdf BrightTexels::importance_cdf(const SamplePoint& receiver) const {
  ImportanceCdf until;
  const Vec3 up = receiver.receiver().horizon();
  float sum = 0;
  for (const Cluster& c : clusters_) {
    const Vec3 off = c.centre - receiver.origin;
    const float distance = glm::length(off), r = c.radius_m;
    // An upper bound of both cosines over the cluster's extent; a flat cluster extends in its own plane only.
    const float turned = glm::dot(up, c.normal), tall = std::sqrt(std::max(1 - turned * turned, 0.01f));
    const float here = std::min((glm::dot(off, up) + r * tall) / (distance + r), 1.0f);
    const float there = std::min((r - glm::dot(off, c.normal)) / (distance + r), 1.0f);
    if (here > 0 && there > 0)
      sum += c.power * (distance > kFar_m + r ? std::max(c.shines_far, 0.5f / kShineRays) : 1.0f) * here * there /
             (kPi * (distance * distance + r * r));
    until.push_back(sum);
  }
  if (!(sum > min_importance_) || !std::isfinite(sum)) until.clear();
  return until;
}

std::optional<BrightTexels::Target> BrightTexels::sample(const ImportanceCdf& cdf, int half, const Vec2& u) const {
  const float at = u.x * cdf.back();
  const auto c =
      std::min<std::size_t>(static_cast<std::size_t>(std::ranges::upper_bound(cdf, at) - cdf.begin()), cdf.size() - 1);
  const float before = c > 0 ? cdf[c - 1] : 0;
  const Cluster& cluster = clusters_[c];
  // The remainder of u.x selects the region.
  const float rest = (at - before) / std::max(cdf[c] - before, 1e-30f) * cluster.power;
  const auto begin = power_until_.begin() + cluster.first, end = power_until_.begin() + cluster.end;
  const auto r =
      std::min(static_cast<std::uint32_t>(std::upper_bound(begin, end, rest) - power_until_.begin()), cluster.end - 1);
  const auto& points = regions_[r].points[half];
  const auto k = std::min(static_cast<std::size_t>(u.y * static_cast<float>(points.size())), points.size() - 1);
  if (!points[k]) return std::nullopt;
  return Target{*points[k], r};
}

std::uint32_t BrightTexels::region(const Texels::Place& place) const {
  if (empty() || place.lies_on == kNoTexel) return kNoTexel;
  if (!place.in_lit_gap && place.texel != place.lies_on) return kNoTexel;  // a wall separates it
  const std::uint32_t r = (place.in_lit_gap ? gap_region_ : open_region_)[place.lies_on];
  return r != kNoTexel && regions_[r].cluster != kNoTexel ? r : kNoTexel;
}

// Points are uniform on the page: their density in the world is the triangle's texel density.
float BrightTexels::density(const ImportanceCdf& cdf, std::uint32_t r, const Ray& ray, const Hit& hit) const {
  const Region& region = regions_[r];
  const std::uint32_t c = region.cluster;
  const float chance = (cdf[c] - (c > 0 ? cdf[c - 1] : 0)) / cdf.back() * region.power / clusters_[c].power;
  const Scene& scene = accel_->scene();
  const float per_m2 = texels_->texels2_per_m2(scene, hit.triangle) / region.area_texels2;
  const float cosine = std::fabs(glm::dot(geometry_at(scene, hit, ray.direction).geometric_normal, ray.direction));
  return chance * per_m2 * hit.distance * hit.distance / std::max(cosine, 1e-6f);
}

}  // namespace oriel
