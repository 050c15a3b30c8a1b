// Materials, textures and what a point shades to: docs/notes/conventions.md, "Materials".
#include <gtest/gtest.h>

#include "bake/import/images.h"
#include "bake/scene/shade.h"
#include "formats/core/color.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

// 2x2: red, green with alpha 128 / blue with alpha 0, white.
constexpr const char* kRgba2x2 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFElEQVR4nGP4z8DwHwgbGMA0EAAAP9cIeY8TiooAAAAASUVORK5CYII=";
// 2x1 grey, 16 bits: black, white. 1x1 grey 128 with alpha 64. 20000x1 grey.
constexpr const char* kGrey16 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABEAAAAACB2fwVAAAADUlEQVR4nGNgYPj/HwADAgH/5ncLrgAAAABJRU5ErkJggg==";
constexpr const char* kGreyAlpha =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR4nGNocAAAAUMAwV/UlQ0AAAAASUVORK5CYII=";
constexpr const char* kHuge =
    "iVBORw0KGgoAAAANSUhEUgAATiAAAAABCAAAAAAe38FSAAAAKklEQVR4nO3BMQEAAADCoPVPbQ0PoAAAAAAAAAAAAAAAAAAAAAAAAAC4ME4hAAE+"
    "tdW1AAAAAElF"
    "TkSuQmCC";

std::string png_uri(const char* data) {
  return std::string("data:image/png;base64,") + data;
}

Bytes png_bytes(const char* data) {
  // The importer's own decoder is tested elsewhere; a plain table does here.
  Bytes out;
  std::uint32_t bits = 0;
  int have = 0;
  for (const char* c = data; *c && *c != '='; ++c) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bits = bits << 6 | static_cast<std::uint32_t>(letters.find(*c));
    if ((have += 6) >= 8) out.push_back(static_cast<std::byte>(bits >> (have -= 8)));
  }
  return out;
}

// The triangle (0,0) (1,0) (0,1) in texture space, with a material.
Gltf textured(const char* material) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}), uv = g.floats("VEC2", {0, 0, 1, 0, 0, 1}),
            uv1 = g.floats("VEC2", {0.75f, 0.75f, 0.75f, 0.75f, 0.75f, 0.75f});
  g.add({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", uv}, {"TEXCOORD_1", uv1}}}, {"material", 0}});
  g.material() = json::parse(material).value();
  g.doc["images"] = {{{"uri", png_uri(kRgba2x2)}}};
  g.doc["samplers"] = {{{"magFilter", 9728}}, json::object(), {{"wrapS", 33071}, {"wrapT", 33648}}};
  g.doc["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}, {{"source", 0}, {"sampler", 2}}};
  return g;
}

Scene scene_of(const Gltf& g) {
  const Imported r = import(g);
  EXPECT_TRUE(r.ok()) << r.error();
  return r.ok() ? r.scene() : Scene{};
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6f) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

TEST(Image, ChannelsBitsAndAlpha) {
  const auto rgba = decode_image(png_bytes(kRgba2x2), "a");
  ASSERT_TRUE(rgba) << rgba.error().text();
  // Alpha is not multiplied in: blue survives alpha 0.
  EXPECT_EQ(rgba->texels,
            (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 0, 255, 255, 255, 255}));
  const auto deep = decode_image(png_bytes(kGrey16), "b");
  ASSERT_TRUE(deep) << deep.error().text();
  EXPECT_EQ(deep->texels, (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 255, 255}));
  const auto grey = decode_image(png_bytes(kGreyAlpha), "c");
  ASSERT_TRUE(grey) << grey.error().text();
  EXPECT_EQ(grey->texels, (std::vector<std::uint8_t>{128, 128, 128, 64}));
}

TEST(Image, BrokenOnesAreRefusedAtEveryLength) {
  EXPECT_NE(decode_image(png_bytes(kHuge), "huge").error().message.find("20000"), std::string::npos);
  const Bytes good = png_bytes(kRgba2x2);
  for (std::size_t n = 0; n + 16 < good.size(); ++n) EXPECT_FALSE(decode_image(std::span(good).first(n), "cut")) << n;
  const std::string webp = "RIFF\x10\0\0\0WEBPVP8 xxxxxxxx";
  EXPECT_NE(decode_image(std::as_bytes(std::span(webp)), "w").error().message.find("unknown"),
            std::string::npos);  // cut at the zero
  const std::string whole("RIFF\x10\0\0\0WEBPVP8 xxxxxxxx", 24);
  EXPECT_NE(decode_image(std::as_bytes(std::span(whole)), "w").error().message.find("WebP"), std::string::npos);
}

