// Textures, lightmaps, radiance maps, surround maps.
#include <algorithm>
#include <bit>
#include <cmath>

#include "formats/core/half.h"
#include "formats/pack/half_page.h"
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

void put_halves(ByteWriter& out, std::span<const Vec3> values, float scale) {
  std::vector<Half3> halves(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int c = 0; c < 3; ++c) halves[i][static_cast<std::size_t>(c)] = half_from_float(values[i][c] * scale);
  put_planes(out, std::span<const Half3>(halves));
}

// Channel c of element i of a block of Half3.
std::uint16_t half_at(const PlaneBlock<6>& block, std::size_t c, std::size_t i) {
  return static_cast<std::uint16_t>(block.plane[2 * c][i] | block.plane[2 * c + 1][i] << 8);
}

Status get_halves(ByteReader& in, std::uint64_t count, float scale, const char* what, std::vector<Vec3>& values) {
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

// Of light, and of other light that has the same exponent.
int describe_half_exponent(Serial& s, std::span<const Vec3> values, std::span<const Vec3> others = {}) {
  int exponent = 0;
  if (!s.reading()) exponent = scale_exponent(std::max(largest_channel(values), largest_channel(others)), 11);
  s.scale_exponent(exponent);
  return exponent;
}

// Light, not negative, over 2^exponent.
void describe_halves(Serial& s, std::vector<Vec3>& values, std::uint64_t n, int exponent, const char* what) {
  if (!s.reading())
    put_halves(s.out(), values, std::ldexp(1.0f, -exponent));
  else if (s.ok())
    s.refuse(get_halves(s.in(), n, std::ldexp(1.0f, exponent), what, values));
}

void describe_directions(Serial& s, std::vector<Vec3>& values, std::uint64_t n) {
  if (!s.reading()) return put_halves(s.out(), values, 1);
  std::vector<Half3> halves;
  s.planes(halves, n);
  values.resize(halves.size());
  for (std::size_t i = 0; i < halves.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const std::uint16_t half = halves[i][static_cast<std::size_t>(c)];
      if ((half & 0x7c00) == 0x7c00)
        s.refuse("found direction half {:#06x} at texel {}, expected a finite one", half, i);
      values[i][c] = float_from_half(half);
    }
}

// cd/m² over 2^exponent.
void describe_rgb9e5(Serial& s, std::vector<Vec3>& values, std::uint64_t n, int exponent) {
  const float up = std::ldexp(1.0f, exponent), down = std::ldexp(1.0f, -exponent);
  s.coded<std::uint32_t>(
      values, n, [&](const Vec3& v) { return rgb9e5_from_rgb(v * down); },
      [&](std::uint32_t code, std::size_t) { return rgb_from_rgb9e5(code) * up; });
}

float largest_of(const std::vector<float>& values) {
  float largest = 0;
  for (const float v : values) largest = std::max(largest, v);
  return largest;
}

}  // namespace

void describe_place(Serial& s, Texture& texture) {
  s(texture.name);
  s.size(texture.width, texture.height);
  s.choice("wrap mode", 2, texture.wrap_s);
  s.choice("wrap mode", 2, texture.wrap_t);
  s.choice("nearest flag", 1, texture.nearest);
  s.reserved(1);
}

void describe(Serial& s, Texture& texture) {
  describe_place(s, texture);
  std::vector<Rgba8> texels(texture.texels.size() / 4);
  if (!texels.empty()) std::memcpy(texels.data(), texture.texels.data(), texture.texels.size());
  s.planes(texels, std::uint64_t{texture.width} * texture.height);
  if (!s.reading()) return;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(texels.data());
  texture.texels.assign(bytes, bytes + texels.size() * sizeof(Rgba8));
}

void describe_place(Serial& s, LightmapPage& page, LightmapFlags& flags) {
  s.size(page.width, page.height);
  std::uint32_t bits = (flags.directional ? 1u : 0u) | (flags.sharp ? 2u : 0u);
  s(bits);
  if (bits > 3) s.refuse("found lightmap flags {:#x}, expected 0 to 3", bits);
  flags = {(bits & 1) != 0, (bits & 2) != 0};
  s(page.detail_width, page.detail_height);
  const auto usable = [](std::uint32_t side) { return side <= kMaxDetailSide; };
  if (!usable(page.detail_width) || !usable(page.detail_height) ||
      (page.detail_width == 0) != (page.detail_height == 0))
    s.refuse("found details of {} x {} points, expected 1 to {} a side, or none", page.detail_width, page.detail_height,
             kMaxDetailSide);
}

