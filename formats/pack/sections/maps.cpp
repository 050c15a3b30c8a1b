// Textures, lightmaps with their directions, radiance maps, surround maps.
#include <algorithm>
#include <bit>

#include "formats/core/half.h"
#include "formats/pack/encoding/planes.h"
#include "formats/pack/encoding/quantise.h"
#include "formats/pack/fields.h"
#include "formats/pack/sections.h"

namespace oriel {
namespace {

using Rgba8 = std::array<std::uint8_t, 4>;
using Half3 = std::array<std::uint16_t, 3>;

float largest_channel(std::span<const Vec3> values) {
  float largest = 0;
  for (const Vec3& v : values) largest = std::max(largest, max_component(v));
  return largest;
}

void put_halves(ByteWriter& out, std::span<const Vec3> values, int exponent) {
  const float scale = std::ldexp(1.0f, -exponent);
  std::vector<Half3> halves(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) halves[i][static_cast<std::size_t>(c)] = half_from_float(values[i][c] * scale);
  put_planes(out, std::span<const Half3>(halves));
}

// A power of two that halves of these values, and of others beside them, have.
int put_half_exponent(ByteWriter& out, std::span<const Vec3> values, std::span<const Vec3> others = {}) {
  const int exponent = scale_exponent(std::max(largest_channel(values), largest_channel(others)), 11);
  out.put(static_cast<std::int32_t>(exponent));
  return exponent;
}

// Channel c of element i of a block of Half3.
std::uint16_t half_at(const PlaneBlock<6>& block, std::size_t c, std::size_t i) {
  return static_cast<std::uint16_t>(block.plane[2 * c][i] | block.plane[2 * c + 1][i] << 8);
}

Status get_halves(ByteReader& in, std::uint64_t count, int exponent, const char* what, std::vector<Vec3>& values) {
  const float scale = std::ldexp(1.0f, exponent);
  Status status;
  for_each_plane_block<6>(in, count, [&](const PlaneBlock<6>& block) {
    if (values.empty()) values.reserve(count);
    std::array<Vec3, kPlaneBlock> made;
    for (std::size_t c = 0; c < 3; ++c) {
      std::array<float, kPlaneBlock> channel;
      unsigned signs = 0;  // bit 15: of a half from 0x7c00 up
      for (std::size_t i = 0; i < block.size; ++i) {
        const std::uint16_t half = half_at(block, c, i);
        signs |= half | (half + 0x400u);
        channel[i] = float_from_positive_half(half) * scale;
      }
      for (std::size_t i = 0; i < block.size; ++i) made[i][static_cast<int>(c)] = channel[i];
      if ((signs & 0x8000) == 0 || !status) continue;
      std::size_t bad = 0;
      while (half_at(block, c, bad) < 0x7c00) ++bad;
      status = invalid("", "found {} half {:#06x} at texel {}, expected a finite one that is not negative", what,
                       half_at(block, c, bad), values.size() + bad);
    }
    values.insert(values.end(), made.begin(), made.begin() + static_cast<std::ptrdiff_t>(block.size));
  });
  return status;
}

// cd/m² over 2^exponent.
void put_rgb9e5(ByteWriter& out, std::span<const Vec3> values, int exponent) {
  const float scale = std::ldexp(1.0f, -exponent);
  std::vector<std::uint32_t> colors(values.size());
  for (std::size_t i = 0; i < colors.size(); ++i) colors[i] = rgb9e5_from_rgb(values[i] * scale);
  put_planes(out, std::span<const std::uint32_t>(colors));
}

std::vector<Vec3> get_rgb9e5(ByteReader& in, std::uint64_t count, int exponent) {
  const float scale = std::ldexp(1.0f, exponent);
  const auto colors = get_planes<std::uint32_t>(in, count);
  std::vector<Vec3> values(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) values[i] = rgb_from_rgb9e5(colors[i]) * scale;
  return values;
}

Status get_texel_states(ByteReader& in, std::uint64_t count, std::vector<TexelState>& states) {
  const auto codes = get_planes<std::uint8_t>(in, count);
  states.resize(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (codes[i] % 85 != 0) return invalid("", "found texel state {}, expected 0, 85, 170 or 255", codes[i]);
    states[i] = static_cast<TexelState>(codes[i]);
  }
  return {};
}

}  // namespace

void encode(ByteWriter& out, const Texture& texture) {
  out.put_string(texture.name);
  out.put(texture.width);
  out.put(texture.height);
  out.put(static_cast<std::uint8_t>(texture.wrap_s));
  out.put(static_cast<std::uint8_t>(texture.wrap_t));
  out.put(static_cast<std::uint8_t>(texture.nearest));
  out.put(std::uint8_t{0});
  put_planes(out, std::span(reinterpret_cast<const Rgba8*>(texture.texels.data()), texture.texels.size() / 4));
}

Status decode_place(ByteReader& in, Texture& texture) {
  texture.name = in.get_string();
  ORIEL_TRY_VOID(get_size(in, texture.width, texture.height));
  ORIEL_TRY_VOID(get_choice(in, "wrap mode", 2, texture.wrap_s));
  ORIEL_TRY_VOID(get_choice(in, "wrap mode", 2, texture.wrap_t));
  ORIEL_TRY_VOID(get_choice(in, "nearest flag", 1, texture.nearest));
  std::uint8_t reserved = 0;
  return get_choice(in, "reserved byte", 0, reserved);
}

Status decode(ByteReader& in, Texture& texture) {
  ORIEL_TRY_VOID(decode_place(in, texture));
  const auto texels = get_planes<Rgba8>(in, std::uint64_t{texture.width} * texture.height);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(texels.data());
  texture.texels.assign(bytes, bytes + texels.size() * sizeof(Rgba8));
  return {};
}

void encode(ByteWriter& out, const LightmapPage& page) {
  out.put(page.width);
  out.put(page.height);
  out.put(page.detail_width);
  out.put(page.detail_height);
  const int exponent = put_half_exponent(out, page.irradiance, page.detail);
  put_halves(out, page.irradiance, exponent);
  put_planes(out, std::span<const std::uint32_t>(page.cell));
  put_halves(out, page.detail, exponent);
  const int of_errors = put_half_exponent(out, page.standard_error);
  put_halves(out, page.standard_error, of_errors);
  put_planes(out, std::span(reinterpret_cast<const std::uint8_t*>(page.state.data()), page.state.size()));
}

Status decode_place(ByteReader& in, LightmapPage& page) {
  ORIEL_TRY_VOID(get_size(in, page.width, page.height));
  page.detail_width = in.get<std::uint32_t>(), page.detail_height = in.get<std::uint32_t>();
  const auto usable = [](std::uint32_t side) { return side <= kMaxDetailSide; };
  if (in.ok() && (!usable(page.detail_width) || !usable(page.detail_height) ||
                  (page.detail_width == 0) != (page.detail_height == 0)))
    return invalid("", "found details of {} x {} points, expected 1 to {} a side, or none", page.detail_width,
                   page.detail_height, kMaxDetailSide);
  return {};
}

Status decode(ByteReader& in, LightmapPage& page) {
  ORIEL_TRY_VOID(decode_place(in, page));
  const std::uint64_t texels = std::uint64_t{page.width} * page.height;
  int exponent = 0;
  ORIEL_TRY_VOID(get_scale_exponent(in, exponent));
  ORIEL_TRY_VOID(get_halves(in, texels, exponent, "irradiance", page.irradiance));
  if (page.detail_width > 0) page.cell = get_planes<std::uint32_t>(in, texels);
  ORIEL_TRY_VOID(
      get_halves(in, std::uint64_t{page.detail_width} * page.detail_height, exponent, "detail", page.detail));
  ORIEL_TRY_VOID(get_scale_exponent(in, exponent));
  ORIEL_TRY_VOID(get_halves(in, texels, exponent, "standard error", page.standard_error));
  return get_texel_states(in, texels, page.state);
}

void encode(ByteWriter& out, const DirectionPage& page) {
  out.put(page.page);
  out.put(page.width);
  out.put(page.height);
  std::vector<Half3> halves(page.direction.size());
  for (std::size_t i = 0; i < halves.size(); ++i)
    for (int c = 0; c < 3; ++c) halves[i][static_cast<std::size_t>(c)] = half_from_float(page.direction[i][c]);
  put_planes(out, std::span<const Half3>(halves));
}

static Status get_half_texels(ByteReader& in, std::uint64_t count, const char* what, std::vector<Half4>& light) {
  constexpr std::uint16_t kOne = 0x3c00;
  unsigned signs = 0;  // as get_halves
  for_each_plane_block<6>(in, count, [&](const PlaneBlock<6>& block) {
    if (light.empty()) light.reserve(count);
    std::array<Half4, kPlaneBlock> made;
    for (std::size_t i = 0; i < block.size; ++i) made[i][3] = kOne;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < block.size; ++i) {
        const std::uint16_t half = half_at(block, c, i);
        signs |= half | (half + 0x400u);
        made[i][c] = half;
      }
    light.insert(light.end(), made.begin(), made.begin() + static_cast<std::ptrdiff_t>(block.size));
  });
  if ((signs & 0x8000) == 0) return {};
  const auto bad = std::find_if(light.begin(), light.end(),
                                [](const Half4& h) { return h[0] >= 0x7c00 || h[1] >= 0x7c00 || h[2] >= 0x7c00; });
  return invalid("", "found {} halves {:#06x} {:#06x} {:#06x} at texel {}, expected finite ones that are not negative",
                 what, (*bad)[0], (*bad)[1], (*bad)[2], bad - light.begin());
}

