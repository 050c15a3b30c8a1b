// Movers under known light.
#pragma once

#include "formats/core/sh.h"
#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel::testing {

inline constexpr int kBands = 2;

// One cell over [-4, 4]³ whose probes hold the same light: `mean` from all sides, and more from +x.
inline LightField even_field(const Vec3& mean, float from_x = 0) {
  LightField field;
  field.bands = kBands;
  field.depth_side = 1;
  field.depth_cap_m = 100;
  field.lower = Vec3(-4);
  field.cell_m = Vec3(8);
  field.size = {1, 1, 1};
  field.cells.resize(1);
  for (std::uint32_t i = 0; i < 8; ++i) {
    field.cells[0].probes[i] = i;
    LightProbe probe;
    probe.position = field.lower + 8.0f * Vec3(i & 1, i >> 1 & 1, i >> 2);
    probe.valid = true;
    probe.depth = {Vec2(1, 1)};
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < sh_count(kBands); ++k)
        probe.sh.push_back(k == 0 ? mean[c] * 2 * std::sqrt(kPi) : k == 3 ? from_x * mean[c] : 0);
    field.probes.push_back(probe);
  }
  return field;
}

// A quad of 2 m about the origin that looks along +z, material 0; its transfer is that of an open plane.
inline Mover plane_mover() {
  Pack shape;
  add_quad(shape, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0, -1);
  Mover mover;
  mover.name = "leaf";
  mover.mesh = shape.mesh;
  CompressedTransfer& t = mover.transfer;
  t.bands = kBands;
  t.clusters = 1;
  t.basis.resize(sh_count(kBands));
  std::vector<float> y(sh_count(kBands));
  evaluate_sh(Vec3(0, 0, 1), y);
  for (int l = 0; l < kBands; ++l)
    for (int m = -l; m <= l; ++m) {
      const auto k = static_cast<std::size_t>(sh_index(l, m));
      t.basis[k] = y[k] * static_cast<float>(cosine_factor(l)) / kPi;
    }
  t.cluster.assign(4, 0);
  return mover;
}

inline Pack mover_pack(const LightField& field) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = {0.5f, 0.25f, 1};
  pack.light_field = field;
  pack.movers = {plane_mover()};
  return pack;
}

inline Camera camera_at(const Vec3& eye, const Vec3& target = Vec3(0)) {
  return look_at(eye, target, 0.5f);
}

inline void expect_near(const Vec3& found, const Vec3& expected, float relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], relative * max_component(expected)) << "channel " << c;
}

// A lamp over a floor, the mover half way between: what the lamp gives is taken away below it and nowhere else.
inline Pack shadow_scene() {
  Pack pack = mover_pack(even_field(Vec3(1)));
  pack.materials.resize(2);
  pack.materials[1].base_color = Vec3(1);
  pack.lightmaps.push_back(flat_page(Vec3(100)));
  add_quad(pack, {-4, -2, 4}, {8, 0, 0}, {0, 0, -8}, 1, 0);
  BrightLight lamp;
  lamp.kind = BrightLightKind::kPoint;
  lamp.position = {0, 2, 0};
  lamp.intensity = Vec3(640);  // 40 lux on the floor below it
  lamp.direction = {0, -1, 0};
  pack.light_field.lights = {lamp};
  for (LightProbe& probe : pack.light_field.probes) probe.bright = 1;
  pack.movers[0].rest.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};  // it faces up
  return pack;
}

inline Camera above_floor(float x, float z) {
  Camera camera = look_at({x, -1, z}, {x, -2, z}, 0.05f);
  camera.up = {0, 0, -1};
  return camera;
}

}  // namespace oriel::testing
