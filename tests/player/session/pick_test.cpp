// What lies under the pointer.
#include "player/session/pick.h"

#include <gtest/gtest.h>

#include "formats/core/color.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

// The floor is 4 m square about the origin, its texels 0 to 3 of 8 across and 4 along -z.
TEST(Pick, TheFloorsTexelWithItsError) {
  const Pack pack = testing::tiny_pack();
  const auto picked = pick_surface(pack, {{0.5f, 2, 1.7f}, {0, -1, 0}});
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->part, "floor");
  EXPECT_EQ(picked->material, "polished");
  EXPECT_FLOAT_EQ(picked->distance_m, 2);
  EXPECT_EQ(picked->page, 0);
  EXPECT_EQ(picked->texel, IVec2(2, 0));
  const std::size_t texel = 2;
  EXPECT_EQ(picked->state, pack.lightmaps[0].state[texel]);
  EXPECT_FLOAT_EQ(picked->lux, luminance(pack.lightmaps[0].irradiance[texel]));
  EXPECT_FLOAT_EQ(picked->lux_error, luminance(pack.lightmaps[0].standard_error[texel]));
  const Vec3 vertex_color = Vec3(255, 64, 128) / 255.0f;
  EXPECT_LT(glm::length(picked->albedo - pack.materials[0].base_color * vertex_color), 1e-6f);
}

TEST(Pick, FromBehindThroughNothingAndPastAll) {
  const Pack pack = testing::tiny_pack();
  ASSERT_TRUE(pick_surface(pack, {{0, -1, 0}, {0, 1, 0}}));
  EXPECT_FALSE(pick_surface(pack, {{0, 1, 0}, {0, 0, 1}}));
  EXPECT_FALSE(pick_surface(pack, {{50, 1, 0}, {0, -1, 0}}));
}

TEST(Pick, TexturesAndUnlitSurfaces) {
  Pack pack = testing::tiny_pack();
  const PickRay at_wall{{-1.9f, 0.1f, 1}, {0, 0, -1}};
  const auto textured = pick_surface(pack, at_wall);
  ASSERT_TRUE(textured);
  EXPECT_EQ(textured->part, "wall");
  const Texture& texture = pack.textures[0];
  const Vec3 texel(linear_from_srgb8(texture.texels[0]), linear_from_srgb8(texture.texels[1]),
                   linear_from_srgb8(texture.texels[2]));
  const Vec3 vertex_color = Vec3(255, 64, 128) / 255.0f;
  EXPECT_LT(glm::length(textured->albedo - pack.materials[1].base_color * vertex_color * texel), 1e-6f);
  pack.mesh.parts[1].lightmap_page = -1;
  EXPECT_EQ(pick_surface(pack, at_wall)->page, -1);
  pack.mesh.uvs.assign(pack.mesh.uvs.size(), Vec2(-1e30f, 1e30f));
  EXPECT_TRUE(pick_surface(pack, at_wall)) << "coordinates beyond any texture";
}

}  // namespace
}  // namespace oriel
