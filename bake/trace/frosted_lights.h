// Point, spot and directional lights behind flat frosted panes: what a pane's facets spread of them to its other side,
// which no path meets. Each light is spread once, by the pane nearest to who receives it; the panes beyond let it pass
// straight.
#pragma once

#include <algorithm>
#include <vector>

#include "bake/trace/planar_mirrors.h"
#include "bake/trace/virtual_lights.h"

namespace oriel {

// The lights of a scene by way of the panes that they shine on. A scene without panes or without lights has none. Holds
// a reference to the scene; immutable.
class FrostedLights {
 public:
  FrostedLights() = default;
  // With an accelerator ways that something stands in are chosen less.
  FrostedLights(const Scene& scene, const LightSet& lights, const Accel* accel);

  // One light by way of one pane.
  struct Way {
    std::uint32_t light = 0;  // into Scene::lights
    std::uint16_t pane = 0;   // into panes(), on the side away from the light
  };
  bool empty() const { return ways_.empty(); }
  const PlanarMirrors& panes() const { return panes_; }
  // Whether a triangle is of a pane that spreads light.
  bool spreads(std::uint32_t triangle) const { return !triangles_.empty() && triangles_[triangle] != 0; }

  // Numbers in [0, 1) that choose how light comes: by which way, from which point of a sun's disk, by which facet.
  struct Chosen {
    float way = 0;
    Vec2 light{0}, facet{0};
  };
  // Light at p by one way, chosen by its worth, and one point of its pane: `endless` is an unbiased estimate of the
  // irradiance by all ways on a plane that faces `direction`, with nothing in the way, `share` 1. No legs: none came.
  // `lights` are the scene's.
  MirroredSample sample(const LightSet& lights, const Vec3& p, const Chosen& chosen) const;

 private:
  // A way to p and one over its probability; 0: none reaches p.
  std::pair<std::size_t, float> choose(const DVec3& p, float u) const;
  // Whose share of what adds up holds a sum.
  static std::size_t at_or_below(const std::vector<double>& sums, double sum) {
    return std::min<std::size_t>(std::ranges::upper_bound(sums, sum) - sums.begin(), sums.size() - 1);
  }
  // What a pane's ways may bring to p, up to a factor: 0 where they bring none. A way's share is that of its power.
  double worth(std::size_t pane, const DVec3& p) const;
  std::optional<PlanarMirrors::On> point_by_area(std::size_t pane, const Vec2& v) const;
  // The share of a pane that a light shines on, from a few of its points; never 0.
  double openness(const Way& way, const LightSet& lights, const Accel& accel) const;

  const Scene* scene_ = nullptr;
  PlanarMirrors panes_;
  std::vector<Way> ways_;
  std::vector<char> triangles_;
  std::vector<std::vector<double>> areas_;         // by pane: cumulative, of its triangles, m²
  std::vector<DVec3> middle_;                      // by pane, of its hull
  std::vector<double> extent_;                     // likewise: of its corners, m
  std::vector<std::vector<std::size_t>> of_pane_;  // by pane: numbers of its ways
  std::vector<std::vector<double>> power_;         // likewise: cumulative, of luminance that it gets by them, about, lm
};

}  // namespace oriel
