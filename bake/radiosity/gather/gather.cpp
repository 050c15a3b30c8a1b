#include "bake/radiosity/gather/gather.h"

#include <cmath>

#include "bake/jobs/units.h"
#include "bake/radiosity/gather/bright_texels.h"
#include "bake/radiosity/gather/moments.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kGroup = 64;  // texels whose rays of one number are traced together: four packets

// One group of texels, in its thread's memory: what every ray needs of its texel is fetched once.
class GroupGather {
 public:
  GroupGather(const FinalGather& scene, std::span<const std::uint32_t> list, const ShiftedNet& net, bool moments)
      : texels_(scene.sample_points.texels()),
        sample_points_(scene.sample_points),
        query_(scene.query),
        cached_(scene.cached),
        net_(net),
        moments_(moments) {
    for (const std::uint32_t t : list) {
      if (texels_.visible[t] == 0) continue;
      members_.emplace_back();
      members_.back().texel = t;
      if (cached_.bright) members_.back().cdf = cached_.bright->importance_cdf(texels_.sample_point(t, 0, 0));
    }
  }

  void run(std::uint32_t per_half, HalfSums& sums) {
    std::uint32_t first = per_half;
    for (const Member& m : members_) first = std::min(first, sums.samples[m.texel]);
    for (int half = 0; half < kHalves; ++half) {
      for (Member& m : members_) {
        m.sum = m.slope = Vec3(0), m.moments = Vec4(0);
        m.grouped.assign(query_.groups(), Vec3(0));
        m.done = sums.samples[m.texel];
        const std::uint64_t stream = std::uint64_t{m.texel} * kHalves + static_cast<std::uint64_t>(half);
        m.shift = net_.shift(stream), m.target_shift = net_.shift(stream | kBrightStream);
      }
      for (std::uint32_t k = first; k < per_half; ++k) {
        if (k == first || k % kStoredPoints == 0) fetch_points(half, k - k % kStoredPoints, k == first);
        add_sample(half, k);
      }
      for (const Member& m : members_) {
        sums.sum[half][m.texel] += m.sum;
        sums.slope[half][m.texel] += m.slope;
        if (moments_) sums.moments[m.texel] += m.moments;
        const std::span<Vec3> grouped = sums.grouped[half].of(m.texel);
        for (std::size_t g = 0; g < grouped.size(); ++g) grouped[g] += m.grouped[g];
      }
    }
    for (const Member& m : members_) sums.samples[m.texel] = per_half;
  }
  std::uint64_t rays() const { return rays_; }

 private:
  static constexpr std::uint32_t kStoredPoints = kSamplePointsPerHalf;  // most texels have no others
  static constexpr std::uint32_t kRaysAPoint = 16;                      // once all stored points were used
  static constexpr std::uint64_t kBrightStream = std::uint64_t{1}
                                                 << 62;  // marks streams of light samples of bright texels
  struct Sent {
    std::uint32_t member = 0;         // into members_
    std::uint32_t region = kNoTexel;  // of a light sample
  };
  struct Member {
    std::uint32_t texel = 0;
    std::uint32_t done = 0;  // samples of each half that it has
    UVec2 shift{0};          // of its directions, by half
    UVec2 target_shift{0};   // of its light samples
    BrightTexels::ImportanceCdf cdf;
    std::array<GatherPoint, kStoredPoints> point;
    Vec3 sum{0}, slope{0};
    Vec4 moments{0};
    std::vector<Vec3> grouped;  // by light group
  };

  // Stored points are reused until each had a few rays. After that every few rays get a new point: more rays cannot
  // make up for too few points.
  void fetch_points(int half, std::uint32_t k, bool all) {
    for (Member& m : members_) {
      const std::uint32_t stored = texels_.sample_point_count(m.texel, half);
      const std::uint32_t serve = texels_.occlusion_heavy[m.texel] ? stored : kRaysAPoint;
      if (m.done >= k + kStoredPoints) continue;
      if (k >= serve) {
        if (k % kRaysAPoint == 0 || m.done > k - k % kRaysAPoint)
          m.point.fill(
              GatherPoint(sample_points_.at(m.texel, half, stored + k / kRaysAPoint - serve / kRaysAPoint, rays_)));
      } else if (all || texels_.occlusion_heavy[m.texel] || m.done + kStoredPoints > k) {
        for (std::uint32_t i = 0; i < kStoredPoints; ++i)
          m.point[i] = GatherPoint(texels_.sample_point(m.texel, half, k + i));
      }
    }
  }

