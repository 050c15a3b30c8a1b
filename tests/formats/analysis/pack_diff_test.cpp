// Two packs beside each other.
#include <gtest/gtest.h>

#include "formats/analysis/pack_diff.h"
#include "formats/analysis/texel_diff.h"

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
  EXPECT_LT(same.largest(), 0.03) << "the mean of four texels";
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

// The bright room is 10 % off, the dark one, of a tenth of the mean, by half of its light; both states 3 lux of error.
TEST(TexelDiff, RelativeErrorsOverBothRooms) {
  const auto off = [](double share, double lux, double mean) { return share * lux / std::hypot(lux, 0.01 * mean); };
  const auto diff = diff_texels(two_rooms(10, 100, 5, 0), two_rooms(10, 110, 7.5f, 3));
  ASSERT_TRUE(diff);
  EXPECT_EQ(diff->texels, 200u);
  EXPECT_NEAR(diff->mean_lux, 52.5, 1e-4);
  EXPECT_NEAR(diff->bias, 58.75 / 52.5 - 1, 1e-6);
  const double bright = off(0.1, 100, 52.5), dark = off(0.5, 5, 52.5);
  EXPECT_NEAR(diff->difference, std::sqrt((bright * bright + dark * dark) / 2), 1e-5);
  EXPECT_EQ(diff->noise, 0);
  EXPECT_NEAR(diff->net, diff->difference, 1e-9);
  EXPECT_NEAR(diff->stated, std::sqrt((std::pow(off(0.03, 100, 52.5), 2) + std::pow(off(0.6, 5, 52.5), 2)) / 2), 1e-5);
  // Two of 200 texels go, of the dark room.
  EXPECT_NEAR(diff->net_without_worst, std::sqrt((100 * bright * bright + 98 * dark * dark) / 198), 1e-5);
  EXPECT_LT(diff->net_of_brighter, diff->net);
}

TEST(TexelDiff, TheReferencesNoiseIsTakenOff) {
  const auto diff = diff_texels(two_rooms(10, 100, 100, 6), two_rooms(10, 110, 110, 0));
  ASSERT_TRUE(diff);
  EXPECT_NEAR(diff->net, 0.08 / std::hypot(1, 0.01), 1e-6);
  EXPECT_EQ(diff_texels(two_rooms(10, 100, 100, 60), two_rooms(10, 110, 110, 0))->net, 0);
}

TEST(TexelDiff, AnotherAtlasNoTexelOrNoLight) {
  EXPECT_FALSE(diff_texels(two_rooms(10, 100, 100, 0), two_rooms(11, 100, 100, 0)));
  Pack moved = two_rooms(10, 100, 100, 0);
  moved.mesh.lightmap_uvs[0].x = 0.5f;
  EXPECT_FALSE(diff_texels(two_rooms(10, 100, 100, 0), moved));
  EXPECT_FALSE(diff_texels(Pack(), Pack()));
  EXPECT_FALSE(diff_texels(two_rooms(10, 0, 0, 0), two_rooms(10, 1, 1, 0))) << "nothing to be relative to";
  const auto dark = diff_texels(two_rooms(10, 0, 0, 0), two_rooms(10, 0, 0, 0));
  ASSERT_TRUE(dark);
  EXPECT_EQ(dark->net, 0);
}

}  // namespace
}  // namespace oriel
