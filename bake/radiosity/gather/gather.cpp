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
        around_(scene.around),
        cached_(scene.cached),
        net_(net),
        moments_(moments) {
    for (const std::uint32_t t : list) {
      if (texels_.visible[t] == 0) continue;
      members_.emplace_back();
      members_.back().texel = t;
      if (cached_.bright) members_.back().aim = cached_.bright->aim(texels_.sample_point(t, 0, 0));
    }
  }

  void run(std::uint32_t per_half, HalfSums& sums) {
    std::uint32_t first = per_half;
    for (const Member& m : members_) first = std::min(first, sums.samples[m.texel]);
    for (int half = 0; half < kHalves; ++half) {
      for (Member& m : members_) {
        m.sum = m.slope = Vec3(0), m.moments = Vec4(0);
        m.grouped.assign(around_.groups(), Vec3(0));
        m.done = sums.samples[m.texel];
        const std::uint64_t stream = std::uint64_t{m.texel} * kHalves + static_cast<std::uint64_t>(half);
        m.shift = net_.shift(stream), m.aim_shift = net_.shift(stream | kAimed);
      }
      for (std::uint32_t k = first; k < per_half; ++k) {
        if (k == first || k % kKeptSites == 0) fetch_sites(half, k - k % kKeptSites, k == first);
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
  static constexpr std::uint32_t kKeptSites = kSamplePointsPerHalf;  // most texels have no others
  static constexpr std::uint32_t kRaysAPoint = 16;                   // once all that are kept were used
  static constexpr std::uint64_t kAimed = std::uint64_t{1} << 62;    // of streams: of aimed rays
  struct Sent {
    std::uint32_t member = 0;         // into members_
    std::uint32_t region = kNoTexel;  // at which it is aimed
  };
  struct Member {
    std::uint32_t texel = 0;
    std::uint32_t done = 0;  // samples of each half that it has
    UVec2 shift{0};          // of its directions, by half
    UVec2 aim_shift{0};      // of what it aims at
    BrightTexels::Aim aim;
    std::array<GatherSite, kKeptSites> site;
    Vec3 sum{0}, slope{0};
    Vec4 moments{0};
    std::vector<Vec3> grouped;  // by group of lamps
  };

  // Points that are kept serve again until each of them had a few rays; then each few rays have a new one, for no
  // number of rays makes up for points too few.
  void fetch_sites(int half, std::uint32_t k, bool all) {
    for (Member& m : members_) {
      const std::uint32_t kept = texels_.sample_point_count(m.texel, half);
      const std::uint32_t serve = texels_.occlusion_heavy[m.texel] ? kept : kRaysAPoint;
      if (m.done >= k + kKeptSites) continue;
      if (k >= serve) {
        if (k % kRaysAPoint == 0 || m.done > k - k % kRaysAPoint)
          m.site.fill(
              GatherSite(sample_points_.at(m.texel, half, kept + k / kRaysAPoint - serve / kRaysAPoint, rays_)));
      } else if (all || texels_.occlusion_heavy[m.texel] || m.done + kKeptSites > k) {
        for (std::uint32_t i = 0; i < kKeptSites; ++i)
          m.site[i] = GatherSite(texels_.sample_point(m.texel, half, k + i));
      }
    }
  }

  // A ray for each texel, and one more at something bright for those that it is worth it.
  void add_sample(int half, std::uint32_t k) {
    batch_.clear(), about_.clear(), sent_.clear();
    const bool weighs = moments_ || around_.weighs();
    for (std::uint32_t i = 0; i < members_.size(); ++i) {
      const Member& m = members_[i];
      if (m.done > k) continue;
      const GatherSite& site = m.site[k % kKeptSites];
      const std::uint64_t stream = std::uint64_t{m.texel} * kHalves + static_cast<std::uint64_t>(half);
      const bool aims = !m.aim.empty();
      send(site.ray(net_.point(k, m.shift)), site, weighs || aims, {0, stream, k, true}, {i});
      if (!aims) continue;
      const auto target = cached_.bright->sample(m.aim, half, net_.point(k, m.aim_shift));
      if (!target) continue;
      if (const auto [ray, distance] = site.ray_to(target->point); distance > 0)
        send(ray, site, true, {0, stream | kAimed, k, true, distance}, {i, target->region});
    }
    around_.answer(batch_, about_, answers_);
    rays_ += batch_.size() + answers_.rays;
    auto& light = answers_.light;
    for (const Link& link : answers_.links) light[link.ray] += link.weight * cached_.irradiance[link.texel] / kPi;
    if (cached_.grouped)
      for (const Link& link : answers_.links) cached_.book(link.texel, link.weight / kPi, grouped_of_ray(link.ray));
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      Member& m = members_[sent_[i].member];
      const float factor = over_density(i, m);
      if (factor == 0) continue;
      Vec3 slope(0);
      if (const std::uint32_t texel = answers_.texel[i]; texel != kNoTexel) {
        const CachedTexel& met = cached_.texels[texel];
        const Vec3 there = met.at(batch_[i].origin + answers_.hits[i].distance * batch_[i].direction);
        light[i] += answers_.share[i] * there;
        slope = factor * answers_.share[i] * (there - met.radiance);
        if (cached_.grouped)
          cached_.book(texel, answers_.share[i] * there / glm::max(cached_.irradiance[texel], Vec3(1e-30f)),
                       grouped_of_ray(i));
      }
      if (!is_usable(light[i]) || !std::isfinite(factor)) {
        around_.transport().accel.dropped().add(answers_.hits[i].triangle);
        continue;
      }
      m.sum += factor * light[i];
      const std::span<Vec3> grouped = grouped_of_ray(i);
      for (std::size_t g = 0; g < grouped.size(); ++g) m.grouped[g] += factor * grouped[g];
      m.slope += slope;
      if (moments_)
        m.moments +=
            moments_of(luminance(light[i]) * factor / std::max(about_[i].incidence, kLeastCosine), batch_[i].direction);
    }
  }

  void send(const Ray& ray, const GatherSite& site, bool weighs, GatherRay about, const Sent& sent) {
    if (weighs) about.incidence = site.incidence(ray.direction);
    batch_.push_back(ray), about_.push_back(about), sent_.push_back(sent);
  }

  // Of a ray's light, for the sum over all rays of a texel: incidence over the density of rays of both kinds, π where
  // none is aimed, by what is met first. 0: an aimed ray that met something else.
  float over_density(std::size_t i, const Member& m) const {
    if (m.aim.empty()) return kPi;
    const Hit& hit = answers_.hits[i];
    if (about_[i].misses(hit)) return 0;
    const std::uint32_t region = cached_.bright->region(answers_.places[i]);
    if (sent_[i].region != kNoTexel && sent_[i].region != region) return 0;
    if (region == kNoTexel) return kPi;
    const float incidence = about_[i].incidence;
    return incidence / (incidence / kPi + cached_.bright->density(m.aim, region, batch_[i], hit));
  }

  std::span<Vec3> grouped_of_ray(std::size_t ray) {
    return std::span(answers_.grouped).subspan(ray * around_.groups(), around_.groups());
  }

  const Texels& texels_;
  const ExtraSamplePoints& sample_points_;
  const Surroundings& around_;
  const CachedLight& cached_;
  const ShiftedNet& net_;
  bool moments_;
  std::vector<Member> members_;
  std::vector<Ray> batch_;
  std::vector<GatherRay> about_;
  std::vector<Sent> sent_;  // by ray
  Answers answers_;
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
    key(light, part(g), per_half, around.near(), around.lamps(), around.survival(), sample_points.texels().eyes);
    if (cached.grouped) key(grouped_light);
    if (cached.bright) key(cached.bright->name());
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
