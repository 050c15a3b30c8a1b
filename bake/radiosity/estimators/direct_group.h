// How direct light is estimated: a group of texels at a time, light by light. For direct_light.cpp alone.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/direct_pilot.h"
#include "bake/radiosity/gather/moments.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {

// A group of texels, light by light.
class DirectGroup {
 public:
  static constexpr std::uint64_t kPicks = 16;  // of many punctual lights, by how bright they are from each point

  // directional: run() is asked for moments.
  DirectGroup(const DirectLight& direct, std::span<const std::uint32_t> list, std::uint32_t per_half, bool directional)
      : d_(direct),
        list_(list),
        per_half_(per_half),
        directional_(directional),
        tallies_(list.size()),
        booked_(list.size(), scene().light_groups.size()),
        booked_difference_(booked_),
        booked_passed_{booked_, booked_} {
    for (std::uint32_t i = 0; i < list.size(); ++i)
      if (d_.texels_.visible[list[i]] > 0) add_points(i);
  }

  void run(DirectSums& sums) {
    sample_polygon_lights();
    for (std::uint32_t l = 0; !d_.many_punctual_ && l < d_.t_.accel.scene().lights.size(); ++l) {
      aim_at_punctual(l);
      finish_light(Vec3(1), scene().lights[l].light_group, hours_of(scene().lights[l]), per_half_);
    }
    const VirtualLights& mirrored = d_.t_.lights.mirrored();
    const auto [centre, radius] = sphere_about_points();
    for (std::uint32_t i = 0; i < mirrored.size(); ++i) {
      if (mirrored[i].order > d_.t_.options.max_bounces || !mirrored[i].may_reach(centre, radius)) continue;
      aim_at_mirrored(i);
      const Light& light = scene().lights[mirrored[i].light];
      finish_light(Vec3(1), light.light_group, hours_of(light), per_half_);
    }
    const auto any = [&](const Point& p, Sampler& sampler) {
      const float u = sampler.next1();
      return d_.t_.lights.sample(p.site.origin, u, sampler.next2());
    };
    if (d_.many_punctual_) sample_punctual(any);
    if (!d_.closed_form_) sample_lights(any);
    if (d_.closed_form_ && d_.t_.lights.samples_sky())
      sample_lights([&](const Point&, Sampler& sampler) { return d_.t_.lights.sample_sky(sampler.next2()); });
    for (std::size_t i = 0; i < list_.size(); ++i) {
      sums.value[list_[i]] = tallies_[i].total;
      sums.difference[list_[i]] = tallies_[i].difference;
      sums.variance[list_[i]] = tallies_[i].variance;
      sums.uneven[list_[i]] = 0.25f * tallies_[i].uneven * tallies_[i].uneven;
      sums.per_half[list_[i]] = per_half_;
      if (!sums.moments.empty()) sums.moments[list_[i]] = tallies_[i].moments;
      std::ranges::copy(booked_.of(i), sums.booked.of(list_[i]).begin());
      std::ranges::copy(booked_difference_.of(i), sums.booked_difference.of(list_[i]).begin());
    }
  }
  std::uint64_t rays() const { return rays_; }

 private:
  static constexpr std::uint32_t kNoGroup = ~0u;
  static constexpr std::uint32_t kSamplesAPoint = 4;  // beyond those that texels keep: to find one takes more rays
  static constexpr int kTries = 16;                   // for a point of a light that is above the horizon

  struct Point {
    TexelSite site;
    std::uint32_t texel = 0;  // of the list
    int half = 0;
    std::uint32_t k = 0;
    bool again = false;  // at the site of the point before
  };
  struct Shot {  // a shadow ray
    std::uint32_t point = 0;
    Vec3 weight{0};
    Vec3 direction{0};
    std::uint32_t group = kNoGroup;  // of a lamp that was found by chance: those done one by one are booked as a whole
    int legs = 1;                    // rays, all of which must pass
    Vec3 share{1};                   // of the weight that comes along them
  };
  // By texel: the light at hand, and what is known of all so far.
  struct Tally : LightTally {
    Vec3 total{0}, variance{0};
    Vec4 moments{0};
    Vec3 difference{0};  // of the halves' light
    Vec3 uneven{0};      // what the halves' points differ by, all lights together
  };

  std::uint64_t stream_of(std::uint32_t texel, int half) const {
    const Texels& t = d_.texels_;
    return (std::uint64_t{t.page[texel]} << 32 | t.index[texel]) * kHalves + static_cast<std::uint64_t>(half);
  }

