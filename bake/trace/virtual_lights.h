// Point, spot and directional lights as planar mirrors show them: light that no path finds by chance. Virtual lights
// and apertures after Diefenbach & Badler 1997, section 4 (light volumes through mirrors, cut by each other).
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "bake/trace/accel.h"
#include "bake/trace/planar_mirrors.h"

namespace oriel {

class LightSet;

// One light by way of mirrors that follow each other.
struct VirtualLight {
  static constexpr int kMostMirrors = 8;

  std::uint32_t light = 0;                           // into Scene::lights
  int order = 0;                                     // mirrors
  std::array<std::uint16_t, kMostMirrors> mirror{};  // of `order`, from the light on
  DMat3 unfolded{1};                                 // turns directions from the receiver's side to the light's
  DVec3 shift{0};      // a receiver p sees the light as unfolded · p + shift would directly
  double flux_lm = 0;  // luminance of what may leave the last mirror, nothing in the way; of directions that see a sun
  // Of the volume that the light's middle fills behind the last mirror: what that reaches has normal · p >= offset for
  // all of them. A sun's disk reaches further, by `spread` metres a metre from the mirror's part that it leaves by.
  struct Side {
    DVec3 normal{0};  // unit, inwards
    double offset = 0;
  };
  std::vector<Side> sides;
  DVec3 middle{0};  // of that part
  double extent_m = 0, spread = 0;

  // False where it shines on no point of a sphere.
  bool may_reach(const DVec3& centre, double radius) const {
    const double far = glm::distance(centre, middle) + extent_m + radius, slack = radius + spread * far;
    return std::ranges::all_of(sides,
                               [&](const Side& side) { return glm::dot(side.normal, centre) - side.offset >= -slack; });
  }
};

// How light comes to a receiver.
struct MirroredSample {
  Vec3 direction{0, 0, 1};  // unit, from the receiver to the last mirror
  // Irradiance on a facing plane with nothing in the way, if the mirrors were endless: of a light, as
  // LightSample::estimate. 0 where the light lies behind a mirror.
  Vec3 endless{0};
  Vec3 share{0};  // that mirrors as they are reflect of it: 0 beside them; at most 1
  int legs = 0;   // shadow rays, all of which must pass; 0 where share is 0
  std::array<Ray, VirtualLight::kMostMirrors + 1> leg;
  std::uint32_t group = 0;  // of lamps

  std::span<const Ray> rays() const { return std::span(leg).first(static_cast<std::size_t>(legs)); }
};

// The brightest mirrored lights of a scene: by way of up to Scene::light_mirrors one after the other, at most kMost of
// them, none that sends less than kLeast of its light that way. A scene without planar mirrors or without such lights
// has none. Holds a reference to the scene; immutable.
class VirtualLights {
 public:
  static constexpr std::size_t kMost = 256;
  static constexpr double kLeast = 1e-6;
  static constexpr std::size_t kVisited = 16;  // of more, so many are chosen by their flux

  VirtualLights() = default;
  explicit VirtualLights(const Scene& scene);

  bool empty() const { return lights_.empty(); }
  std::size_t size() const { return lights_.size(); }
  const VirtualLight& operator[](std::size_t i) const { return lights_[i]; }
  const PlanarMirrors& mirrors() const { return mirrors_; }
  // The share of their flux that mirrored lights have which were left out because there are kMost brighter ones.
  double left_out() const { return left_out_; }

  // Light number i at p; `lights` are the scene's. v chooses a point of a sun's disk.
  MirroredSample sample(std::size_t i, const LightSet& lights, const Vec3& p, const Vec2& v) const;

  // Calls visit(i, weight) for mirrored lights whose weighted light is on average all light; u in [0, 1).
  template <class Visit>
  void choose(float u, const Visit& visit) const {
    if (lights_.size() <= kVisited) {
      for (std::size_t i = 0; i < lights_.size(); ++i) visit(i, 1.0f);
      return;
    }
    for (std::size_t k = 0; k < kVisited; ++k) {
      const double at = (static_cast<double>(k) + u) / kVisited * cumulative_.back();
      const std::size_t i = std::min<std::size_t>(
          std::upper_bound(cumulative_.begin(), cumulative_.end(), at) - cumulative_.begin(), lights_.size() - 1);
      const double share = cumulative_[i] - (i > 0 ? cumulative_[i - 1] : 0);
      visit(i, static_cast<float>(cumulative_.back() / (kVisited * share)));
    }
  }

 private:
  const Scene* scene_ = nullptr;
  PlanarMirrors mirrors_;
  std::vector<VirtualLight> lights_;
  std::vector<double> cumulative_;  // flux
  double left_out_ = 0;
};

}  // namespace oriel
