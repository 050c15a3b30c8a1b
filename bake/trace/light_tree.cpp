#include "bake/trace/light_tree.h"

#include <array>
#include <numeric>

namespace oriel {
namespace {

constexpr int kBuckets = 12;

// cos(max(0, a - b)) and sin(max(0, a - b)) of angles in [0, π].
float cos_sub_clamped(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}
float sin_sub_clamped(float sin_a, float cos_a, float sin_b, float cos_b) {
  return cos_a > cos_b ? 0 : sin_a * cos_b - cos_a * sin_b;
}

}  // namespace

// Lights taken together: bounds, cone of normals, power.
struct LightTree::Group {
  Vec3 lower{3e38f}, upper{-3e38f};
  Cone cone{{0, 0, 1}, -1, 0};  // spread < 0: nothing yet
  double power = 0;

  void add(const Group& other) {
    if (other.cone.spread < 0) return;
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
    cone = cone.spread < 0 ? other.cone : united(cone, other.cone);
    power += other.power;
  }

  // The smallest cone around both (the paper's algorithm 1).
  static Cone united(Cone a, Cone b) {
    if (b.spread > a.spread) std::swap(a, b);
    const float between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0f, 1.0f));
    const float reach = std::max(a.reach, b.reach);
    if (std::min(between + b.spread, kPi) <= a.spread) return {a.axis, a.spread, reach};
    const float spread = 0.5f * (a.spread + between + b.spread);
    const Vec3 side = normalize_or(b.axis - glm::dot(a.axis, b.axis) * a.axis, Vec3(0));
    if (spread >= kPi || side == Vec3(0)) return {a.axis, kPi, reach};
    const float turn = spread - a.spread;
    return {glm::normalize(std::cos(turn) * a.axis + std::sin(turn) * side), spread, reach};
  }

  // Power times extent times the measure of directions: what splitting keeps small.
  double cost() const {
    if (cone.spread < 0) return 0;
    const double o = cone.spread, w = std::min<double>(o + cone.reach, kPiD);
    const double directions =
        2 * kPiD * (1 - std::cos(o)) +
        kPiD / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
    const DVec3 size(upper - lower);
    return power * glm::dot(size, size) * directions;
  }
};

class LightTree::Builder {
 public:
  Builder(const std::vector<BoundedLight>& lights, LightTree& tree)
      : lights_(lights), tree_(tree), order_(lights.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    tree_.nodes_.reserve(2 * lights.size());
    tree_.leaf_.resize(lights.size());
    build(0, lights.size(), 0);
  }

 private:
  Group group_of(std::uint32_t light) const {
    const BoundedLight& l = lights_[light];
    return {l.lower, l.upper, {l.axis, l.spread_rad, l.reach_rad}, l.power};
  }
  Vec3 centroid(std::uint32_t light) const { return 0.5f * (lights_[light].lower + lights_[light].upper); }

  void build(std::size_t begin, std::size_t end, std::uint32_t parent) {
    Group all;
    for (std::size_t i = begin; i < end; ++i) all.add(group_of(order_[i]));
    const auto self = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.push_back({0.5f * (all.lower + all.upper), 0.5f * glm::length(all.upper - all.lower), all.cone.axis,
                            all.cone.spread >= kPi ? -1 : std::cos(all.cone.spread),
                            all.cone.spread >= kPi ? 0 : std::sin(all.cone.spread),
                            all.cone.reach >= kPi / 2 ? 0 : std::cos(all.cone.reach), all.power, parent, 0,
                            order_[begin]});
    if (end - begin == 1) {
      tree_.leaf_[order_[begin]] = self;
      return;
    }
    const std::size_t middle = split(begin, end);
    build(begin, middle, self);
    tree_.nodes_[self].right = static_cast<std::uint32_t>(tree_.nodes_.size());
    build(middle, end, self);
  }