TEST(Image, ABrokenOneLeavesTheFactorAndAWarning) {
  for (const char* uri :
       {"missing.png", "http://example.org/a.png", "data:image/png;base64,AAAA", "data:image/png;base64,A"}) {
    Gltf g = textured(
        R"({"pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.6,1],"baseColorTexture":{"index":0},"metallicFactor":0}})");
    g.doc["images"][0]["uri"] = uri;
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_TRUE(r.warned("images[0]")) << uri;
    EXPECT_TRUE(r.scene().images.empty());
    EXPECT_EQ(r.scene().materials[0].base_color_texture.image, -1);
    expect_near(shade_point(r.scene(), 0, Vec2(0.3f)).base_color, Vec3(0.2f, 0.4f, 0.6f));
  }
}

// A mark in the texels tells where they come from.
TEST(Image, OfTheSameFileIsTakenFromTheLastReading) {
  const TempFolder folder;
  Context context;
  Gltf g = textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const auto file = folder.write("a.gltf", g.text());
  ImportedScene last = *import_gltf(file, {}, context);
  ASSERT_EQ(last.image_files.size(), 1u);
  last.scene.images[0].texels[0] ^= 1;
  g.doc["images"][0]["name"] = "another";
  folder.write("a.gltf", g.text());
  const ImportedScene again = *import_gltf(file, {}, context, &last);
  EXPECT_EQ(again.scene.images[0].texels, last.scene.images[0].texels);
  EXPECT_EQ(again.scene.images[0].name, "another");
  g.doc["images"][0]["uri"] = png_uri(kGrey16);
  folder.write("a.gltf", g.text());
  const ImportedScene other = *import_gltf(file, {}, context, &last);
  EXPECT_EQ(other.scene.images[0].texels, import_gltf(file, {}, context)->scene.images[0].texels);
}

TEST(Image, OnlyUsedOnesAreLoaded) {
  Gltf g = textured(R"({"emissiveTexture":{"index":0}})");
  g.doc["images"] = {{{"uri", "unused-and-missing.png"}}, g.doc["images"][0]};
  g.doc["textures"][0]["source"] = 1;
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.warnings.empty()) << r.warnings.front();
  EXPECT_EQ(r.scene().images.size(), 1u);
  EXPECT_EQ(r.scene().materials[0].emission_texture.image, 0);
  EXPECT_EQ(broken_promise(r.scene()), "");
}

TEST(Image, ThreadsDoNotMatter) {
  Gltf g =
      textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":1}}})");
  g.doc["images"].push_back({{"uri", png_uri(kGrey16)}});
  g.doc["textures"][1]["source"] = 1;
  const TempFolder folder;
  const auto path = folder.write("s.gltf", g.text());
  std::vector<std::vector<std::uint8_t>> texels[2];
  for (int threads = 1; threads <= 2; ++threads) {
    Context context;
    context.threads = threads;
    const auto r = import_gltf(path, {}, context);
    ASSERT_TRUE(r) << r.error().text();
    for (const Image& image : r->scene.images) texels[threads - 1].push_back(image.texels);
  }
  ASSERT_EQ(texels[0].size(), 2u);
  EXPECT_EQ(texels[0], texels[1]);
}

TEST(Material, DoubleSidedOnRequest) {
  ImportOptions both;
  both.double_sided = true;
  EXPECT_FALSE(import(triangle()).scene().materials.front().double_sided);
  EXPECT_TRUE(import(triangle(), both).scene().materials.front().double_sided);
}

