// What gather rays find: cached texels, and light that no texel holds.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// What a gather ray is asked beside its direction.
struct GatherRay {
  float incidence = 0;       // of its direction: π times its density
  std::uint64_t stream = 0;  // of the random numbers for lobes behind the first hit
  std::uint32_t sample = 0;
  // Texels met from nearer than Surroundings::near() of their sides, and further where something stands or hangs close
  // to them, are not asked: a path goes on from the point met.
  bool near = false;
  // What is not that far, to a thousandth, has no answer: the ray was aimed at something else. 0: whatever it meets.
  float aimed_m = 0;
  bool misses(const Hit& hit) const {
    return aimed_m > 0 && !(hit && std::fabs(hit.distance - aimed_m) <= 1e-3f * aimed_m + 1e-4f);
  }
};

// A texel seen through lobes and layers.
struct Link {
  std::uint32_t ray = 0;  // of the batch
  std::uint32_t texel = 0;
  Vec3 weight{0};
};
// The light along a ray: light + share * albedo(texel) * irradiance(texel) / π + Σ weight * irradiance / π over its
// links.
struct Answers {
  std::vector<Hit> hits;
  std::vector<Texels::Place> places;  // by ray: of the front that was met first
  std::vector<std::uint32_t> texel;   // by ray: of the opaque surface met; kNoTexel: none
  std::vector<float> share;  // by ray: of light that the texel's specular layers leave to its diffuse reflection
  std::vector<Link> links;   // in order of rays
  // By ray: sky, emitters behind mirrors, emitters that closed forms do not hold, and what near surfaces reflect.
  std::vector<Vec3> light;
  std::vector<Vec3> unreflected;  // of it what comes straight from the sky and from emitters
  std::vector<Vec3> grouped;      // light by group of lamps, at ray * groups + group; empty where there are none
  std::uint64_t rays = 0;         // traced, beyond the batch itself
};

class Surroundings {
 public:
  // closed_form: emitters met directly are left out, their irradiance is known (PolygonLight). Else they count,
  // weighted against LightSet::sample (balance heuristic). So does the sky's image, against LightSet::sample_sky in the
  // first case, LightSet::sample in the second.
  Surroundings(const Transport& transport, const Texels& texels, bool closed_form, std::uint64_t seed);

  // Answers a batch; what Answers held is dropped.
  void answer(std::span<const Ray> rays, std::span<const GatherRay> about, Answers& answers) const;

  // Whether answers depend on GatherRay::incidence.
  bool weighs() const { return !closed_form_ || t_.lights.samples_sky(); }
  bool closed_form() const { return closed_form_; }

  // In sides of the texel met. The further paths go on, the less does it matter what texels cannot tell, and the more
  // rays and noise there are.
  float near() const { return near_; }
  void set_near(float sides) { near_ = sides; }
  const Transport& transport() const { return t_; }
  std::size_t groups() const { return scene().light_groups.size(); }  // of lamps
  // Whether a path goes on from a texel that is met from that far, all light in it.
  bool goes_on(float distance, std::uint32_t texel) const {
    return texel != kNoTexel &&
           distance < near_ * (texels_.occlusion_heavy[texel] ? kCrowdedNear : 1.0f) * side_[texel];
  }

  // Light of near lamps that comes by way of specular reflections alone is left out of answers: somebody else follows
  // it (lamp_paths.h).
  void leave_out_lamps() { lamps_ = false; }
  bool lamps() const { return lamps_; }

  // By material: a path goes on from specular layers so many times as often as they are bright; 1 unless told
  // (learn_survival). It changes what rays cost and how noisy they are, not the light that they find on average.
  void set_survival(std::vector<float> by_material) { survival_ = std::move(by_material); }
  const std::vector<float>& survival() const { return survival_; }

 private:
  static constexpr float kCrowdedNear = 8;  // times as far

  // Whether the mean over a texel says too little about the point that was met: it is close by, or the texel reaches
  // under or into something and is lit elsewhere.
  bool is_near(const GatherRay& about, float distance, std::uint32_t texel) const {
    return about.near && goes_on(distance, texel);
  }

  // At a surface that lets light through or emits, or that is near.
  void follow(const Ray& ray, const GatherRay& about, const Hit& hit, std::uint32_t number, Answers& answers) const;
  // At an opaque one with specular layers, whose texel is in `answers`.
  void look_through_layers(const Ray& ray, const GatherRay& about, const Hit& hit, std::uint32_t number,
                           Answers& answers) const;
  float survival_of(std::uint32_t triangle) const {
    return survival_[scene().surfaces[scene().triangle_surface[triangle]].material];
  }
  std::optional<float> link_to(const GatherRay& about, const DiffuseVertex& v, std::uint32_t number,
                               Answers& answers) const;  // as OnDiffuse

  void book(std::uint32_t number, std::span<const Vec3> light, Answers& answers) const {
    for (std::size_t g = 0; g < light.size(); ++g) answers.grouped[number * light.size() + g] += light[g];
  }

  // The part of the sky met that rays answer for, the rest is left to light sampling.
  float sky_weight(const Vec3& direction, const GatherRay& about) const;

  const Scene& scene() const { return t_.accel.scene(); }

  enum class Kind : char { kOther, kMatt, kLayered };  // the last two are opaque, and lit by what texels hold
  const Transport& t_;
  const Texels& texels_;
  bool closed_form_;
  std::uint64_t seed_;
  float near_ = 1;
  bool lamps_ = true;
  std::vector<Kind> kinds_;      // by triangle
  std::vector<float> survival_;  // by material
  std::vector<float> side_;      // by texel, m
};

}  // namespace oriel
