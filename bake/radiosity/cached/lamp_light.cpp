#include "bake/radiosity/cached/lamp_light.h"

#include <algorithm>

#include "bake/radiosity/gather/lamp_paths.h"

namespace oriel {
namespace {

constexpr std::uint64_t kFirst = 1u << 15;  // particles a half
constexpr std::uint64_t kMostATexel = 64;   // of both halves
constexpr std::uint64_t kRaysAParticle = 8;
constexpr double kRaw =
    2;  // times the error asked for, before the filter, whose work is that of some 33 times the rays

// Mean square over the pixels that eyes see.
double mean_square(const LampLight& lamps, std::span<const Vec3> direct, const FrameError& frames) {
  std::vector<Vec3> light(direct.size()), variance(direct.size());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Vec3 a = lamps.half(0, i), b = lamps.half(1, i);
    light[i] = direct[i] + 0.5f * (a + b);
    variance[i] = 0.25f * (a - b) * (a - b);
  }
  double sum = 0, shares = 0;
  for (const float square : frames.squares(light, variance)) sum += square;
  for (const float share : frames.shares()) shares += share;
  return shares > 0 ? sum / shares : 0;
}

}  // namespace

Status follow_lamps(const Texels& texels, Surroundings& around, std::span<const Vec3> direct, const FrameError& frames,
                    double error, const RadiosityOptions& options, Context& context, HalfSums& sums,
                    std::atomic<std::uint64_t>& rays) {
  LampLight lamps(texels.count(), options.directional);
  const std::uint64_t most = std::max(kFirst, texels.count() * kMostATexel / kHalves);
  std::uint64_t per_half = kFirst;
  if (error <= 0) per_half = std::clamp(texels.count() * options.samples / (kRaysAParticle * kHalves), kFirst, most);
  for (;; per_half *= 2) {
    ORIEL_TRY_VOID(trace_lamps(texels, around, per_half, context, lamps, rays));
    if (lamps.particles == 0) return {};
    if (error <= 0 || 2 * per_half > most || (options.enough && options.enough())) break;
    if (mean_square(lamps, direct, frames) <= kRaw * kRaw * error * error) break;
  }
  around.leave_out_lamps();
  for (std::size_t i = 0; i < texels.count(); ++i) {
    for (int h = 0; h < kHalves; ++h) sums.beside[h][i] = lamps.half(h, i);
    if (options.directional) sums.beside_moments[i] = lamps.moments[i] / static_cast<float>(kHalves * lamps.particles);
  }
  return {};
}

}  // namespace oriel
