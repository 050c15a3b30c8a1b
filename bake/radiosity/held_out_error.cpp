#include "bake/radiosity/held_out_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/jobs/units.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/radiosity/texels/texel_paths.h"
#include "formats/core/color.h"
#include "formats/core/half.h"
#include "formats/query/sharp_light.h"

namespace oriel {
namespace {

constexpr std::uint32_t kCalibrationPaths = 32;              // of a pixel, which determine the number per estimate
constexpr double kRaysAPath = 8;                             // about, with those to lights
constexpr std::uint32_t kDarkPaths = 8 * kCalibrationPaths;  // where calibration paths may find no light
constexpr std::uint32_t kMostPaths = 5461;                   // of each estimate
constexpr std::size_t kBatch = 64, kMostPixels = 4096;       // pixels a batch, and at most
constexpr std::size_t kLeastCompared = 8;                    // for an interval to mean anything
constexpr double kPrecise = 0.2;                             // of the squared error requested

struct HeldOutPixel {
  const FramePixel* pixel = nullptr;
  std::size_t number = 0;                     // of the pixel
  DVec3 baked{0};                             // cd/m²
  DVec3 floor2{0};                            // of its view
  std::array<DVec3, kEstimates> estimates{};  // cd/m², independent of each other
  std::uint32_t paths = 0;                    // of all of them

  DVec3 mean() const { return std::accumulate(estimates.begin(), estimates.end(), DVec3(0)) / double{kEstimates}; }
  double square() const { return squared_error(baked, estimates, floor2); }
};

// Rounds the mantissa to that of a half: the pack scales halves so that exponents suffice.
float as_half(float x) {
  int exponent = 0;
  const float mantissa = std::frexp(x, &exponent);
  return std::ldexp(float_from_half(half_from_float(mantissa)), exponent);
}

// Irradiance as the player shows it, lux.
DVec3 read_light(const Scene& scene, std::span<const LightmapPage> pages, const SharpLight* sharp,
                 const FramePixel& pixel) {
  const LightmapPage& page = pages[pixel.page];
  const Vec2 first(pixel.texel[0] % page.width, pixel.texel[0] / page.width);
  const Vec2 beyond(pixel.share[1] + pixel.share[3], pixel.share[2] + pixel.share[3]);
  const Vec2 uv = (first + beyond + 0.5f) / Vec2(page.width, page.height);
  const Vec3 smooth = smooth_irradiance_at(page, uv);
  const DVec3 light(as_half(smooth.r), as_half(smooth.g), as_half(smooth.b));
  if (sharp == nullptr || page.sharp_at.empty()) return light;
  const SharpPlace at{uv, point_on(scene, pixel.triangle, pixel.barycentric), geometric_normal(scene, pixel.triangle)};
  return light + DVec3(sharp_irradiance(*sharp, page, at));
}

std::vector<HeldOutPixel> hold_out(const LightmapScene& scene, std::span<const LightmapPage> pages,
                                   std::span<const FramePixel> pixels, const HeldOutQuery& query) {
  const auto read = [&](const FramePixel& p) {
    return read_light(scene.transport.accel.scene(), pages, query.sharp, p);
  };
  const auto shown = [&](const FramePixel& p, const DVec3& light) { return DVec3(p.transfer) * light; };
  const std::vector<DVec3> floors2 =
      frame_floors2(pixels, [&](std::size_t i) { return shown(pixels[i], read(pixels[i])); });
  std::vector<HeldOutPixel> chosen;
  for (std::size_t i = 0; i < pixels.size() && chosen.size() < kMostPixels; ++i) {
    const FramePixel& p = pixels[i];
    HeldOutPixel h{&p, i, shown(p, read(p)) + DVec3(p.emitted), floors2[p.view]};
    chosen.push_back(h);
  }
  return chosen;
}

class Verifier {
 public:
  Verifier(const LightmapScene& scene, const HeldOutQuery& query, Context& context)
      : t_(scene.transport), query_(query), goal2_(query.error * query.error), context_(context) {
    for (std::uint64_t k = 0; k < seeds_.size(); ++k) seeds_[k] = mix64(context.seed + seeds::kHeldOutPaths + k);
  }