TEST(Texture, TransformTurnsAsKhronosTestModelDoes) {
  // TextureTransformTest: turned by 22.5°, its arrow, which lies along u = v in the image, shows 67.5° below the u
  // axis.
  Gltf g = textured(
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"rotation":0.39269908169872414}}}}})");
  g.use("KHR_texture_transform");
  const Mat3 turn = scene_of(g).materials[0].base_color_texture.image_from_uv;
  const Vec3 at = turn * Vec3(std::cos(1.1780972451f), std::sin(1.1780972451f), 1);
  EXPECT_NEAR(at.x, at.y, 1e-6);
  EXPECT_GT(at.x, 0);
  g.doc["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0.5}}, {"scale", {2, 4}}, {"texCoord", 1}};
  const TextureSlot slot = scene_of(g).materials[0].base_color_texture;
  EXPECT_EQ(slot.texcoord, 1u);
  expect_near(slot.image_from_uv * Vec3(0.1f, 0.1f, 1), Vec3(0.45f, 0.9f, 1));
}

TEST(Texture, SamplersAndSecondCoordinates) {
  Gltf g = textured(
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}},"emissiveTexture":{"index":2}})");
  const Scene s = scene_of(g);
  const SceneMaterial& m = s.materials[0];
  EXPECT_TRUE(m.base_color_texture.nearest);
  EXPECT_EQ(m.emission_texture.wrap_s, Wrap::kClamp);
  EXPECT_EQ(m.emission_texture.wrap_t, Wrap::kMirror);
  expect_near(shade_point(s, 0, Vec2(0)).base_color, Vec3(1));  // texel (1,1), wherever uv0 points
  EXPECT_TRUE(s.surfaces[0].has_uv1);
  g.doc["materials"][0]["emissiveTexture"]["texCoord"] = 2;
  const Imported far = import(g);
  ASSERT_TRUE(far.ok());
  EXPECT_TRUE(far.warned("texture coordinates 2"));
}

TEST(Shade, PlainDielectricAndMetal) {
  Gltf g = textured(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,2,1],"metallicFactor":0,"roughnessFactor":0.5}})");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.warned("clamped"));
  ShadePoint p = shade_point(r.scene(), 0, Vec2(0.2f));
  expect_near(p.diffuse, Vec3(0.5f, 0.25f, 1));
  expect_near(p.f0, Vec3(0.04f));
  EXPECT_FLOAT_EQ(p.f90, 1);
  EXPECT_FLOAT_EQ(p.alpha, 0.25f);
  EXPECT_FLOAT_EQ(p.coverage, 1);
  expect_near(p.transmission, Vec3(0));
  Scene s = r.scene();
  s.materials[0].metallic = 1;
  p = shade_point(s, 0, Vec2(0.2f));
  expect_near(p.diffuse, Vec3(0));
  expect_near(p.f0, Vec3(0.5f, 0.25f, 1));
}

TEST(Shade, IorSpecularAndTransmission) {
  Gltf g = textured(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1],"metallicFactor":0},"extensions":{
      "KHR_materials_ior":{"ior":2},"KHR_materials_specular":{"specularFactor":0.5,"specularColorFactor":[1,20,0]},
      "KHR_materials_transmission":{"transmissionFactor":0.75}}})");
  const Scene s = scene_of(g);
  const ShadePoint p = shade_point(s, 0, Vec2(0.2f));
  expect_near(p.f0, Vec3(0.5f / 9, 0.5f, 0));  // min(1/9 * 20, 1) * 0.5
  EXPECT_FLOAT_EQ(p.f90, 0.5f);
  expect_near(p.diffuse, Vec3(0.25f, 0.125f, 0));
  expect_near(p.transmission, Vec3(0.75f, 0.375f, 0));
  expect_near(transmittance_at(s, 0, Vec2(0.2f)), Vec3(0.375f, 0.1875f, 0));
  EXPECT_TRUE(may_transmit(s.materials[0]));
  EXPECT_FLOAT_EQ(shade_point(s, 0, Vec2(0.2f)).coverage, 1);
}

TEST(Shade, FresnelFollowsTheIndexAndSchlickTheMetal) {
  Gltf g =
      textured(R"({"pbrMetallicRoughness":{"metallicFactor":0.25},"extensions":{"KHR_materials_ior":{"ior":1.33}}})");
  const ShadePoint p = shade_point(scene_of(g), 0, Vec2(0.2f));
  EXPECT_FLOAT_EQ(p.curve.ior, 1.33f);
  EXPECT_FLOAT_EQ(p.curve.schlick, 0.25f);
  EXPECT_EQ(p.curve.metal, Metal::kNone);
}

