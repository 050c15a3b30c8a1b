#include "bake/radiance/surround_viewpoints.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "bake/brdf/microfacet.h"
#include "bake/jobs/parallel.h"
#include "bake/radiance/sight.h"
#include "bake/radiance/surround_sight.h"
#include "bake/scene/shade.h"
#include "bake/trace/path.h"
#include "bake/trace/sampler.h"

namespace oriel {
namespace {

constexpr std::uint32_t kTries = 4096;    // pairs of an eye and a point
constexpr std::size_t kEnough = 256;      // of them that see each other
constexpr int kLayers = 16;               // of the object itself and of glass before the first surface that counts
constexpr float kMirror = 1e-3f;          // alpha up to which a lobe has one direction
constexpr float kSame = 1e-3f;            // of the distance: so near is the same surface
constexpr float kLeastDistance_m = 0.5f;  // of eyes, for their solid angle
constexpr float kNearly = 0.9f;           // of what other views see, from which glass leaves out what is within it
constexpr float kGain = 1.02f;            // what a place must see more than the middle to replace it

// What an eye sees in the reflector, and by how much it counts.
struct Reflection {
  Vec3 on_surface{0};
  Vec3 met{0};  // scene space; a unit direction where `sky`
  bool sky = false;
  float weight = 0;
};

// The direction that a lobe's facet reflects to; may lie below the surface.
Vec3 mirror(const Vec3& normal, const Vec3& view, float roughness, const Vec2& facet) {
  const float alpha = roughness * roughness;
  const Mat3 frame = frame_from_normal(normal);
  const DVec3 local(glm::transpose(frame) * view);
  if (!(alpha > kMirror) || !(local.z > 0)) return glm::normalize(glm::reflect(-view, normal));
  const DVec3 h = Microfacet(FacetModel::kGgx, alpha).sample_visible_normal(local, DVec2(facet));
  return glm::normalize(frame * Vec3(reflect_at(local, h)));
}

class Viewpoint {
 public:
  Viewpoint(const Accel& accel, std::span<const Vec3> eyes, const FoundCurvedReflector& reflector,
            const CurvedObject& object, std::uint64_t seed)
      : accel_(accel), scene_(accel.scene()), eyes_(eyes), reflector_(reflector), object_(object), seed_(seed) {}

  struct Choice {
    Vec3 place{0};
    SurroundView view = SurroundView::kOutside;
  };
  Choice best(const Vec3& middle) const {
    const std::vector<Reflection> seen = reflections();
    if (seen.empty()) return {middle};
    const std::vector<Vec3> places = candidates(seen);
    const auto best_of = [&](std::initializer_list<SurroundView> views) {
      Choice best{middle, *views.begin()};
      float most = kGain * share_seen(best, seen);
      for (const SurroundView view : views)
        for (const Vec3& place : places)
          if (const float share = share_seen({place, view}, seen); share > most) best = {place, view}, most = share;
      return best;
    };
    // What lies within the bounds and is mirrored to no eye would still leak into wide lobes: a bulb, a thousand times
    // as bright as all else. Glass round a bulb mirrors it but faintly, and a map has one distance each way: where the
    // bulb is near it showed in the wrong places, or not at all.
    const Choice best = best_of({SurroundView::kOutside, SurroundView::kHollow}),
                 beyond = best_of({SurroundView::kBeyondBounds});
    const bool glass = is_glass(scene_, reflector_.triangles.front());
    return share_seen(beyond, seen) >= (glass ? kNearly : 1.0f) * share_seen(best, seen) ? beyond : best;
  }

 private:
  std::vector<Reflection> reflections() const {
    std::vector<float> until;  // areas of the triangles, summed up
    for (const std::uint32_t t : reflector_.triangles)
      until.push_back((until.empty() ? 0 : until.back()) + static_cast<float>(triangle_area(scene_, t)));
    std::vector<Reflection> all;
    for (std::uint32_t k = 0; k < kTries && all.size() < kEnough; ++k) {
      Sampler sampler(seed_, reflector_.triangles.front(), k);
      const auto place = std::upper_bound(until.begin(), until.end(), sampler.next1() * until.back());
      const auto index = std::min<std::size_t>(place - until.begin(), until.size() - 1);
      const Vec2 u = sampler.next2();
      const float root = std::sqrt(u.x);
      if (const auto r = reflection(reflector_.triangles[index], {root * (1 - u.y), root * u.y},
                                    eyes_[k % eyes_.size()], sampler.next2()))
        all.push_back(*r);
    }
    return all;
  }