namespace {

// The light that is stored beside sharp light. The rounding of both as one sum has no bits that another round would
// take: what was read is written as it was.
std::vector<Vec3> light_beside_sharp(const LightmapPage& page) {
  const int exponent = scale_exponent(largest_channel(page.sharp), 11);
  const float up = std::ldexp(1.0f, exponent), down = std::ldexp(1.0f, -exponent);
  std::vector<Vec3> rest = without_sharp(page);
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float sharp = float_from_half(half_from_float(page.sharp[i][c] * down)) * up;
      rest[i][c] = (rest[i][c] + sharp) - sharp;
    }
  return rest;
}

// And what of its light texels have.
void describe_sharp(Serial& s, LightmapPage& page, std::uint64_t texels) {
  s.planes(page.sharp_at, texels);
  const int exponent = describe_half_exponent(s, page.sharp);
  describe_halves(s, page.sharp, texels, exponent, "sharp light");
  if (!s.reading() || !s.ok()) return;
  for (std::size_t i = 0; i < texels; ++i) page.irradiance[i] += page.sharp[i];
}

}  // namespace

void describe(Serial& s, LightmapPage& page) {
  LightmapFlags flags{!page.direction.empty(), !page.sharp_at.empty()};
  std::vector<Vec3> beside_sharp;
  const bool divide = !s.reading() && flags.sharp;
  if (divide) beside_sharp = light_beside_sharp(page);
  std::vector<Vec3>& light = divide ? beside_sharp : page.irradiance;
  describe_place(s, page, flags);
  const std::uint64_t texels = std::uint64_t{page.width} * page.height;
  const std::uint64_t details = std::uint64_t{page.detail_width} * page.detail_height;
  const int exponent = describe_half_exponent(s, light, page.detail);
  describe_halves(s, light, texels, exponent, "irradiance");
  if (flags.directional) describe_directions(s, page.direction, texels);
  if (details > 0) s.planes(page.cell, texels);
  describe_halves(s, page.detail, details, exponent, "detail");
  if (flags.sharp) describe_sharp(s, page, texels);
  const int of_errors = describe_half_exponent(s, page.standard_error);
  describe_halves(s, page.standard_error, texels, of_errors, "standard error");
  s.coded<std::uint8_t>(
      page.state, texels, [](TexelState state) { return static_cast<std::uint8_t>(state); },
      [&](std::uint8_t code, std::size_t) {
        if (code % 85 != 0) s.refuse("found texel state {}, expected 0, 85, 170 or 255", code);
        return static_cast<TexelState>(code);
      });
}

namespace {

// Halves of light as they lie in the file.
Status get_half_texels(ByteReader& in, std::uint64_t count, const char* what, std::vector<Half4>& light) {
  unsigned signs = 0;  // as get_halves
  for_each_plane_block<6>(in, count, [&](const PlaneBlock<6>& block) {
    if (light.empty()) light.reserve(count);
    std::array<Half4, kPlaneBlock> made;
    for (std::size_t i = 0; i < block.size; ++i) made[i][3] = kHalfOne;
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

}  // namespace

Status decode(ByteReader& in, HalfPage& page) {
  Serial s(in);
  LightmapPage place;
  LightmapFlags flags;
  describe_place(s, place, flags);
  int exponent = 0;
  s.scale_exponent(exponent);
  if (!s.ok()) return s.status();
  page.width = place.width, page.height = place.height;
  page.detail_width = place.detail_width, page.detail_height = place.detail_height;
  page.scale = std::ldexp(1.0f, exponent);
  const std::uint64_t texels = std::uint64_t{page.width} * page.height;
  ORIEL_TRY_VOID(get_half_texels(in, texels, "irradiance", page.light));
  std::vector<Vec3> directions;
  if (flags.directional) describe_directions(s, directions, texels);
  page.direction = halves_of(directions);
  if (page.detail_width > 0) s.planes(page.cell, texels);
  if (!s.ok()) return s.status();
  ORIEL_TRY_VOID(get_half_texels(in, std::uint64_t{page.detail_width} * page.detail_height, "detail", page.detail));
  if (flags.sharp) s.planes(page.sharp_at, texels);
  return s.status();
}

void describe_place(Serial& s, RadianceMap& map, RadianceMapScale& scale) {
  s(map.reflector, map.element);
  s.size(map.width, map.height);
  s.choice("emission flag", 1, map.has_emission);
  std::uint8_t unread = 0;  // 1: one of the residual maps that packs had once
  s.choice("unread flag", 1, unread);
  s.reserved(2);
  s(map.eye, map.lower, map.upper);
  s.scale_exponent(scale.exponent);
  s(scale.shift);
  if (scale.shift < 0 || scale.shift > kMaxDisparityShift)
    s.refuse("found disparity shift {}, expected 0 to {}", scale.shift, kMaxDisparityShift);
}

void describe(Serial& s, RadianceMap& map) {
  RadianceMapScale scale;
  if (!s.reading())
    scale = {scale_exponent(largest_channel(map.radiance), 9), disparity_shift(largest_of(map.disparity))};
  describe_place(s, map, scale);
  const std::uint64_t pixels = std::uint64_t{map.width} * map.height;
  describe_rgb9e5(s, map.radiance, pixels, scale.exponent);
  s.coded<std::uint16_t>(
      map.disparity, pixels, [&](float d) { return code_from_disparity(d, scale.shift); },
      [&](std::uint16_t code, std::size_t) { return disparity_from_code(code, scale.shift); });
  s.planes(map.valid, pixels);
}

namespace {

std::uint16_t code_of_share(float share) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(share, 0.0f, 1.0f)));
}

// An index as how far it lies below the next vertex that none has used.
void describe_indices(Serial& s, std::vector<std::uint32_t>& indices, std::uint32_t n, std::size_t vertices) {
  std::uint32_t unused = 0;
  s.coded<std::uint32_t>(
      indices, n,
      [&](std::uint32_t index) {
        const std::uint32_t code = unused - index;
        unused += code == 0;
        return code;
      },
      [&](std::uint32_t code, std::size_t i) {
        const std::uint32_t index = unused - code;
        unused += code == 0;
        if (index >= vertices) s.refuse("found index {} at {}, expected less than {} vertices", index, i, vertices);
        return index;
      });
}

}  // namespace

