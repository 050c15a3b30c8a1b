// Exported scenes: what our own importer reads back, the bytes' own rules, and the light that is baked into textures.
#include "formats/export/scene_glb.h"
#include "formats/core/json.h"

#include <gmock/gmock.h>

#include <cstring>

#include "bake/import/import.h"
#include "formats/assets/bilinear.h"
#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/export/shown_page.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

Scene imported(const Bytes& glb) {
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(write_file_atomically(folder.path() / "a.glb", glb));
  Context context;
  auto scene = import_gltf(folder.path() / "a.glb", {}, context);
  EXPECT_TRUE(scene) << scene.error().text();
  return scene ? std::move(scene->scene) : Scene{};
}

Json json_of(const Bytes& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  const auto* text = reinterpret_cast<const char*>(glb.data() + 20);
  return Json::parse({text, size}).value();
}

TEST(SceneGlb, OurImporterReadsTheSameScene) {
  const Pack pack = testing::tiny_mapped_pack();
  for (const LightAs light : {LightAs::kEmissive, LightAs::kLightmap}) {
    const auto exported = scene_glb(pack, {light, "tiny_lightmap"});
    ASSERT_TRUE(exported) << exported.error().text();
    const Scene scene = imported(exported->file);
    ASSERT_EQ(scene.triangles.size(), pack.mesh.indices.size() / 3);
    ASSERT_EQ(scene.surfaces.size(), pack.mesh.parts.size());
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
      for (int c = 0; c < 3; ++c) {
        const std::uint32_t was = pack.mesh.indices[3 * t + static_cast<std::size_t>(c)], is = scene.triangles[t][c];
        const DVec3 at = DVec3(scene.positions[is]) + scene.origin;
        EXPECT_LT(glm::length(at - DVec3(pack.mesh.positions[was]) - pack.mesh.origin), 1e-5);
        EXPECT_EQ(scene.uv0[is], pack.mesh.uvs[was]);
        EXPECT_EQ(scene.uv1[is], pack.mesh.lightmap_uvs[was]);
        EXPECT_EQ(scene.colors[is], pack.mesh.colors[was]);
      }
    ASSERT_EQ(scene.cameras.size(), pack.cameras.size());
    for (std::size_t i = 0; i < pack.cameras.size(); ++i) {
      EXPECT_EQ(scene.cameras[i].name, pack.cameras[i].name);
      EXPECT_GT(glm::dot(scene.cameras[i].forward, glm::normalize(pack.cameras[i].forward)), 0.99999f);
      EXPECT_EQ(scene.cameras[i].vertical_fov_rad, pack.cameras[i].vertical_fov_rad);
    }
  }
}

TEST(SceneGlb, MaterialsOfLightmapsAreThePacks) {
  const Pack pack = testing::tiny_mapped_pack();
  const auto exported = scene_glb(pack, {LightAs::kLightmap, "tiny_lightmap"});
  ASSERT_TRUE(exported);
  const Scene scene = imported(exported->file);
  ASSERT_EQ(scene.materials.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const SceneMaterial& m = scene.materials[i];
    EXPECT_EQ(m.name, pack.materials[i].name);
    EXPECT_EQ(m.base_color, pack.materials[i].base_color);
    EXPECT_EQ(m.roughness, pack.materials[i].roughness);
    EXPECT_EQ(m.metallic, pack.materials[i].metallic);
    EXPECT_LT(glm::length(m.emission - pack.materials[i].emission), 1e-6f);
    EXPECT_EQ(m.double_sided, pack.materials[i].double_sided);
  }
  EXPECT_EQ(scene.materials[1].base_color_texture.image, 0);
  const auto json = json_of(exported->file);
  for (std::size_t i = 0; i < 2; ++i)  // in the file: what covers all is imported as opaque
    EXPECT_EQ(json["materials"][i].contains("alphaMode"), pack.materials[i].alpha_mode != AlphaMode::kOpaque);
  const auto& page = json["asset"]["extras"]["oriel"]["lightmaps"][0];
  EXPECT_EQ(page["file"], "tiny_lightmap_000.exr");
  EXPECT_EQ(page["ktx2"]["file"], "tiny_lightmap_000.ktx2");
  EXPECT_EQ(page["ktx2"]["scale"], 1);
  EXPECT_EQ(page["unit"], "lux");
  EXPECT_EQ(page["texcoord"], 1);
  EXPECT_EQ(json["meshes"][0]["primitives"][0]["extras"]["oriel"]["lightmap_page"], 0);
}

