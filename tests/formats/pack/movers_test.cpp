// Movers and the light field in packs: what goes in comes out, and damage is named.
#include "tests/formats/pack/hostile.h"

namespace oriel {
namespace {

using namespace testing;

TEST(Pack, MoversAndTheirLightComeBack) {
  const Pack in = tiny_mapped_pack(), out = decode_pack(tiny_file()).value();
  ASSERT_EQ(out.movers.size(), 1u);
  const Mover &m = out.movers[0], &from = in.movers[0];
  EXPECT_EQ(std::tie(m.name, m.rest.position, m.rest.rotation),
            std::tie(from.name, from.rest.position, from.rest.rotation));
  ASSERT_EQ(m.keys.size(), 2u);
  EXPECT_EQ(m.keys[1].time_s, 1.5f);
  EXPECT_EQ(m.keys[1].pose.position, from.keys[1].pose.position);
  EXPECT_EQ(m.mesh.positions, from.mesh.positions);
  EXPECT_EQ(m.mesh.indices, from.mesh.indices);
  const CompressedTransfer &t = m.transfer, &t0 = from.transfer;
  EXPECT_EQ(std::tie(t.bands, t.channels, t.clusters, t.components, t.error),
            std::tie(t0.bands, t0.channels, t0.clusters, t0.components, t0.error));
  EXPECT_EQ(std::tie(t.basis, t.weight_scale, t.cluster, t.weight),
            std::tie(t0.basis, t0.weight_scale, t0.cluster, t0.weight));
  const LightField &f = out.light_field, &f0 = in.light_field;
  EXPECT_EQ(std::tie(f.bands, f.depth_side, f.depth_cap_m, f.error, f.lower, f.cell_m, f.size),
            std::tie(f0.bands, f0.depth_side, f0.depth_cap_m, f0.error, f0.lower, f0.cell_m, f0.size));
  ASSERT_EQ(f.cells.size(), 9u);
  EXPECT_EQ(f.cells[0].children, 1u);
  EXPECT_EQ(f.cells[3].probes, f0.cells[3].probes);
  ASSERT_EQ(f.probes.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    const LightProbe &p = f.probes[i], &p0 = f0.probes[i];
    EXPECT_EQ(std::tie(p.position, p.valid, p.bright, p.kept), std::tie(p0.position, p0.valid, p0.bright, p0.kept));
    ASSERT_EQ(p.sh.size(), 12u);
    for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(p.sh[k], p0.sh[k], 0x1p-11f * std::abs(p0.sh[k]));
    ASSERT_EQ(p.depth.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(glm::length(p.depth[k] - p0.depth[k]), 0, 2e-5);
  }
  ASSERT_EQ(f.lights.size(), 2u);
  EXPECT_EQ(
      std::tie(f.lights[0].name, f.lights[0].kind, f.lights[0].intensity, f.lights[0].corners, f.lights[0].two_sided),
      std::tie(f0.lights[0].name, f0.lights[0].kind, f0.lights[0].intensity, f0.lights[0].corners,
               f0.lights[0].two_sided));
  EXPECT_EQ(f.lights[1].outer_cone_rad, 0.5f);
  EXPECT_EQ(f.lights[1].position, f0.lights[1].position);
}

TEST(Hostile, MoversAndTheirLight) {
  const std::string mover = "section MOVR 0 (mover): ", field = "section PROB (light field): ";
  constexpr std::size_t kKeys = 8 + 28;  // after the name and the rest pose
  expect_refusal(with_raw(kMoverSection, 0, ~0u), mover + "its counts need more");
  expect_refusal(with_raw(kMoverSection, kKeys, ~0u), mover + "its counts need more");
  const Bytes raw = Forge::raw(Forge::from(tiny_file()).find(kMoverSection));
  // Transfer: four u16, the error, 16 + 2 floats, 4 clusters, 4 weights.
  const std::size_t transfer = raw.size() - (8 + 4 + 18 * 4 + 4 + 8);
  expect_refusal(with_raw(kMoverSection, transfer, std::uint16_t{7}), mover + "element 0: found a transfer of 7 bands");
  expect_refusal(with_raw(kMoverSection, transfer + 2, std::uint16_t{2}), "2 channels");
  expect_refusal(with_raw(kMoverSection, transfer + 4, std::uint16_t{256}), mover + "its counts need more");
  expect_refusal(with_raw(kMoverSection, transfer + 6, std::uint16_t{0}), "0 components");
  expect_refusal(with_raw(kLightFieldSection, 0, 7u), field + "found 7 bands");
  expect_refusal(with_raw(kLightFieldSection, 4, 65u), field + "found 2 bands and depth maps of 65 texels");
  expect_refusal(with_raw(kLightFieldSection, 4, 64u), field + "its counts need more");
  for (const std::size_t count : {52u, 56u, 60u})  // cells, probes, lights
    expect_refusal(with_raw(kLightFieldSection, count, ~0u), field + "its counts need more");
  const std::size_t valid = 64 + 9 * 36 + 8 * 12, halves = valid + 8 + 2 * 64 + 4;
  expect_refusal(with_raw(kLightFieldSection, valid, std::uint8_t{2}), field + "found validity 2 of probe 0");
  expect_refusal(with_raw(kLightFieldSection, halves - 4, 113), field + "found scale exponent 113");
  expect_refusal(with_raw(kLightFieldSection, halves + 96, std::uint8_t{0x7c}), field + "found coefficient half 0x7c");
  expect_refusal(with_record(kLightFieldSection, [](SectionRecord& r) { r.count = 2; }), field + "found 2 elements");
}

}  // namespace
}  // namespace oriel