TEST(Shade, NamedMetalsReplaceTheColour) {
  Gltf g = textured(R"({"pbrMetallicRoughness":{"baseColorFactor":[0,0,1,1],"metallicFactor":0,"roughnessFactor":0.5},
      "extras":{"oriel_metal":"gold"}})");
  const ShadePoint p = shade_point(scene_of(g), 0, Vec2(0.2f));
  EXPECT_EQ(p.curve.metal, Metal::kGold);
  expect_near(p.f0, Vec3(0.942f, 0.704f, 0.404f), 1e-3f);
  expect_near(p.diffuse, Vec3(0));
  EXPECT_FLOAT_EQ(p.alpha, 0.25f);
}

// A node's metal is that of its instance of the mesh alone.
TEST(Shade, NodesMayNameTheirMetal) {
  Gltf g = textured("{}");
  g.doc["nodes"].push_back(g.doc["nodes"][0]);
  g.doc["nodes"].push_back(g.doc["nodes"][0]);
  g.doc["nodes"][1]["extras"] = {{"oriel_metal", "Cu"}};
  g.doc["nodes"][2]["extras"] = {{"oriel_metal", "copper"}};
  g.doc["scenes"][0]["nodes"] = {0, 1, 2};
  const Scene s = scene_of(g);
  ASSERT_EQ(s.surfaces.size(), 3u);
  EXPECT_EQ(s.materials.size(), 2u) << "both coppers share a material";
  EXPECT_EQ(s.materials[s.surfaces[0].material].metal, Metal::kNone);
  EXPECT_EQ(s.materials[s.surfaces[1].material].metal, Metal::kCopper);
  EXPECT_EQ(s.surfaces[1].material, s.surfaces[2].material);
}

TEST(Materials, UnknownMetalsAreNamed) {
  for (const char* where : {"materials", "nodes"}) {
    Gltf g = textured("{}");
    g.doc[where][0]["extras"] = {{"oriel_metal", "unobtainium"}};
    const Imported r = import(g);
    ASSERT_TRUE(r.ok());
    EXPECT_TRUE(r.warned("found unobtainium, expected gold, silver"));
    g.doc[where][0]["extras"] = "anybody's text";
    EXPECT_TRUE(import(g).ok());
  }
}

TEST(Shade, CoatAndAnisotropy) {
  Gltf g = textured(R"({"extensions":{
      "KHR_materials_clearcoat":{"clearcoatFactor":0.5,"clearcoatRoughnessFactor":0.2},
      "KHR_materials_anisotropy":{"anisotropyStrength":0.6,"anisotropyRotation":1.5707963}}})");
  const Scene s = scene_of(g);
  const ShadePoint p = shade_point(s, 0, Vec2(0.2f));
  EXPECT_FLOAT_EQ(p.coat, 0.5f);
  EXPECT_FLOAT_EQ(p.coat_alpha, 0.04f);
  EXPECT_FLOAT_EQ(p.anisotropy, 0.6f);
  EXPECT_NEAR(p.wide_direction.x, 0, 1e-6);
  EXPECT_NEAR(p.wide_direction.y, 1, 1e-6);
}

TEST(Shade, TexturesMultiply) {
  // Nearest; uv (0.25, 0.25): red, (0.75, 0.25): green with alpha 128.
  Gltf g = textured(
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0},"baseColorFactor":[0.5,0.5,0.5,1]},
      "emissiveTexture":{"index":0},"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":10}},"alphaMode":"BLEND"})");
  const Scene s = scene_of(g);
  const ShadePoint red = shade_point(s, 0, Vec2(0.25f)), green = shade_point(s, 0, Vec2(0.75f, 0.2f));
  expect_near(red.base_color, Vec3(0.5f, 0, 0));
  expect_near(red.emission, Vec3(10, 0, 0));
  EXPECT_FLOAT_EQ(red.alpha, 0);  // roughness is G
  EXPECT_FLOAT_EQ(green.alpha, 1);
  expect_near(green.diffuse, Vec3(0, 0.5f, 0));  // metallic is B
  EXPECT_NEAR(green.coverage, 128 / 255.0, 1e-6);
  EXPECT_NEAR(transmittance_at(s, 0, Vec2(0.75f, 0.2f)).r, 127 / 255.0, 1e-6);
}