TEST(SceneGlb, EmissiveMaterialsReflectNothing) {
  const auto exported = scene_glb(testing::tiny_pack(), {});
  ASSERT_TRUE(exported);
  const Scene scene = imported(exported->file);
  for (const SceneMaterial& m : scene.materials) {
    EXPECT_EQ(m.base_color, Vec3(0));
    EXPECT_EQ(m.specular, 0);
    EXPECT_EQ(m.emission, Vec3(1));
    EXPECT_GE(m.emission_texture.image, 0);
    EXPECT_EQ(m.emission_texture.texcoord, 1);
  }
  EXPECT_FLOAT_EQ(json_of(exported->file)["asset"]["extras"]["oriel"]["white_cd_m2"].get<double>(),
                  exported->white_cd_m2);
  EXPECT_GT(exported->white_cd_m2, 0);
}

// What of glTF the importer does not need to mind.
TEST(SceneGlb, BytesKeepTheRules) {
  const auto exported = scene_glb(testing::tiny_mapped_pack(), {});
  ASSERT_TRUE(exported);
  const Bytes& file = exported->file;
  std::uint32_t words[5];
  std::memcpy(words, file.data(), sizeof(words));
  EXPECT_EQ(words[0], 0x46546C67u);
  EXPECT_EQ(words[1], 2u);
  EXPECT_EQ(words[2], file.size());
  EXPECT_EQ(words[3] % 4, 0u);
  const auto json = json_of(file);
  EXPECT_EQ(json["buffers"][0]["byteLength"], file.size() - 28 - words[3]);
  for (const auto& view : json["bufferViews"]) EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
  std::size_t bounded = 0;
  for (const auto& accessor : json["accessors"]) bounded += accessor.contains("min") && accessor.contains("max");
  EXPECT_EQ(bounded, 2u) << "one for the positions of each part";
  EXPECT_THAT(exported->left_out, ::testing::Contains("1 movers"));
}

TEST(SceneGlb, EmptyAndBarePacks) {
  for (const LightAs light : {LightAs::kEmissive, LightAs::kLightmap}) {
    const auto nothing = scene_glb(Pack{}, {light, "a"});
    ASSERT_TRUE(nothing) << nothing.error().text();
    EXPECT_FALSE(json_of(nothing->file).contains("buffers"));
    Pack bare = testing::tiny_pack();
    bare.lightmaps.clear();
    for (MeshPart& part : bare.mesh.parts) part.lightmap_page = -1, part.name = "\xff\xfe broken";
    const auto unlit = scene_glb(bare, {light, "a"});
    ASSERT_TRUE(unlit) << unlit.error().text();
    EXPECT_EQ(imported(unlit->file).triangles.size(), 4u);
  }
}

// A square of even light: its texels are albedo E / π + emission, to the border and beyond it.
TEST(ShownPage, IsAlbedoTimesIrradianceOverPi) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = {0.5f, 0.25f, 1};
  pack.materials[0].metallic = 0.5f;
  pack.materials[0].emission = {3, 2, 1};
  for (const Vec2& uv : {Vec2(0.25f, 0.25f), Vec2(0.75f, 0.25f), Vec2(0.75f, 0.75f), Vec2(0.25f, 0.75f)}) {
    pack.mesh.positions.emplace_back(uv.x, 0, uv.y);
    pack.mesh.lightmap_uvs.push_back(uv);
    pack.mesh.uvs.push_back(4.0f * (uv - 0.25f));
  }
  pack.mesh.indices = {0, 1, 2, 0, 3, 2};  // one is mirrored in the page
  pack.mesh.parts.push_back({"square", 0, 6, 0, 0});
  LightmapPage page;
  page.width = page.height = 16;
  page.irradiance.assign(256, Vec3(100, 200, 300));
  pack.lightmaps.push_back(page);
  for (const std::uint32_t scale : {1u, 3u}) {
    const FloatImage image = shown_page(pack, 0, scale);
    ASSERT_EQ(image.width, 16 * scale);
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
      const float* p = &image.pixels[3 * (std::size_t{y} * image.width + x)];
      return Vec3(p[0], p[1], p[2]);
    };
    const Vec3 expected = Vec3(0.25f, 0.125f, 0.5f) * Vec3(100, 200, 300) / kPi + Vec3(3, 2, 1);
    for (std::uint32_t i = 2 * scale; i < 14 * scale; ++i)
      for (const auto& [x, y] : {std::pair(i, i), std::pair(i, 8 * scale), std::pair(i, 4 * scale)})
        EXPECT_LT(glm::length(at(x, y) - expected), 1e-3f) << x << " " << y;
    EXPECT_EQ(at(0, 0), Vec3(0)) << "far from any surface";
  }
  EXPECT_EQ(fitting_scale(pack, 0, 64), 1u);
  pack.materials[0].base_color_texture = 0;
  pack.materials[0].metallic = 0;
  pack.materials[0].emission = Vec3(0);
  pack.materials[0].base_color = Vec3(1);
  Texture halves{"halves", 2, 1, Wrap::kClamp, Wrap::kClamp, false, {255, 0, 0, 255, 0, 255, 0, 255}};
  pack.textures.push_back(halves);
  EXPECT_EQ(fitting_scale(pack, 0, 64), 4u);
  EXPECT_EQ(fitting_scale(pack, 0, 40), 2u);
  EXPECT_EQ(fitting_scale(pack, 0, 8), 1u) << "never coarser than the page";
  const FloatImage image = shown_page(pack, 0, 4);
  EXPECT_NEAR(image.pixels[3 * (32 * 64 + 17)], 100 / kPi, 1e-3f) << "the left half is red";
  EXPECT_EQ(image.pixels[3 * (32 * 64 + 17) + 1], 0);
  EXPECT_EQ(image.pixels[3 * (32 * 64 + 46)], 0);
  EXPECT_NEAR(image.pixels[3 * (32 * 64 + 46) + 1], 200 / kPi, 1e-3f) << "the right one green";
}

