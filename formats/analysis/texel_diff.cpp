#include "formats/analysis/texel_diff.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kDarkTexel = 0.01;  // of the mean: what relative errors of darker texels are relative to

struct Pair {
  double first = 0, second = 0, first_error = 0, second_error = 0;
};

// Channels' errors are taken as one.
double error_of(const LightmapPage& page, std::size_t texel) {
  return page.standard_error.empty() ? 0 : luminance(page.standard_error[texel]);
}

std::vector<Pair> valid_pairs(const Pack& a, const Pack& b) {
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < a.lightmaps.size(); ++p) {
    const LightmapPage &first = a.lightmaps[p], &second = b.lightmaps[p];
    for (std::size_t i = 0; i < first.irradiance.size(); ++i)
      if (first.state[i] == TexelState::kValid && second.state[i] == TexelState::kValid)
        pairs.push_back(
            {luminance(first.irradiance[i]), luminance(second.irradiance[i]), error_of(first, i), error_of(second, i)});
  }
  return pairs;
}

double root(double mean_square) {
  return std::sqrt(std::max(0.0, mean_square));
}

}  // namespace

bool same_texels(const Pack& a, const Pack& b) {
  return a.mesh.lightmap_uvs == b.mesh.lightmap_uvs &&
         std::ranges::equal(a.lightmaps, b.lightmaps, [](const LightmapPage& p, const LightmapPage& q) {
           return p.width == q.width && p.height == q.height;
         });
}

std::optional<TexelDiff> diff_texels(const Pack& first, const Pack& second) {
  if (!same_texels(first, second)) return std::nullopt;
  const std::vector<Pair> pairs = valid_pairs(first, second);
  if (pairs.empty()) return std::nullopt;
  const auto count = static_cast<double>(pairs.size());
  TexelDiff out;
  out.texels = pairs.size();
  double second_mean = 0;
  for (const Pair& p : pairs) out.mean_lux += p.first / count, second_mean += p.second / count;
  if (!(out.mean_lux > 0) && second_mean > 0) return std::nullopt;
  out.bias = out.mean_lux > 0 ? second_mean / out.mean_lux - 1 : 0;
  const double dark = kDarkTexel * out.mean_lux;
  std::vector<double> net;  // squares
  double brighter = 0;
  for (const Pair& p : pairs) {
    const double scale = p.first * p.first + dark * dark;
    if (!(scale > 0)) continue;
    const double off = (p.second - p.first) * (p.second - p.first), noise = p.first_error * p.first_error;
    const double most = std::max(p.first, p.second);
    out.difference += off / scale, out.noise += noise / scale;
    out.stated += p.second_error * p.second_error / scale;
    brighter += (off - noise) / (most * most + dark * dark);
    net.push_back((off - noise) / scale);
  }
  const auto worst = static_cast<std::ptrdiff_t>(net.size() / 100);
  double all = 0, rest = 0;
  std::ranges::sort(net);
  for (const double square : net) all += square;
  for (auto at = net.begin(); at != net.end() - worst; ++at) rest += *at;
  out.difference = root(out.difference / count), out.noise = root(out.noise / count);
  out.stated = root(out.stated / count);
  out.net = root(all / count), out.net_of_brighter = root(brighter / count);
  out.net_without_worst = root(rest / (count - static_cast<double>(worst)));
  return out;
}

}  // namespace oriel
