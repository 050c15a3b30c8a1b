#include "bake/radiance/samples.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/radiance/reproject.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr std::uint32_t kRounds = 32;   // of as many pairs as samples are asked for
constexpr float kSameDistance = 2e-3f;  // relative: two rays that meet the same point
constexpr float kNearestEye = 0.1f;     // metres: closer eyes would outweigh all others
constexpr float kFlattest = 1e-3f;      // cosine at which surfaces are seen edge-on

bool depth_is_enough(const SeenSurface&) {
  return false;
}

Sight look_along(const ReflectedSurroundings& surroundings, std::uint32_t reflector, const Vec3& on_plane,
                 const Vec3& along) {
  const Reflector& r = surroundings.reflectors()[reflector].reflector;
  const Vec3 direction = glm::normalize(Mat3(r.pack_from_reflector) * along);
  return surroundings.look(reflector, pack_from_reflector(r, on_plane), direction, depth_is_enough);
}

// Points evenly over the reflector's triangles.
class SurfacePoints {
 public:
  SurfacePoints(const Scene& scene, const FoundReflector& found) : scene_(scene), found_(found) {
    double total = 0;
    for (const std::uint32_t t : found.triangles) area_until_.push_back(total += triangle_area(scene, t));
  }
  Vec3 sample(Sampler& sampler) const {
    const double area = sampler.next1() * area_until_.back();
    const auto at =
        static_cast<std::size_t>(std::lower_bound(area_until_.begin(), area_until_.end(), area) - area_until_.begin());
    return point_on(scene_, found_.triangles[std::min(at, area_until_.size() - 1)],
                    square_to_triangle(sampler.next2()));
  }
  double area() const { return area_until_.back(); }

 private:
  const Scene& scene_;
  const FoundReflector& found_;
  std::vector<double> area_until_;
};

bool shows_sky(const Scene& scene) {
  return max_component(scene.sky) > 0 || !scene.sky_image.texels.empty();
}

// What the eye (scene space) sees at a point of the reflector; none where it does not see the point or nothing in it.
// The weight is the solid angle for an area of one square metre.
std::optional<ReflectedSample> reflect(const ReflectedSurroundings& surroundings, std::uint32_t reflector,
                                       const Vec3& eye, const Vec3& point) {
  const Accel& accel = surroundings.accel();
  const FoundReflector& found = surroundings.reflectors()[reflector];
  const Reflector& r = found.reflector;
  ReflectedSample s;
  s.eye = reflector_from_pack(r, eye);
  s.on_plane = Vec3(Vec2(reflector_from_pack(r, point)), 0);
  const Vec3 to_eye = s.eye - s.on_plane;
  const float distance = glm::length(to_eye);
  if (!(s.eye.z > 0) || !(distance > 0)) return {};
  const Vec3 origin =
      pack_from_reflector(r, s.on_plane) + 1e-5f * (distance + r.flatness_m) * Vec3(r.pack_from_reflector[2]);
  const Vec3 towards = glm::normalize(Mat3(r.pack_from_reflector) * to_eye);
  if (!(max_component(accel.transmittance({origin, towards, distance * (1 - 1e-4f)})) >= 0.5f)) return {};
  const Vec3 along = Vec3(-to_eye.x, -to_eye.y, to_eye.z) / distance;
  const Sight sight = look_along(surroundings, reflector, s.on_plane, along);
  if (sight.state == Sight::kNothing) return {};
  s.sky = sight.state == Sight::kSky || sight.backdrop;
  const float alpha = found.roughness * found.roughness;
  if (sight.state == Sight::kSurface) {
    const float away = glm::length(sight.offset);
    s.image = Vec4(s.on_plane + away * along, 1);
    s.normal = glm::transpose(Mat3(r.pack_from_reflector)) * sight.normal;
    s.spacing = std::max(static_cast<float>(kSharpAngleRad) * (away + distance), alpha * away);
  } else {
    s.image = Vec4(along, 0);
    s.spacing = std::max(static_cast<float>(kSharpAngleRad), alpha);
  }
  const float d = std::max(distance, kNearestEye);
  s.weight = s.eye.z / distance / (d * d);
  return s;
}

Result<std::vector<ReflectedSample>> draw_samples(const ReflectedSurroundings& surroundings, std::uint32_t reflector,
                                                  const SampleOptions& options, Context& context) {
  const std::span<const Vec3> eyes = options.eyes;
  const std::uint32_t count = options.count;
  const SurfacePoints points(surroundings.accel().scene(), surroundings.reflectors()[reflector]);
  std::vector<ReflectedSample> samples;
  std::vector<std::optional<ReflectedSample>> tried(eyes.empty() ? 0 : count);
  std::uint32_t tries = 0;
  for (std::uint32_t round = 0; round < kRounds && samples.size() < count; ++round) {
    ORIEL_TRY_VOID(parallel_for(context, "", tried.size(), [&](std::size_t i) {
      const std::size_t pair = std::size_t{round} * count + i;
      Sampler sampler(options.seed, reflector, static_cast<std::uint32_t>(pair));
      tried[i] = reflect(surroundings, reflector, eyes[pair % eyes.size()], points.sample(sampler));
    }));
    for (const auto& sample : tried) {
      if (samples.size() == count) break;
      ++tries;
      if (sample) samples.push_back(*sample);
    }
  }
  const auto is_sky = [](const ReflectedSample& s) { return s.sky; };
  if (!shows_sky(surroundings.accel().scene()) && std::all_of(samples.begin(), samples.end(), is_sky)) samples.clear();
  for (ReflectedSample& s : samples) s.weight *= static_cast<float>(points.area()) / static_cast<float>(tries);
  return samples;
}

}  // namespace

