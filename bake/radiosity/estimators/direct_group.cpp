#include "bake/radiosity/estimators/direct_group.h"

#include <algorithm>
#include <optional>

#include "bake/radiosity/gather/moments.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/trace/rounded.h"
#include "formats/core/color.h"

namespace oriel {

DirectGroup::DirectGroup(const DirectLight& direct, std::span<const std::uint32_t> list, std::uint32_t per_half,
                         bool directional)
    : d_(direct),
      list_(list),
      per_half_(per_half),
      directional_(directional),
      tallies_(list.size()),
      grouped_(list.size(), scene().light_groups.size()),
      grouped_difference_(grouped_),
      grouped_sharp_(grouped_),
      grouped_transmitted_{grouped_, grouped_} {
  for (std::uint32_t i = 0; i < list.size(); ++i)
    if (d_.texels_.visible[list[i]] > 0) add_points(i);
}

void DirectGroup::run(DirectSums& sums) {
  for (std::uint32_t l = 0; l < d_.polygons_.size(); ++l) {
    const PolygonLight& polygon = d_.polygons_[l];
    add_lamp({polygon.radiance, scene().light_group(polygon.triangles.front()), 1, kFewSamples},
             [&](auto... range) { sample_polygon(l, range...); });
  }
  const std::vector<Light>& punctual = scene().lights;
  for (std::uint32_t l = 0; !d_.many_punctual_ && l < punctual.size(); ++l)
    add_lamp({Vec3(1), punctual[l].light_group, hours_of(punctual[l]), per_half_ / 4, l},
             [&](auto... range) { sample_punctual_light(l, range...); });
  const VirtualLights& mirrored = d_.t_.lights.mirrored();
  const auto [centre, radius] = sphere_about_points();
  for (std::uint32_t i = 0; i < mirrored.size(); ++i) {
    if (mirrored[i].order > d_.t_.options.max_bounces || !mirrored[i].may_reach(centre, radius)) continue;
    const Light& light = punctual[mirrored[i].light];
    add_lamp({Vec3(1), light.light_group, hours_of(light), per_half_ / 4},
             [&](auto... range) { sample_mirrored_light(i, range...); });
  }
  const auto any = [&](const Point& p, Sampler& sampler) {
    const float u = sampler.next1();
    return d_.t_.lights.sample(p.sample_point.origin, u, sampler.next2());
  };
  if (d_.many_punctual_) sample_lights(any, kPicks);
  if (!d_.t_.lights.frosted().empty()) sample_frosted();
  if (!d_.closed_form_) sample_lights(any);
  if (d_.closed_form_ && d_.t_.lights.samples_sky())
    sample_lights([&](const Point&, Sampler& sampler) { return d_.t_.lights.sample_sky(sampler.next2()); });
  for (std::size_t i = 0; i < list_.size(); ++i) {
    sums.value[list_[i]] = tallies_[i].total;
    sums.difference[list_[i]] = tallies_[i].difference;
    sums.variance[list_[i]] = tallies_[i].variance;
    sums.uneven[list_[i]] = 0.25f * tallies_[i].uneven * tallies_[i].uneven;
    sums.per_half[list_[i]] = per_half_;
    sums.sharp[list_[i]] = tallies_[i].sharp;
    if (!sums.moments.empty()) sums.moments[list_[i]] = tallies_[i].moments;
    std::ranges::copy(grouped_.of(i), sums.grouped.of(list_[i]).begin());
    std::ranges::copy(grouped_difference_.of(i), sums.grouped_difference.of(list_[i]).begin());
    std::ranges::copy(grouped_sharp_.of(i), sums.grouped_sharp.of(list_[i]).begin());
  }
}

std::uint64_t DirectGroup::stream_of(std::uint32_t texel, int half) const {
  const Texels& t = d_.texels_;
  return (std::uint64_t{t.page[texel]} << 32 | t.index[texel]) * kHalves + static_cast<std::uint64_t>(half);
}

void DirectGroup::add_points(std::uint32_t i) {
  // With punctual lights a repeated point would repeat the shadow ray.
  const std::uint32_t samples_a_point = d_.t_.accel.scene().lights.empty() ? kSamplesAPoint : 1;
  for (int half = 0; half < kHalves; ++half) {
    const std::uint32_t stored = d_.sample_points_.cached_count(list_[i], half);
    for (std::uint32_t k = 0; k < per_half_; ++k) {
      const bool repeats = k > stored && (k - stored) % samples_a_point != 0;
      const std::uint32_t point = k < stored ? k : stored + (k - stored) / samples_a_point;
      points_.push_back({repeats ? points_.back().sample_point : d_.sample_points_.at(list_[i], half, point, rays_), i,
                         half, k, repeats});
    }
  }
}

bool DirectGroup::is_usable(const Point& point, const Vec3& light) const {
  if (oriel::is_usable(light)) return true;
  d_.t_.accel.dropped().add(d_.sample_points_.triangle(list_[point.texel]));
  return false;
}

float DirectGroup::noise_of(const LightTally& t, const Lamp& lamp, std::uint32_t per_half) {
  // With so few samples the visibility is uncertain: one sample is added, half of it visible.
  const float n = 1.0f * kHalves * per_half, weight = luminance(t.proposal_weight[0] + t.proposal_weight[1]),
              sample = weight / n, unoccluded = luminance(lamp.radiance * (t.unoccluded[0] + t.unoccluded[1])) / n;
  if (!(weight > 0)) return 0;
  const float share = (luminance(t.transmitted[0] + t.transmitted[1]) + 0.5f * sample) / (weight + sample);
  return lamp.hours * unoccluded * unoccluded * share * (1 - share);
}

void DirectGroup::sample_polygon(std::uint32_t l, std::uint32_t first, std::uint32_t end) {
  const PolygonLight& light = d_.polygons_[l];
  Receiver receiver;
  std::optional<PolygonView> view;
  float unoccluded = 0;
  std::uint32_t last = ~0u;  // index of the point that these belong to
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    if (point.k < first || point.k >= end) continue;
    if (!point.repeats || last + 1 != p) {
      receiver = point.sample_point.receiver();
      unoccluded = polygon_irradiance(light, receiver);
      view.reset();
    }
    last = p;
    if (!(unoccluded > 0) || !is_usable(point, Vec3(unoccluded))) continue;
    Tally& tally = tallies_[point.texel];
    tally.unoccluded[point.half] += Vec3(unoccluded);
    if (!traces_[point.texel]) continue;
    if (!view) view.emplace(light, receiver);
    Sampler sampler(d_.seed_ + seeds::kPolygonLight + l, stream_of(list_[point.texel], point.half), point.k);
    add_polygon_sample(*view, receiver, p, sampler);
  }
}

