#include "bake/reference/meter.h"

#include "bake/trace/buried.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kMostLights = 128;        // visited one by one
constexpr std::size_t kMostTallies = 1u << 25;  // 1 GiB

// Scaled by its largest component first: the square of a tiny or huge one leaves what a double can hold.
Vec3 unit(const DVec3& v) {
  return Vec3(glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)})));
}

}  // namespace

Meter::Meter(const Transport& t, std::span<const MeasurePoint> points, const Context& context)
    : t_(t), context_(context), sums_(points.size() * kReplicates) {
  const Scene& scene = t.accel.scene();
  polygons_ = find_polygon_lights(scene);
  one_by_one_ = all_emission_is_plain(scene) && polygons_.size() + scene.lights.size() <= kMostLights &&
                points.size() * polygons_.size() * kReplicates <= kMostTallies;
  for (const MeasurePoint& point : points) add_point(point);
  tallies_.resize(facing_.size() * kReplicates);
}

void Meter::add_point(const MeasurePoint& point) {
  const Scene& scene = t_.accel.scene();
  Place place;
  SurfacePoint& s = place.surface;
  s.position = Vec3(point.position - scene.origin);
  s.magnitude = max_component(glm::max(glm::abs(s.position), glm::max(glm::abs(scene.lower), glm::abs(scene.upper))));
  s.normal = s.geometric_normal = unit(point.normal);
  place.receiver = {spawn_origin(s, s.geometric_normal), s.normal, s.geometric_normal};
  place.first_facing = facing_.size();
  for (std::uint32_t l = 0; one_by_one_ && l < polygons_.size(); ++l)
    if (const float open = polygon_irradiance(polygons_[l], place.receiver); open > 0)
      facing_.push_back({l, DVec3(polygons_[l].radiance) * double{open}});
  place.end_facing = facing_.size();
  places_.push_back(place);
}

bool Meter::buried(std::size_t p, std::uint64_t& rays) const {
  return is_buried(t_, places_[p].surface, {context_.seed, p, 0}, rays);
}

void Meter::grow(std::size_t p, std::uint32_t r, std::uint64_t& rays) {
  const Place& place = places_[p];
  const std::uint64_t stream = p * kReplicates + r;
  for (std::uint32_t k = place.polygons.done; k < place.polygons.goal; ++k) {
    if (k % 1024 == 0 && context_.stopped()) return;  // the result is thrown away
    sample_polygons(place, r, stream, k, rays);
  }
  Sums& sums = sums_[stream];
  for (std::uint32_t k = place.rest.done; k < place.rest.goal; ++k) {
    if (k % 1024 == 0 && context_.stopped()) return;
    IrradianceSample e;
    if (one_by_one_) {
      e = sample(place, stream, k, rays);
    } else {
      Sampler sampler(context_.seed, stream, k);
      e = sample_irradiance(t_, place.surface, sampler, rays);
    }
    sums.direct += DVec3(e.direct);
    sums.indirect += DVec3(e.indirect);
  }
}

void Meter::sample_polygons(const Place& place, std::uint32_t r, std::uint64_t stream, std::uint32_t k,
                            std::uint64_t& rays) {
  for (std::size_t f = place.first_facing; f < place.end_facing; ++f) {
    const PolygonLight& light = polygons_[facing_[f].light];
    Sampler sampler(context_.seed + 0xd1ec + facing_[f].light, stream, k);
    const auto s = sample_polygon(light, place.receiver, sampler.next2());
    if (!s) continue;
    const float weight = incidence(place.receiver, s->direction) * s->solid_angle;
    if (!(weight > 0)) continue;
    Tally& tally = tallies_[f * kReplicates + r];
    tally.weight += weight;
    const bool touching = !(s->distance > 0);
    rays += touching ? 0 : 1;
    tally.passed +=
        double{weight} *
        (touching ? DVec3(1)
                  : DVec3(t_.accel.transmittance({place.receiver.position, s->direction, s->distance, false})));
  }
}