// R = 1 - √cosθ has the mean ∫ 2 c (1 - √c) dc = 1/5 over the hemisphere, and takes its share of the diffuse light.
TEST(ShownPage, ReflectsTheLightAround) {
  Pack pack;
  pack.fresnel_maps.push_back({0.1f, {Vec3(1, 0.5f, 0), Vec3(0)}, {}});
  pack.materials.resize(2);
  for (Material& m : pack.materials) m.fresnel_map = 0, m.base_color = Vec3(0.5f);
  pack.materials[1].metallic = 1;
  pack.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  pack.mesh.uvs.resize(3);
  pack.mesh.lightmap_uvs = {{-1, -1}, {3, -1}, {-1, 3}};  // all over the page
  pack.mesh.indices = {0, 1, 2};
  LightmapPage page;
  page.width = page.height = 4;
  page.irradiance.assign(16, Vec3(kPi));
  pack.lightmaps.push_back(page);
  for (const std::uint32_t material : {0u, 1u}) {
    pack.mesh.parts = {{"all", 0, 3, material, 0}};
    const FloatImage image = shown_page(pack, 0, 1);
    const float diffuse = material == 0 ? 0.5f * (1 - 0.2f) : 0;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(image.pixels[static_cast<std::size_t>(c)], diffuse + 0.1f * static_cast<float>(2 - c), 2e-4f);
  }
}

TEST(Bilinear, WrapsAsTheTextureSays) {
  const auto blend = [](float at, Wrap wrap) {  // of a map whose texel i holds i
    const TexelsAlong t = texels_along(at, 4, wrap);
    return (1 - t.share) * static_cast<float>(t.first) + t.share * static_cast<float>(t.second);
  };
  for (const Wrap wrap : {Wrap::kRepeat, Wrap::kClamp, Wrap::kMirror}) {
    EXPECT_FLOAT_EQ(blend(0.125f, wrap), 0);
    EXPECT_FLOAT_EQ(blend(0.5f, wrap), 1.5f);
    for (const float far : {1e30f, -1e30f, 1e7f + 0.5f, std::nanf(""), HUGE_VALF, -HUGE_VALF}) {
      const TexelsAlong t = texels_along(far, 4, wrap);
      EXPECT_LT(std::max(t.first, t.second), 4u) << far;
      EXPECT_TRUE(std::isfinite(t.share));
    }
  }
  EXPECT_FLOAT_EQ(blend(0, Wrap::kRepeat), 1.5f) << "between the last and the first";
  EXPECT_FLOAT_EQ(blend(-0.125f, Wrap::kRepeat), 3);
  EXPECT_FLOAT_EQ(blend(-5, Wrap::kClamp), 0);
  EXPECT_FLOAT_EQ(blend(5, Wrap::kClamp), 3);
  EXPECT_FLOAT_EQ(blend(0, Wrap::kMirror), 0);
  EXPECT_FLOAT_EQ(blend(1.125f, Wrap::kMirror), 3);
  EXPECT_FLOAT_EQ(blend(1.875f, Wrap::kMirror), 0);
  EXPECT_FLOAT_EQ(blend(1, Wrap::kMirror), 3);
}

}  // namespace
}  // namespace oriel
