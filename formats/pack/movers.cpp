// Movers and the light field that they move through.
#include <algorithm>

#include "formats/core/half.h"
#include "formats/pack/sections.h"

namespace oriel {
namespace {

void describe(Serial& s, MoverPose& pose) {
  s(pose.position, pose.rotation);
}

void describe(Serial& s, std::size_t vertices, CompressedTransfer& t) {
  for (int* v : {&t.bands, &t.channels, &t.clusters, &t.components}) s.as<std::uint16_t>(*v);
  if (t.bands < 2 || t.bands > 6 || (t.channels != 1 && t.channels != 3) || t.clusters < 1 || t.clusters > 256 ||
      t.components < 1 || t.components > 64)
    s.refuse(
        "found a transfer of {} bands, {} channels, {} clusters and {} components, expected 2 to 6, 1 or 3, 1 to 256 "
        "and 1 to 64",
        t.bands, t.channels, t.clusters, t.components);
  if (!s.ok()) return;
  s(t.error);
  const auto clusters = static_cast<std::size_t>(t.clusters), components = static_cast<std::size_t>(t.components);
  s.array(t.basis, clusters * (components + 1) * t.stride());
  s.array(t.weight_scale, clusters * components);
  s.planes(t.cluster, vertices);
  s.planes(t.weight, vertices * components);
}

void describe(Serial& s, BrightLight& light) {
  s(light.name);
  s.choice("kind of light", 3, light.kind);
  s.choice("two-sided flag", 1, light.two_sided);
  s(light.intensity, light.position, light.direction, light.inner_cone_rad, light.outer_cone_rad,
    light.angular_radius_rad);
  s.list(light.corners, s.count(light.corners), [&](Vec3& corner) { s(corner); });
}

using CellCode = std::array<std::uint32_t, 9>;  // children, probes

void describe(Serial& s, std::vector<FieldCell>& cells, std::uint32_t count) {
  s.coded<CellCode>(
      cells, count,
      [](const FieldCell& cell) {
        CellCode code{cell.children};
        std::copy(cell.probes.begin(), cell.probes.end(), code.begin() + 1);
        return code;
      },
      [](const CellCode& code, std::size_t) {
        FieldCell cell;
        cell.children = code[0];
        std::copy(code.begin() + 1, code.end(), cell.probes.begin());
        return cell;
      });
}

// Coefficient by coefficient over all probes: neighbours are alike.
void describe_harmonics(Serial& s, std::vector<LightProbe>& probes, std::size_t count) {
  float largest = 0;
  for (const LightProbe& probe : probes)
    for (const float v : probe.sh) largest = std::max(largest, std::abs(v));
  int exponent = s.reading() ? 0 : scale_exponent(largest, 11);
  s.scale_exponent(exponent);
  std::vector<float> values;
  for (std::size_t i = 0; i < count && !s.reading(); ++i)
    for (const LightProbe& probe : probes) values.push_back(probe.sh[i]);
  const float up = std::ldexp(1.0f, exponent), down = std::ldexp(1.0f, -exponent);
  s.coded<std::uint16_t>(
      values, probes.size() * count, [&](float v) { return half_from_float(v * down); },
      [&](std::uint16_t half, std::size_t) {
        if ((half & 0x7c00u) == 0x7c00u) s.refuse("found coefficient half {:#06x}, expected a finite one", half);
        return float_from_half(half) * up;
      });
  for (std::size_t i = 0; s.reading() && i < values.size(); ++i) probes[i % probes.size()].sh.push_back(values[i]);
}

void describe_depth(Serial& s, std::vector<LightProbe>& probes, std::size_t texels) {
  for (int moment = 0; moment < 2; ++moment) {
    std::vector<float> values;
    for (const LightProbe& probe : probes)
      for (const Vec2& d : probe.depth) values.push_back(d[moment]);
    s.coded<std::uint16_t>(
        values, probes.size() * texels, [](float v) { return static_cast<std::uint16_t>(std::lround(v * 65535)); },
        [](std::uint16_t code, std::size_t) { return static_cast<float>(code) / 65535; });
    for (std::size_t i = 0; s.reading() && s.ok() && i < values.size(); ++i) {
      LightProbe& probe = probes[i / texels];
      if (moment == 0) probe.depth.push_back(Vec2(0));
      probe.depth[i % texels][moment] = values[i];
    }
  }
}

void describe_probes(Serial& s, LightField& field, std::uint32_t count) {
  std::vector<Vec3> positions;
  std::vector<std::uint8_t> valid;
  std::vector<std::uint64_t> bright, kept;
  for (const LightProbe& probe : field.probes) {
    positions.push_back(probe.position);
    valid.push_back(probe.valid);
    bright.push_back(probe.bright);
    kept.push_back(probe.kept);
  }
  s.planes(positions, count);
  s.planes(valid, count);
  s.planes(bright, count);
  s.planes(kept, count);
  if (!s.ok()) return;
  if (s.reading()) field.probes.resize(count);
  for (std::size_t i = 0; i < count && s.reading(); ++i) {
    if (valid[i] > 1) s.refuse("found validity {} of probe {}, expected 0 or 1", valid[i], i);
    LightProbe& probe = field.probes[i];
    probe.position = positions[i], probe.valid = valid[i] != 0, probe.bright = bright[i], probe.kept = kept[i];
  }
  describe_harmonics(s, field.probes, static_cast<std::size_t>(3 * field.bands * field.bands));
  describe_depth(s, field.probes, std::size_t{field.depth_side} * field.depth_side);
}

}  // namespace

void describe_motion(Serial& s, MoverPose& rest, std::vector<MoverKey>& keys) {
  describe(s, rest);
  s.list(keys, s.count(keys), [&](MoverKey& key) {
    s(key.time_s);
    describe(s, key.pose);
  });
}

void describe(Serial& s, Mover& mover) {
  s(mover.name);
  describe_motion(s, mover.rest, mover.keys);
  describe(s, mover.mesh);
  describe(s, mover.mesh.positions.size(), mover.transfer);
}

void describe(Serial& s, LightField& field) {
  s.as<std::uint32_t>(field.bands);
  s(field.depth_side);
  if (field.bands < 2 || field.bands > 6 || field.depth_side < 2 || field.depth_side > kMaxDepthSide)
    s.refuse("found {} bands and depth maps of {} texels a side, expected 2 to 6 and 2 to {}", field.bands,
             field.depth_side, kMaxDepthSide);
  s(field.depth_cap_m, field.error, field.lower, field.cell_m);
  for (std::uint32_t& n : field.size) s(n);
  const std::uint32_t cells = s.count(field.cells), probes = s.count(field.probes), lights = s.count(field.lights);
  describe(s, field.cells, cells);
  describe_probes(s, field, probes);
  s.list(field.lights, lights, [&](BrightLight& light) { describe(s, light); });
}

}  // namespace oriel