  // Sets the limit on paths per estimate so that a batch stays within the rays.
  Status limit_paths(std::span<HeldOutPixel> first) {
    ORIEL_TRY_VOID(measure(first, kCalibrationPaths));
    std::uint64_t paths = 0;
    for (const HeldOutPixel& h : first) paths += h.paths;
    const double rays_a_path = static_cast<double>(rays_) / static_cast<double>(std::max<std::uint64_t>(paths, 1));
    const double fit =
        static_cast<double>(query_.rays_at_most) / (rays_a_path * kEstimates * static_cast<double>(kBatch));
    most_paths_ = static_cast<std::uint32_t>(std::clamp(fit, double{kCalibrationPaths}, double{kMostPaths}));
    return {};
  }

  Status measure(std::span<HeldOutPixel> batch) { return measure(batch, most_paths_); }
  std::uint64_t rays() const { return rays_; }

 private:
  Status measure(std::span<HeldOutPixel> batch, std::uint32_t most) {
    UnitLoop loop{.stage = "certificate", .count = batch.size(), .rays = kRaysAPath * kCalibrationPaths};
    loop.inputs = [&](std::size_t k, Archive& key) {
      FramePixel pixel = *batch[k].pixel;
      key(pixel, batch[k].number, batch[k].baked, batch[k].floor2, goal2_, most);
    };
    loop.compute = [&](std::size_t k) {
      HeldOutPixel& h = batch[k];
      std::uint64_t traced = 0;
      const TexelSums calibration = sums(kEstimates, h, kCalibrationPaths, traced);
      const std::uint32_t wanted = paths_for(h, calibration, most);
      h.paths = 0;
      for (std::size_t e = 0; e < kEstimates; ++e) {
        const TexelSums own = sums(e, h, wanted, traced);
        h.estimates[e] = DVec3(h.pixel->transfer) * own.irradiance() + DVec3(h.pixel->emitted);
        h.paths += own.count;
      }
      return traced;
    };
    loop.results = [&](std::size_t k, Archive& archive) { archive(batch[k].estimates, batch[k].paths); };
    return parallel_units({context_, &rays_}, loop);
  }

  // which: an estimate, or kEstimates for the calibration.
  TexelSums sums(std::size_t which, const HeldOutPixel& h, std::uint32_t paths, std::uint64_t& traced) const {
    TexelSums own;
    const SurfacePoint point = point_on_side(t_.accel, h.pixel->triangle, h.pixel->barycentric);
    for (std::uint32_t k = 0; k < paths; ++k) {
      if (k % 256 == 0 && context_.stopped()) break;  // the result is thrown away
      Sampler sampler(seeds_[which], h.number, k);
      own.add(sample_irradiance(t_, point, sampler, traced));
    }
    return own;
  }

  // The error of the mean over pixels is about minimal for its rays where a pixel's noise equals its error.
  std::uint32_t paths_for(const HeldOutPixel& h, const TexelSums& calibration, std::uint32_t most) const {
    const DVec3 transfer(h.pixel->transfer),
        variance = transfer * transfer * calibration.variance() * double(calibration.count);
    const double relative = relative_square(variance, h.baked * h.baked, h.floor2);
    const bool dark = luminance(Vec3(h.baked)) < luminance(Vec3(glm::sqrt(h.floor2)));
    std::uint32_t paths = dark ? std::min(most, kDarkPaths) : kCalibrationPaths;
    while (paths < most && paths * goal2_ < relative) paths = std::min(2 * paths, most);
    return paths;
  }

