#include "bake/trace/lobe_fit.h"

#include <algorithm>
#include <array>
#include <limits>

#include "bake/brdf/quadrature.h"
#include "formats/query/lobe_light.h"

namespace oriel {
namespace {

constexpr int kOrder = 20;  // of the quadrature: distances to 1e-3

// A direction of the quadrature with the lobe there.
struct Node {
  DVec3 wi;
  double solid_angle, density;
};

struct Nodes {
  std::vector<Node> list;
  double albedo = 0;
};

Nodes nodes_of(const LobeFunction& lobe, double alpha, double cos_theta) {
  Nodes nodes;
  const DVec3 wo = direction_at(cos_theta);
  for_each_reflection(cos_theta, alpha, kOrder, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    const double value = lobe(wo, wi, h);
    nodes.list.push_back({wi, solid_angle, value});
    nodes.albedo += value * solid_angle;
  });
  for (Node& node : nodes.list) node.density /= nodes.albedo;
  return nodes;
}

double distance(const Nodes& nodes, const LobeFit& fit) {
  double sum = 0;
  for (const Node& node : nodes.list) sum += std::abs(node.density - lobe_density(fit, node.wi)) * node.solid_angle;
  return sum;
}

// A lobe around an axis in the plane of incidence, tilt off the normal: widths (tangents) in that plane and across it,
// and how the first shears with height. What Heitz et al. fit, and the axis besides.
using LobeShape = std::array<double, 4>;

// As steps from a first guess, so that all four are of one size.
struct Guess {
  double tilt, along, across;

  LobeFit fit(const LobeShape& p) const {
    const double angle = tilt + p[0] * along, a = along * std::exp(p[1]), b = across * std::exp(p[2]), s = p[3] * a;
    const double c = std::cos(angle), sine = std::sin(angle);
    LobeFit fit;  // the inverse of (axes) · ((a, 0, s), (0, b, 0), (0, 0, 1)), over its last element
    fit.m11 = static_cast<float>((c + s * sine) / (a * c));
    fit.m13 = static_cast<float>((sine - s * c) / (a * c));
    fit.m22 = static_cast<float>(1 / (b * c));
    fit.m31 = static_cast<float>(-sine / c);
    return fit;
  }
  // Axes on or below the horizon have no such matrix; a lobe far narrower than the guess could hide between nodes.
  bool allows(const LobeShape& p) const {
    constexpr double kHighest = kPiD / 2 - 1e-6, kMostChange = 2.5;
    return std::abs(tilt + p[0] * along) < kHighest && std::abs(p[1]) < kMostChange && std::abs(p[2]) < kMostChange &&
           fit(p).m11 >= 0;
  }
};

// Nelder and Mead 1965, with their coefficients.
template <class Cost>
LobeShape simplex_minimum(const Cost& cost, const LobeShape& start, double step) {
  constexpr int kSteps = 150;
  constexpr double kFlat = 1e-5;  // of the cost: far below what the quadrature knows
  struct Corner {
    double cost;
    LobeShape at;
  };
  std::array<Corner, 5> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    LobeShape at = start;
    if (i > 0) at[i - 1] += step;
    corners[i] = {cost(at), at};
  }
  const auto order = [&] {
    std::stable_sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.cost < b.cost; });
  };
  order();
  for (int n = 0; n < kSteps && corners[4].cost - corners[0].cost > kFlat; ++n, order()) {
    LobeShape centre{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) centre[k] += corners[i].at[k] / 4;
    const auto beyond = [&](double t) {
      Corner c{0, {}};
      for (std::size_t k = 0; k < 4; ++k) c.at[k] = centre[k] + t * (corners[4].at[k] - centre[k]);
      c.cost = cost(c.at);
      return c;
    };
    Corner next = beyond(-1);
    if (next.cost < corners[0].cost) {
      const Corner farther = beyond(-2);
      if (farther.cost < next.cost) next = farther;
    } else if (next.cost >= corners[3].cost) {
      next = beyond(next.cost < corners[4].cost ? -0.5 : 0.5);
    }
    if (next.cost < corners[4].cost) {
      corners[4] = next;
      continue;
    }
    for (std::size_t i = 1; i < corners.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) corners[i].at[k] = 0.5 * (corners[i].at[k] + corners[0].at[k]);
      corners[i].cost = cost(corners[i].at);
    }
  }
  return corners[0].at;
}

}  // namespace

LobeFit fit_lobe(const LobeFunction& lobe, double alpha, double cos_theta) {
  const Nodes nodes = nodes_of(lobe, alpha, cos_theta);
  // Half vectors of slope alpha turn the mirror direction by twice that, and across the plane of incidence by less: in
  // proportion to their cosine to the eye, which at grazing angles their own slope keeps up.
  const double theta = std::min(std::acos(std::min(cos_theta, 1.0)), kPiD / 2 - 1e-3), width = 2 * alpha;
  const Guess guess{theta, width, width * std::min(1.0, cos_theta + alpha)};
  const auto cost = [&](const LobeShape& p) {
    return guess.allows(p) ? distance(nodes, guess.fit(p)) : std::numeric_limits<double>::max();
  };
  // Twice: a simplex that has become thin starts anew.
  const LobeShape first = simplex_minimum(cost, LobeShape{}, -0.2);
  LobeFit fit = guess.fit(simplex_minimum(cost, first, 0.1));
  fit.amplitude = static_cast<float>(std::clamp(nodes.albedo, 0.0, 1.0));
  return fit;
}

}  // namespace oriel
