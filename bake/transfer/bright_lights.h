// Lights strong enough to shine on movers by themselves, with shadows of their own, instead of in harmonics.
#pragma once

#include <functional>

#include "bake/jobs/context.h"
#include "bake/trace/lights.h"
#include "bake/trace/polygon_light.h"
#include "formats/assets/light_field.h"
#include "formats/core/archive.h"

namespace oriel {

// How the lights reach one point.
struct LightsAt {
  std::uint64_t bright = 0, kept = 0;        // of the list: LightProbe's
  std::vector<const PolygonLight*> sampled;  // large there, and to be added by points on them
  std::vector<const PolygonLight*> unrayed;  // whose emission rays are not to count: the sampled, bright and hidden
};

// What may be a bright light: plain emissive polygons of at most 64 triangles, points, spots, directional lights; not
// measured profiles, which are no cones. Holds references.
class BrightLights {
 public:
  BrightLights(const Accel& accel, const LightSet& lights);

  // Lists the `strongest` lights of every point, by the irradiance of a plane that faces them, shadows included; those
  // that shine most on all of them where they are more than kMaxBrightLights. Asks no more points once there is enough;
  // enough() may be empty. Error kStopped.
  Status choose(std::span<const Vec3> points, int strongest, const std::function<bool()>& enough, Context& context);

  // Lists all that may be bright lights, or the first kMaxBrightLights of them; how many they are.
  std::size_t choose_all();

  std::size_t size() const { return listed_.size(); }
  const std::vector<std::size_t>& listed() const { return listed_; }  // candidates, by number
  // Of the listed lights, in their order.
  std::vector<BrightLight> list() const;
  // The candidate that a triangle belongs to; may be null. The place in the list of Scene::lights[light], or -1.
  const PolygonLight* of_triangle(std::uint32_t triangle) const;
  int of_light(std::uint32_t light) const { return of_light_[light]; }

  // At one point, for the same number of `strongest`. The point's number seeds its shadow rays: that of choose() where
  // it was asked there.
  LightsAt at(const Vec3& p, std::uint64_t stream) const;

 private:
  struct Candidate {
    const PolygonLight* polygon = nullptr;
    std::uint32_t light = 0;  // into Scene::lights, where it is no polygon
  };
  struct Shine {
    std::size_t candidate;
    float lux;    // luminance of the irradiance on a facing plane
    bool hidden;  // no shadow ray got through
  };
  friend void fields(Archive& archive, Shine& s) { archive(s.candidate, s.lux, s.hidden); }

  float unshadowed(const Candidate& candidate, const Vec3& p) const;
  float visibility(const Candidate& candidate, const Vec3& p, std::uint64_t stream) const;
  // The brightest candidates with their shadows, strongest first.
  std::vector<Shine> rank(const Vec3& p, std::uint64_t stream) const;
  void set_list(const std::vector<double>& lux);

  const Accel& accel_;
  const LightSet& lights_;
  std::uint64_t seed_ = 1;
  int strongest_ = 0;
  std::vector<PolygonLight> polygons_;
  std::vector<Candidate> candidates_;
  std::vector<std::vector<Shine>> ranked_;  // by point that choose() asked
  std::vector<std::int16_t> place_;         // by candidate: in listed_, or -1
  std::vector<std::size_t> listed_;         // candidates
  std::vector<std::uint32_t> of_triangle_;  // into polygons_, or ~0u; empty: there is none
  std::vector<std::int16_t> of_light_;
};

}  // namespace oriel
