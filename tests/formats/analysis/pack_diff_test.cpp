// Two packs beside each other.
#include <gtest/gtest.h>

#include "formats/analysis/pack_diff.h"

namespace oriel {
namespace {

// Two squares of 2 m side, each with a page of its own of that size and light.
Pack two_rooms(std::uint32_t size, float first_lux, float second_lux, float error_lux) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].name = "plaster";
  for (std::uint32_t room = 0; room < 2; ++room) {
    const auto base = static_cast<std::uint32_t>(pack.mesh.positions.size());
    for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
      pack.mesh.positions.emplace_back(2 * uv.x + 10 * static_cast<float>(room), 0, 2 * uv.y);
      pack.mesh.lightmap_uvs.push_back(uv);
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) pack.mesh.indices.push_back(base + i);
    pack.mesh.parts.push_back({room == 0 ? "hall" : "study", 6 * room, 6, 0, static_cast<std::int32_t>(room)});
    LightmapPage page;
    page.width = page.height = size;
    const std::size_t texels = std::size_t{size} * size;
    page.irradiance.assign(texels, Vec3(room == 0 ? first_lux : second_lux));
    page.standard_error.assign(texels, Vec3(error_lux));
    page.state.assign(texels, TexelState::kValid);
    pack.lightmaps.push_back(std::move(page));
  }
  return pack;
}

TEST(PackDiff, NothingChangedWhateverTheAtlas) {
  const PackDiff diff = diff_packs(two_rooms(8, 100, 50, 0), two_rooms(21, 100, 50, 0));
  ASSERT_EQ(diff.surfaces.size(), 2u);
  EXPECT_NEAR(diff.mean_lux, 75, 1e-3);
  EXPECT_LT(diff.largest(), 1e-6);
  EXPECT_NEAR(diff.surfaces[0].area_m2, 4, 1e-6);
  EXPECT_TRUE(diff.options.empty());
}

TEST(PackDiff, TheRoomWhoseLampChangedComesFirst) {
  const PackDiff diff = diff_packs(two_rooms(8, 100, 50, 0), two_rooms(8, 101, 80, 0));
  EXPECT_EQ(diff.surfaces[0].name, "study");
  EXPECT_NEAR(diff.surfaces[0].change_lux(), 30, 1e-3);
  EXPECT_NEAR(diff.largest(), 30.0 / 80, 1e-5);
  EXPECT_NEAR(diff.share(diff.surfaces[1]), 1.0 / 101, 1e-5);
}

// An edge of light within a texel: what either shows of it is another value, and no change of light.
TEST(PackDiff, OtherTexelSizesAreNoChange) {
  const auto lit_to = [](Pack pack, float edge) {
    for (LightmapPage& page : pack.lightmaps)
      for (std::size_t i = 0; i < page.irradiance.size(); ++i) {
        const float left = static_cast<float>(i % page.width) / static_cast<float>(page.width);
        const float share = std::clamp((edge - left) * static_cast<float>(page.width), 0.0f, 1.0f);
        page.irradiance[i] = Vec3(100 * share);
      }
    return pack;
  };
  const Pack fine = lit_to(two_rooms(64, 0, 0, 0), 0.53f), coarse = lit_to(two_rooms(16, 0, 0, 0), 0.53f);
  const PackDiff same = diff_packs(fine, coarse);
  EXPECT_GT(same.surfaces[0].block_m, 0);
  const double by = same.surfaces[0].before_lux;
  EXPECT_LT(std::max(same.surfaces[0].mean_change_lux, same.surfaces[0].rms_change_lux) / by, 0.03);
  // Interpolation takes at most an eighth of a texel's light over a block's rim, of four texels.
  EXPECT_LT(same.surfaces[0].p99_change_lux, 100.0 / 32);
  EXPECT_GT(diff_packs(fine, lit_to(two_rooms(16, 0, 0, 0), 0.7f)).largest(), 0.3) << "the light has moved";
  EXPECT_EQ(diff_packs(fine, fine).surfaces[0].block_m, 0);
}

TEST(PackDiff, NoiseIsNoChange) {
  Pack before = two_rooms(64, 100, 50, 0), after = before;
  // Errors of +-5 lux that the standard errors tell of.
  for (Pack* pack : {&before, &after})
    for (LightmapPage& page : pack->lightmaps)
      for (std::size_t i = 0; i < page.irradiance.size(); ++i) {
        const bool up = ((i * 2654435761u >> (pack == &before ? 7 : 13)) & 1) != 0;
        page.irradiance[i] += Vec3(up ? 5.0f : -5.0f);
        page.standard_error[i] = Vec3(5);
      }
  const PackDiff quiet = diff_packs(before, after);
  EXPECT_GT(quiet.surfaces[0].rms_lux, 2) << "it was there";
  EXPECT_LT(quiet.largest(), 0.01);
  for (LightmapPage& page : after.lightmaps) page.standard_error.assign(page.standard_error.size(), Vec3(0));
  for (LightmapPage& page : before.lightmaps) page.standard_error.assign(page.standard_error.size(), Vec3(0));
  EXPECT_GT(diff_packs(before, after).largest(), 0.03) << "without a stated error it counts";
}

