#include "bake/radiosity/certificate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/jobs/units.h"
#include "bake/radiosity/texels/texel_paths.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kPilotPaths = 32;               // of each estimate: they tell how many it gets
constexpr double kRaysAPath = 8;                        // about, with those to lights
constexpr std::uint32_t kDarkPaths = 8 * kPilotPaths;   // where a pilot that finds no light foretells nothing:
constexpr double kDark = 0.1;                           // of the mean
constexpr std::uint32_t kMostPaths = 5461;              // of each estimate
constexpr std::size_t kBatch = 64, kMostTexels = 4096;  // texels asked at a time and at most
constexpr std::size_t kLeastCompared = 8;               // for an interval to mean anything
constexpr double kWellKnown = 0.2;                      // of the squared error asked for

struct HeldOut {
  std::size_t page = 0, index = 0;
  DVec3 baked{0};                             // lux
  std::array<DVec3, kEstimates> estimates{};  // lux, independent of each other
  std::uint32_t paths = 0;                    // of all of them
  bool compared = false;                      // false: nearly all of its points are buried

  DVec3 mean() const { return std::accumulate(estimates.begin(), estimates.end(), DVec3(0)) / double{kEstimates}; }
};

std::uint32_t reversed(std::uint32_t bits) {
  std::uint32_t out = 0;
  for (int i = 0; i < 32; ++i) out |= (bits >> i & 1u) << (31 - i);
  return out;
}

// What is seen of the valid texels, by surface; of it `count` places at equal steps, in an order whose every beginning
// is spread evenly. No texel is chosen twice.
std::vector<HeldOut> choose(const Scene& scene, std::span<const TexelMapPage> map, const Radiosity& radiosity,
                            std::size_t count, std::uint64_t seed) {
  struct Place {
    std::uint32_t surface, page, index;
    double seen;  // and after accumulating, with all before it
  };
  std::vector<Place> places;
  for (std::uint32_t p = 0; p < map.size(); ++p)
    for (std::uint32_t i = 0; i < map[p].texel.size(); ++i)
      if (radiosity.pages[p].state[map[p].texel[i]] == TexelState::kValid)
        places.push_back({scene.triangle_surface[map[p].fragments[map[p].first[i]].triangle], p, i,
                          seen_share(map, radiosity, p, i)});
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.surface < b.surface; });
  double seen = 0;
  for (Place& place : places) place.seen = seen += place.seen;
  if (!(seen > 0)) return {};
  count = std::clamp<std::size_t>(static_cast<std::size_t>(seen), 1, count);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [](std::uint32_t a, std::uint32_t b) { return reversed(a) < reversed(b); });
  const double offset = static_cast<double>(mix64(seed) >> 11u) * 0x1p-53;
  std::vector<HeldOut> chosen;
  for (const std::uint32_t k : order) {
    const double at = (k + offset) / static_cast<double>(count) * seen;
    const auto found = std::upper_bound(places.begin(), places.end(), at,
                                        [](double value, const Place& place) { return value < place.seen; });
    const Place& place = found == places.end() ? places.back() : *found;
    chosen.push_back(
        {place.page, place.index, DVec3(radiosity.pages[place.page].irradiance[map[place.page].texel[place.index]])});
  }
  return chosen;
}

class Verifier {
 public:
  Verifier(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> map, const DVec3& mean,
           double asked, std::uint64_t rays_at_most, Context& context)
      : map_(map), floor2_(1e-4 * mean * mean), asked2_(asked * asked), rays_at_most_(rays_at_most), context_(context) {
    paths_.reserve(seeds_.size());
    for (std::uint64_t k = 0; k < seeds_.size(); ++k) seeds_[k].seed = mix64(context.seed + 0xce27 + k);
    for (const Context& own : seeds_) paths_.emplace_back(transport, atlas, false, own);
  }

  // How many paths an estimate may have, so that a batch stays within the rays.
  Status limit_paths(std::span<HeldOut> first) {
    ORIEL_TRY_VOID(ask(first, kPilotPaths));
    std::uint64_t paths = 0;
    for (const HeldOut& h : first) paths += h.paths;
    const double rays_a_path = static_cast<double>(rays_) / static_cast<double>(std::max<std::uint64_t>(paths, 1));
    const double fit = static_cast<double>(rays_at_most_) / (rays_a_path * kEstimates * static_cast<double>(kBatch));
    most_paths_ = static_cast<std::uint32_t>(std::clamp(fit, double{kPilotPaths}, double{kMostPaths}));
    return {};
  }

  Status ask(std::span<HeldOut> batch) { return ask(batch, most_paths_); }
  std::uint64_t rays() const { return rays_; }

  double square(const HeldOut& h) const { return squared_error(h.baked, h.estimates, floor2_); }

 private:
  Status ask(std::span<HeldOut> batch, std::uint32_t most) {
    UnitLoop loop{.stage = "certificate", .count = batch.size(), .rays = kRaysAPath * kPilotPaths};
    loop.inputs = [&](std::size_t k, Archive& key) {
      key(batch[k].page, batch[k].index, batch[k].baked, floor2_, asked2_, most);
    };
    loop.compute = [&](std::size_t k) {
      HeldOut& h = batch[k];
      std::uint64_t traced = 0;
      const TexelSums pilot = sums(kEstimates, h, kPilotPaths, traced);
      const std::uint32_t wanted = paths_for(h, pilot, most);
      h.paths = 0;
      h.compared = true;
      for (std::size_t e = 0; e < kEstimates; ++e) {
        const TexelSums own = sums(e, h, wanted, traced);
        h.estimates[e] = own.irradiance();
        h.paths += own.count;
        h.compared = h.compared && own.count * 4 >= wanted;
      }
      return traced;
    };
    loop.results = [&](std::size_t k, Archive& archive) {
      archive(batch[k].estimates, batch[k].paths, batch[k].compared);
    };
    return parallel_units(context_, loop, &rays_);
  }