TEST(Shade, MaskIsAllOrNothing) {
  Gltf g =
      textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"alphaMode":"MASK","alphaCutoff":0.6})");
  const Scene s = scene_of(g);
  EXPECT_EQ(shade_point(s, 0, Vec2(0.25f)).coverage, 1);
  EXPECT_EQ(shade_point(s, 0, Vec2(0.75f, 0.2f)).coverage, 0);
  EXPECT_EQ(transmittance_at(s, 0, Vec2(0.75f, 0.2f)), Vec3(1));
  EXPECT_EQ(transmittance_at(s, 0, Vec2(0.25f)), Vec3(0));
}

TEST(Shade, UnlitTakesNoPart) {
  Gltf g = textured(R"({"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_unlit":{}}})");
  const Scene s = scene_of(g);
  const ShadePoint p = shade_point(s, 0, Vec2(0.2f));
  expect_near(p.diffuse + p.f0 + p.emission, Vec3(0));
  EXPECT_EQ(p.f90, 0);
  EXPECT_EQ(transmittance_at(s, 0, Vec2(0.2f)), Vec3(1));
  EXPECT_EQ(mean_emission(s, 0), Vec3(0));
}

TEST(Shade, OpaqueLetsNothingThrough) {
  const Scene s = scene_of(triangle());
  EXPECT_EQ(s.materials[0].name, "default");
  EXPECT_FALSE(may_transmit(s.materials[0]));
  EXPECT_EQ(transmittance_at(s, 0, Vec2(0.2f)), Vec3(0));
}

TEST(Shade, VertexColoursMultiply) {
  Gltf g = triangle();
  g.doc["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = g.floats("VEC3", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  const Scene s = scene_of(g);
  expect_near(shade_point(s, 0, Vec2(0.25f, 0.5f)).base_color, Vec3(0.25f, 0.25f, 0.5f));
}

TEST(Shade, MeanEmissionIsTheIntegral) {
  Gltf g = textured(R"({"emissiveTexture":{"index":0},"emissiveFactor":[1,1,1]})");
  // Nearest, uv over the lower left half: red ½, green and blue ¼ each (of the triangle).
  const Scene s = scene_of(g);
  const Vec3 mean = mean_emission(s, 0);
  DVec3 reference(0);
  constexpr int kN = 400;
  int count = 0;
  for (int i = 0; i < kN; ++i)
    for (int k = 0; i + k < kN; ++k, ++count)
      reference +=
          DVec3(shade_point(s, 0, (Vec2(static_cast<float>(i), static_cast<float>(k)) + 0.33f) / static_cast<float>(kN))
                    .emission);
  expect_near(mean, Vec3(reference / static_cast<double>(count)), 0.15f);
  g.doc["materials"][0].erase("emissiveTexture");
  expect_near(mean_emission(scene_of(g), 0), Vec3(1));
  // A texture seen many texels wide converges.
  g.doc["materials"][0]["emissiveTexture"] = {{"index", 1},
                                              {"extensions", {{"KHR_texture_transform", {{"scale", {10, 10}}}}}}};
  const Vec3 fine = mean_emission(scene_of(g), 0);
  expect_near(fine, Vec3(0.5f), 0.03f);
}

TEST(Materials, OutOfRangeIsClampedOrRefused) {
  for (const char* bad :
       {R"({"alphaMode":"GLASS"})", R"({"emissiveFactor":[-1,0,0]})", R"({"emissiveFactor":[1,1]})", R"({"name":7})",
        R"({"pbrMetallicRoughness":[]})", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":9}}})",
        R"({"normalTexture":{"index":9}})",
        R"({"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":-2}}})", R"({"doubleSided":1})",
        R"({"pbrMetallicRoughness":{"baseColorTexture":{}}})"}) {
    const Imported r = import(textured(bad));
    EXPECT_NE(r.error().find("materials[0]"), std::string::npos) << bad << r.error();
  }
  const Imported clamped = import(textured(
      R"({"pbrMetallicRoughness":{"roughnessFactor":1.5,"metallicFactor":-1},"extensions":{"KHR_materials_ior":{"ior":0.5}}})"));
  ASSERT_TRUE(clamped.ok()) << clamped.error();
  EXPECT_EQ(clamped.warnings.size(), 3u);
  EXPECT_EQ(clamped.scene().materials[0].roughness, 1);
  EXPECT_EQ(clamped.scene().materials[0].ior, 1);
}

}  // namespace
}  // namespace oriel::test