  void add_points(std::uint32_t i) {
    // What casts sharp shadows sends the same ray from the same point.
    const std::uint32_t samples_a_point = d_.t_.accel.scene().lights.empty() ? kSamplesAPoint : 1;
    for (int half = 0; half < kHalves; ++half) {
      const std::uint32_t kept = d_.sites_.known(list_[i], half);
      for (std::uint32_t k = 0; k < per_half_; ++k) {
        const bool again = k > kept && (k - kept) % samples_a_point != 0;
        const std::uint32_t point = k < kept ? k : kept + (k - kept) / samples_a_point;
        points_.push_back(
            {again ? points_.back().site : d_.sites_.at(list_[i], half, point, rays_), i, half, k, again});
      }
    }
  }

  // Whether an estimate is a number; where not it is told.
  bool is_usable(const Point& point, const Vec3& light) const {
    if (oriel::is_usable(light)) return true;
    d_.t_.accel.dropped().add(d_.sites_.triangle(list_[point.texel]));
    return false;
  }

  void sample_polygon_lights() {
    const std::uint32_t first = std::min(per_half_, LightPilot::kSamples);
    std::vector<LightPilot> pilots;
    float most = 0;
    for (std::uint32_t l = 0; l < d_.polygons_.size(); ++l) {
      aim_at_polygon(l, 0, first, true);
      pilots.push_back(end_pilot(l));
      most = std::max(most, pilots.back().noise);
    }
    for (std::uint32_t l = 0; l < d_.polygons_.size(); ++l) {
      const LightPilot& pilot = pilots[l];
      for (std::size_t i = 0; i < tallies_.size(); ++i) static_cast<LightTally&>(tallies_[i]) = pilot.tallies[i];
      const std::uint32_t samples = per_half_ > first ? samples_of(pilot, most, per_half_) : first;
      if (samples > first) aim_at_polygon(l, first, samples, !pilot.all);
      finish_light(d_.polygons_[l].radiance, scene().light_group(d_.polygons_[l].triangles.front()), 1, samples);
    }
  }

  LightPilot end_pilot(std::uint32_t l) {
    trace();
    LightPilot pilot;
    bool any = false;
    for (Tally& t : tallies_) {
      for (int half = 0; half < kHalves; ++half) {
        pilot.all = pilot.all && t.passed[half] == t.weight[half];
        pilot.none = pilot.none && t.passed[half] == Vec3(0);
        any = any || t.weight[half] != Vec3(0);
      }
      // Of so few samples none is sure that it sees all there is: as if half a sample more saw it and half a one not.
      const float open =
          luminance(d_.polygons_[l].radiance) * (t.open[0].x + t.open[1].x) / (kHalves * LightPilot::kSamples);
      const float weight = luminance(t.weight[0] + t.weight[1]), sample = weight / (kHalves * LightPilot::kSamples);
      const float share = weight > 0 ? (luminance(t.passed[0] + t.passed[1]) + 0.5f * sample) / (weight + sample) : 0;
      pilot.noise += open * open * share * (1 - share);
      pilot.tallies.push_back(t);
      forget_light(t);
    }
    pilot.none = pilot.none && any;
    if (pilot.all || pilot.none) pilot.noise = 0;
    return pilot;
  }