void DirectGroup::add_polygon_sample(const PolygonView& view, const Receiver& receiver, std::uint32_t p,
                                     Sampler& sampler) {
  for (int tries = 0; tries < kTries; ++tries) {
    const auto s = view.sample(sampler.next2());
    const float weight = s ? incidence(receiver, s->direction) * s->solid_angle : 0;
    if (!(weight > 0)) continue;
    add_shadow_ray(p, {points_[p].sample_point.origin, s->direction, s->distance, false}, Vec3(weight));
    return;
  }
}

template <class Sample>
void DirectGroup::add_lamp(const Lamp& lamp, const Sample& sample) {
  const std::uint32_t first = std::min(std::max(lamp.first, kFewSamples), per_half_);
  std::uint32_t samples = first;
  traces_.assign(tallies_.size(), true);
  sample(0u, first);
  const bool told = shadow_rays_.size() >= kTelling;
  trace();
  const auto is_dark = [](const Tally& t) { return t.transmitted[0] + t.transmitted[1] == Vec3(0); };
  if (first < per_half_ && !(told && std::ranges::all_of(tallies_, is_dark))) {
    const bool lit = told && std::ranges::all_of(tallies_, [](auto& t) { return t.transmitted == t.proposal_weight; });
    if (lit) std::ranges::transform(tallies_, traces_.begin(), is_dark);  // none was asked for
    float noise = 0;
    for (std::uint32_t i = 0; i < tallies_.size() && !lit; ++i)
      if (!is_sharp(lamp.punctual, i)) noise += noise_of(tallies_[i], lamp, first);
    noisiest_ = std::max(noisiest_, noise);
    samples = lit ? per_half_ : std::max(first, sample_count(noise, noisiest_, per_half_));
    sample(first, samples);
    trace();
  }
  finish_lamp(lamp, samples);
}