  // Sorts the range into two parts at the cheapest plane between buckets of centroids; returns where the second begins.
  std::size_t split(std::size_t begin, std::size_t end) {
    Vec3 lower(3e38f), upper(-3e38f);
    for (std::size_t i = begin; i < end; ++i) {
      lower = glm::min(lower, centroid(order_[i]));
      upper = glm::max(upper, centroid(order_[i]));
    }
    int best_axis = -1, best_bucket = 0;
    double best = 0;
    const auto bucket_of = [&](std::uint32_t light, int axis) {
      const float t = (centroid(light)[axis] - lower[axis]) / (upper[axis] - lower[axis]);
      return std::clamp(static_cast<int>(t * kBuckets), 0, kBuckets - 1);
    };
    for (int axis = 0; axis < 3; ++axis) {
      if (!(upper[axis] > lower[axis])) continue;
      std::array<Group, kBuckets> buckets, after;
      for (std::size_t i = begin; i < end; ++i) buckets[bucket_of(order_[i], axis)].add(group_of(order_[i]));
      Group sum;
      for (int b = kBuckets - 1; b > 0; --b) {
        sum.add(buckets[b]);
        after[b] = sum;
      }
      sum = {};
      for (int b = 1; b < kBuckets; ++b) {
        sum.add(buckets[b - 1]);
        const double cost = sum.cost() + after[b].cost();
        if (sum.power > 0 && after[b].power > 0 && (best_axis < 0 || cost < best)) {
          best = cost;
          best_axis = axis;
          best_bucket = b;
        }
      }
    }
    if (best_axis < 0) return begin + (end - begin) / 2;  // all in one place
    const auto second = std::stable_partition(
        order_.begin() + static_cast<std::ptrdiff_t>(begin), order_.begin() + static_cast<std::ptrdiff_t>(end),
        [&](std::uint32_t light) { return bucket_of(light, best_axis) < best_bucket; });
    return static_cast<std::size_t>(second - order_.begin());
  }

  const std::vector<BoundedLight>& lights_;
  LightTree& tree_;
  std::vector<std::uint32_t> order_;
};

LightTree::LightTree(const std::vector<BoundedLight>& lights) {
  if (lights.empty()) return;
  if (lights.size() > kFlat) {
    Builder(lights, *this);
    return;
  }
  std::vector<BoundedLight> evened(lights);
  double mean = 0;
  for (const BoundedLight& light : lights) mean += light.power / static_cast<double>(lights.size());
  for (BoundedLight& light : evened) light.power = (1 - kEven) * light.power + kEven * mean;
  Builder(evened, *this);
}

double LightTree::importance(const Node& node, const Vec3& p) const {
  if (leaf_.size() <= kFlat) return node.power;
  const Vec3 to = p - node.centre;
  const double d2 = glm::dot(DVec3(to), DVec3(to)), r2 = static_cast<double>(node.radius) * node.radius;
  // Within the bounds the distance says nothing more; at a point light the quotient must stay finite.
  const double nearness = node.power / std::max({d2, r2, 1e-60});
  if (d2 <= r2 || node.cos_spread <= -1) return nearness;
  const auto d = static_cast<float>(std::sqrt(d2));
  const float sin_size = std::min(1.0f, node.radius / d), cos_size = std::sqrt(1 - sin_size * sin_size);
  const float cos_axis = std::clamp(glm::dot(node.axis, to) / d, -1.0f, 1.0f),
              sin_axis = std::sqrt(1 - cos_axis * cos_axis);
  // The angle between the axis and p, less the spread of normals and the angle that the bounds take up.
  const float cos_left = cos_sub_clamped(sin_axis, cos_axis, node.sin_spread, node.cos_spread),
              sin_left = sin_sub_clamped(sin_axis, cos_axis, node.sin_spread, node.cos_spread);
  const float cosine = cos_sub_clamped(sin_left, cos_left, sin_size, cos_size);
  return cosine < node.cos_reach ? 0 : nearness * std::max(0.0f, cosine);
}

double LightTree::share_of_left(std::uint32_t parent, const Vec3& p) const {
  const Node &left = nodes_[parent + 1], &right = nodes_[nodes_[parent].right];
  const double a = importance(left, p), b = importance(right, p);
  return a + b > 0 ? a / (a + b) : left.power / (left.power + right.power);
}

LightTree::Pick LightTree::pick(const Vec3& p, float u) const {
  const double even = even_share(), each = even / static_cast<double>(leaf_.size());
  if (u < even) {
    const auto light = static_cast<std::uint32_t>(u / even * static_cast<double>(leaf_.size()));
    return {light, probability(p, light)};
  }
  std::uint32_t at = 0;
  double rest = std::min((u - even) / (1 - even), 1 - 0x1p-53), probability = 1;
  while (nodes_[at].right != 0) {
    const double left = share_of_left(at, p);
    if (rest < left) {
      rest = std::min(rest / left, 1 - 0x1p-53);
      probability *= left;
      at = at + 1;
    } else {
      rest = std::min((rest - left) / (1 - left), 1 - 0x1p-53);
      probability *= 1 - left;
      at = nodes_[at].right;
    }
  }
  return {nodes_[at].light, static_cast<float>(each + (1 - even) * probability)};
}

float LightTree::probability(const Vec3& p, std::uint32_t light) const {
  double probability = 1;
  for (std::uint32_t at = leaf_[light]; at != 0; at = nodes_[at].parent) {
    const std::uint32_t parent = nodes_[at].parent;
    const double left = share_of_left(parent, p);
    probability *= at == parent + 1 ? left : 1 - left;
  }
  const double even = even_share();
  return static_cast<float>(even / static_cast<double>(leaf_.size()) + (1 - even) * probability);
}

}  // namespace oriel
