// Movers and the light field that they move through.
#include <algorithm>

#include "formats/core/half.h"
#include "formats/pack/encoding/planes.h"
#include "formats/pack/encoding/quantise.h"
#include "formats/pack/fields.h"
#include "formats/pack/sections.h"

namespace oriel {
namespace {

void put(ByteWriter& out, const MoverPose& pose) {
  put(out, pose.position);
  for (int i = 0; i < 4; ++i) out.put(pose.rotation[i]);
}

MoverPose get_pose(ByteReader& in) {
  MoverPose pose;
  pose.position = get_vec3(in);
  for (int i = 0; i < 4; ++i) pose.rotation[i] = in.get<float>();
  return pose;
}

void put(ByteWriter& out, const CompressedTransfer& t) {
  for (const int v : {t.bands, t.channels, t.clusters, t.components}) out.put(static_cast<std::uint16_t>(v));
  out.put(t.error);
  out.put_array(std::span<const float>(t.basis));
  out.put_array(std::span<const float>(t.weight_scale));
  put_planes(out, std::span<const std::uint8_t>(t.cluster));
  put_planes(out, std::span<const std::int16_t>(t.weight));
}

Status get_transfer(ByteReader& in, std::size_t vertices, CompressedTransfer& t) {
  for (int* v : {&t.bands, &t.channels, &t.clusters, &t.components}) *v = in.get<std::uint16_t>();
  if (!in.ok()) return {};  // what was read before the end may be any number
  if (t.bands < 2 || t.bands > 6 || (t.channels != 1 && t.channels != 3) || t.clusters < 1 || t.clusters > 256 ||
      t.components < 1 || t.components > 64)
    return invalid("",
                   "found a transfer of {} bands, {} channels, {} clusters and {} components, expected 2 to 6, 1 or 3, "
                   "1 to 256 and 1 to 64",
                   t.bands, t.channels, t.clusters, t.components);
  t.error = in.get<float>();
  const auto clusters = static_cast<std::size_t>(t.clusters), components = static_cast<std::size_t>(t.components);
  t.basis = in.get_array<float>(clusters * (components + 1) * t.stride());
  t.weight_scale = in.get_array<float>(clusters * components);
  t.cluster = get_planes<std::uint8_t>(in, vertices);
  t.weight = get_planes<std::int16_t>(in, vertices * components);
  return {};
}

void put(ByteWriter& out, const BrightLight& light) {
  out.put_string(light.name);
  out.put(static_cast<std::uint8_t>(light.kind));
  out.put(static_cast<std::uint8_t>(light.two_sided));
  for (const Vec3& v : {light.intensity, light.position, light.direction}) put(out, v);
  for (const float v : {light.inner_cone_rad, light.outer_cone_rad, light.angular_radius_rad}) out.put(v);
  out.put(static_cast<std::uint32_t>(light.corners.size()));
  for (const Vec3& corner : light.corners) put(out, corner);
}

Status get_light(ByteReader& in, BrightLight& light) {
  light.name = in.get_string();
  ORIEL_TRY_VOID(get_choice(in, "kind of light", 3, light.kind));
  ORIEL_TRY_VOID(get_choice(in, "two-sided flag", 1, light.two_sided));
  for (Vec3* v : {&light.intensity, &light.position, &light.direction}) *v = get_vec3(in);
  for (float* v : {&light.inner_cone_rad, &light.outer_cone_rad, &light.angular_radius_rad}) *v = in.get<float>();
  const auto corners = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < corners && in.ok(); ++i) light.corners.push_back(get_vec3(in));
  return {};
}

using CellCode = std::array<std::uint32_t, 9>;  // children, probes

void put_cells(ByteWriter& out, const std::vector<FieldCell>& cells) {
  std::vector<CellCode> codes(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    codes[i][0] = cells[i].children;
    std::copy(cells[i].probes.begin(), cells[i].probes.end(), codes[i].begin() + 1);
  }
  put_planes(out, std::span<const CellCode>(codes));
}

void get_cells(ByteReader& in, std::uint32_t count, std::vector<FieldCell>& cells) {
  const auto codes = get_planes<CellCode>(in, count);
  cells.resize(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    cells[i].children = codes[i][0];
    std::copy(codes[i].begin() + 1, codes[i].end(), cells[i].probes.begin());
  }
}

// Coefficient by coefficient over all probes: neighbours are alike.
void put_harmonics(ByteWriter& out, const std::vector<LightProbe>& probes, std::size_t count) {
  float largest = 0;
  for (const LightProbe& probe : probes)
    for (const float v : probe.sh) largest = std::max(largest, std::abs(v));
  const int exponent = scale_exponent(largest, 11);
  const float scale = std::ldexp(1.0f, -exponent);
  std::vector<std::uint16_t> halves;
  for (std::size_t i = 0; i < count; ++i)
    for (const LightProbe& probe : probes) halves.push_back(half_from_float(probe.sh[i] * scale));
  out.put(static_cast<std::int32_t>(exponent));
  put_planes(out, std::span<const std::uint16_t>(halves));
}

Status get_harmonics(ByteReader& in, std::size_t count, std::vector<LightProbe>& probes) {
  int exponent = 0;
  ORIEL_TRY_VOID(get_scale_exponent(in, exponent));
  const auto halves = get_planes<std::uint16_t>(in, probes.size() * count);
  const float scale = std::ldexp(1.0f, exponent);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    if ((halves[i] & 0x7c00u) == 0x7c00u)
      return invalid("", "found coefficient half {:#06x}, expected a finite one", halves[i]);
    probes[i % probes.size()].sh.push_back(float_from_half(halves[i]) * scale);
  }
  return {};
}