void describe(Serial& s, MapMesh& mesh) {
  float nearest = 0;
  for (const Vec3& v : mesh.vertices) nearest = std::max(nearest, v.z);
  std::int32_t shift = s.reading() ? 0 : disparity_shift(nearest);
  s(shift);
  if (shift < 0 || shift > kMaxDisparityShift)
    s.refuse("found disparity shift {}, expected 0 to {}", shift, kMaxDisparityShift);
  using Codes = std::array<std::uint16_t, 3>;
  const std::uint32_t vertices = s.count(mesh.vertices), indices = s.count(mesh.indices);
  s.coded<Codes>(
      mesh.vertices, vertices,
      [&](const Vec3& v) {
        return Codes{code_of_share(v.x), code_of_share(v.y), code_from_disparity(v.z, shift)};
      },
      [&](const Codes& c, std::size_t) {
        return Vec3(c[0] / 65535.0f, c[1] / 65535.0f, disparity_from_code(c[2], shift));
      });
  describe_indices(s, mesh.indices, indices, mesh.vertices.size());
}

void describe(Serial& s, SkyMap& sky) {
  std::int32_t exponent = s.reading() ? 0 : scale_exponent(largest_channel(sky.texels), 9);
  s.size(sky.width, sky.height);
  if (sky.width > SkyMap::kMostWidth || sky.height > SkyMap::kMostHeight)
    s.refuse("found {} x {} texels, expected at most {} x {}", sky.width, sky.height, SkyMap::kMostWidth,
             SkyMap::kMostHeight);
  s.scale_exponent(exponent);
  describe_rgb9e5(s, sky.texels, std::uint64_t{sky.width} * sky.height, exponent);
}

void describe_place(Serial& s, SurroundMap& map, SurroundMapScale& scale) {
  s(map.centre, map.size);
  if (map.size > kMaxSide || !std::has_single_bit(map.size))
    s.refuse("found {} texels a side, expected a power of two up to {}", map.size, kMaxSide);
  s.scale_exponent(scale.exponent);
  s(scale.nearest);
}

void describe(Serial& s, SurroundMap& map) {
  SurroundMapScale scale;
  if (!s.reading()) scale = {scale_exponent(largest_channel(map.radiance), 9), largest_of(map.inverse_distance)};
  describe_place(s, map, scale);
  const std::uint64_t texels = std::uint64_t{map.size} * map.size;
  describe_rgb9e5(s, map.radiance, texels, scale.exponent);
  s.coded<std::uint16_t>(
      map.inverse_distance, texels,
      [&](float d) { return scale.nearest > 0 ? code_from_disparity(d / scale.nearest, 0) : std::uint16_t{0}; },
      [&](std::uint16_t code, std::size_t) { return disparity_from_code(code, 0) * scale.nearest; });
  s.planes(map.valid, texels);
}

}  // namespace oriel
