// Which of many lights to sample, by what each can send to a point. Conty Estevez & Kulla 2018, "Importance Sampling of
// Many Lights with Adaptive Tree Splitting" (without the splitting and without the receiver's normal).
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// A light of finite extent. Its intensity towards a direction that makes the angle θ with the nearest normal of its
// surface is bounded by cosθ where θ <= reach, and 0 beyond; normals lie within `spread` of the axis. So a triangle has
// spread 0 and reach π/2, a point light spread π, a spot light its cone as spread and reach 0.
struct BoundedLight {
  Vec3 lower{0}, upper{0};
  Vec3 axis{0, 0, 1};  // unit
  float spread_rad = kPi, reach_rad = kPi / 2;
  double power = 0;  // > 0, finite
};

class LightTree {
 public:
  // With this many lights or fewer the choice does not look at places: it is cheaper, and nothing is hidden from it.
  static constexpr std::size_t kFlat = 8;
  // With this many or fewer a quarter of the choices are even (a defensive mixture, Hesterberg 1995): a dim lamp at a
  // place from which the bright ones are hidden is not left to luck, for a sixth more noise of the others at most.
  static constexpr std::size_t kFew = 64;
  static constexpr double kEven = 0.25;

  LightTree() = default;
  explicit LightTree(const std::vector<BoundedLight>& lights);

  bool empty() const { return nodes_.empty(); }

  struct Pick {
    std::uint32_t light;  // of the constructor's
    float probability;
  };
  // From a point and a uniform u. The probabilities of all lights add up to 1 at every point.
  Pick pick(const Vec3& p, float u) const;
  float probability(const Vec3& p, std::uint32_t light) const;

 private:
  struct Cone {
    Vec3 axis;
    float spread, reach;
  };
  struct Node {
    Vec3 centre;
    float radius;  // of the bounding box's sphere
    Vec3 axis;
    float cos_spread, sin_spread, cos_reach;
    double power;
    std::uint32_t parent;
    std::uint32_t right;  // the left child follows its parent; 0: a leaf
    std::uint32_t light;  // of a leaf
  };
  struct Group;
  class Builder;

  // Beside the tree; in a flat one powers themselves are evened out.
  double even_share() const { return leaf_.size() > kFlat && leaf_.size() <= kFew ? kEven : 0; }
  double importance(const Node& node, const Vec3& p) const;
  double share_of_left(std::uint32_t parent, const Vec3& p) const;

  std::vector<Node> nodes_;          // depth first
  std::vector<std::uint32_t> leaf_;  // node of each light
};

}  // namespace oriel