  // Samples first <= k < end of each half: their light if nothing were before the lamp; with `shoot_rays` what is.
  void aim_at_polygon(std::uint32_t l, std::uint32_t first, std::uint32_t end, bool shoot_rays) {
    const PolygonLight& light = d_.polygons_[l];
    Receiver receiver;
    std::optional<PolygonView> view;
    float open = 0;
    std::uint32_t last = ~0u;  // whose site these are of
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const Point& point = points_[p];
      if (point.k < first || point.k >= end) continue;
      if (!point.again || last + 1 != p) {
        receiver = point.site.receiver();
        open = polygon_irradiance(light, receiver);
        view.reset();
      }
      last = p;
      if (!(open > 0) || !is_usable(point, Vec3(open))) continue;
      Tally& tally = tallies_[point.texel];
      tally.open[point.half] += Vec3(open);
      const bool unseen = tally.weight[0] + tally.weight[1] == Vec3(0);
      if (!shoot_rays && !unseen) continue;
      if (!view) view.emplace(light, receiver);
      Sampler sampler(d_.seed_ + seeds::kPolygonLight + l, stream_of(list_[point.texel], point.half), point.k);
      shoot_at_polygon(*view, receiver, p, sampler);
    }
  }

  // Points of the light below the horizon weigh nothing: others are tried, of a light that reaches barely above it too.
  void shoot_at_polygon(const PolygonView& view, const Receiver& receiver, std::uint32_t p, Sampler& sampler) {
    for (int tries = 0; tries < kTries; ++tries) {
      const auto s = view.sample(sampler.next2());
      const float weight = s ? incidence(receiver, s->direction) * s->solid_angle : 0;
      if (!(weight > 0)) continue;
      shoot(p, {points_[p].site.origin, s->direction, s->distance, false}, Vec3(weight));
      return;
    }
  }

  void aim_at_punctual(std::uint32_t l) {
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const Point& point = points_[p];
      Sampler sampler(d_.seed_ + seeds::kSharpLight + l, stream_of(list_[point.texel], point.half), point.k);
      const LightSample s = d_.t_.lights.sample_light(l, point.site.origin, sampler.next2());
      const Vec3 value = s.estimate * incidence(point.site.receiver(), s.direction);
      if (!(max_component(value) > 0) || !is_usable(point, value)) continue;
      tallies_[point.texel].open[point.half] += value;
      shoot(p, {point.site.origin, s.direction, s.distance}, value);
    }
  }

  std::pair<DVec3, double> sphere_about_points() const {
    Vec3 lower = points_.empty() ? Vec3(0) : points_.front().site.origin, upper = lower;
    for (const Point& p : points_) lower = glm::min(lower, p.site.origin), upper = glm::max(upper, p.site.origin);
    return {0.5 * (DVec3(lower) + DVec3(upper)), 0.5 * double{glm::length(upper - lower)}};
  }

  // A mirror's edge is taken for one of a shadow: what is beside it weighs as if the mirror were endless.
  void aim_at_mirrored(std::uint32_t i) {
    const VirtualLights& mirrored = d_.t_.lights.mirrored();
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const Point& point = points_[p];
      Sampler sampler(d_.seed_ + seeds::kMirroredLight + i, stream_of(list_[point.texel], point.half), point.k);
      const MirroredSample s = mirrored.sample(i, d_.t_.lights, point.site.origin, sampler.next2());
      const Vec3 value = s.endless * incidence(point.site.receiver(), s.direction);
      if (!(max_component(value) > 0) || !is_usable(point, value)) continue;
      tallies_[point.texel].open[point.half] += value;
      tallies_[point.texel].weight[point.half] += value;
      if (s.legs == 0) continue;
      rays_to_trace_.insert(rays_to_trace_.end(), s.rays().begin(), s.rays().end());
      shots_.push_back({p, value, s.direction, kNoGroup, s.legs, s.share});
    }
  }

  void shoot(std::uint32_t point, const Ray& ray, const Vec3& weight, std::uint32_t group = kNoGroup) {
    const Point& p = points_[point];
    tallies_[p.texel].weight[p.half] += weight;
    if (ray.max_distance > 0) {
      rays_to_trace_.push_back(ray);
      shots_.push_back({point, weight, ray.direction, group});
    } else {
      receive({point, weight, ray.direction, group}, Vec3(1));  // touching
    }
  }

  void receive(const Shot& shot, const Vec3& passed) {
    const Point& p = points_[shot.point];
    Tally& tally = tallies_[p.texel];
    const Vec3 light = shot.weight * shot.share * passed;
    tally.passed[p.half] += light;
    if (booked_.groups > 0 && shot.group != kNoGroup)
      each_owner(scene(), shot.group, shot.direction, light,
                 [&](std::uint32_t group, const Vec3& part) { booked_passed_[p.half].of(p.texel)[group] += part; });
    if (!directional_) return;
    const float cosine = std::max(incidence(p.site.receiver(), shot.direction), 1e-6f);
    tally.from += moments_of(luminance(light) / cosine, shot.direction);
  }

  void trace() {
    passed_.resize(rays_to_trace_.size());
    d_.t_.accel.transmittance(rays_to_trace_, passed_);
    rays_ += rays_to_trace_.size();
    auto leg = passed_.begin();
    for (const Shot& shot : shots_) {
      Vec3 passed(1);
      for (int k = 0; k < shot.legs; ++k) passed *= *leg++;
      receive(shot, passed);
    }
    shots_.clear();
    rays_to_trace_.clear();
  }

  // Visibility as a ratio of weights (Heitz et al. 2018): exact where all is lit or all is dark, noise in penumbrae
  // only. One ratio over all samples: its bias falls with their number. A half none of whose samples weigh anything,
  // the light being mostly below its points' horizon, knows no ratio of its own.
  void finish_light(const Vec3& radiance, std::uint32_t group, float hours, std::uint32_t per_half) {
    trace();
    const auto n = static_cast<float>(kHalves * per_half);
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      Tally& t = tallies_[i];
      const Vec3 share = ratio(t.passed[0] + t.passed[1], t.weight[0] + t.weight[1]);
      const auto own = [&](int half) {
        return max_component(t.weight[half]) > 0 ? ratio(t.passed[half], t.weight[half]) : share;
      };
      const std::array<Vec3, kHalves> of_half{own(0), own(1)};
      const Vec3 halves = 0.5f * (of_half[0] + of_half[1]);
      const Vec3 open = radiance * (t.open[0] + t.open[1]) / n;
      const Vec3 value = open * (2.0f * share - halves);
      t.total += value;
      add_moments(t, value);
      // A mix of lit and dark: Bernoulli's spread, falling as n^-1.5 for stratified points on a discontinuity.
      t.variance += hours * open * open * share * (Vec3(1) - share) / std::pow(n, 1.5f);
      // The closed form is exact at a point; the texel's mean is had from a few.
      t.uneven += std::sqrt(hours) * radiance * share * (t.open[0] - t.open[1]) / static_cast<float>(per_half);
      const Vec3 difference =
          radiance * (t.open[0] * of_half[0] - t.open[1] * of_half[1]) / static_cast<float>(per_half);
      t.difference += difference;
      if (!booked_.empty()) booked_.of(i)[group] += value, booked_difference_.of(i)[group] += difference;
      forget_light(t);
    }
  }
  // A sun of a day is seen without the other hours. Relative to its own light, a share of all, noise is so much more:
  // the mean square over hours, were they alike.
  float hours_of(const Light& light) const { return light.hour >= 0 ? static_cast<float>(scene().day.lit()) : 1.0f; }
  // The light of `value` came as the samples did.
  static void add_moments(Tally& t, const Vec3& value) {
    const float seen = luminance(t.passed[0] + t.passed[1]);
    if (seen > 0) t.moments += t.from * (std::max(0.0f, luminance(value)) / seen);
  }
  static Vec3 ratio(const Vec3& a, const Vec3& b) { return a / glm::max(b, Vec3(1e-30f)); }
  static void forget_light(LightTally& t) { t = {}; }

  // Light without a closed form: one sampled light a point, combined with the gather's own hits on it.
  template <class Sample>
  void sample_lights(const Sample& sample) {
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const Point& point = points_[p];
      Sampler sampler(d_.seed_ + seeds::kSky, stream_of(list_[point.texel], point.half), point.k);
      const LightSample s = sample(point, sampler);
      if (s.pdf == 0) continue;  // nothing, or punctual: those are done light by light
      const float cosine = incidence(point.site.receiver(), s.direction);
      const Vec3 value = s.estimate * (cosine * s.pdf / (s.pdf + cosine / kPi));
      if (max_component(value) > 0 && is_usable(point, value))
        shoot(p, {point.site.origin, s.direction, s.distance, false}, value, s.group);
    }
    finish_sampled();
  }

  void finish_sampled() {
    trace();
    const auto n = static_cast<float>(per_half_);
    for (Tally& t : tallies_) {
      const Vec3 value = (t.passed[0] + t.passed[1]) / (kHalves * n);
      t.total += value;
      add_moments(t, value);
      const Vec3 difference = (t.passed[0] - t.passed[1]) / n;
      t.variance += 0.25f * difference * difference;
      t.difference += difference;
      forget_light(t);
    }
    for (int h = 0; h < kHalves; ++h) {
      booked_.add(booked_passed_[h], 1 / (kHalves * n));
      booked_difference_.add(booked_passed_[h], (h == 0 ? 1 : -1) / n);
      std::ranges::fill(booked_passed_[h].light, Vec3(0));
    }
  }

  // The same for points, spots and suns, which no ray meets.
  template <class Sample>
  void sample_punctual(const Sample& sample) {
    for (std::uint64_t pick = 0; pick < kPicks; ++pick)
      for (std::uint32_t p = 0; p < points_.size(); ++p) {
        const Point& point = points_[p];
        Sampler sampler(d_.seed_ + seeds::kManyLights + pick, stream_of(list_[point.texel], point.half), point.k);
        const LightSample s = sample(point, sampler);
        if (s.pdf > 0) continue;  // an emissive surface, or the sky
        const Vec3 value = s.estimate * (incidence(point.site.receiver(), s.direction) / static_cast<float>(kPicks));
        if (max_component(value) > 0 && is_usable(point, value))
          shoot(p, {point.site.origin, s.direction, s.distance}, value, s.group);
      }
    finish_sampled();
  }

  const Scene& scene() const { return d_.t_.accel.scene(); }

  const DirectLight& d_;
  std::span<const std::uint32_t> list_;
  std::uint32_t per_half_;
  bool directional_;
  std::vector<Point> points_;
  std::vector<Tally> tallies_;
  BookedLight booked_, booked_difference_;          // by texel of the list: of all lights so far,
  std::array<BookedLight, kHalves> booked_passed_;  // and by half of those found by chance now
  std::vector<Ray> rays_to_trace_;
  std::vector<Shot> shots_;
  std::vector<Vec3> passed_;
  std::uint64_t rays_ = 0;
};

}  // namespace oriel