  TexelSums sums(std::size_t which, const HeldOut& h, std::uint32_t paths, std::uint64_t& traced) const {
    TexelSums own;
    paths_[which].add(map_[h.page], h.page, h.index, 0, paths, own, traced);
    return own;
  }

  // The least error in the mean of all texels for a number of rays is where a texel's noise equals its error, about.
  std::uint32_t paths_for(const HeldOut& h, const TexelSums& pilot, std::uint32_t most) const {
    const DVec3 variance = pilot.variance() * double(pilot.count);
    double relative = 0;
    for (int c = 0; c < 3; ++c)
      if (const double d = h.baked[c] * h.baked[c] + floor2_[c]; d > 0) relative += variance[c] / d / 3;
    const float light = luminance(Vec3(h.baked)), mean = 100 * luminance(Vec3(glm::sqrt(floor2_)));
    std::uint32_t paths = light < static_cast<float>(kDark) * mean ? std::min(most, kDarkPaths) : kPilotPaths;
    while (paths < most && paths * asked2_ < relative) paths = std::min(2 * paths, most);
    return paths;
  }

  std::span<const TexelMapPage> map_;
  DVec3 floor2_;
  double asked2_;
  std::uint64_t rays_at_most_;
  Context& context_;
  std::array<Context, kEstimates + 1> seeds_;  // of the estimates and the foretelling
  std::vector<TexelPaths> paths_;
  std::uint32_t most_paths_ = kPilotPaths;
  std::atomic<std::uint64_t> rays_{0};
};

// The ratio Σ (baked - path) / Σ path in luminance, and 1.96 standard errors of it.
void state_bias(std::span<const HeldOut> samples, Certificate& c) {
  const auto path = [](const HeldOut& h) { return double{luminance(Vec3(h.mean()))}; };
  const auto off = [&](const HeldOut& h) { return luminance(Vec3(h.baked)) - path(h); };
  double difference = 0, paths = 0, squares = 0;
  for (const HeldOut& h : samples) difference += off(h), paths += path(h);
  if (!(paths > 0)) return;
  c.bias = difference / paths;
  for (const HeldOut& h : samples) squares += std::pow(off(h) - c.bias * path(h), 2);
  c.bias_interval = 1.96 * std::sqrt(squares) / paths;
}

struct MeanSquare {
  double mean = 0, interval = 0;  // 95 %: mean ± interval
};

MeanSquare mean_square(std::span<const HeldOut> samples, const Verifier& verifier) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(samples.size());
  for (const HeldOut& h : samples) sum += verifier.square(h);
  const double mean = sum / n;
  for (const HeldOut& h : samples) squares += std::pow(verifier.square(h) - mean, 2);
  return {mean, 1.96 * std::sqrt(squares / (n * std::max(1.0, n - 1)))};
}

}  // namespace

double squared_error(const DVec3& baked, const std::array<DVec3, kEstimates>& estimates, const DVec3& floor2) {
  double sum = 0;
  for (std::size_t divisor = 0; divisor < kEstimates; ++divisor) {
    const DVec3 &a = estimates[(divisor + 1) % kEstimates], &b = estimates[(divisor + 2) % kEstimates];
    for (int c = 0; c < 3; ++c) {
      const double brighter = std::max(baked[c], estimates[divisor][c]);
      const double denominator = brighter * brighter + floor2[c];
      if (denominator > 0) sum += (baked[c] - a[c]) * (baked[c] - b[c]) / denominator;
    }
  }
  return sum / (3 * kEstimates);
}

Result<Certificate> certify(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                            const Radiosity& radiosity, double asked, std::uint64_t rays_at_most, Context& context) {
  Certificate c;
  std::vector<HeldOut> texels =
      choose(transport.accel.scene(), texel_map, radiosity, kMostTexels, mix64(context.seed + 0xce27));
  if (asked <= 0) asked = radiosity.report.relative_error;
  Verifier verifier(transport, atlas, texel_map, DVec3(radiosity.report.mean), asked, rays_at_most, context);
  std::vector<HeldOut> compared;
  for (std::size_t first = 0; first < texels.size(); first += kBatch) {
    const auto batch = std::span(texels).subspan(first, std::min(kBatch, texels.size() - first));
    if (first == 0) ORIEL_TRY_VOID(verifier.limit_paths(batch));
    ORIEL_TRY_VOID(verifier.ask(batch));
    for (const HeldOut& h : batch) c.paths += h.paths;
    std::copy_if(batch.begin(), batch.end(), std::back_inserter(compared), [](const HeldOut& h) { return h.compared; });
    if (verifier.rays() >= rays_at_most) break;
    if (compared.size() >= kLeastCompared && mean_square(compared, verifier).interval <= kWellKnown * asked * asked)
      break;
  }
  c.rays = verifier.rays();
  c.texels = compared.size();
  if (compared.empty()) return c;
  state_bias(compared, c);
  const MeanSquare square = mean_square(compared, verifier);
  c.relative_error = std::sqrt(std::max(0.0, square.mean));
  c.error_low = std::sqrt(std::max(0.0, square.mean - square.interval));
  c.error_high = std::sqrt(std::max(0.0, square.mean + square.interval));
  return c;
}

}  // namespace oriel
