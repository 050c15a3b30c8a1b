#include "bake/radiosity/estimators/lamp_light.h"

#include <algorithm>
#include <numeric>

namespace oriel {
namespace {

constexpr std::uint64_t kLeast = 1u << 13, kFirstATexel = 8, kMostATexel = 512, kRaysAParticle = 8;
constexpr double kCost = 3;  // of a particle, in rays: it traces two incoherent ones

double total_square(const FrameError& frames, std::span<const Vec3> light, std::span<const Vec3> variance) {
  const std::vector<float> squares = frames.squares(light, variance);
  return std::accumulate(squares.begin(), squares.end(), 0.0);
}

}  // namespace

std::uint64_t first_particles(std::size_t texels, const RadiosityOptions& options) {
  const std::uint64_t of_both =
      options.error > 0 ? kFirstATexel * texels : std::min(kMostATexel, options.samples / kRaysAParticle) * texels;
  return std::max(kLeast, of_both / kHalves);
}

void set_additional(const LampLight& lamps, HalfSums& sums) {
  for (std::size_t i = 0; i < sums.samples.size(); ++i) {
    for (int h = 0; h < kHalves; ++h) sums.additional[h][i] = lamps.half(h, i);
    if (!sums.additional_moments.empty())
      sums.additional_moments[i] = lamps.moments[i] / static_cast<float>(kHalves * lamps.particles);
    for (int h = 0; h < kHalves; ++h)
      for (std::size_t g = 0; g < lamps.grouped[h].groups; ++g)
        sums.additional_grouped[h].of(i)[g] = lamps.grouped[h].of(i)[g] / static_cast<float>(lamps.particles);
  }
}

AdditionalLight smooth_additional(const LampLight& lamps, const Texels& texels, const TexelGraph& graph,
                                  const HalfSums& sums, Context& context) {
  if (lamps.particles == 0) return {};
  Halves halves{sums.additional, std::vector<Vec3>(texels.count()), std::vector<Vec3>(texels.count())};
  for (std::size_t i = 0; i < texels.count(); ++i) halves.additional[i] = sums.mean(i);
  return {filter(texels, graph, halves, {.scales = 1}, context).value,
          filter_groups(texels, graph, GroupHalves{sums.additional_grouped}, {.scales = 1}, context)};
}

bool particles_pay(const LampLight& lamps, const HalfSums& sums, std::span<const Vec3> light,
                   const FrameError& frames) {
  if (lamps.particles == 0 || 2 * kHalves * lamps.particles > kMostATexel * light.size()) return false;
  std::vector<Vec3> of_lamps(light.size()), of_all(light.size());
  double rays = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Vec3 a = sums.additional[0][i] - sums.additional[1][i], b = sums.half(0, i) - sums.half(1, i);
    of_lamps[i] = 0.25f * a * a, of_all[i] = 0.25f * b * b;
    rays += kHalves * sums.samples[i];
  }
  const double lamp_square = total_square(frames, light, of_lamps);
  const double ray_square = std::max(0.0, total_square(frames, light, of_all) - lamp_square);
  return lamp_square * rays > ray_square * kCost * kHalves * static_cast<double>(lamps.particles);
}

}  // namespace oriel
