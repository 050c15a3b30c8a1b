#include "bake/radiance/surround_sight.h"

#include <algorithm>

#include "bake/radiance/sight.h"
#include "bake/scene/shade.h"
#include "bake/trace/albedo.h"

namespace oriel {
namespace {

constexpr float kNearest = 1e-3f;       // of the object's size: a surface through the very centre has no distance
constexpr float kAtBounds = 1 - 1e-4f;  // of the way out of the bounds: what the object stands on is not in it

}  // namespace

SurroundRays::SurroundRays(const Accel& accel, const CurvedObject& object, const Vec3& centre, SurroundView view)
    : accel_(accel),
      scene_(accel.scene()),
      object_(object),
      centre_(centre),
      view_(view),
      nearest_(std::max(kNearest * glm::length(object.upper - object.lower), 1e-12f)) {}

SurroundSight SurroundRays::look(const Vec3& direction, float farthest) {
  const float bounds_end = leaves_bounds(direction);
  Ray ray{centre_, direction};
  SurroundSight sight;
  if (view_ == SurroundView::kBeyondBounds) {
    ray.origin += kAtBounds * bounds_end * direction;
    if (farthest < kAtBounds * bounds_end) sight.valid = 0;  // within the bounds nothing is seen, points neither
    if (sight.valid == 0) return sight;
  }
  std::uint32_t last = ~0u;
  for (int layer = 0; layer < kMostSightLayers; ++layer) {
    const Hit hit = accel_.intersect(ray);
    ++count_;
    if (!hit) return sight;
    const Vec3 p = point_on(scene_, hit.triangle, hit.barycentric);
    if (glm::length(p - centre_) > farthest) return sight;
    const Own side = own(hit);
    if (side != Own::kNo && !(view_ == SurroundView::kHollow && side == Own::kFront)) {
      // All before lies inside. A sheet that is seen from both sides may have its fronts there: a lamp's shade.
      const bool inside = side == Own::kBack || scene_.material_of(hit.triangle).double_sided;
      if (inside && view_ == SurroundView::kOutside) sight = {};
    } else if (!sight.ended && hit.triangle != last) {
      meet(hit, p, direction, sight);
    }
    const bool all_known = view_ != SurroundView::kOutside || glm::length(p - centre_) >= bounds_end;
    if (sight.ended && all_known) return sight;
    last = hit.triangle;
    ray.origin = p + direction * (kSightStep * max_component(glm::abs(p)) + 1e-6f * hit.distance);
  }
  if (!sight.ended) sight.valid = 0;  // nothing opaque within reason
  return sight;
}

// Of a pair that a double-sided sheet was split into, a ray meets the one that faces it.
SurroundRays::Own SurroundRays::own(const Hit& hit) const {
  const auto listed = [&](std::uint32_t t) { return std::ranges::binary_search(object_.triangles, t); };
  if (listed(hit.triangle)) return hit.front ? Own::kFront : Own::kBack;
  return !scene_.twin.empty() && listed(scene_.twin[hit.triangle]) ? Own::kBack : Own::kNo;
}

// The distance at which a ray from the centre leaves the object's bounds.
float SurroundRays::leaves_bounds(const Vec3& direction) const {
  float nearest = std::numeric_limits<float>::max();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const float side = direction[axis] > 0 ? object_.upper[axis] : object_.lower[axis];
    nearest = std::min(nearest, (side - centre_[axis]) / direction[axis]);
  }
  return nearest;
}

// Adds what a surface shows; the ray ends there unless it lets light pass.
void SurroundRays::meet(const Hit& hit, const Vec3& p, const Vec3& direction, SurroundSight& sight) const {
  const SceneMaterial& material = scene_.material_of(hit.triangle);
  Vec3 through(0);
  float coverage = 1;
  if (may_transmit(material) && !material.unlit) {  // light passes unlit surfaces, but eyes see them
    const ShadePoint point = shade_point(scene_, hit.triangle, hit.barycentric);
    coverage = point.coverage;
    through = straight_transmittance(point, std::abs(glm::dot(geometric_normal(scene_, hit.triangle), direction)));
  }
  const bool back = !hit.front && !material.double_sided;
  if (coverage > 0 && !back) sight.layers.push_back({hit, sight.throughput * coverage});
  sight.throughput *= through;
  if (max_component(through) >= kSeeThrough) return;
  sight.ended = true;
  sight.inverse_distance = 1 / std::max(glm::length(p - centre_), nearest_);
  sight.valid = back ? 0 : 1;
  if (back) sight.layers.clear();
}

}  // namespace oriel
