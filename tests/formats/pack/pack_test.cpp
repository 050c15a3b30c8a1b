// Packs in memory and in files: what goes in comes out, within the errors that docs/notes/format.md states.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>

#include "formats/core/half.h"
#include "formats/pack/index.h"
#include "formats/pack/reader.h"
#include "formats/pack/validate.h"
#include "formats/pack/writer.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

using testing::tiny_mapped_pack;
using testing::tiny_pack;

Pack round_trip(const Pack& pack) {
  const auto bytes = encode_pack(pack);
  if (!bytes) {
    ADD_FAILURE() << bytes.error().text();
    return {};
  }
  auto decoded = decode_pack(*bytes);
  if (!decoded) {
    ADD_FAILURE() << decoded.error().text();
    return {};
  }
  return *decoded;
}

void expect_near(const std::vector<Vec3>& found, const std::vector<Vec3>& expected, float relative) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_LE(std::abs(found[i][c] - expected[i][c]), relative * std::abs(expected[i][c])) << i << " channel " << c;
}

TEST(Pack, SolidGlassComesBack) {
  Pack pack = tiny_pack();
  EXPECT_TRUE(round_trip(pack).solids.empty());
  pack.solids = {{0, Vec3(0.9f, 0.8f, 0.7f), Vec3(0, 1.5f, 1e20f)}};
  const Pack out = round_trip(pack);
  ASSERT_EQ(out.solids.size(), 1u);
  EXPECT_EQ(out.solids[0].material, 0u);
  EXPECT_EQ(out.solids[0].tint, pack.solids[0].tint);
  EXPECT_EQ(out.solids[0].absorption, pack.solids[0].absorption);
}

TEST(Pack, EmissionTexturesComeBack) {
  const Pack out = round_trip(tiny_mapped_pack());
  ASSERT_EQ(out.metalness.size(), 2u);
  EXPECT_EQ(out.metalness[0].texture, -1);
  EXPECT_EQ(out.metalness[1].material, 1u);
  EXPECT_EQ(out.metalness[1].texture, 0);
  EXPECT_EQ(out.metalness[1].dielectric, Vec3(0.02f, 0.03f, 0.04f));
  ASSERT_EQ(out.emission_textures.size(), 1u);
  EXPECT_EQ(out.emission_textures[0].material, 1u);
  EXPECT_EQ(out.emission_textures[0].texture, 0u);
  EXPECT_EQ(out.emission_textures[0].mean, Vec3(0.5f, 0.25f, 1));
}

TEST(Pack, TinyPackIsFreeOfIssues) {
  for (const Pack& pack : {tiny_pack(), tiny_mapped_pack()})
    for (const auto& issue : validate(pack)) ADD_FAILURE() << issue.section << ": " << issue.message;
}

TEST(Pack, GeometryAndNamesComeBack) {
  const Pack in = tiny_pack(), out = round_trip(in);
  EXPECT_EQ(out.mesh.origin, in.mesh.origin);
  EXPECT_EQ(out.mesh.positions, in.mesh.positions);
  EXPECT_EQ(out.mesh.uvs, in.mesh.uvs);
  EXPECT_EQ(out.mesh.lightmap_uvs, in.mesh.lightmap_uvs);
  EXPECT_EQ(out.mesh.colors, in.mesh.colors);
  EXPECT_EQ(out.mesh.indices, in.mesh.indices);
  ASSERT_EQ(out.mesh.parts.size(), 2u);
  EXPECT_EQ(out.mesh.parts[1].name, "wall");
  EXPECT_EQ(out.mesh.parts[1].first_index, 6u);
  EXPECT_EQ(out.mesh.parts[1].material, 1u);
  EXPECT_EQ(out.mesh.parts[1].lightmap_page, 0);
  for (std::size_t i = 0; i < in.mesh.normals.size(); ++i)
    EXPECT_LE(glm::length(out.mesh.normals[i] - in.mesh.normals[i]), 7e-5f);
  EXPECT_EQ(out.provenance, in.provenance);
  EXPECT_EQ(out.plan, in.plan);
  EXPECT_EQ(out.sky, in.sky);
}