Result<std::vector<ReflectedSample>> sample_reflections(const ReflectedSurroundings& surroundings,
                                                        std::uint32_t reflector, const SampleOptions& options,
                                                        Context& context) {
  const FoundReflector& found = surroundings.reflectors()[reflector];
  std::vector<ReflectedSample> samples;
  ORIEL_TRY_VOID(one_unit(
      context, "reflected samples",
      [&](Archive& key) { key(reflector, options.eyes, options.count, options.seed, found); },
      [&]() -> Status {
        ORIEL_TRY(samples, draw_samples(surroundings, reflector, options, context));
        return {};
      },
      [&](Archive& archive) { archive(samples); }));
  return samples;
}

Vec2 map_pixel(const RadianceMap& map, const ReflectedSample& s) {
  constexpr float kFar = 1e4f;  // of the eye's distance
  return map_pixel(map, s.image.w == 0 ? map.eye - kFar * map.eye.z * Vec3(s.image) : Vec3(s.image));
}

float needed_resolution(const ReflectedSurroundings& surroundings, std::uint32_t reflector, const Vec3& viewpoint,
                        const Element& window, const ReflectedSample& s) {
  constexpr float kNever = std::numeric_limits<float>::infinity();
  const Vec3 way = Vec3(s.image) - s.image.w * viewpoint;  // towards the image; its length for the sky is 1
  if (!(way.z > 0) || !(viewpoint.z < 0)) return kNever;
  const Vec3 through = viewpoint - way * (viewpoint.z / way.z);
  if (through.x < window.lower.x || through.y < window.lower.y || through.x > window.upper.x ||
      through.y > window.upper.y)
    return kNever;
  const Vec3 along = glm::normalize(way);
  const Sight sight = look_along(surroundings, reflector, Vec3(Vec2(through), 0), along);
  const bool sky = s.image.w == 0;
  if (sight.state != (sky ? Sight::kSky : Sight::kSurface)) return kNever;
  const float to_window = glm::length(through - viewpoint);
  if (!sky) {
    if (sight.backdrop != s.sky) return kNever;
    const float expected = glm::length(Vec3(s.image) - through);
    if (std::abs(glm::length(sight.offset) - expected) > kSameDistance * expected) return kNever;
  }
  // A step on the plane moves the ray's end by as much more as it is further away, along the surface; the eye sees what
  // of that is across its own ray.
  const float scale = sky ? 1 / to_window : glm::length(way) / to_window;
  const Vec3 from_eye = glm::normalize(s.on_plane - Vec3(s.eye.x, s.eye.y, -s.eye.z));
  const Vec3 normal = sky ? along : s.normal;
  const float cosine = glm::dot(along, normal);
  const float facing = std::copysign(std::max(std::abs(cosine), kFlattest), cosine);
  float widest = 0;
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    const Vec3 step = scale * axis;
    const Vec3 on_surface = step - along * (glm::dot(step, normal) / facing);
    widest = std::max(widest, glm::length(on_surface - from_eye * glm::dot(on_surface, from_eye)));
  }
  const Vec2 size = window.upper - window.lower;
  return widest * std::max(size.x, size.y) / s.spacing;
}

namespace {

enum Shown : std::uint8_t { kNot, kSeen, kSharp };

Shown shown_by(const ReflectedSurroundings& surroundings, const RadianceMap& map, const ReflectedSample& s) {
  const float needed = needed_resolution(surroundings, map.reflector, map.eye, {map.lower, map.upper}, s);
  if (!std::isfinite(needed)) return kNot;
  return needed <= static_cast<float>(std::max(map.width, map.height)) ? kSharp : kSeen;
}

}  // namespace

ViewQuality judge_maps(const ReflectedSurroundings& surroundings, std::span<const RadianceMap> maps,
                       std::span<const ReflectedSample> samples, Context& context) {
  std::vector<Shown> found(samples.size(), kNot);
  const Status status = parallel_for(context, "", samples.size(), [&](std::size_t i) {
    for (const RadianceMap& map : maps)
      if (found[i] != kSharp) found[i] = std::max(found[i], shown_by(surroundings, map, samples[i]));
  });
  ViewQuality quality;
  double total = 0;
  for (std::size_t i = 0; i < samples.size() && status; ++i) {
    const double weight = samples[i].weight;
    total += weight;
    quality.seen += found[i] != kNot ? weight : 0;
    quality.sharp += found[i] == kSharp ? weight : 0;
  }
  if (total > 0) quality.seen /= total, quality.sharp /= total;
  return quality;
}

}  // namespace oriel