  // facet: in [0, 1)², chooses a direction of the lobe.
  std::optional<Reflection> reflection(std::uint32_t triangle, const Vec2& barycentric, const Vec3& eye,
                                       const Vec2& facet) const {
    const Vec3 p = point_on(scene_, triangle, barycentric), towards = eye - p;
    const float distance = glm::length(towards);
    const Vec3 view = towards / distance, front = geometric_normal(scene_, triangle);
    const bool turned = scene_.material_of(triangle).double_sided && glm::dot(front, view) < 0;
    const Vec3 flat = turned ? -front : front;
    const float cosine = glm::dot(flat, view);
    if (!(cosine > 0)) return std::nullopt;
    const SurfacePoint point = geometry_at(scene_, {.triangle = triangle, .barycentric = barycentric}, -view);
    const Vec3 mirrored = mirror(point.normal, view, scene_.material_of(triangle).roughness, facet);
    if (!(glm::dot(mirrored, flat) > 0)) return std::nullopt;
    const Vec3 origin = spawn_origin(scene_, triangle, barycentric, view);
    if (max_component(accel_.transmittance({origin, view, distance})) <= 0) return std::nullopt;
    const Hit hit = first_hiding(origin, mirrored);
    const float apart = std::max(distance, kLeastDistance_m);
    return Reflection{p, hit ? point_on(scene_, hit.triangle, hit.barycentric) : mirrored, !hit,
                      cosine / (apart * apart)};
  }

  // The first surface that hides what is behind it; of the object itself fronts do.
  Hit first_hiding(const Vec3& from, const Vec3& direction) const {
    Ray ray{from, direction};
    for (int layer = 0; layer < kLayers; ++layer) {
      const Hit hit = accel_.intersect(ray);
      if (!hit) return hit;
      const bool own_back = !hit.front && is_among(scene_, object_.triangles, hit.triangle);
      const bool passes =
          own_back || max_component(transmittance_at(scene_, hit.triangle, hit.barycentric)) >= kSeeThrough;
      if (!passes) return hit;
      ray.origin = spawn_origin(scene_, hit.triangle, hit.barycentric, direction);
    }
    return {};
  }

  float share_seen(const Choice& from, std::span<const Reflection> reflections) const {
    SurroundRays rays(accel_, object_, from.place, from.view);
    float sum = 0, seen = 0;
    for (const Reflection& r : reflections) {
      const float distance = glm::length(r.met - from.place);
      const SurroundSight sight = rays.look(r.sky ? r.met : (r.met - from.place) / distance);
      sum += r.weight;
      if (r.sky ? !sight.ended : std::abs(1 - distance * sight.inverse_distance) <= kSame) seen += r.weight;
    }
    return seen / sum;
  }

  std::vector<Vec3> candidates(std::span<const Reflection> reflections) const {
    Vec3 lower(scene_.positions[scene_.triangles[reflector_.triangles.front()].x]), upper = lower;
    for (const std::uint32_t t : reflector_.triangles)
      for (int corner = 0; corner < 3; ++corner) {
        lower = glm::min(lower, scene_.positions[scene_.triangles[t][corner]]);
        upper = glm::max(upper, scene_.positions[scene_.triangles[t][corner]]);
      }
    Vec3 mean(0);
    float weight = 0;
    for (const Reflection& r : reflections) mean += r.weight * r.on_surface, weight += r.weight;
    std::vector<Vec3> places{mean / weight};
    for (int i = 0; i < 27; ++i)
      places.push_back(glm::mix(lower, upper, (Vec3(i % 3, i / 3 % 3, i / 9) * 2.0f + 1.0f) / 6.0f));
    return places;
  }

  const Accel& accel_;
  const Scene& scene_;
  std::span<const Vec3> eyes_;
  const FoundCurvedReflector& reflector_;
  const CurvedObject& object_;
  std::uint64_t seed_;
};

}  // namespace

Status place_surround_maps(const Accel& accel, std::span<const Vec3> eyes, Context& context,
                           FoundCurvedReflectors& found) {
  if (eyes.empty()) return {};
  const Status all = parallel_for(context, "", found.reflectors.size(), [&](std::size_t i) {
    FoundCurvedReflector& reflector = found.reflectors[i];
    Vec3& centre = found.maps[reflector.reflector.map].centre;
    const auto best = Viewpoint(accel, eyes, reflector, found.objects[reflector.object], context.seed).best(centre);
    centre = best.place;
    reflector.view = best.view;
  });
  if (context.stop) return all;
  if (!all) context.warning("time-over", "surround maps: some are taken from their middles, as --time was over");
  return {};
}

}  // namespace oriel
