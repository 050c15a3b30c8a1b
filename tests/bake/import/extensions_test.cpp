// WebP images, specular and glossiness, and what is told of extensions that are not read.
#include <gtest/gtest.h>

#include <cmath>

#include "bake/import/images.h"
#include "bake/scene/shade.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

// 2x2: red, green with alpha 128 / blue with alpha 0, white.
constexpr const char* kRgbaOfFour =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFElEQVR4nGP4z8DwHwgbGMA0EAAAP9cIeY8TiooAAAAASUVORK5CYII=";
// The same as lossless WebP, black where alpha is 0.
constexpr char kWebp2x2[] =
    "\x52\x49\x46\x46\x34\x00\x00\x00\x57\x45\x42\x50\x56\x50\x38\x4c\x27\x00\x00\x00\x2f\x01\x40\x00\x10\x1f\x30"
    "\xff\x02\x82\x22\xff\x47\x13\x10\x14\xf9\x3f\x9a\x80\xa0\xe8\xba\xe5\x02\xec\xa6\x82\x9a\xb6\x0d\x58\xfc\x26"
    "\x1d\x11\xfd\x8f\x03\x00";

// A triangle whose texture coordinates are its barycentric ones, with two textures, of which the first is not filtered.
Gltf textured_by(const char* material) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}), uv = g.floats("VEC2", {0, 0, 1, 0, 0, 1});
  g.add({{"attributes", {{"POSITION", p}, {"TEXCOORD_0", uv}}}, {"material", 0}});
  g.material() = json::parse(material).value();
  g.doc["images"] = {{{"uri", std::string("data:image/png;base64,") + kRgbaOfFour}}};
  g.doc["samplers"] = {{{"magFilter", 9728}}};
  g.doc["textures"] = {{{"source", 0}, {"sampler", 0}}};
  return g;
}

double largest(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

TEST(Image, WebP) {
  const std::string bytes(kWebp2x2, sizeof(kWebp2x2) - 1);
  const auto size = image_size(std::as_bytes(std::span(bytes)), "w");
  ASSERT_TRUE(size) << size.error().text();
  EXPECT_EQ(size->width, 2u);
  EXPECT_EQ(size->height, 2u);
  const auto image = decode_image(std::as_bytes(std::span(bytes)), "w");
  ASSERT_TRUE(image) << image.error().text();
  // What has no alpha has the colour of what is beside it.
  EXPECT_EQ(image->texels,
            (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 128, 170, 170, 85, 0, 255, 255, 255, 255}));
  for (std::size_t n = 0; n + 1 < bytes.size(); ++n)
    EXPECT_FALSE(decode_image(std::as_bytes(std::span(bytes)).first(n), "cut")) << n;
}

// As its extension has it, whatever stands beside it.
TEST(Image, WebPStandsBeforeItsFallback) {
  Gltf g = textured_by(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  g.use("EXT_texture_webp", true);
  const std::string bytes(kWebp2x2, sizeof(kWebp2x2) - 1);
  g.doc["images"].push_back({{"uri", "data:image/webp;base64," + base64(bytes)}});
  g.doc["textures"][0] = {{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.warnings.empty());
  ASSERT_EQ(r.scene().images.size(), 1u);
  EXPECT_EQ(r.scene().images[0].texels[8], 170);
}

// Files of Windows: names part by \ and in any case, where no file is named as written.
TEST(Image, FilesAreFoundAsWindowsFindsThem) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "Textures");
  const auto write = [&](const char* name) { folder.write(name, std::string(kWebp2x2, sizeof(kWebp2x2) - 1)); };
  write("Textures/Wood.webp");
  Gltf g = textured_by(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const auto found = [&](const char* uri) {
    g.doc["images"][0] = {{"uri", uri}};
    const Imported r = import_file(folder.write("scene.gltf", g.text()));
    return r.ok() && r.scene().images.size() == 1;
  };
  EXPECT_TRUE(found("Textures/Wood.webp"));
  EXPECT_TRUE(found("textures\\WOOD.webp"));
  EXPECT_FALSE(found("textures/woods.webp"));
  EXPECT_TRUE(found("./no/such/../../Textures/Wood.webp?v=3"));
  write("Textures/wood.WEBP");
  EXPECT_FALSE(found("textures/wood.webp")) << "two files it could be";
  EXPECT_TRUE(found("Textures/Wood.webp"));
}

// What cannot be read is told of, with what is shown instead or what to do.
TEST(Extensions, WhatIsLeftOutIsNamed) {
  const auto with = [](const char* name, bool fallback, bool required) {
    Gltf g = textured_by(R"({"name":"cloth","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
    g.use(name, required);
    g.doc["textures"][0] = {{"extensions", {{name, {{"source", 0}}}}}};
    if (fallback) g.doc["textures"][0]["source"] = 0;
    return import(g);
  };
  EXPECT_TRUE(with("KHR_texture_basisu", true, false).warned("1 textures is not supported: the PNG or JPEG beside"));
  EXPECT_TRUE(with("KHR_texture_basisu", false, false).warned("no other image and are left out: convert its images"));
  EXPECT_NE(with("KHR_texture_basisu", false, true).error().find("convert its images to PNG"), std::string::npos);
  EXPECT_NE(with("XYZ_new", true, true).error().find("expected one that is supported: export"), std::string::npos);
  EXPECT_TRUE(with("XYZ_new", true, false).warned("extension XYZ_new is not supported and is left out"));
  // The scene is whole without these, required or not.
  Gltf g = textured_by(R"({"name":"cloth","extensions":{"KHR_materials_sheen":{"sheenRoughnessFactor":0.5}}})");
  g.use("KHR_materials_sheen", true);
  g.use("KHR_materials_variants", true);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.warnings.size(), 2u);
  EXPECT_TRUE(r.warned("KHR_materials_sheen of material \"cloth\" is not supported and is left out: cloth has"));
  EXPECT_TRUE(r.warned("extension KHR_materials_variants is not supported and is left out: meshes have their own"));
}

// KHR_materials_pbrSpecularGlossiness: the colour of reflections by itself, with Schlick's curve; the alpha of its
// texture makes rough.
TEST(Materials, SpecularGlossiness) {
  const Imported imported =
      import(textured_by(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"metallicFactor":1},
    "extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.2,0.4,0.6,1],
      "specularFactor":[0.5,0.25,0.125],"glossinessFactor":0.75,"specularGlossinessTexture":{"index":0}}}})"));
  ASSERT_TRUE(imported.ok()) << imported.error();
  const Scene& scene = imported.scene();
  const ShadePoint green = shade_point(scene, 0, Vec2(0.75f, 0.2f));
  EXPECT_LT(largest(green.diffuse - Vec3(0.2f, 0.4f, 0.6f)), 1e-6);
  EXPECT_LT(largest(green.f0 - Vec3(0, 0.25f, 0)), 1e-6);
  EXPECT_EQ(green.f90, 1);
  EXPECT_NEAR(green.alpha, std::pow(1 - 0.75 * 128 / 255, 2), 1e-6);
  const ShadePoint red = shade_point(scene, 0, Vec2(0.2f, 0.2f));
  EXPECT_LT(largest(red.f0 - Vec3(0.5f, 0, 0)), 1e-6);
  EXPECT_NEAR(red.alpha, 0.0625, 1e-6);
  for (const double cosine : {1.0, 0.5, 0.1})
    EXPECT_NEAR(fresnel_weight(red.curve, cosine).r, std::pow(1 - cosine, 5), 1e-9) << cosine;
}

}  // namespace
}  // namespace oriel::test
