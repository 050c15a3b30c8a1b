// What of a scene's materials comes into a pack.
#include <gtest/gtest.h>

#include "bake/atlas/atlas.h"
#include "bake/run/assemble.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel::test {
namespace {

// A wall that shines by an image of a black and a white half.
Scene screen(const TextureSlot& base = {}) {
  SceneParts parts;
  SceneMaterial m;
  m.name = "screen", m.metallic = 0;
  m.emission = {100, 40, 0};
  m.emission_texture.image = 0;
  m.emission_texture.image_from_uv[2] = {0.25f, 0, 1};  // moved along u
  m.base_color_texture = base;
  parts.quad("wall", parts.add(m), Vec3(0), Vec3(2, 0, 0), Vec3(0, 1, 0));
  Image image;
  image.name = "picture", image.width = 2, image.height = 1;
  image.texels = {0, 0, 0, 255, 255, 255, 255, 255};
  parts.scene().images = {image};
  return parts.finish();
}

Pack assembled(const Scene& scene) {
  Context context;
  Pack pack;
  pack.mesh = assemble_mesh(scene, *build_atlas(scene, {}, context)).mesh;
  assemble_materials(scene, *bake_materials(scene, {}, context), pack);
  return pack;
}

TEST(Assemble, WhatShinesByAPictureKeepsIt) {
  const Pack pack = assembled(screen());
  ASSERT_EQ(pack.emission_textures.size(), 1u);
  const EmissionTexture& e = pack.emission_textures[0];
  ASSERT_LT(e.texture, pack.textures.size());
  EXPECT_EQ(pack.textures[e.texture].name, "picture");
  EXPECT_NEAR(e.mean.r, 0.5, 0.05);
  EXPECT_EQ(e.mean.b, 0) << "it does not shine blue";
  EXPECT_NEAR(pack.materials[0].emission.r / e.mean.r, 100, 1e-3);
  EXPECT_NEAR(pack.materials[0].emission.g / e.mean.g, 40, 1e-3);
  float least = 9, most = -9;
  for (const Vec2& uv : pack.mesh.uvs) least = std::min(least, uv.x), most = std::max(most, uv.x);
  EXPECT_FLOAT_EQ(least, 0.25f);
  EXPECT_FLOAT_EQ(most, 1.25f);
}

// Polished and rough halves; both as rough as before their texture.
TEST(Assemble, RoughnessThatIsAveragedIsTold) {
  Scene scene = screen();
  SceneMaterial& m = scene.materials[0];
  m.roughness = 0.5f;
  m.metallic_roughness_texture = m.emission_texture;
  Context context;
  EXPECT_EQ(averaged_roughness(scene, *bake_materials(scene, {}, context)), std::vector<std::string>{"'screen'"});
  m.metallic_roughness_texture = {};
  EXPECT_TRUE(averaged_roughness(scene, *bake_materials(scene, {}, context)).empty());
}

// A mesh has one set of coordinates. Where the base colour has others, the picture's mean is shown.
TEST(Assemble, TheBaseColoursCoordinatesComeFirst) {
  TextureSlot base;
  base.image = 0;
  EXPECT_TRUE(assembled(screen(base)).emission_textures.empty());
  base.image_from_uv[2] = {0.25f, 0, 1};
  EXPECT_EQ(assembled(screen(base)).emission_textures.size(), 1u);
}

// Metal in every second texel, in a texture of blue alone; with the picture, if there is one, in one texture.
TEST(Assemble, MetalInPlacesIsToldByAlpha) {
  for (const bool shines : {false, true}) {
    Scene scene = screen();
    SceneMaterial& m = scene.materials[0];
    Image image{"metal", 2, 1, {255, 90, 0, 255, 255, 90, 200, 255}};
    scene.images.push_back(image);
    m.metallic_roughness_texture = m.emission_texture;
    m.metallic_roughness_texture.image = 1;
    m.metallic = 0.5f, m.base_color = {0.9f, 0.7f, 0.3f};
    if (!shines) m.emission_texture = {}, m.emission = Vec3(0);
    const Pack pack = assembled(scene);
    ASSERT_EQ(pack.metalness.size(), 1u);
    const Metalness& metal = pack.metalness[0];
    ASSERT_EQ(metal.texture, 0);
    ASSERT_EQ(pack.textures.size(), 1u);
    EXPECT_NEAR(metal.dielectric.g, 0.04f, 1e-5f);
    const std::vector<std::uint8_t>& texels = pack.textures[0].texels;
    EXPECT_EQ(texels[3], 0);
    EXPECT_EQ(texels[7], 100);
    EXPECT_EQ(texels[0], shines ? 0 : 255);
    EXPECT_EQ(pack.emission_textures.size(), shines ? 1u : 0u);
    scene.images[1].texels = {255, 90, 200, 255, 255, 90, 200, 255};
    EXPECT_TRUE(assembled(scene).metalness.empty()) << "the same everywhere";
    m.base_color_texture = m.metallic_roughness_texture;
    ASSERT_EQ(assembled(scene).metalness.size(), 1u) << "its colour is F0";
    EXPECT_EQ(assembled(scene).metalness[0].texture, -1);
    m.alpha_mode = AlphaMode::kBlend;
    EXPECT_TRUE(assembled(scene).metalness.empty()) << "glass shows its mean";
  }
}

}  // namespace
}  // namespace oriel::test