Status decode(ByteReader& in, HalfPage& page) {
  LightmapPage place;
  ORIEL_TRY_VOID(decode_place(in, place));
  page.width = place.width, page.height = place.height;
  page.detail_width = place.detail_width, page.detail_height = place.detail_height;
  int exponent = 0;
  ORIEL_TRY_VOID(get_scale_exponent(in, exponent));
  page.scale = std::ldexp(1.0f, exponent);
  const std::uint64_t texels = std::uint64_t{page.width} * page.height;
  ORIEL_TRY_VOID(get_half_texels(in, texels, "irradiance", page.light));
  if (page.detail_width > 0) page.cell = get_planes<std::uint32_t>(in, texels);
  return get_half_texels(in, std::uint64_t{page.detail_width} * page.detail_height, "detail", page.detail);
}

Status decode_place(ByteReader& in, DirectionPage& page) {
  page.page = in.get<std::uint32_t>();
  return get_size(in, page.width, page.height);
}

Status decode(ByteReader& in, DirectionPage& page) {
  ORIEL_TRY_VOID(decode_place(in, page));
  const auto halves = get_planes<Half3>(in, std::uint64_t{page.width} * page.height);
  page.direction.resize(halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const std::uint16_t half = halves[i][static_cast<std::size_t>(c)];
      if ((half & 0x7c00) == 0x7c00)
        return invalid("", "found direction half {:#06x} at texel {}, expected a finite one", half, i);
      page.direction[i][c] = float_from_half(half);
    }
  return {};
}