void put_depth(ByteWriter& out, const std::vector<LightProbe>& probes) {
  for (int moment = 0; moment < 2; ++moment) {
    std::vector<std::uint16_t> codes;
    for (const LightProbe& probe : probes)
      for (const Vec2& d : probe.depth) codes.push_back(static_cast<std::uint16_t>(std::lround(d[moment] * 65535)));
    put_planes(out, std::span<const std::uint16_t>(codes));
  }
}

void get_depth(ByteReader& in, std::size_t texels, std::vector<LightProbe>& probes) {
  for (int moment = 0; moment < 2; ++moment) {
    const auto codes = get_planes<std::uint16_t>(in, probes.size() * texels);
    for (std::size_t i = 0; i < codes.size(); ++i) {
      LightProbe& probe = probes[i / texels];
      if (moment == 0) probe.depth.push_back(Vec2(0));
      probe.depth[i % texels][moment] = static_cast<float>(codes[i]) / 65535;
    }
  }
}

void put_probes(ByteWriter& out, const LightField& field) {
  std::vector<Vec3> positions;
  std::vector<std::uint8_t> valid;
  std::vector<std::uint64_t> bright, kept;
  for (const LightProbe& probe : field.probes) {
    positions.push_back(probe.position);
    valid.push_back(probe.valid);
    bright.push_back(probe.bright);
    kept.push_back(probe.kept);
  }
  put_planes(out, std::span<const Vec3>(positions));
  put_planes(out, std::span<const std::uint8_t>(valid));
  put_planes(out, std::span<const std::uint64_t>(bright));
  put_planes(out, std::span<const std::uint64_t>(kept));
  put_harmonics(out, field.probes, static_cast<std::size_t>(3 * field.bands * field.bands));
  put_depth(out, field.probes);
}

Status get_probes(ByteReader& in, std::uint32_t count, LightField& field) {
  const auto positions = get_planes<Vec3>(in, count);
  const auto valid = get_planes<std::uint8_t>(in, count);
  const auto bright = get_planes<std::uint64_t>(in, count);
  const auto kept = get_planes<std::uint64_t>(in, count);
  if (!in.ok()) return {};
  field.probes.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (valid[i] > 1) return invalid("", "found validity {} of probe {}, expected 0 or 1", valid[i], i);
    LightProbe& probe = field.probes[i];
    probe.position = positions[i];
    probe.valid = valid[i] != 0;
    probe.bright = bright[i];
    probe.kept = kept[i];
  }
  ORIEL_TRY_VOID(get_harmonics(in, static_cast<std::size_t>(3 * field.bands * field.bands), field.probes));
  get_depth(in, std::size_t{field.depth_side} * field.depth_side, field.probes);
  return {};
}

}  // namespace

void encode(ByteWriter& out, const Mover& mover) {
  out.put_string(mover.name);
  put(out, mover.rest);
  out.put(static_cast<std::uint32_t>(mover.keys.size()));
  for (const MoverKey& key : mover.keys) {
    out.put(key.time_s);
    put(out, key.pose);
  }
  encode(out, mover.mesh);
  encode(out, NormalMapping{{}, mover.mesh.normal_uvs, mover.mesh.tangents});
  put(out, mover.transfer);
}

Status decode(ByteReader& in, Mover& mover) {
  mover.name = in.get_string();
  mover.rest = get_pose(in);
  const auto keys = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < keys && in.ok(); ++i) {
    const auto time_s = in.get<float>();
    mover.keys.push_back({time_s, get_pose(in)});
  }
  ORIEL_TRY_VOID(decode(in, mover.mesh));
  NormalMapping mapping;
  ORIEL_TRY_VOID(decode(in, mapping));
  if (!mapping.uses.empty())
    return invalid("", "found {} materials with normal textures, expected none here", mapping.uses.size());
  mover.mesh.normal_uvs = std::move(mapping.uvs);
  mover.mesh.tangents = std::move(mapping.tangents);
  return get_transfer(in, mover.mesh.positions.size(), mover.transfer);
}

void encode(ByteWriter& out, const LightField& field) {
  out.put(static_cast<std::uint32_t>(field.bands));
  out.put(field.depth_side);
  out.put(field.depth_cap_m);
  out.put(field.error);
  put(out, field.lower);
  put(out, field.cell_m);
  for (const std::uint32_t n : field.size) out.put(n);
  for (const std::size_t n : {field.cells.size(), field.probes.size(), field.lights.size()})
    out.put(static_cast<std::uint32_t>(n));
  put_cells(out, field.cells);
  put_probes(out, field);
  for (const BrightLight& light : field.lights) put(out, light);
}

Status decode(ByteReader& in, LightField& field) {
  field.bands = static_cast<int>(std::min(in.get<std::uint32_t>(), 99u));
  field.depth_side = in.get<std::uint32_t>();
  if (in.ok() && (field.bands < 2 || field.bands > 6 || field.depth_side < 2 || field.depth_side > kMaxDepthSide))
    return invalid("", "found {} bands and depth maps of {} texels a side, expected 2 to 6 and 2 to {}", field.bands,
                   field.depth_side, kMaxDepthSide);
  field.depth_cap_m = in.get<float>();
  field.error = in.get<float>();
  field.lower = get_vec3(in);
  field.cell_m = get_vec3(in);
  for (std::uint32_t& n : field.size) n = in.get<std::uint32_t>();
  const auto cells = in.get<std::uint32_t>(), probes = in.get<std::uint32_t>(), lights = in.get<std::uint32_t>();
  get_cells(in, cells, field.cells);
  ORIEL_TRY_VOID(get_probes(in, probes, field));
  for (std::uint32_t i = 0; i < lights && in.ok(); ++i) {
    BrightLight light;
    ORIEL_TRY_VOID(get_light(in, light));
    field.lights.push_back(std::move(light));
  }
  return {};
}

}  // namespace oriel