  const Transport& t_;
  const HeldOutQuery query_;
  double goal2_;
  Context& context_;
  std::array<std::uint64_t, kEstimates + 1> seeds_;  // of the estimates and the calibration
  std::uint32_t most_paths_ = kCalibrationPaths;
  std::atomic<std::uint64_t> rays_{0};
};

// The ratio Σ (baked - path) / Σ path in luminance, and 1.96 standard errors of it.
void state_bias(std::span<const HeldOutPixel> samples, HeldOutError& c) {
  const auto path = [](const HeldOutPixel& h) { return double{luminance(Vec3(h.mean()))}; };
  const auto off = [&](const HeldOutPixel& h) { return luminance(Vec3(h.baked)) - path(h); };
  double difference = 0, paths = 0, squares = 0;
  for (const HeldOutPixel& h : samples) difference += off(h), paths += path(h);
  if (!(paths > 0)) return;
  c.bias = difference / paths;
  for (const HeldOutPixel& h : samples) squares += std::pow(off(h) - c.bias * path(h), 2);
  c.bias_interval = 1.96 * std::sqrt(squares) / paths;
}

struct MeanSquare {
  double mean = 0, interval = 0;  // 95 %: mean ± interval
};

MeanSquare mean_square(std::span<const HeldOutPixel> samples) {
  double sum = 0, squares = 0;
  const auto n = static_cast<double>(samples.size());
  for (const HeldOutPixel& h : samples) sum += h.square();
  const double mean = sum / n;
  for (const HeldOutPixel& h : samples) squares += std::pow(h.square() - mean, 2);
  return {mean, 1.96 * std::sqrt(squares / (n * std::max(1.0, n - 1)))};
}

// The pixels with most of the squared error: a mean may be due to a few crevices.
std::vector<WorstPixel> worst_of(std::span<const HeldOutPixel> samples, const Scene& scene) {
  constexpr std::size_t kMost = 8;
  constexpr double kLeastShare = 0.01;
  std::vector<WorstPixel> worst;
  double sum = 0, off = 0;  // off: without negative squares, which are noise, so that shares stay below 1
  for (const HeldOutPixel& h : samples) {
    const double square = h.square();
    sum += square, off += std::max(square, 0.0);
    worst.push_back({h.pixel->triangle, point_on(scene, h.pixel->triangle, h.pixel->barycentric),
                     luminance(Vec3(h.baked)), luminance(Vec3(h.mean())), square});
  }
  if (!(sum > 0)) return {};  // less than the paths' noise
  std::stable_sort(worst.begin(), worst.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
  while (worst.size() > kMost || (!worst.empty() && !(worst.back().share >= kLeastShare * off))) worst.pop_back();
  for (WorstPixel& w : worst) w.share /= off;
  return worst;
}

}  // namespace

double squared_error(const DVec3& baked, const std::array<DVec3, kEstimates>& estimates, const DVec3& floor2) {
  double sum = 0;
  for (std::size_t divisor = 0; divisor < kEstimates; ++divisor) {
    const DVec3 &a = estimates[(divisor + 1) % kEstimates], &b = estimates[(divisor + 2) % kEstimates];
    const DVec3 brighter = glm::max(baked, estimates[divisor]);
    sum += relative_square((baked - a) * (baked - b), brighter * brighter, floor2);
  }
  return sum / kEstimates;
}

Result<HeldOutError> measure_held_out_error(const LightmapScene& scene, std::span<const LightmapPage> pages,
                                            std::span<const FramePixel> pixels, const HeldOutQuery& query,
                                            Context& context) {
  HeldOutError c;
  std::vector<HeldOutPixel> held_out = hold_out(scene, pages, pixels, query);
  Verifier verifier(scene, query, context);
  std::span<const HeldOutPixel> compared;
  while (compared.size() < held_out.size()) {
    const auto batch =
        std::span(held_out).subspan(compared.size()).first(std::min(kBatch, held_out.size() - compared.size()));
    if (compared.empty()) ORIEL_TRY_VOID(verifier.limit_paths(batch));
    ORIEL_TRY_VOID(verifier.measure(batch));
    for (const HeldOutPixel& h : batch) c.paths += h.paths;
    compared = std::span(held_out).first(compared.size() + batch.size());
    if (verifier.rays() >= query.rays_at_most) break;
    if (compared.size() >= kLeastCompared && mean_square(compared).interval <= kPrecise * query.error * query.error)
      break;
  }
  c.rays = verifier.rays();
  c.pixels = compared.size();
  if (compared.empty()) return c;
  state_bias(compared, c);
  const MeanSquare square = mean_square(compared);
  c.relative_error = std::sqrt(std::max(0.0, square.mean));
  c.worst = worst_of(compared, scene.transport.accel.scene());
  c.error_low = std::sqrt(std::max(0.0, square.mean - square.interval));
  c.error_high = std::sqrt(std::max(0.0, square.mean + square.interval));
  return c;
}

}  // namespace oriel
