#include "bake/brdf/quadrature.h"

#include <array>
#include <mutex>

#include "formats/core/check.h"

namespace oriel {
namespace {

constexpr int kMaxOrder = 512;

// Roots of the Legendre polynomial by Newton's steps from Tricomi's guess.
GaussRule make_rule(int order) {
  GaussRule rule;
  for (int i = 0; i < order; ++i) {
    double x = std::cos(kPiD * (i + 0.75) / (order + 0.5)), slope = 1;
    for (int step = 0; step < 20; ++step) {
      double p = 1, before = 0;
      for (int k = 1; k <= order; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = order * (x * p - before) / (x * x - 1);
      const double change = p / slope;
      x -= change;
      if (std::abs(change) < 1e-15) break;
    }
    rule.nodes.push_back(0.5 * (1 - x));
    rule.weights.push_back(1 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace

const GaussRule& gauss_rule(int order) {
  ORIEL_CHECK(order >= 1 && order <= kMaxOrder);
  static std::array<GaussRule, kMaxOrder + 1> rules;
  static std::array<std::once_flag, kMaxOrder + 1> once;
  const auto i = static_cast<std::size_t>(order);
  std::call_once(once[i], [&] { rules[i] = make_rule(order); });
  return rules[i];
}

}  // namespace oriel
