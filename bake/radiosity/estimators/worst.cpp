#include "bake/radiosity/estimators/worst.h"

#include <algorithm>

#include "bake/radiosity/estimators/filter.h"

namespace oriel {

std::vector<std::uint32_t> worst_texels(const TexelGraph& graph, std::span<const std::uint32_t> candidates,
                                        const TexelErrors& of, const WorstOptions& options, Context& context) {
  const auto& [squares, importance, samples] = of;
  std::vector<float> typical(squares);
  for (std::size_t i = 0; i < typical.size(); ++i) typical[i] *= static_cast<float>(samples[i]);
  typical = typical_errors(graph, std::move(typical), context);
  for (std::size_t i = 0; i < typical.size(); ++i) typical[i] /= static_cast<float>(std::max(1u, samples[i]));
  std::vector<std::uint32_t> by_error;
  for (const std::uint32_t i : candidates)
    if (typical[i] > options.goal / 4 * importance[i]) by_error.push_back(i);
  const auto gain_a_ray = [&](std::uint32_t i) { return double{typical[i]} / std::max(1u, samples[i]); };
  std::sort(by_error.begin(), by_error.end(), [&](std::uint32_t a, std::uint32_t b) {
    const double ga = gain_a_ray(a), gb = gain_a_ray(b);
    return ga != gb ? ga > gb : a < b;
  });
  double left = options.excess;
  std::size_t count = 0;
  for (; count < by_error.size() && left > 0; ++count) left -= options.gain * typical[by_error[count]];
  by_error.resize(count);
  std::sort(by_error.begin(), by_error.end());
  std::vector<std::uint32_t> in_order;
  for (const std::uint32_t i : candidates)
    if (std::binary_search(by_error.begin(), by_error.end(), i)) in_order.push_back(i);
  return in_order;
}

std::vector<SameSamples> groups_of(std::span<const std::uint32_t> list, const std::vector<std::uint32_t>& samples) {
  std::vector<SameSamples> groups;
  for (const std::uint32_t i : list) {
    const auto same = std::ranges::find(groups, samples[i], &SameSamples::samples);
    if (same == groups.end())
      groups.push_back({samples[i], {i}});
    else
      same->texels.push_back(i);
  }
  return groups;
}

std::vector<bool> little_seen(std::span<const std::uint32_t> texels, const std::vector<float>& importance,
                              double square) {
  std::vector<bool> little(importance.size());
  if (square <= 0) return little;
  std::vector<std::uint32_t> by_share(texels.begin(), texels.end());
  std::sort(by_share.begin(), by_share.end(), [&](std::uint32_t a, std::uint32_t b) {
    return importance[a] != importance[b] ? importance[a] < importance[b] : a < b;
  });
  for (const std::uint32_t i : by_share) {
    if ((square -= importance[i]) < 0) break;
    little[i] = true;
  }
  return little;
}

}  // namespace oriel
