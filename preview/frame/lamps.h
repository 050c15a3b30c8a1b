// Points on lamps that passes draw light from: jittered samples (U1), as many as are asked for, whatever the lamps.
#pragma once

#include <optional>
#include <span>

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"
#include "bake/trace/sky_sampler.h"
#include "preview/frame/eye_points.h"

namespace oriel {

enum class LampKind { kFlat, kPunctual, kAfar };

// A point that shines. On a receiver's incidence i (bake/trace/polygon_light.h: the cosine at it) its light, lux, is
//   kFlat      power cos i / d², cos at the lamp's front; power = radiance area over the density of choosing the point
//   kPunctual  power profile i / d²; power = cd
//   kAfar      power i; power = lux
// and with `soft` that is added to d², of a disk that is near: its area / pi.
struct LampPoint {
  LampKind kind = LampKind::kFlat;
  Vec4 place{0, 0, 0, 1};     // scene space, homogeneous: w = 0, and xyz is the unit direction to it, from afar
  Vec3 normal{0, 0, -1};      // of a flat lamp's front
  Vec3 power{0};              // per channel
  std::uint32_t light = ~0u;  // into Scene::lights, of a punctual one
  float soft = 0;             // m²; > 0: an element, of what surfaces reflect
  float share = 1;            // of one with a light: power over the light's own colour or intensity
  std::uint32_t lamp = ~0u;   // a number of its own: surfaces, then lights; ~0u: of an element or the sky
};

// A point's light on a receiver, lux, were nothing between, and the ray that looks for what is, from `origin`; none
// where it cannot shine.
struct Shone {
  Ray ray;
  Vec3 light;
};
std::optional<Shone> shine(const LampPoint& lamp, const EyePoint& at, const Scene& scene);

// How points are shared among a scene's lamps: by power, or by what they give what the eye sees.
struct LampShares {
  std::vector<double> near_cdf;  // cumulative, of lamps that are near; any unit
  std::vector<double> kinds;     // of all points: near lamps, if there are any, then each of those afar; sums to 1
  std::vector<double> sky_cdf;   // cumulative, of parts of the square that directions to the sky are drawn from
};

// All that shines in a scene.
class Lamps {
 public:
  Lamps() = default;
  explicit Lamps(const Scene& scene);

  bool empty() const { return near_.empty() && afar_.empty(); }
  // Flat lamps that touch count as one; a sky too.
  std::size_t count() const { return count_; }
  // Kinds alike.
  LampShares by_power() const;
  // A tenth of points is shared by power all the same, so that what the eye's points do not tell of is found too. Error
  // kStopped.
  Result<LampShares> by_eye(std::span<const EyePoint> eye, const Accel& accel, Context& context) const;
  // About `count` points, stratified over those of pass 0, 1, 2, … of the same shares: the mean over passes is all
  // direct light. From each kind of lamp, near or afar, at least one.
  std::vector<LampPoint> points(std::uint64_t seed, std::uint32_t pass, std::uint32_t count,
                                const LampShares& shares) const;

 private:
  struct Near {
    bool punctual;
    std::uint32_t index;  // of a triangle or of Scene::lights
    bool back;            // of a double-sided triangle
  };
  LampPoint near_point(double at, const Vec2& on, float count, std::span<const double> cdf) const;
  // On lamp i, that stands for all of it.
  LampPoint point_of(std::size_t i, const Vec2& on) const;
  LampPoint afar_point(std::size_t k, const Vec2& on, float count) const;
  // What one of its points gives all of the eye's, lux.
  template <typename Point>
  double given(const Point& point_of_eye, std::span<const EyePoint> eye, const Accel& accel) const;
  LampPoint sky_point(const Vec2& on, float count) const;
  std::size_t kinds() const { return afar_.size() + (near_.empty() ? 0 : 1); }

  const Scene* scene_ = nullptr;
  std::vector<Near> near_;
  std::vector<double> near_cdf_;     // cumulative lumens
  std::vector<std::uint32_t> afar_;  // into Scene::lights; ~0u: the sky
  SkySampler sky_;                   // of an image
  std::size_t count_ = 0;
};

}  // namespace oriel