// Equal luminance, and so the light of what it falls on: only channels tell.
TEST(PackDiff, RedThatBecameBlueIsAChange) {
  Pack before = two_rooms(16, 100, 50, 0), after = before;
  for (Vec3& lux : before.lightmaps[0].irradiance) lux = Vec3(100, 0, 0);
  for (Vec3& lux : after.lightmaps[0].irradiance) lux = Vec3(0, 0, 100 * 0.2126f / 0.0722f);
  before.materials[0].base_color = Vec3(0.6f, 0.1f, 0.1f);
  after.materials[0].base_color = Vec3(0.1f, 0.1f, 0.6f);
  const PackDiff diff = diff_packs(before, after);
  EXPECT_NEAR(diff.surfaces[0].before_lux, diff.surfaces[0].after_lux, 1e-3);
  EXPECT_NEAR(diff.surfaces[0].bias_lux.b, 100 * 0.2126 / 0.0722, 1e-2);
  EXPECT_GT(diff.largest(), 1);
  ASSERT_EQ(diff.assets.size(), 1u);
  EXPECT_EQ(diff.assets[0].member, "base colour");
  EXPECT_NEAR(diff.assets[0].change, 0.5 / 0.6, 1e-6);
  EXPECT_FALSE(diff.within(0.5));
}

// Texels of 5 % noise hide it one by one, but not in their mean.
TEST(PackDiff, ALampThatBecameBrighterIsSeenBelowTheNoise) {
  const auto noisy = [](float scale, std::uint32_t seed) {
    Pack pack = two_rooms(64, 100 * scale, 50 * scale, 0);
    for (LightmapPage& page : pack.lightmaps)
      for (std::size_t i = 0; i < page.irradiance.size(); ++i) {
        const float error = 0.05f * page.irradiance[i].x;
        page.irradiance[i] += Vec3((i * 2654435761u >> seed & 1) != 0 ? error : -error);
        page.standard_error[i] = Vec3(error);
      }
    return pack;
  };
  EXPECT_FALSE(diff_packs(noisy(1, 7), noisy(1.02f, 13)).within(0.01));
  EXPECT_TRUE(diff_packs(noisy(1, 7), noisy(1.02f, 13)).within(0.02));
  EXPECT_TRUE(diff_packs(noisy(1, 7), noisy(1, 13)).within(0.005));
}

// Light of 100 lux more on a square of 1/16 of a surface.
TEST(PackDiff, MeanRmsAndPercentileOfASpot) {
  const Pack before = two_rooms(128, 100, 50, 0);
  Pack after = before;
  for (std::size_t y = 32; y < 64; ++y)
    for (std::size_t x = 32; x < 64; ++x) after.lightmaps[0].irradiance[128 * y + x] += Vec3(100);
  const PackDiff diff = diff_packs(before, after);
  EXPECT_NEAR(diff.surfaces[0].mean_change_lux, 100.0 / 16, 0.2);
  EXPECT_NEAR(diff.surfaces[0].rms_change_lux, 25, 0.7);
  EXPECT_NEAR(diff.surfaces[0].p99_change_lux, 100, 0.1);
  EXPECT_NEAR(diff.bias_lux, 100.0 / 32, 0.1);
}

TEST(PackDiff, WhatCamerasSee) {
  Pack before = two_rooms(8, 100, 50, 0);
  before.cameras.push_back({"in the hall", Vec3(1, 1, 1), Vec3(0, -1, 0), Vec3(0, 0, -1), 0.5f});
  const PackDiff diff = diff_packs(before, [&] {
    Pack after = before;
    after.lightmaps[0].irradiance.assign(64, Vec3(110));
    return after;
  }());
  ASSERT_EQ(diff.cameras.size(), 1u);
  EXPECT_NEAR(diff.cameras[0].before_lux, 100, 1e-3);
  EXPECT_NEAR(diff.cameras[0].mean_change_lux, 10, 1e-3);
  EXPECT_NEAR(diff.share(diff.cameras[0]), 10.0 / 110, 1e-5);
}