  // Traces a ray for each texel, and a light sample of bright texels where those matter.
  void add_sample(int half, std::uint32_t k) {
    batch_.clear(), infos_.clear(), sent_.clear();
    const bool weighs = moments_ || query_.weighs();
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      const Member& m = members_[i];
      if (m.done > k) continue;
      const GatherPoint& point = m.point[k % kStoredPoints];
      const std::uint64_t stream = std::uint64_t{m.texel} * kHalves + static_cast<std::uint64_t>(half);
      const bool samples_bright = !m.cdf.empty();
      send(point.ray(net_.point(k, m.shift)), point, weighs || samples_bright, {0, stream, k, true}, {i});
      if (!samples_bright) continue;
      const auto target = cached_.bright->sample(m.cdf, half, net_.point(k, m.target_shift));
      if (!target) continue;
      if (const auto [ray, distance] = point.ray_to(target->point); distance > 0)
        send(ray, point, true, {0, stream | kBrightStream, k, true, distance}, {i, target->region});
    }
    query_.evaluate(batch_, infos_, results_);
    rays_ += batch_.size() + results_.rays;
    auto& light = results_.light;
    for (const Link& link : results_.links) light[link.ray] += link.weight * cached_.irradiance[link.texel] / kPi;
    if (cached_.grouped)
      for (const Link& link : results_.links)
        cached_.add_to_groups(link.texel, link.weight / kPi, grouped_of_ray(link.ray));
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      Member& m = members_[sent_[i].member];
      const float factor = over_density(i, m);
      if (factor == 0) continue;
      Vec3 slope(0);
      if (const std::uint32_t texel = results_.texel[i]; texel != kNoTexel) {
        const CachedTexel& met = cached_.texels[texel];
        const Vec3 there = met.at(batch_[i].origin + results_.hits[i].distance * batch_[i].direction);
        light[i] += results_.share[i] * there;
        slope = factor * results_.share[i] * (there - met.radiance);
        if (cached_.grouped)
          cached_.add_to_groups(texel, results_.share[i] * there / glm::max(cached_.irradiance[texel], Vec3(1e-30f)),
                                grouped_of_ray(i));
      }
      if (!is_usable(light[i]) || !std::isfinite(factor)) {
        query_.transport().accel.dropped().add(results_.hits[i].triangle);
        continue;
      }
      m.sum += factor * light[i];
      const std::span<Vec3> grouped = grouped_of_ray(i);
      for (std::size_t g = 0; g < grouped.size(); ++g) m.grouped[g] += factor * grouped[g];
      m.slope += slope;
      if (moments_)
        m.moments +=
            moments_of(luminance(light[i]) * factor / std::max(infos_[i].incidence, kLeastCosine), batch_[i].direction);
    }
  }

  void send(const Ray& ray, const GatherPoint& point, bool weighs, GatherRay info, const Sent& sent) {
    if (weighs) info.incidence = point.incidence(ray.direction);
    batch_.push_back(ray), infos_.push_back(info), sent_.push_back(sent);
  }

  // The factor of a ray's light in the sum: cosine over the density of both strategies (balance heuristic); π where
  // there is one only. 0: a light sample that hit another region.
  float over_density(std::size_t i, const Member& m) const {
    if (m.cdf.empty()) return kPi;
    const Hit& hit = results_.hits[i];
    if (infos_[i].misses(hit)) return 0;
    const std::uint32_t region = cached_.bright->region(results_.places[i]);
    if (sent_[i].region != kNoTexel && sent_[i].region != region) return 0;
    if (region == kNoTexel) return kPi;
    // By a rounded surface two ways lead to what lies barely over the facet: light samples go straight.
    const Vec3 met = batch_[i].origin + hit.distance * batch_[i].direction;
    if (m.point[infos_[i].sample % kStoredPoints].ray_to(met).first.origin != batch_[i].origin) return kPi;
    const float incidence = infos_[i].incidence;
    return incidence / (incidence / kPi + cached_.bright->density(m.cdf, region, batch_[i], hit));
  }

  std::span<Vec3> grouped_of_ray(std::size_t ray) {
    return std::span(results_.grouped).subspan(ray * query_.groups(), query_.groups());
  }

  const Texels& texels_;
  const ExtraSamplePoints& sample_points_;
  const CacheQuery& query_;
  const CachedLight& cached_;
  const ShiftedNet& net_;
  bool moments_;
  std::vector<Member> members_;
  std::vector<Ray> batch_;
  std::vector<GatherRay> infos_;
  std::vector<Sent> sent_;  // by ray
  QueryResults results_;
  std::uint64_t rays_ = 0;
};

}  // namespace

Status FinalGather::run(std::span<const std::uint32_t> list, std::uint32_t per_half, const Stage& stage,
                        HalfSums& sums) const {
  const Context& context = stage.context;
  const ShiftedNet net(context.seed + seeds::kGather, per_half);
  const Hash128 light = context.units ? hash_of(cached.irradiance) : Hash128();
  const Hash128 grouped_light = context.units && cached.grouped ? hash_of(cached.grouped->light) : Hash128();
  const auto part = [&](std::size_t g) { return list.subspan(g * kGroup, std::min(kGroup, list.size() - g * kGroup)); };
  const auto sums_of = [&](std::size_t g, Archive& archive) {
    for (const std::uint32_t t : part(g)) {
      archive(sums.samples[t]);
      for (int h = 0; h < kHalves; ++h) archive(sums.sum[h][t], sums.slope[h][t]);
      if (!sums.moments.empty()) archive(sums.moments[t]);
      for (GroupedLight& grouped : sums.grouped)
        if (!grouped.empty()) archive(grouped.of(t));
    }
  };
  UnitLoop loop{.stage = "gather", .count = (list.size() + kGroup - 1) / kGroup};
  loop.rays = static_cast<double>(kGroup * kHalves) * per_half;
  loop.inputs = [&](std::size_t g, Archive& key) {
    key(light, part(g), per_half, query.lamps(), query.survival(), sample_points.texels().eyes);
    if (cached.grouped) key(grouped_light);
    if (cached.bright) key(cached.bright->content_hash());
    sums_of(g, key);  // samples are added to them
  };
  loop.compute = [&](std::size_t g) {
    GroupGather group(*this, part(g), net, !sums.moments.empty());
    group.run(per_half, sums);
    return group.rays();
  };
  loop.results = sums_of;
  return parallel_units(stage, loop);
}

}  // namespace oriel
