// How materials reflect: kernels, alone and by incidence, and reflectances.
#include "formats/core/half.h"
#include "formats/pack/sections.h"

namespace oriel {
namespace {

// Numbers within [0, 1], each a half.
void describe_shares(Serial& s, std::vector<float>& values, std::uint64_t n, const char* what) {
  s.coded<std::uint16_t>(values, n, half_from_float, [&](std::uint16_t half, std::size_t i) {
    if (half > 0x3c00) s.refuse("found {} half {:#06x} at {}, expected 0 to 1", what, half, i);
    return float_from_half(half);
  });
}

// The middle column and those right of it, row by row: the left ones mirror them.
std::vector<float> right_half(const std::vector<float>& weights, std::uint32_t size) {
  std::vector<float> half;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = size / 2; x < size; ++x) half.push_back(weights[y * size + x]);
  return half;
}

std::vector<float> both_halves(const std::vector<float>& half, std::uint32_t size) {
  std::vector<float> weights(std::size_t{size} * size);
  std::size_t i = 0;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = size / 2; x < size; ++x)
      weights[y * size + x] = weights[y * size + size - 1 - x] = half[i++];
  return weights;
}

void describe(Serial& s, std::uint32_t size, KernelSlice& slice) {
  s(slice.cos_theta, slice.albedo, slice.energy_kept, slice.tilt_rad, slice.shift, slice.width, slice.lower,
    slice.upper, slice.radial_extent);
  describe_shares(s, slice.radial, s.count(slice.radial), "radial share");
  std::vector<float> half;
  if (!s.reading()) half = right_half(slice.weights, size);
  describe_shares(s, half, std::uint64_t{size} * (size / 2 + 1), "weight");
  if (s.reading() && s.ok()) slice.weights = both_halves(half, size);
}

}  // namespace

void describe(Serial& s, BrdfKernel& k) {
  std::uint8_t facets = 1;  // GGX
  s.choice("kernel model", 2, facets);
  if (facets != 1) s.refuse("found a kernel of model {}, expected GGX's, 1", facets);
  s.reserved(3);
  s(k.alpha, k.cos_theta, k.half_extent, k.energy_kept, k.size);
  s.planes(k.weights, std::uint64_t{k.size} * k.size);
  s(k.slice_size);
  const std::uint32_t slices = s.count(k.slices);
  if (slices > 0 && (k.slice_size % 2 == 0 || k.slice_size > kMaxSide))
    s.refuse("found slices of size {}, expected an odd one up to {}", k.slice_size, kMaxSide);
  if (slices > kMaxSlices) s.refuse("found {} slices, expected at most {}", slices, kMaxSlices);
  s.list(k.slices, slices, [&](KernelSlice& slice) { describe(s, k.slice_size, slice); });
  s.list(k.fits, s.count(k.fits), [&](LobeFit& f) { s(f.m11, f.m13, f.m22, f.m31, f.amplitude); });
}

void describe(Serial& s, FresnelMap& map) {
  s(map.alpha);
  const std::uint32_t entries = s.count(map.table), factors = s.count(map.factor);
  std::uint32_t side = 0;  // of an image of R that packs by earlier programs hold
  s(side);
  s.planes(map.table, entries);
  s.planes(map.factor, factors);
  std::vector<Vec3> image;
  s.planes(image, std::uint64_t{side} * side);
}

}  // namespace oriel