TEST(PackDiff, MaterialsLampsShapesAndCameras) {
  Pack before = two_rooms(8, 100, 50, 0);
  before.cameras.push_back({"door"});
  before.sharp_light.lamps.push_back({.intensity = Vec3(100)});
  before.mesh.parts[1].lightmap_page = -1;
  const auto only_change = [&](const char* asset, const char* member, double change, const auto& edit) {
    Pack after = before;
    edit(after);
    const auto found = diff_assets(before, after);
    ASSERT_EQ(found.size(), 1u) << asset;
    EXPECT_EQ(found[0].asset, asset);
    EXPECT_EQ(found[0].member, member);
    EXPECT_NEAR(found[0].change, change, 1e-6) << asset;
    EXPECT_FALSE(diff_packs(before, after).within(0.9 * change));
  };
  only_change("material 'plaster'", "roughness", 0.2, [](Pack& p) { p.materials[0].roughness = 0.8f; });
  only_change("material 'plaster'", "emission", 1, [](Pack& p) { p.materials[0].emission = Vec3(3); });
  only_change("material 'plaster'", "double-sided", 1, [](Pack& p) { p.materials[0].double_sided = true; });
  only_change("material 'glue'", "added", 1, [](Pack& p) { p.materials.push_back({.name = "glue"}); });
  only_change("lamp '0'", "intensity", 0.02 / 1.02, [](Pack& p) { p.sharp_light.lamps[0].intensity *= 1.02f; });
  only_change("light 'sky'", "radiance", 1, [](Pack& p) { p.sky = Vec3(1); });
  Vec3 upper(0), lower(0);
  for (const Vec3& p : before.mesh.positions) upper = glm::max(upper, p), lower = glm::min(lower, p);
  const double size = glm::length(DVec3(upper - lower));
  only_change("unlit surface 'study'", "upper", 1.0 / size, [](Pack& p) {
    for (std::size_t i = 4; i < 8; ++i) p.mesh.positions[i].x += i == 5 || i == 6 ? 1.0f : 0.0f;
  });
  only_change("camera 'door'", "eye", 0.5 / size, [](Pack& p) { p.cameras[0].eye.x += 0.5f; });
  only_change("camera 'door'", "gone", 1, [](Pack& p) { p.cameras.clear(); });
  EXPECT_TRUE(diff_packs(before, before).within(0));
}

TEST(PackDiff, SurfacesThatCameWentOrMoved) {
  const Pack before = two_rooms(8, 100, 50, 0);
  Pack after = before;
  after.mesh.parts[0].name = "foyer";
  for (std::size_t i = 4; i < 8; ++i) after.mesh.positions[i].y += 1;
  const PackDiff diff = diff_packs(before, after);
  ASSERT_EQ(diff.surfaces.size(), 3u);
  std::size_t gone = 0, added = 0, moved = 0;
  for (const SurfaceChange& s : diff.surfaces) {
    gone += s.state == SurfaceState::kOnlyInFirst && s.name == "hall";
    added += s.state == SurfaceState::kOnlyInSecond && s.name == "foyer";
    moved += s.name == "study" && !s.same_shape;
  }
  EXPECT_EQ(gone + added + moved, 3u);
  after = before;
  after.mesh.origin = DVec3(0, -3, 0);
  for (Vec3& p : after.mesh.positions) p.y += 3;
  for (const SurfaceChange& s : diff_packs(before, after).surfaces)
    EXPECT_TRUE(s.same_shape) << "only the origin moved";
  after.cameras.push_back({.name = "door", .eye = Vec3(1, 4, 2)});
  Pack with_camera = before;
  with_camera.cameras.push_back({.name = "door", .eye = Vec3(1, 1, 2)});
  EXPECT_TRUE(diff_assets(with_camera, after).empty());
}

TEST(PackDiff, OptionsByName) {
  Pack before = two_rooms(2, 1, 1, 0), after = before;
  before.provenance = R"({"options": {"error": 0.02, "seed": 1}, "tool": "oriel-bake"})";
  after.provenance = R"({"options": {"error": 0.01, "seed": 1, "time": 3}, "tool": "oriel-bake"})";
  const PackDiff diff = diff_packs(before, after);
  ASSERT_EQ(diff.options.size(), 2u);
  EXPECT_EQ(diff.options[0].name, "options.error");
  EXPECT_EQ(diff.options[0].before, "0.02");
  EXPECT_EQ(diff.options[1].name, "options.time");
  EXPECT_EQ(diff.options[1].before, "");
  before.provenance = "no JSON";
  EXPECT_EQ(diff_packs(before, after).options.size(), 4u);
}

TEST(PackDiff, EmptyAndDegeneratePacks) {
  EXPECT_EQ(diff_packs({}, {}).largest(), 0);
  Pack flat = two_rooms(1, 100, 100, 0);
  for (Vec3& p : flat.mesh.positions) p = Vec3(0);
  const PackDiff diff = diff_packs(flat, flat);
  EXPECT_EQ(diff.surfaces.size(), 2u);
  EXPECT_EQ(diff.largest(), 0);
  const Pack black = two_rooms(4, 0, 0, 0);
  EXPECT_EQ(diff_packs(black, black).largest(), 0);
  EXPECT_GT(diff_packs(black, two_rooms(4, 1, 0, 0)).largest(), 0.99);
}

}  // namespace
}  // namespace oriel