Vec3 Meter::sample_punctual(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const {
  Vec3 sum(0);
  for (std::uint32_t l = 0; l < t_.accel.scene().lights.size(); ++l) {
    Sampler sampler(context_.seed + 0x9f00 + l, stream, k);
    const LightSample s = t_.lights.sample_light(l, place.receiver.position, sampler.next2());
    const Vec3 value = s.estimate * incidence(place.receiver, s.direction, true);
    if (!(max_component(value) > 0)) continue;
    ++rays;
    sum += value * t_.accel.transmittance({place.receiver.position, s.direction, s.distance, true, false});
  }
  return sum;
}

// Of the same lights by way of mirrors.
Vec3 Meter::sample_mirrored(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const {
  const VirtualLights& mirrored = t_.lights.mirrored();
  Vec3 sum(0);
  for (std::uint32_t i = 0; i < mirrored.size(); ++i) {
    if (mirrored[i].order > t_.options.max_bounces) continue;
    Sampler sampler(context_.seed + 0x3177 + i, stream, k);
    const MirroredSample s = mirrored.sample(i, t_.lights, place.receiver.position, sampler.next2());
    const Vec3 value = s.endless * s.share * incidence(place.receiver, s.direction, true);
    if (max_component(value) > 0) sum += value * t_.accel.transmittance_of_all(s.rays(), rays);
  }
  return sum;
}

// And by way of frosted panes.
Vec3 Meter::sample_frosted(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const {
  if (t_.lights.frosted().empty()) return Vec3(0);
  Sampler sampler(context_.seed + 0xf057, stream, k);
  const float way = sampler.next1();
  const Vec2 of_light = sampler.next2();
  const MirroredSample s =
      t_.lights.frosted().sample(t_.lights, place.receiver.position, {way, of_light, sampler.next2()});
  const Vec3 value = s.endless * incidence(place.receiver, s.direction);
  return s.legs > 0 && max_component(value) > 0 ? value * t_.accel.transmittance_of_all(s.rays(), rays) : Vec3(0);
}

// The sky's image, combined with cosine-distributed rays by the balance heuristic.
Vec3 Meter::sample_sky(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const {
  Sampler sampler(context_.seed + 0x5c1, stream, k);
  const LightSample s = t_.lights.sample_sky(sampler.next2());
  const float cosine = incidence(place.receiver, s.direction);
  const Vec3 value = s.estimate * cosine;
  if (!(max_component(value) > 0)) return Vec3(0);
  ++rays;
  return value * (s.pdf / (s.pdf + cosine / kPi)) *
         t_.accel.transmittance({place.receiver.position, s.direction, s.distance, false});
}

// All but the polygons' direct light.
IrradianceSample Meter::sample(const Place& place, std::uint64_t stream, std::uint32_t k, std::uint64_t& rays) const {
  IrradianceSample e;
  e.direct = sample_punctual(place, stream, k, rays) + sample_mirrored(place, stream, k, rays) +
             sample_frosted(place, stream, k, rays);
  if (t_.lights.samples_sky()) e.direct += sample_sky(place, stream, k, rays);
  Sampler sampler(context_.seed, stream, k);
  const Vec3 local = square_to_cosine_hemisphere(sampler.next2());
  const Vec3 direction = glm::normalize(frame_from_normal(place.receiver.normal) * local);
  const PathLight light = trace_path(t_, {place.receiver.position, direction}, 0, sampler, rays);
  const float pdf = local.z / kPi;
  const float weight = t_.lights.samples_sky() ? pdf / std::max(pdf + t_.lights.sky_pdf(direction), 1e-30f) : 1.0f;
  e.direct += kPi * weight * light.sky;  // cosθ / pdf = π; what it met of emitters is known in closed form
  e.indirect = kPi * light.scattered;
  return e;
}

DVec3 Meter::add_polygons(const Place& place, Spread& spread) const {
  DVec3 sum(0);
  for (std::size_t f = place.first_facing; f < place.end_facing; ++f) {
    const Tally* const tallies = &tallies_[f * kReplicates];
    Tally all;
    for (std::uint32_t r = 0; r < kReplicates; ++r) {
      all.weight += tallies[r].weight;
      all.passed += tallies[r].passed;
    }
    if (!(all.weight > 0)) continue;
    const DVec3 share = all.passed / all.weight;
    sum += facing_[f].open * share;
    // The ratio's spread, to first order: the residuals of each set (Cochran 1977, ch. 6).
    for (std::uint32_t r = 0; r < kReplicates; ++r)
      spread[r] += facing_[f].open * (tallies[r].passed - share * tallies[r].weight) * (kReplicates / all.weight);
  }
  return sum;
}

PointIlluminance Meter::summarize(std::size_t p) {
  Place& place = places_[p];
  const Sums* const own = &sums_[p * kReplicates];
  const double n = place.rest.goal;
  PointIlluminance result;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    result.direct += own[r].direct / (n * kReplicates);
    result.indirect += own[r].indirect / (n * kReplicates);
  }
  Spread rest, polygons{};
  for (std::uint32_t r = 0; r < kReplicates; ++r)
    rest[r] = (own[r].direct + own[r].indirect) / n - result.direct - result.indirect;
  result.direct += add_polygons(place, polygons);

  DVec3 squares(0);
  double of_all = 0, of_rest = 0, of_polygons = 0;
  for (std::uint32_t r = 0; r < kReplicates; ++r) {
    const DVec3 both = rest[r] + polygons[r];
    squares += both * both;
    of_all += std::pow(luminance(both), 2);
    of_rest += std::pow(luminance(rest[r]), 2);
    of_polygons += std::pow(luminance(polygons[r]), 2);
  }
  constexpr double kCount = kReplicates * (kReplicates - 1.0);
  result.standard_error = glm::sqrt(squares / kCount);
  result.luminance_error = std::sqrt(of_all / kCount);
  result.samples = std::max(place.polygons.goal, place.rest.goal) * kReplicates;
  // A part that makes a tenth of the other's variance is not worth a ray more.
  const bool polygons_next = of_polygons > 0.1 * of_rest;
  place.polygons.advance(polygons_next);
  place.rest.advance(!polygons_next || of_rest > 0.1 * of_polygons);
  return result;
}

}  // namespace oriel
