// How materials reflect: kernels, alone and by incidence, and reflectances.
#include <algorithm>

#include "formats/pack/issues.h"

namespace oriel {
namespace {

// size² numbers from 0 up with sum 1.
void validate_weights(std::size_t i, std::uint32_t size, const std::vector<float>& weights, IssueList& list) {
  if (size % 2 == 0 || size > kMaxSide || weights.size() != std::size_t{size} * size) {
    list.error(502, "kernel {}: found size {} with {} weights, expected an odd size and its square", i, size,
               weights.size());
    return;
  }
  const std::size_t before = list.issues.size();
  list.each(
      503, "kernel weights", weights, [](float w) { return not_negative(w); }, kNotNegative);
  double sum = 0;
  for (const float w : weights) sum += w;
  if (list.issues.size() == before && !(std::abs(sum - 1) <= 1e-4))
    list.error(504, "kernel {}: found weights with sum {}, expected 1 within 1e-4", i, sum);
}

void validate_kernel(std::size_t i, const BrdfKernel& kernel, IssueList& list) {
  if (!within(kernel.alpha, 0, 1) || !within(kernel.cos_theta, 0, 1) || !not_negative(kernel.half_extent) ||
      !within(kernel.energy_kept, 0, 1))
    list.error(501,
               "kernel {}: found alpha {}, cosine {}, half extent {}, energy {}, expected 0 to 1 (extent: from 0 up)",
               i, kernel.alpha, kernel.cos_theta, kernel.half_extent, kernel.energy_kept);
  validate_weights(i, kernel.size, kernel.weights, list);
}

// A texture whose corners are directions that floats can tell apart.
bool good_box(const KernelSlice& s) {
  constexpr float kWidest = 1e4f, kFarthest = 20;  // sinh 20 = 2e8: 1e-8 rad from the way back
  const auto in_s = [](float v) { return within(v, -kFarthest, kFarthest); };
  return s.width.x > 0 && s.width.y > 0 && s.width.x <= kWidest && s.width.y <= kWidest &&
         within(s.shift, -kWidest, kWidest) && in_s(s.lower.x) && in_s(s.lower.y) && in_s(s.upper.x) &&
         in_s(s.upper.y) && s.lower.x == -s.upper.x && s.lower.x < s.upper.x && s.lower.y < s.upper.y;
}

// A section holds one half.
bool even_in_x(const std::vector<float>& weights, std::uint32_t size) {
  for (std::size_t row = 0; row + size <= weights.size() && size > 0; row += size)
    for (std::size_t x = 0; x < size / 2; ++x)
      if (weights[row + x] != weights[row + size - 1 - x]) return false;
  return true;
}

void validate_slices(std::size_t i, const BrdfKernel& kernel, IssueList& list) {
  if (kernel.slices.size() > kMaxSlices)
    list.error(515, "kernel {}: found {} slices, expected at most {}", i, kernel.slices.size(), kMaxSlices);
  float before = -1;
  for (const KernelSlice& s : kernel.slices) {
    if (!within(s.cos_theta, 0, 1) || !(s.cos_theta > before))
      list.error(511, "kernel {}: found cosine {} after {}, expected 0 to 1 and rising", i, s.cos_theta, before);
    before = s.cos_theta;
    if (!within(s.albedo, 0, 1) || !within(s.energy_kept, 0, 1) || !within(s.tilt_rad, -kPi, kPi) ||
        !not_negative(s.radial_extent))
      list.error(512, "kernel {}: found albedo {}, energy {}, tilt {}, radial extent {}, expected 0 to 1, a half turn",
                 i, s.albedo, s.energy_kept, s.tilt_rad, s.radial_extent);
    if (!good_box(s))
      list.error(513, "kernel {}: found a texture {} to {} of width {} around {}, expected rising and even in x", i,
                 text_of(s.lower), text_of(s.upper), text_of(s.width), s.shift);
    const bool shares = std::all_of(s.radial.begin(), s.radial.end(), [](float v) { return within(v, 0, 1); });
    if (s.radial.size() < 2 || !shares || !std::is_sorted(s.radial.begin(), s.radial.end()))
      list.error(514, "kernel {}: found {} radial shares, expected at least 2, 0 to 1 and rising", i, s.radial.size());
    validate_weights(i, kernel.slice_size, s.weights, list);
    if (!even_in_x(s.weights, kernel.slice_size))
      list.error(516, "kernel {}: found weights of a slice that differ left and right, expected the same", i);
  }
}

}  // namespace

void validate_kernels(const Pack& pack, IssueList& list) {
  list.in_section(kKernelSection);
  for (std::size_t i = 0; i < pack.kernels.size(); ++i) validate_kernel(i, pack.kernels[i], list);
  list.in_section(kKernelSection);
  for (std::size_t i = 0; i < pack.kernels.size(); ++i) validate_slices(i, pack.kernels[i], list);
}

void validate_fresnel_maps(const Pack& pack, IssueList& list) {
  list.in_section(kFresnelSection);
  for (std::size_t i = 0; i < pack.fresnel_maps.size(); ++i) {
    const FresnelMap& map = pack.fresnel_maps[i];
    if (!within(map.alpha, 0, 1)) list.error(601, "Fresnel map {}: found alpha {}, expected 0 to 1", i, map.alpha);
    if (map.table.size() < 2 || map.table.size() > kMaxSide)
      list.error(602, "Fresnel map {}: found {} table entries, expected at least 2", i, map.table.size());
    list.each(
        603, "Fresnel table entries", map.table, [](const Vec3& v) { return within(v, 0, 1); }, "0 to 1");
  }
  list.in_section(kFresnelSection);
  for (std::size_t i = 0; i < pack.fresnel_maps.size(); ++i) {
    const std::vector<Vec3>& factor = pack.fresnel_maps[i].factor;
    if (factor.size() == 1 || factor.size() > kMaxSide)
      list.error(604, "Fresnel map {}: found {} factors, expected none or 2 to {}", i, factor.size(), kMaxSide);
    list.each(
        605, "Fresnel factors", factor, [](const Vec3& v) { return within(v, 0, 1); }, "0 to 1");
  }
}

}  // namespace oriel