void DirectGroup::sample_punctual_light(std::uint32_t l, std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    if (point.k < first || point.k >= end || (d_.sharp_.left_out && is_sharp(l, point.texel))) continue;
    Sampler sampler(d_.seed_ + seeds::kSharpLight + l, stream_of(list_[point.texel], point.half), point.k);
    const LightSample s = d_.t_.lights.sample_light(l, point.sample_point.origin, sampler.next2());
    const Vec3 value = s.estimate * incidence(point.sample_point.receiver(), s.direction, true);
    if (!(max_component(value) > 0) || !is_usable(point, value)) continue;
    tallies_[point.texel].unoccluded[point.half] += value;
    add_shadow_ray(p, {point.sample_point.origin, s.direction, traces_[point.texel] ? s.distance : 0, true, false},
                   value);
  }
}

std::pair<DVec3, double> DirectGroup::sphere_about_points() const {
  Vec3 lower = points_.empty() ? Vec3(0) : points_.front().sample_point.origin, upper = lower;
  for (const Point& p : points_)
    lower = glm::min(lower, p.sample_point.origin), upper = glm::max(upper, p.sample_point.origin);
  return {0.5 * (DVec3(lower) + DVec3(upper)), 0.5 * double{glm::length(upper - lower)}};
}

void DirectGroup::sample_mirrored_light(std::uint32_t i, std::uint32_t first, std::uint32_t end) {
  const VirtualLights& mirrored = d_.t_.lights.mirrored();
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const Point& point = points_[p];
    if (point.k < first || point.k >= end) continue;
    Sampler sampler(d_.seed_ + seeds::kMirroredLight + i, stream_of(list_[point.texel], point.half), point.k);
    MirroredSample s = mirrored.sample(i, d_.t_.lights, point.sample_point.origin, sampler.next2());
    const Vec3 value = s.endless * incidence(point.sample_point.receiver(), s.direction, true);
    if (!(max_component(value) > 0) || !is_usable(point, value)) continue;
    tallies_[point.texel].unoccluded[point.half] += value;
    tallies_[point.texel].proposal_weight[point.half] += value;
    if (s.legs == 0) continue;
    s.leg[0] = leaving(point.sample_point.receiver(), s.leg[0]);
    rays_to_trace_.insert(rays_to_trace_.end(), s.rays().begin(), s.rays().end());
    shadow_rays_.push_back({p, value, s.direction, kNoGroup, s.legs, true, s.share});
  }
}

void DirectGroup::sample_frosted() {
  const std::uint32_t first = std::min(per_half_, kFewSamples);
  sample_frosted(0, first, 1);
  // Where no point of the group sees a lit pane, as in other rooms, few groups go on, which stand for all.
  const auto is_lit = [](const Tally& t) { return t.transmitted[0] + t.transmitted[1] != Vec3(0); };
  const bool lit = std::ranges::any_of(tallies_, is_lit);
  Sampler roulette(d_.seed_ + seeds::kFrostedLight, stream_of(list_[0], 0), per_half_);
  if (lit || roulette.next1() * kUnlitGroups < 1) sample_frosted(first, per_half_, lit ? 1 : kUnlitGroups);
  const auto of_a_day = [](const Light& light) { return light.hour >= 0; };
  finish_sampled(std::ranges::any_of(scene().lights, of_a_day) ? static_cast<float>(scene().day.lit()) : 1.0f);
}

