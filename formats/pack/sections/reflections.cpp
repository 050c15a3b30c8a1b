// What reflections need beside their maps: walk grids, emitters, residual maps, lobes as cosines.
#include <cmath>
#include <limits>

#include "formats/pack/encoding/planes.h"
#include "formats/pack/fields.h"
#include "formats/pack/sections.h"

namespace oriel {

void encode(ByteWriter& out, const WalkGrid& grid) {
  put(out, grid.lower);
  out.put(grid.cell_m);
  out.put(grid.eye_height_m);
  out.put(grid.width);
  out.put(grid.height);
  std::vector<std::uint8_t> walkable(grid.floor_y.size());
  std::vector<float> floor(grid.floor_y.size());
  for (std::size_t i = 0; i < floor.size(); ++i) {
    walkable[i] = grid.walkable(i);
    floor[i] = walkable[i] ? grid.floor_y[i] : 0;
  }
  put_planes(out, std::span<const std::uint8_t>(walkable));
  put_planes(out, std::span<const float>(floor));
}

Status decode(ByteReader& in, WalkGrid& grid) {
  grid.lower = get_vec2(in);
  grid.cell_m = in.get<float>();
  grid.eye_height_m = in.get<float>();
  ORIEL_TRY_VOID(get_size(in, grid.width, grid.height));
  const std::uint64_t cells = std::uint64_t{grid.width} * grid.height;
  const auto walkable = get_planes<std::uint8_t>(in, cells);
  grid.floor_y = get_planes<float>(in, cells);
  for (std::size_t i = 0; i < grid.floor_y.size(); ++i) {
    if (walkable[i] > 1 || !std::isfinite(grid.floor_y[i]))
      return invalid("", "found floor {} with walkable flag {} in cell {}, expected a finite one with 0 or 1",
                     grid.floor_y[i], walkable[i], i);
    if (walkable[i] == 0) grid.floor_y[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return {};
}

void encode(ByteWriter& out, const Emitter& emitter) {
  out.put(static_cast<std::uint8_t>(emitter.corners.size()));
  out.put(static_cast<std::uint8_t>(emitter.two_sided));
  put(out, emitter.radiance);
  for (const Vec3& corner : emitter.corners) put(out, corner);
}

Status decode(ByteReader& in, Emitter& emitter) {
  const auto corners = in.get<std::uint8_t>();
  if (in.ok() && corners != 3 && corners != 4) return invalid("", "found {} corners, expected 3 or 4", corners);
  ORIEL_TRY_VOID(get_choice(in, "two-sided flag", 1, emitter.two_sided));
  emitter.radiance = get_vec3(in);
  for (int i = 0; i < corners; ++i) emitter.corners.push_back(get_vec3(in));
  return {};
}

void encode(ByteWriter& out, const ReflectorEmitters& part) {
  out.put(part.reflector);
  out.put(static_cast<std::uint32_t>(part.emitters.size()));
  out.put(part.width);
  out.put(part.height);
  for (const std::uint32_t emitter : part.emitters) out.put(emitter);
  put_planes(out, std::span<const std::uint8_t>(part.visibility));
}

Status decode(ByteReader& in, ReflectorEmitters& part) {
  part.reflector = in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  if (in.ok() && (count == 0 || count > kMaxReflectorEmitters))
    return invalid("", "found {} emitters, expected 1 to {}", count, kMaxReflectorEmitters);
  ORIEL_TRY_VOID(get_size(in, part.width, part.height));
  part.emitters = in.get_array<std::uint32_t>(count);
  part.visibility = get_planes<std::uint8_t>(in, std::uint64_t{part.width} * part.height * count);
  return {};
}

void encode(ByteWriter& out, const ResidualMap& residual) {
  out.put(residual.map);
}

Status decode(ByteReader& in, ResidualMap& residual) {
  residual.map = in.get<std::uint32_t>();
  return {};
}

void encode(ByteWriter& out, const KernelFits& fits) {
  out.put(fits.kernel);
  out.put(static_cast<std::uint32_t>(fits.fits.size()));
  for (const LobeFit& fit : fits.fits)
    for (const float v : {fit.m11, fit.m13, fit.m22, fit.m31, fit.amplitude}) out.put(v);
}

Status decode(ByteReader& in, KernelFits& fits) {
  fits.kernel = in.get<std::uint32_t>();
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    LobeFit fit;
    for (float* v : {&fit.m11, &fit.m13, &fit.m22, &fit.m31, &fit.amplitude}) *v = in.get<float>();
    fits.fits.push_back(fit);
  }
  return {};
}

}  // namespace oriel