void encode(ByteWriter& out, const RadianceMap& map) {
  out.put(map.reflector);
  out.put(map.width);
  out.put(map.height);
  out.put(static_cast<std::uint8_t>(map.has_emission));
  for (int i = 0; i < 3; ++i) out.put(std::uint8_t{0});
  put(out, map.eye);
  put(out, map.lower);
  put(out, map.upper);
  const int exponent = scale_exponent(largest_channel(map.radiance), 9);
  float largest_disparity = 0;
  for (const float d : map.disparity) largest_disparity = std::max(largest_disparity, d);
  const int shift = disparity_shift(largest_disparity);
  out.put(static_cast<std::int32_t>(exponent));
  out.put(static_cast<std::int32_t>(shift));
  put_rgb9e5(out, map.radiance, exponent);
  std::vector<std::uint16_t> disparities(map.disparity.size());
  for (std::size_t i = 0; i < disparities.size(); ++i) disparities[i] = code_from_disparity(map.disparity[i], shift);
  put_planes(out, std::span<const std::uint16_t>(disparities));
  put_planes(out, std::span<const std::uint8_t>(map.valid));
}

Status decode_place(ByteReader& in, RadianceMap& map, RadianceMapScale& scale) {
  map.reflector = in.get<std::uint32_t>();
  ORIEL_TRY_VOID(get_size(in, map.width, map.height));
  ORIEL_TRY_VOID(get_choice(in, "emission flag", 1, map.has_emission));
  std::uint8_t reserved = 0;
  for (int i = 0; i < 3; ++i) ORIEL_TRY_VOID(get_choice(in, "reserved byte", 0, reserved));
  map.eye = get_vec3(in);
  map.lower = get_vec2(in);
  map.upper = get_vec2(in);
  ORIEL_TRY_VOID(get_scale_exponent(in, scale.exponent));
  scale.shift = in.get<std::int32_t>();
  if (scale.shift < 0 || scale.shift > kMaxDisparityShift)
    return invalid("", "found disparity shift {}, expected 0 to {}", scale.shift, kMaxDisparityShift);
  return {};
}

