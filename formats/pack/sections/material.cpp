// How materials reflect: kernels, alone and by incidence, and reflectances.
#include "formats/core/half.h"
#include "formats/pack/encoding/planes.h"
#include "formats/pack/fields.h"
#include "formats/pack/sections.h"

namespace oriel {
namespace {

// Numbers within [0, 1], each a half.
void put_shares(ByteWriter& out, std::span<const float> values) {
  std::vector<std::uint16_t> halves;
  halves.reserve(values.size());
  for (const float v : values) halves.push_back(half_from_float(v));
  put_planes(out, std::span<const std::uint16_t>(halves));
}

Status get_shares(ByteReader& in, std::uint64_t count, const char* what, std::vector<float>& values) {
  const auto halves = get_planes<std::uint16_t>(in, count);
  values.resize(halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if (halves[i] > 0x3c00) return invalid("", "found {} half {:#06x} at {}, expected 0 to 1", what, halves[i], i);
    values[i] = float_from_half(halves[i]);
  }
  return {};
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

void encode(ByteWriter& out, const KernelSlice& slice, std::uint32_t size) {
  for (const float v : {slice.cos_theta, slice.albedo, slice.energy_kept, slice.tilt_rad, slice.shift}) out.put(v);
  put(out, slice.width);
  put(out, slice.lower);
  put(out, slice.upper);
  out.put(slice.radial_extent);
  out.put(static_cast<std::uint32_t>(slice.radial.size()));
  put_shares(out, slice.radial);
  put_shares(out, right_half(slice.weights, size));
}

Status decode(ByteReader& in, std::uint32_t size, KernelSlice& slice) {
  for (float* v : {&slice.cos_theta, &slice.albedo, &slice.energy_kept, &slice.tilt_rad, &slice.shift})
    *v = in.get<float>();
  slice.width = get_vec2(in);
  slice.lower = get_vec2(in);
  slice.upper = get_vec2(in);
  slice.radial_extent = in.get<float>();
  const auto entries = in.get<std::uint32_t>();
  ORIEL_TRY_VOID(get_shares(in, entries, "radial share", slice.radial));
  std::vector<float> half;
  ORIEL_TRY_VOID(get_shares(in, std::uint64_t{size} * (size / 2 + 1), "weight", half));
  if (in.ok()) slice.weights = both_halves(half, size);
  return {};
}

}  // namespace

void encode(ByteWriter& out, const BrdfKernel& kernel) {
  out.put(static_cast<std::uint8_t>(kernel.model));
  for (int i = 0; i < 3; ++i) out.put(std::uint8_t{0});
  out.put(kernel.alpha);
  out.put(kernel.cos_theta);
  out.put(kernel.half_extent);
  out.put(kernel.energy_kept);
  out.put(kernel.size);
  put_planes(out, std::span<const float>(kernel.weights));
}

Status decode(ByteReader& in, BrdfKernel& kernel) {
  ORIEL_TRY_VOID(get_choice(in, "kernel model", 1, kernel.model));
  std::uint8_t reserved = 0;
  for (int i = 0; i < 3; ++i) ORIEL_TRY_VOID(get_choice(in, "reserved byte", 0, reserved));
  kernel.alpha = in.get<float>();
  kernel.cos_theta = in.get<float>();
  kernel.half_extent = in.get<float>();
  kernel.energy_kept = in.get<float>();
  kernel.size = in.get<std::uint32_t>();
  kernel.weights = get_planes<float>(in, std::uint64_t{kernel.size} * kernel.size);
  return {};
}

void encode(ByteWriter& out, const KernelSlices& slices) {
  out.put(slices.kernel);
  out.put(slices.size);
  out.put(static_cast<std::uint32_t>(slices.slices.size()));
  for (const KernelSlice& slice : slices.slices) encode(out, slice, slices.size);
}

Status decode(ByteReader& in, KernelSlices& slices) {
  slices.kernel = in.get<std::uint32_t>();
  slices.size = in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  if (in.ok() && (slices.size % 2 == 0 || slices.size > kMaxSide))
    return invalid("", "found size {}, expected an odd one up to {}", slices.size, kMaxSide);
  if (in.ok() && (count == 0 || count > kMaxSlices))
    return invalid("", "found {} slices, expected 1 to {}", count, kMaxSlices);
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    KernelSlice slice;
    ORIEL_TRY_VOID(decode(in, slices.size, slice));
    if (in.ok()) slices.slices.push_back(std::move(slice));
  }
  return {};
}

void encode(ByteWriter& out, const FresnelMap& map) {
  out.put(map.alpha);
  out.put(static_cast<std::uint32_t>(map.table.size()));
  out.put(map.sphere_size);
  put_planes(out, std::span<const Vec3>(map.table));
  put_planes(out, std::span<const Vec3>(map.sphere));
}

Status decode(ByteReader& in, FresnelMap& map) {
  map.alpha = in.get<float>();
  const auto entries = in.get<std::uint32_t>();
  map.sphere_size = in.get<std::uint32_t>();
  map.table = get_planes<Vec3>(in, entries);
  map.sphere = get_planes<Vec3>(in, std::uint64_t{map.sphere_size} * map.sphere_size);
  return {};
}

void encode(ByteWriter& out, const FresnelFactor& factor) {
  out.put(factor.map);
  out.put(static_cast<std::uint32_t>(factor.factor.size()));
  put_planes(out, std::span<const Vec3>(factor.factor));
}

Status decode(ByteReader& in, FresnelFactor& factor) {
  factor.map = in.get<std::uint32_t>();
  const auto entries = in.get<std::uint32_t>();
  factor.factor = get_planes<Vec3>(in, entries);
  return {};
}

void encode(ByteWriter& out, const SplitReflectance& split) {
  out.put(split.angles);
  out.put(split.roughnesses);
  for (int c = 0; c < 2; ++c) {
    std::vector<float> channel;
    for (const Vec2& v : split.table) channel.push_back(v[c]);
    put_shares(out, channel);
  }
}

Status decode(ByteReader& in, SplitReflectance& split) {
  ORIEL_TRY_VOID(get_size(in, split.angles, split.roughnesses));
  std::vector<float> scale, bias;
  ORIEL_TRY_VOID(get_shares(in, std::uint64_t{split.angles} * split.roughnesses, "scale", scale));
  ORIEL_TRY_VOID(get_shares(in, std::uint64_t{split.angles} * split.roughnesses, "bias", bias));
  for (std::size_t i = 0; in.ok() && i < scale.size(); ++i) split.table.emplace_back(scale[i], bias[i]);
  return {};
}

}  // namespace oriel
