// Queries of the radiosity cache by gather rays: the texels hit, and light that no texel holds.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// Parameters of a gather ray besides origin and direction.
struct GatherRay {
  float incidence = 0;       // cosine: π times the density of its direction
  std::uint64_t stream = 0;  // of the random numbers beyond the first hit
  std::uint32_t sample = 0;
  // True: a hit closer than the minimum distance of its texel (CacheQuery::continues_path) is not looked up. A path
  // continues from it.
  bool follows_near = false;
  // Distance to the target of a light sample, m: a hit at another distance, beyond a thousandth, gives no light. 0: any
  // hit counts.
  float target_m = 0;
  bool misses(const Hit& hit) const {
    return target_m > 0 && !(hit && std::fabs(hit.distance - target_m) <= 1e-3f * target_m + 1e-4f);
  }
};

// A texel that a ray sees through lobes and layers, with the throughput to it.
struct Link {
  std::uint32_t ray = 0;  // of the batch
  std::uint32_t texel = 0;
  Vec3 weight{0};
};
// Results of a batch. The radiance along a ray is light + share * albedo(texel) * irradiance(texel) / π + Σ weight *
// irradiance / π over its links, cd/m².
struct QueryResults {
  std::vector<Hit> hits;
  std::vector<Texels::Place> places;  // by ray: of the front side hit first
  std::vector<std::uint32_t> texel;   // by ray: of the opaque surface hit; kNoTexel: none
  std::vector<float> share;  // by ray: fraction of light that specular layers let through to the diffuse reflection
  std::vector<Link> links;   // in order of rays
  // Per ray, cd/m²: sky, emitters behind mirrors, emitters without a closed form, and reflection by near surfaces.
  std::vector<Vec3> light;
  std::vector<Vec3> unreflected;  // the part of `light` directly from sky and emitters
  std::vector<Vec3> grouped;      // `light` by group, at ray * groups + group; empty without groups
  std::uint64_t rays = 0;         // traced beyond those of the batch
};

class CacheQuery {
 public:
  // closed_form: emitters hit directly are left out, as their irradiance is computed analytically (PolygonLight).
  // Otherwise they count, weighted against LightSet::sample by the balance heuristic. A sky image is weighted against
  // LightSet::sample_sky in the first case, LightSet::sample in the second.
  CacheQuery(const Transport& transport, const Texels& texels, bool closed_form, std::uint64_t seed);

  // Traces and evaluates a batch. The former contents of `results` are discarded.
  void evaluate(std::span<const Ray> rays, std::span<const GatherRay> info, QueryResults& results) const;

  // True if results depend on GatherRay::incidence.
  bool weighs() const { return !closed_form_ || t_.lights.samples_sky(); }
  bool closed_form() const { return closed_form_; }

  const Transport& transport() const { return t_; }
  std::size_t groups() const { return scene().light_groups.size(); }  // light groups
  // True if a path continues from a hit at that distance, m, instead of looking up the texel: closer than its
  // side, or eight of them where much is occluded. It then finds all light.
  bool continues_path(float distance, std::uint32_t texel) const {
    return texel != kNoTexel &&
           distance < (texels_.occlusion_heavy[texel] ? kOcclusionHeavyFactor : 1.0f) * side_[texel];
  }

  // Leaves light of near lamps by specular reflections alone out of results: particles carry it (lamp_paths.h).
  void leave_out_lamps() { lamps_ = false; }
  bool lamps() const { return lamps_; }

  // Per material: the survival probability of a path at specular layers over their reflectance, 1 by default
  // (learn_survival). It changes cost and noise, not the mean.
  void set_survival(std::vector<float> by_material) { survival_ = std::move(by_material); }
  const std::vector<float>& survival() const { return survival_; }

 private:
  static constexpr float kOcclusionHeavyFactor = 8;  // times the distance

  // True if the texel's mean is a poor estimate at the hit: it is close by, or the texel reaches under or into another
  // body and is lit elsewhere.
  bool is_near(const GatherRay& info, float distance, std::uint32_t texel) const {
    return info.follows_near && continues_path(distance, texel);
  }

  // Continues a path at a hit that transmits, emits or is near.
  void follow(const Ray& ray, const GatherRay& info, const Hit& hit, std::uint32_t number, QueryResults& results) const;
  // Continues a path at the specular layers of an opaque hit, whose texel is in `results`.
  void follow_layers(const Ray& ray, const GatherRay& info, const Hit& hit, std::uint32_t number,
                     QueryResults& results) const;
  float survival_of(std::uint32_t triangle) const {
    return survival_[scene().surfaces[scene().triangle_surface[triangle]].material];
  }
  std::optional<float> link_to(const GatherRay& info, const DiffuseVertex& v, std::uint32_t number,
                               QueryResults& results) const;  // an OnDiffuse callback

  void add_to_groups(std::uint32_t number, std::span<const Vec3> light, QueryResults& results) const {
    for (std::size_t g = 0; g < light.size(); ++g) results.grouped[number * light.size() + g] += light[g];
  }

  // The balance-heuristic weight of a ray that hits the sky; light sampling has the rest.
  float sky_weight(const Vec3& direction, const GatherRay& info) const;

  const Scene& scene() const { return t_.accel.scene(); }

  enum class Kind : char { kOther, kMatt, kLayered };  // the last two are opaque, and their light is in texels
  const Transport& t_;
  const Texels& texels_;
  bool closed_form_;
  std::uint64_t seed_;
  bool lamps_ = true;
  std::vector<Kind> kinds_;      // by triangle
  std::vector<float> survival_;  // by material
  std::vector<float> side_;      // by texel, m
};

}  // namespace oriel
