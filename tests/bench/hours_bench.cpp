// How far an hour of a day is from a bake of that hour alone, over all texels of the same scene:
//   hours_bench DAY.oriel HOUR ALONE.oriel
// rms: relative, texels darker than a tenth of the mean as that; off: the share of texels whose light differs by more
// than a tenth, likewise; stated: what the bake alone says of its noise.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>

#include "formats/core/color.h"
#include "formats/pack/reader.h"
#include "formats/query/day_hours.h"
#include "formats/query/group_light.h"

namespace {
using namespace oriel;

struct Sums {
  std::vector<double> squares;
  double stated = 0, bias = 0, light = 0, off = 0;

  // Of so many of the texels, those that differ least.
  double rms(double share) {
    std::ranges::sort(squares);
    const auto count = static_cast<std::size_t>(share * static_cast<double>(squares.size()));
    return std::sqrt(std::accumulate(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(count), 0.0) /
                     static_cast<double>(std::max<std::size_t>(count, 1)));
  }
  double count() const { return std::max(static_cast<double>(squares.size()), 1.0); }
};

double mean_light(const Pack& pack) {
  double sum = 0, count = 0;
  for (const LightmapPage& page : pack.lightmaps)
    for (std::size_t t = 0; t < page.state.size(); ++t)
      if (page.state[t] == TexelState::kValid) sum += luminance(page.irradiance[t]), ++count;
  return sum / std::max(count, 1.0);
}

void add(const LightmapPage& alone, const std::vector<Vec3>& shown, double floor, Sums& sums) {
  for (std::size_t t = 0; t < shown.size(); ++t) {
    if (alone.state[t] != TexelState::kValid) continue;
    const double one = luminance(alone.irradiance[t]), off = luminance(shown[t]) - one,
                 noise = luminance(alone.standard_error[t]);
    const double by = one * one + floor * floor;
    sums.squares.push_back(off * off / by), sums.stated += noise * noise / by, sums.bias += off, sums.light += one;
    sums.off += off * off > 0.01 * by ? 1 : 0;
  }
}

Status compare(const char* day_file, float hour, const char* alone_file) {
  ORIEL_TRY(const Pack day, read_pack(day_file));
  ORIEL_TRY(const Pack alone, read_pack(alone_file));
  ORIEL_TRY(const std::vector<float> weights, weights_at(day.day, hour, day.light_groups.size()));
  std::vector<Vec3> factors;
  for (const float weight : weights) factors.emplace_back(weight);
  const double floor = 0.1 * mean_light(alone);
  Sums sums;
  double relit_s = 0;
  for (const PageGroups& groups : day.page_groups) {
    const LightmapPage &page = day.lightmaps[groups.page], &other = alone.lightmaps.at(groups.page);
    if (page.state != other.state)
      return fail(ErrorCode::kDifferent, alone_file, "found other texels, expected those of {}", day_file);
    std::vector<Vec3> shown = page.irradiance, detail = page.detail;
    const auto started = std::chrono::steady_clock::now();
    relight(groups, false, factors, 0, shown);
    relight(groups, true, factors, 0, detail);
    relit_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    add(other, shown, floor, sums);
  }
  fmt::print(
      "{:g}: rms {:.2f} %, of 99.9 % of the texels {:.2f} %, off by a tenth {:.2f} % of texels, bias {:.2f} %, "
      "stated alone {:.2f} %, relit in {:.1f} ms\n",
      hour, 100 * sums.rms(1), 100 * sums.rms(0.999), 100 * sums.off / sums.count(), 100 * sums.bias / sums.light,
      100 * std::sqrt(sums.stated / sums.count()), 1000 * relit_s);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: hours_bench DAY.oriel HOUR ALONE.oriel\n");
    return static_cast<int>(ErrorCode::kUsage);
  }
  const Status done = compare(argv[1], std::strtof(argv[2], nullptr), argv[3]);
  if (!done) fmt::print(stderr, "hours_bench: {}\n", done.error().text());
  return done ? 0 : static_cast<int>(done.error().code);
}
