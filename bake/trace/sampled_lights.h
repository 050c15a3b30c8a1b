// Light that a path's surface gets from lamps that are sampled. Of the path tracer (path.cpp).
#pragma once

#include "bake/trace/path.h"
#include "bake/trace/rounded.h"
#include "bake/trace/shading.h"
#include "formats/core/color.h"

namespace oriel {

// What a path is traced with.
struct Tracing {
  const Transport& transport;
  Sampler& sampler;
  std::uint64_t& rays;
  bool one = false;  // of the lights in mirrors one is asked, which stands for all
};

inline float balance(float pdf, float other) {
  return pdf / (pdf + other);
}

// Incident light from one sampled emitter, times f·cosθ as `reflect(wi, punctual)` gives it; `pdf_of(wi)` is the
// density with which the other strategy would have chosen that direction.
struct FromEmitter {
  Vec3 light{0};
  bool lamp = false;        // a near one, or a sun on a polished surface: what lamp paths follow where they are traced
  std::uint32_t group = 0;  // LightSample::group
  Vec3 direction{0, 0, 1};  // LightSample::direction
};
template <class Reflect, class Pdf>
FromEmitter sample_lights(const Tracing& by, const SurfacePoint& surface, const Reflect& reflect, const Pdf& pdf_of) {
  const Transport& t = by.transport;
  const float u = by.sampler.next1();
  const Vec2 v = by.sampler.next2();
  if (t.lights.empty()) return {};
  // Sampled from where the shadow ray starts: close to a lamp over a large floor the offset is not small.
  const Receiver receiver = receiver_of(surface);
  const LightSample light = t.lights.sample(receiver.position, u, v);
  const bool punctual = light.pdf == 0;
  if (max_component(light.estimate) <= 0) return {};
  if (!(incidence(receiver, light.direction, punctual) > 0)) return {};
  Vec3 value = light.estimate * reflect(light.direction, punctual);
  if (max_component(value) <= 0) return {};
  if (light.pdf > 0) value *= balance(light.pdf, pdf_of(light.direction));
  if (!is_usable(value)) {
    t.accel.dropped().add(surface.triangle);
    return {};
  }
  const bool lamp = light.near || (light.sun && is_polished(t.accel.scene().material_of(surface.triangle)));
  if (!(light.distance > 0)) return {value, lamp, light.group, light.direction};  // touching
  const Ray ray = leaving(receiver, {receiver.position, light.direction, light.distance, punctual, !punctual});
  ++by.rays;
  return {value * t.accel.transmittance(ray), lamp, light.group, light.direction};
}

inline void record(const Transport& t, PathGroups::Kind kind, std::uint32_t group, const Vec3& direction,
                   const Vec3& light) {
  if (!t.grouped) return;
  each_owner(t.accel.scene(), group, direction, light,
             [&](std::uint32_t owner, const Vec3& part) { t.grouped->add(kind, owner, part); });
}

// What a frosted pane's facets send towards wo of one point, spot or sun behind it, as shading.spread() would have it;
// other frosted panes let it pass straight.
inline Vec3 sample_behind(const Tracing& by, const SurfacePoint& pane, const Shading& shading) {
  const Transport& t = by.transport;
  if (t.accel.scene().lights.empty()) return Vec3(0);
  const float u = by.sampler.next1();
  const Vec2 v = by.sampler.next2();
  const Vec3 origin = spawn_origin(pane, -pane.geometric_normal);
  const LightSample light = t.lights.sample(origin, u, v);
  if (light.pdf > 0 || !(max_component(light.estimate) > 0)) return Vec3(0);
  const Vec3 value = light.estimate * shading.spread_pdf(light.direction);
  if (!is_usable(value)) t.accel.dropped().add(pane.triangle);
  if (!is_usable(value) || !(max_component(value) > 0)) return Vec3(0);
  ++by.rays;
  return value * t.accel.transmittance({origin, light.direction, light.distance});
}

// The same of lights in mirrors, which no other strategy finds, by way of so many at most, and of lights that frosted
// panes spread. add(direction, group, light).
template <class Reflect, class Add>
void sample_virtual(const Tracing& by, const SurfacePoint& surface, int most_mirrors, const Reflect& reflect,
                    const Add& add) {
  const Transport& t = by.transport;
  Sampler& sampler = by.sampler;
  const VirtualLights& mirrored = t.lights.mirrored();
  const FrostedLights& frosted = t.lights.frosted();
  if (mirrored.empty() && frosted.empty()) return;
  const Receiver receiver = receiver_of(surface);
  const auto arrive = [&](MirroredSample light, float weight, bool punctual) {
    if (light.legs == 0 || !(incidence(receiver, light.direction, punctual) > 0)) return;
    light.leg[0] = leaving(receiver, light.leg[0]);
    Vec3 value = weight * light.endless * light.share * reflect(light.direction, punctual);
    if (!is_usable(value)) t.accel.dropped().add(surface.triangle);
    if (!is_usable(value) || max_component(value) <= 0) return;
    value *= t.accel.transmittance_of_all(light.rays(), by.rays);
    if (max_component(value) > 0) add(light.direction, light.group, value);
  };
  if (!mirrored.empty()) {
    const float u = sampler.next1();
    const Vec2 v = sampler.next2();
    const float of = by.one ? static_cast<float>(std::min(mirrored.size(), VirtualLights::kVisited)) : 1;
    float left = by.one ? std::floor(of * sampler.next1()) : 0;
    mirrored.choose(u, [&](std::size_t i, float weight) {
      if (of > 1 && left-- != 0) return;
      if (mirrored[i].order > most_mirrors || !mirrored[i].may_reach(DVec3(receiver.position), 0)) return;
      arrive(mirrored.sample(i, t.lights, receiver.position, v), of * weight, true);
    });
  }
  if (frosted.empty()) return;
  const float way = sampler.next1();
  const Vec2 of_light = sampler.next2();
  arrive(frosted.sample(t.lights, receiver.position, {way, of_light, sampler.next2()}), 1, false);
}

}  // namespace oriel
