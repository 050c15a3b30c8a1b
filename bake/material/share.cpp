#include "bake/material/share.h"

#include <algorithm>
#include <numeric>

#include "bake/material/reflectance.h"

namespace oriel {
namespace {

constexpr double kMovedPerWidth = 4 / 2.718281828459045;  // Beckmann's, the larger

// At the entries of the finer table: between two of them both maps are linear.
bool same(const FresnelMap& a, const FresnelMap& b, float error) {
  const std::size_t entries = std::max({a.table.size(), b.table.size(), std::size_t{2}});
  for (std::size_t i = 0; i < entries; ++i) {
    const float root = static_cast<float>(i) / static_cast<float>(entries - 1);
    const Vec3 ra = fresnel_lookup(a, root * root), rb = fresnel_lookup(b, root * root);
    for (int c = 0; c < 3; ++c)
      if (!(std::abs(ra[c] - rb[c]) <= std::max(error * std::min(ra[c], rb[c]), kLeastDifference))) return false;
  }
  return true;
}

}  // namespace

Groups group_widths(std::span<const float> alphas, double error) {
  Groups groups;
  groups.of.resize(alphas.size());
  std::vector<std::size_t> order(alphas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return alphas[a] < alphas[b]; });
  const double factor = std::exp(2 * std::max(error, 0.0) / kMovedPerWidth);  // from one end of a group to the other
  for (std::size_t first = 0; first < order.size();) {
    const float narrowest = std::max(alphas[order[first]], 0.0f);
    std::size_t last = first;
    while (last < order.size() && std::max(alphas[order[last]], 0.0f) <= narrowest * factor)
      groups.of[order[last++]] = static_cast<std::uint32_t>(groups.values.size());
    const float widest = std::max(alphas[order[last - 1]], 0.0f);
    groups.values.push_back(widest == narrowest ? widest : std::sqrt(narrowest * widest));
    first = last;
  }
  return groups;
}

Groups group_reflectances(std::span<const FresnelMap> maps, double error) {
  Groups groups;
  std::vector<std::uint32_t> firsts;
  for (std::uint32_t i = 0; i < maps.size(); ++i) {
    const auto found = std::find_if(firsts.begin(), firsts.end(), [&](std::uint32_t first) {
      return same(maps[first], maps[i], static_cast<float>(error));
    });
    groups.of.push_back(found == firsts.end() ? i : *found);
    if (found == firsts.end()) firsts.push_back(i);
  }
  return groups;
}

}  // namespace oriel