Status decode(ByteReader& in, RadianceMap& map) {
  RadianceMapScale scale;
  ORIEL_TRY_VOID(decode_place(in, map, scale));
  const std::uint64_t pixels = std::uint64_t{map.width} * map.height;
  map.radiance = get_rgb9e5(in, pixels, scale.exponent);
  const auto disparities = get_planes<std::uint16_t>(in, pixels);
  map.disparity.resize(disparities.size());
  for (std::size_t i = 0; i < disparities.size(); ++i)
    map.disparity[i] = disparity_from_code(disparities[i], scale.shift);
  map.valid = get_planes<std::uint8_t>(in, pixels);
  return {};
}

void encode(ByteWriter& out, const CurvedReflector& reflector) {
  out.put_string(reflector.name);
  out.put(reflector.material);
  out.put(reflector.map);
  out.put(static_cast<std::uint32_t>(reflector.indices.size()));
  out.put_array(std::span<const std::uint32_t>(reflector.indices));
}

Status decode(ByteReader& in, CurvedReflector& reflector) {
  reflector.name = in.get_string();
  reflector.material = in.get<std::uint32_t>();
  reflector.map = in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  reflector.indices = in.get_array<std::uint32_t>(count);
  return {};
}

void encode(ByteWriter& out, const SurroundMap& map) {
  put(out, map.centre);
  out.put(map.size);
  const int exponent = scale_exponent(largest_channel(map.radiance), 9);
  out.put(static_cast<std::int32_t>(exponent));
  const float nearest = *std::max_element(map.inverse_distance.begin(), map.inverse_distance.end());
  out.put(nearest);
  put_rgb9e5(out, map.radiance, exponent);
  std::vector<std::uint16_t> codes(map.inverse_distance.size());
  for (std::size_t i = 0; i < codes.size() && nearest > 0; ++i)
    codes[i] = code_from_disparity(map.inverse_distance[i] / nearest, 0);
  put_planes(out, std::span<const std::uint16_t>(codes));
  put_planes(out, std::span<const std::uint8_t>(map.valid));
}

Status decode_place(ByteReader& in, SurroundMap& map, SurroundMapScale& scale) {
  map.centre = get_vec3(in);
  map.size = in.get<std::uint32_t>();
  if (in.ok() && (map.size > kMaxSide || !std::has_single_bit(map.size)))
    return invalid("", "found {} texels a side, expected a power of two up to {}", map.size, kMaxSide);
  ORIEL_TRY_VOID(get_scale_exponent(in, scale.exponent));
  scale.nearest = in.get<float>();
  return {};
}

Status decode(ByteReader& in, SurroundMap& map) {
  SurroundMapScale scale;
  ORIEL_TRY_VOID(decode_place(in, map, scale));
  const std::uint64_t texels = std::uint64_t{map.size} * map.size;
  map.radiance = get_rgb9e5(in, texels, scale.exponent);
  const auto codes = get_planes<std::uint16_t>(in, texels);
  map.inverse_distance.resize(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    map.inverse_distance[i] = disparity_from_code(codes[i], 0) * scale.nearest;
  map.valid = get_planes<std::uint8_t>(in, texels);
  return {};
}

}  // namespace oriel