TEST(Pack, MaterialsAndTexturesComeBack) {
  const Pack in = tiny_pack(), out = round_trip(in);
  ASSERT_EQ(out.materials.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Material &a = in.materials[i], &b = out.materials[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.base_color, b.base_color);
    EXPECT_EQ(a.base_color_texture, b.base_color_texture);
    EXPECT_EQ(a.alpha_mode, b.alpha_mode);
    EXPECT_EQ(a.double_sided, b.double_sided);
    EXPECT_EQ(a.metallic, b.metallic);
    EXPECT_EQ(a.roughness, b.roughness);
    EXPECT_EQ(a.f0, b.f0);
    EXPECT_EQ(a.emission, b.emission);
    EXPECT_EQ(a.kernel, b.kernel);
    EXPECT_EQ(a.fresnel_map, b.fresnel_map);
  }
  ASSERT_EQ(out.textures.size(), 1u);
  EXPECT_EQ(out.textures[0].name, "checks");
  EXPECT_EQ(out.textures[0].texels, in.textures[0].texels);
  EXPECT_EQ(out.textures[0].wrap_t, Wrap::kClamp);
  EXPECT_TRUE(out.textures[0].nearest);
}

TEST(Pack, MapsComeBackWithinTheirErrors) {
  const Pack in = tiny_pack(), out = round_trip(in);
  ASSERT_EQ(out.lightmaps.size(), 1u);
  expect_near(out.lightmaps[0].irradiance, in.lightmaps[0].irradiance, 0x1p-11f);
  expect_near(out.lightmaps[0].standard_error, in.lightmaps[0].standard_error, 0x1p-11f);
  EXPECT_EQ(out.lightmaps[0].state, in.lightmaps[0].state);
  ASSERT_EQ(out.radiance_maps.size(), 2u);
  const RadianceMap &a = in.radiance_maps[1], &b = out.radiance_maps[1];
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.has_emission, b.has_emission);
  EXPECT_EQ(a.valid, b.valid);
  for (std::size_t i = 0; i < a.radiance.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_LE(std::abs(a.radiance[i][c] - b.radiance[i][c]), 0x1p-9f * max_component(a.radiance[i]));
    EXPECT_LE(std::abs(a.disparity[i] - b.disparity[i]), 1.0f / 131070 * 1.001f);
  }
  EXPECT_EQ(b.disparity[0], 0.0f) << "a miss stays at infinity";
  ASSERT_EQ(out.reflectors.size(), 1u);
  EXPECT_EQ(out.reflectors[0].pack_from_reflector, in.reflectors[0].pack_from_reflector);
  EXPECT_EQ(out.reflectors[0].indices, in.reflectors[0].indices);
  EXPECT_EQ(out.reflectors[0].map_count, 2u);
  EXPECT_EQ(out.kernels[1].weights, in.kernels[1].weights);
  EXPECT_EQ(out.fresnel_maps[0].table, in.fresnel_maps[0].table);
  EXPECT_EQ(out.cameras[1].half_height, 3.0f);
  EXPECT_EQ(out.paths[0].keys[1].eye, in.paths[0].keys[1].eye);
}

TEST(Pack, DirectionsAndNormalMapsComeBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  const auto &a = in.lightmaps[0].direction, &b = out.lightmaps[0].direction;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[i][c], b[i][c], 0x1p-12f);
  EXPECT_EQ(b[0], Vec3(0, -1, 0));
  ASSERT_EQ(out.normal_textures.size(), 1u);
  EXPECT_EQ(out.normal_textures[0].texels, in.normal_textures[0].texels);
  EXPECT_EQ(out.normal_textures[0].wrap_s, Wrap::kMirror);
  EXPECT_EQ(out.materials[0].normal_texture, -1);
  EXPECT_EQ(out.materials[1].normal_texture, 0);
  EXPECT_EQ(out.materials[1].normal_scale, 0.75f);
  EXPECT_EQ(out.mesh.normal_uvs, in.mesh.normal_uvs);
  ASSERT_EQ(out.mesh.tangents.size(), in.mesh.tangents.size());
  for (std::size_t i = 0; i < in.mesh.tangents.size(); ++i)
    EXPECT_LE(glm::length(out.mesh.tangents[i] - in.mesh.tangents[i]), 7e-5f);
  const auto first = encode_pack(in), second = encode_pack(out);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

TEST(Pack, KernelsByIncidenceComeBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  EXPECT_TRUE(out.kernels[0].slices.empty());
  EXPECT_EQ(out.kernels[1].slice_size, 3u);
  ASSERT_EQ(out.kernels[1].slices.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const KernelSlice &a = in.kernels[1].slices[i], &b = out.kernels[1].slices[i];
    EXPECT_EQ(std::tie(a.cos_theta, a.albedo, a.energy_kept, a.tilt_rad, a.shift, a.radial_extent),
              std::tie(b.cos_theta, b.albedo, b.energy_kept, b.tilt_rad, b.shift, b.radial_extent));
    EXPECT_EQ(std::tie(a.width, a.lower, a.upper), std::tie(b.width, b.lower, b.upper));
    EXPECT_EQ(a.weights, b.weights);  // halves hold these
    for (std::size_t k = 0; k < a.radial.size(); ++k) EXPECT_NEAR(a.radial[k], b.radial[k], 0x1p-12f);
  }
}

TEST(Pack, WhatReflectionsNeedComesBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  ASSERT_EQ(out.emitters.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(out.emitters[i].corners, in.emitters[i].corners);
    EXPECT_EQ(out.emitters[i].radiance, in.emitters[i].radiance);
    EXPECT_EQ(out.emitters[i].two_sided, in.emitters[i].two_sided);
  }
  EXPECT_EQ(out.reflectors[0].emitters, in.reflectors[0].emitters);
  EXPECT_EQ(std::pair(out.reflectors[0].visibility_x, out.reflectors[0].visibility_y), std::pair(3u, 2u));
  EXPECT_EQ(out.reflectors[0].visibility, in.reflectors[0].visibility);
  EXPECT_EQ(out.fresnel_maps[0].factor, in.fresnel_maps[0].factor);
  EXPECT_TRUE(out.kernels[0].fits.empty());
  ASSERT_EQ(out.kernels[1].fits.size(), 2u);
  const LobeFit &a = in.kernels[1].fits[0], &b = out.kernels[1].fits[0];
  EXPECT_EQ(std::tie(a.m11, a.m13, a.m22, a.m31, a.amplitude), std::tie(b.m11, b.m13, b.m22, b.m31, b.amplitude));
  ASSERT_EQ(out.walk_grids.size(), 2u);
  const WalkGrid& grid = out.walk_grids[0];
  EXPECT_EQ(grid.lower, Vec2(-2));
  EXPECT_EQ(std::tie(grid.cell_m, grid.eye_height_m), std::tuple(0.5f, 1.6f));
  EXPECT_FALSE(grid.walkable(3));
  EXPECT_EQ(grid.eye(4), Vec3(-1.25f, 0.6f, -1.25f));
}