void DirectGroup::sample_frosted(std::uint32_t first, std::uint32_t end, float weight) {
  for (std::uint32_t p = 0; p < points_.size(); ++p)
    for (std::uint64_t pick = 0; pick < kFrosted && points_[p].k >= first && points_[p].k < end; ++pick) {
      const Point& point = points_[p];
      Sampler sampler(d_.seed_ + seeds::kFrostedLight + pick, stream_of(list_[point.texel], point.half), point.k);
      const FrostedLights::Chosen chosen{(static_cast<float>(pick) + sampler.next1()) / kFrosted, sampler.next2(),
                                         sampler.next2()};
      MirroredSample s = d_.t_.lights.frosted().sample(d_.t_.lights, point.sample_point.origin, chosen);
      const Vec3 value = s.endless * (weight * incidence(point.sample_point.receiver(), s.direction) / float{kFrosted});
      if (s.legs == 0 || !(max_component(value) > 0) || !is_usable(point, value)) continue;
      s.leg[0] = leaving(point.sample_point.receiver(), s.leg[0]);
      rays_to_trace_.insert(rays_to_trace_.end(), s.rays().begin(), s.rays().end());
      shadow_rays_.push_back({p, value, s.direction, s.group, s.legs});
    }
  trace();
}

void DirectGroup::add_shadow_ray(std::uint32_t point, const Ray& ray, const Vec3& weight, std::uint32_t group) {
  const Point& p = points_[point];
  tallies_[p.texel].proposal_weight[p.half] += weight;
  if (ray.max_distance > 0) {
    rays_to_trace_.push_back(leaving(p.sample_point.receiver(), ray));
    shadow_rays_.push_back({point, weight, ray.direction, group, 1, ray.past_solids});
  } else {
    add_transmitted({point, weight, ray.direction, group, 0, ray.past_solids}, Vec3(1));  // touching
  }
}

void DirectGroup::add_transmitted(const ShadowRay& shadow_ray, const Vec3& transmittance) {
  const Point& p = points_[shadow_ray.point];
  Tally& tally = tallies_[p.texel];
  const Vec3 light = shadow_ray.weight * shadow_ray.share * transmittance;
  tally.transmitted[p.half] += light;
  if (grouped_.groups > 0 && shadow_ray.group != kNoGroup)
    each_owner(scene(), shadow_ray.group, shadow_ray.direction, light,
               [&](std::uint32_t group, const Vec3& part) { grouped_transmitted_[p.half].of(p.texel)[group] += part; });
  if (!directional_) return;
  const float cosine = std::max(incidence(p.sample_point.receiver(), shadow_ray.direction, shadow_ray.punctual), 1e-6f);
  tally.transmitted_moments += moments_of(luminance(light) / cosine, shadow_ray.direction);
}

void DirectGroup::trace() {
  transmittances_.resize(rays_to_trace_.size());
  d_.t_.accel.transmittance(rays_to_trace_, transmittances_);
  rays_ += rays_to_trace_.size();
  auto segment = transmittances_.begin();
  for (const ShadowRay& shadow_ray : shadow_rays_) {
    Vec3 transmittance(1);
    for (int k = 0; k < shadow_ray.segments; ++k) transmittance *= *segment++;
    add_transmitted(shadow_ray, transmittance);
  }
  shadow_rays_.clear();
  rays_to_trace_.clear();
}

