// Point, spot and directional lights behind flat frosted panes: what a pane's facets spread of them to its other side,
// which no path meets. Each light is spread once, by the pane nearest to who receives it; the panes beyond let it pass
// straight.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "bake/trace/planar_mirrors.h"
#include "bake/trace/virtual_lights.h"

namespace oriel {

// The lights of a scene by way of the panes that they shine on. A scene without panes or without lights has none. Holds
// a reference to the scene; immutable.
class FrostedLights {
 public:
  FrostedLights() = default;
  explicit FrostedLights(const Scene& scene);

  // One light by way of one pane.
  struct Way {
    std::uint32_t light = 0;  // into Scene::lights
    std::uint16_t pane = 0;   // into panes(), on the side away from the light
  };
  bool empty() const { return ways_.empty(); }
  std::size_t size() const { return ways_.size(); }
  const Way& operator[](std::size_t i) const { return ways_[i]; }
  const PlanarMirrors& panes() const { return panes_; }
  // Whether a triangle is of a pane that spreads light.
  bool spreads(std::uint32_t triangle) const { return !triangles_.empty() && triangles_[triangle] != 0; }

  // False where way number i brings no light to any point of a sphere.
  bool may_reach(std::size_t i, const DVec3& centre, double radius) const {
    return panes_[ways_[i].pane].height(centre) > -radius;
  }

  // Numbers that choose how light comes: a point of a sun's disk, and a facet of the pane.
  struct Chosen {
    Vec2 light{0}, facet{0};
  };
  // Light by way number i at p, by one point of the pane: `endless` is an unbiased estimate of the irradiance on a
  // plane that faces `direction`, with nothing in the way, `share` 1. No legs: none came. `lights` are the scene's.
  MirroredSample sample(std::size_t i, const LightSet& lights, const Vec3& p, const Chosen& chosen) const;

  // Calls visit(i, weight) for ways whose weighted light at p is on average all light: for all of a
  // few that reach it, for kVisited of more, by their worth. u in [0, 1).
  template <class Visit>
  void choose(const DVec3& p, float u, const Visit& visit) const {
    if (ways_.size() <= kVisited) {
      for (std::size_t i = 0; i < ways_.size(); ++i)
        if (may_reach(i, p, 0)) visit(i, 1.0f);
      return;
    }
    thread_local std::vector<double> until;
    until.clear();
    double sum = 0;
    for (std::size_t m = 0; m < panes_.size(); ++m) until.push_back(sum += worth(m, p));
    for (std::size_t k = 0; k < kVisited && sum > 0; ++k) {
      double at = (static_cast<double>(k) + u) / kVisited * sum;
      const std::size_t m = at_or_below(until, at);
      const double before = m > 0 ? until[m - 1] : 0, of_pane = until[m] - before;
      if (!(of_pane > 0)) continue;
      const double power = power_[m].back();
      at = (at - before) / of_pane * power;
      const std::size_t i = at_or_below(power_[m], at);
      const double own = (power_[m][i] - (i > 0 ? power_[m][i - 1] : 0)) / power * of_pane;
      if (own > 0) visit(of_pane_[m][i], static_cast<float>(sum / (kVisited * own)));
    }
  }

 private:
  static constexpr std::size_t kVisited = 16;

  // Whose share of what adds up holds a sum.
  static std::size_t at_or_below(const std::vector<double>& sums, double sum) {
    return std::min<std::size_t>(std::ranges::upper_bound(sums, sum) - sums.begin(), sums.size() - 1);
  }
  // What a pane's ways may bring to p, up to a factor: 0 where they bring none. A way's share is that of its power.
  double worth(std::size_t pane, const DVec3& p) const;
  std::optional<PlanarMirrors::On> point_by_area(std::size_t pane, const Vec2& v) const;

  const Scene* scene_ = nullptr;
  PlanarMirrors panes_;
  std::vector<Way> ways_;
  std::vector<char> triangles_;
  std::vector<std::vector<double>> areas_;         // by pane: cumulative, of its triangles, m²
  std::vector<DVec3> middle_;                      // by pane, of its hull
  std::vector<double> extent_;                     // likewise: of its corners, m
  std::vector<std::vector<std::size_t>> of_pane_;  // by pane: numbers of its ways
  std::vector<std::vector<double>> power_;         // likewise: cumulative, of luminance that it gets by them, lm
};

}  // namespace oriel