TEST(Pack, VisibleSetsComeBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  const VisibleSets &a = in.visible_sets, &b = out.visible_sets;
  EXPECT_EQ(std::tie(b.groups, b.side, b.below_m, b.above_m), std::tie(a.groups, a.side, a.below_m, a.above_m));
  ASSERT_EQ(b.runs.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(std::tie(b.runs[i].index_count, b.runs[i].group), std::tie(a.runs[i].index_count, a.runs[i].group));
  EXPECT_EQ(b.seen, a.seen);
  EXPECT_TRUE(made_for(b, out.mesh, out.materials, out.walk_grids));
}

TEST(Pack, MapMeshesComeBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  ASSERT_EQ(out.map_meshes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const MapMesh &a = in.map_meshes[i], &b = out.map_meshes[i];
    EXPECT_EQ(b.indices, a.indices);
    ASSERT_EQ(b.vertices.size(), a.vertices.size());
    for (std::size_t v = 0; v < a.vertices.size(); ++v)
      EXPECT_LE(max_component(glm::abs(b.vertices[v] - a.vertices[v])), 1.001f / 131070);
  }
}

TEST(Pack, ReflectedSetsComeBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  ASSERT_FALSE(in.reflected_sets.empty());
  EXPECT_EQ(out.reflected_sets.seen, in.reflected_sets.seen);
  EXPECT_EQ(out.reflected_sets.made_for, reflected_hash(out.visible_sets, out.reflectors));
}

TEST(Pack, CurvedReflectorsComeBack) {
  const Pack in = tiny_mapped_pack(), out = round_trip(in);
  ASSERT_EQ(out.curved_reflectors.size(), 1u);
  const CurvedReflector& r = out.curved_reflectors[0];
  EXPECT_EQ(std::tie(r.name, r.material, r.map), std::tuple("wall", 1u, 0u));
  EXPECT_EQ(r.indices, in.curved_reflectors[0].indices);
  ASSERT_EQ(out.surround_maps.size(), 1u);
  const SurroundMap &a = in.surround_maps[0], &b = out.surround_maps[0];
  EXPECT_EQ(b.centre, a.centre);
  EXPECT_EQ(b.size, 2u);
  EXPECT_EQ(b.valid, a.valid);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(b.inverse_distance[i], a.inverse_distance[i], 2.0f / 131070);
    EXPECT_LE(glm::length(b.radiance[i] - a.radiance[i]), 0x1p-9f * max_component(a.radiance[i]));
  }
  EXPECT_EQ(b.inverse_distance[0], 2);
  EXPECT_EQ(b.inverse_distance[1], 0);
}

// What halves do to the light shown under lamps anywhere above, with any share of even light, on normals
// tilted up to 60 degrees: the figures of docs/notes/format.md.
TEST(Pack, DirectionsKeepWhatIsShown) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0, 1);
  const Vec3 up(0, 0, 1);
  const auto direction = [&](float cosine) {
    const float around = unit(random) * 2 * kPi, sine = std::sqrt(1 - cosine * cosine);
    return Vec3(sine * std::cos(around), sine * std::sin(around), cosine);
  };
  std::vector<double> errors;
  double squares = 0;
  for (int i = 0; i < 200'000; ++i) {
    const float lamp = unit(random);
    const Vec3 towards = direction(unit(random)), d = (1 - lamp) * 0.5f * up + lamp * towards;
    const Vec3 n = direction(1 - 0.5f * unit(random));
    Vec3 stored(0);
    for (int c = 0; c < 3; ++c) stored[c] = float_from_half(half_from_float(d[c]));
    const double error = std::abs(directional_ratio(stored, n, up) - directional_ratio(d, n, up));
    squares += error * error;
    errors.push_back(error);
  }
  std::sort(errors.begin(), errors.end());
  std::printf("directions in halves: the irradiance shown is off by %.3f %% (rms), %.3f %% (95th percentile)\n",
              100 * std::sqrt(squares / static_cast<double>(errors.size())), 100 * errors[errors.size() * 95 / 100]);
  EXPECT_LE(errors[errors.size() * 95 / 100], 0.001);
}

TEST(Pack, UnknownOptionalSectionsAreKept) {
  const Pack in = tiny_pack(), out = round_trip(in);
  ASSERT_EQ(out.unknown.size(), 1u);
  EXPECT_EQ(out.unknown[0].kind, in.unknown[0].kind);
  EXPECT_EQ(out.unknown[0].codec, 77u);
  EXPECT_EQ(out.unknown[0].count, 3u);
  EXPECT_EQ(out.unknown[0].raw_bytes, 1000u);
  EXPECT_EQ(out.unknown[0].stored, in.unknown[0].stored);
}