void DirectGroup::finish_lamp(const Lamp& lamp, std::uint32_t per_half) {
  const auto& [radiance, group, hours, first, punctual] = lamp;
  const auto n = static_cast<float>(kHalves * per_half);
  for (std::uint32_t i = 0; i < tallies_.size(); ++i) {
    Tally& t = tallies_[i];
    if (is_sharp(punctual, i)) {  // shadows' edges are drawn by pixel: their noise here is nobody's
      const Vec3 mean = (t.transmitted[0] + t.transmitted[1]) / n;
      t.total += mean, t.sharp += mean;
      if (!grouped_.empty()) grouped_.of(i)[group] += mean, grouped_sharp_.of(i)[group] += mean;
      static_cast<LightTally&>(t) = {};
      continue;
    }
    const Vec3 share = ratio(t.transmitted[0] + t.transmitted[1], t.proposal_weight[0] + t.proposal_weight[1]);
    const auto own = [&](int half) {
      return max_component(t.proposal_weight[half]) > 0 ? ratio(t.transmitted[half], t.proposal_weight[half]) : share;
    };
    const std::array<Vec3, kHalves> of_half{own(0), own(1)};
    const Vec3 halves = 0.5f * (of_half[0] + of_half[1]);
    const Vec3 unoccluded = radiance * (t.unoccluded[0] + t.unoccluded[1]) / n;
    const Vec3 value = unoccluded * (2.0f * share - halves);
    t.total += value;
    add_moments(t, value);
    // Bernoulli variance of visibility, which falls as n^-1.5 for stratified points on a discontinuity.
    t.variance += hours * unoccluded * unoccluded * share * (Vec3(1) - share) / std::pow(n, 1.5f);
    // The closed form is exact at a point; the mean over the texel is estimated from a few points.
    t.uneven +=
        std::sqrt(hours) * radiance * share * (t.unoccluded[0] - t.unoccluded[1]) / static_cast<float>(per_half);
    const Vec3 difference =
        radiance * (t.unoccluded[0] * of_half[0] - t.unoccluded[1] * of_half[1]) / static_cast<float>(per_half);
    t.difference += difference;
    if (!grouped_.empty()) grouped_.of(i)[group] += value, grouped_difference_.of(i)[group] += difference;
    static_cast<LightTally&>(t) = {};
  }
}

void DirectGroup::add_moments(Tally& t, const Vec3& value) {
  const float seen = luminance(t.transmitted[0] + t.transmitted[1]);
  if (seen > 0) t.moments += t.transmitted_moments * (std::max(0.0f, luminance(value)) / seen);
}

template <class Sample>
void DirectGroup::sample_lights(const Sample& sample, std::uint64_t punctual_picks) {
  const bool punctual = punctual_picks > 0;
  for (std::uint64_t pick = 0; pick < std::max<std::uint64_t>(punctual_picks, 1); ++pick)
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
      const Point& point = points_[p];
      Sampler sampler(d_.seed_ + (punctual ? seeds::kManyLights + pick : seeds::kSky),
                      stream_of(list_[point.texel], point.half), point.k);
      const LightSample s = sample(point, sampler);
      if ((s.pdf > 0) == punctual) continue;  // no light, or one that is sampled elsewhere
      const float cosine = incidence(point.sample_point.receiver(), s.direction, punctual),
                  share = punctual ? 1 / static_cast<float>(punctual_picks) : s.pdf / (s.pdf + cosine / kPi);
      const Vec3 value = s.estimate * (cosine * share);
      if (max_component(value) > 0 && is_usable(point, value))
        add_shadow_ray(p, {point.sample_point.origin, s.direction, s.distance, punctual, !punctual}, value, s.group);
    }
  finish_sampled();
}

void DirectGroup::finish_sampled(float hours) {
  trace();
  const auto n = static_cast<float>(per_half_);
  for (Tally& t : tallies_) {
    const Vec3 value = (t.transmitted[0] + t.transmitted[1]) / (kHalves * n);
    t.total += value;
    add_moments(t, value);
    const Vec3 difference = (t.transmitted[0] - t.transmitted[1]) / n;
    t.variance += 0.25f * hours * difference * difference;
    t.difference += difference;
    static_cast<LightTally&>(t) = {};
  }
  for (int h = 0; h < kHalves; ++h) {
    grouped_.add(grouped_transmitted_[h], 1 / (kHalves * n));
    grouped_difference_.add(grouped_transmitted_[h], (h == 0 ? 1 : -1) / n);
    std::ranges::fill(grouped_transmitted_[h].light, Vec3(0));
  }
}

}  // namespace oriel