TEST(Pack, EmptyPackComesBack) {
  const Pack out = round_trip(Pack{});
  EXPECT_TRUE(out.mesh.positions.empty());
  EXPECT_TRUE(out.lightmaps.empty());
}

// A pack full of numbers at every scale.
Pack wild_pack(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::uniform_int_distribution<int> exponent(-149, 127);
  Pack pack = tiny_pack();
  const int high = exponent(random);
  const auto number = [&] { return std::ldexp(unit(random), std::min(127, high - std::abs(exponent(random)) % 40)); };
  for (auto& page : pack.lightmaps)
    for (auto& v : page.irradiance) v = {number(), number(), number()};
  for (auto& map : pack.radiance_maps) {
    const int depth = std::abs(exponent(random)) % 40;
    for (auto& v : map.radiance) v = {number(), number(), number()};
    for (auto& d : map.disparity) d = std::ldexp(unit(random), -depth);
  }
  for (auto& n : pack.mesh.normals)
    n = normalize_or({unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f}, {0, 0, -1});
  return pack;
}

TEST(Pack, EncodingAgainChangesNoByte) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    const auto first = encode_pack(wild_pack(seed));
    ASSERT_TRUE(first) << first.error().text();
    const auto decoded = decode_pack(*first);
    ASSERT_TRUE(decoded) << decoded.error().text();
    EXPECT_TRUE(validate(*decoded).empty());
    const auto second = encode_pack(*decoded);
    ASSERT_TRUE(second) << second.error().text();
    EXPECT_EQ(*first, *second) << "seed " << seed;
  }
}

TEST(Pack, ThreadsAndTimeDoNotChangeTheBytes) {
  const auto alone = encode_pack(wild_pack(1));
  Result<Bytes> a, b;
  std::thread one([&] { a = encode_pack(wild_pack(1)); });
  std::thread two([&] { b = encode_pack(wild_pack(1)); });
  one.join();
  two.join();
  ASSERT_TRUE(alone && a && b);
  EXPECT_EQ(*alone, *a);
  EXPECT_EQ(*alone, *b);
}

TEST(Pack, BlackAndHugePagesSurvive) {
  Pack pack = tiny_pack();
  for (auto& v : pack.lightmaps[0].irradiance) v = Vec3(0);
  EXPECT_EQ(round_trip(pack).lightmaps[0].irradiance, pack.lightmaps[0].irradiance);
  for (auto& v : pack.lightmaps[0].irradiance) v = Vec3(std::numeric_limits<float>::max(), 0, 1);
  const Pack out = round_trip(pack);
  EXPECT_NEAR(out.lightmaps[0].irradiance[3].r / std::numeric_limits<float>::max(), 1, 0x1p-10);
}

TEST(Pack, LargeBlackPageIsNoBomb) {
  Pack pack = tiny_pack();
  auto& page = pack.lightmaps[0];
  page.width = page.height = 2048;
  page.cell.clear(), page.detail.clear();
  page.detail_width = page.detail_height = 0;
  page.irradiance.assign(2048 * 2048, Vec3(0));
  page.standard_error = page.irradiance;
  page.state.assign(2048 * 2048, TexelState::kValid);
  const Pack out = round_trip(pack);
  EXPECT_EQ(out.lightmaps[0].width, 2048u);
}

TEST(Pack, WriterRefusesWhatMeansNothing) {
  Pack pack = tiny_pack();
  pack.lightmaps[0].irradiance[5].g = std::nanf("");
  const auto bytes = encode_pack(pack);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::kInvalid);
  EXPECT_NE(bytes.error().text().find("section LMAP 0 (lightmap page): issue 302: 1 of 32 texels"), std::string::npos)
      << bytes.error().text();
}

}  // namespace
}  // namespace oriel
