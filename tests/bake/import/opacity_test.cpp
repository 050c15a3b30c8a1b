// A file whose materials are all BLEND, as some exporters write them, is the same scene as one of OPAQUE materials.
#include <gtest/gtest.h>

#include "bake/scene/shade.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

// 2x2: red, green with alpha 128 / blue with alpha 0, white.
constexpr const char* kQuadrants =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFElEQVR4nGP4z8DwHwgbGMA0EAAAP9cIeY8TiooAAAAASUVORK5CYII=";

// A triangle of a material; alphas: those of its corners' colours.
AlphaMode mode_of(const std::string& material, const std::vector<float>& alphas = {}) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}), uv = g.floats("VEC2", {0, 0, 1, 0, 0, 1});
  json attributes = {{"POSITION", p}, {"TEXCOORD_0", uv}};
  std::vector<float> colors;
  for (const float a : alphas) colors.insert(colors.end(), {1, 1, 1, a});
  if (!colors.empty()) attributes["COLOR_0"] = g.floats("VEC4", colors);
  g.add({{"attributes", attributes}, {"material", 0}});
  g.material() = json::parse(material).value();
  g.doc["images"] = {{{"uri", kQuadrants}}};
  g.doc["samplers"] = {{{"magFilter", 9728}}};
  g.doc["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
  const Imported r = import(g);
  EXPECT_TRUE(r.ok()) << r.error();
  return r.ok() ? r.scene().materials[r.scene().surfaces[0].material].alpha_mode : AlphaMode::kBlend;
}

AlphaMode mode_of_factor(float alpha, const std::vector<float>& alphas = {}) {
  return mode_of(
      fmt::format(R"({{"alphaMode":"BLEND","pbrMetallicRoughness":{{"baseColorFactor":[1,1,1,{}]}}}})", alpha), alphas);
}

// The triangle shows the image from an offset on, so much of it. Texture 0 is sharp, 1 smooth.
AlphaMode mode_of_part(const char* offset, const char* scale, int texture = 0, const char* mode = R"("BLEND")") {
  return mode_of(fmt::format(R"({{"alphaMode":{},"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{},
      "extensions":{{"KHR_texture_transform":{{"offset":{},"scale":{}}}}}}}}}}})",
                             mode, texture, offset, scale));
}

TEST(Opacity, BlendOfAlpha1IsOpaque) {
  EXPECT_EQ(mode_of_factor(1), AlphaMode::kOpaque);
  EXPECT_EQ(mode_of_factor(0.999f), AlphaMode::kOpaque);  // 254.7 of 255
  EXPECT_EQ(mode_of_factor(0.99f), AlphaMode::kBlend);
  EXPECT_EQ(mode_of_factor(0), AlphaMode::kBlend);
}

TEST(Opacity, AlphaOfVertexColoursCounts) {
  EXPECT_EQ(mode_of_factor(1, {1, 1, 1}), AlphaMode::kOpaque);
  EXPECT_EQ(mode_of_factor(1, {1, 1, 0.5f}), AlphaMode::kBlend);
}

TEST(Opacity, OnlyTheTexelsThatAreUsedCount) {
  EXPECT_EQ(mode_of_part("[0,0]", "[1,1]"), AlphaMode::kBlend);
  EXPECT_EQ(mode_of_part("[0.05,0.05]", "[0.4,0.4]"), AlphaMode::kOpaque);    // red
  EXPECT_EQ(mode_of_part("[0.55,0.55]", "[0.4,0.4]"), AlphaMode::kOpaque);    // white
  EXPECT_EQ(mode_of_part("[-7.95,9.05]", "[0.4,0.4]"), AlphaMode::kOpaque);   // red, repeated
  EXPECT_EQ(mode_of_part("[0.55,0.05]", "[0.4,0.4]"), AlphaMode::kBlend);     // green
  EXPECT_EQ(mode_of_part("[0.8,0.8]", "[0.4,0.1]"), AlphaMode::kBlend);       // white, and across the border blue
  EXPECT_EQ(mode_of_part("[0.05,0.05]", "[0.4,0.4]", 1), AlphaMode::kBlend);  // smooth: the others shine in
  EXPECT_EQ(mode_of_part("[0.25,0.25]", "[0,0]", 1), AlphaMode::kOpaque);     // the middle of a texel alone
  EXPECT_EQ(mode_of_part("[1e9,0]", "[1e9,1e9]"), AlphaMode::kBlend);
}

TEST(Opacity, MaskThatCutsNothingIsOpaque) {
  EXPECT_EQ(mode_of_part("[0.05,0.05]", "[0.9,0.4]", 0, R"("MASK")"), AlphaMode::kOpaque);  // 128 of 255 reaches 0.5
  EXPECT_EQ(mode_of_part("[0.05,0.05]", "[0.9,0.4]", 0, R"("MASK","alphaCutoff":0.6)"), AlphaMode::kMask);
}

TEST(Opacity, SurfacesOfOneMaterialAreToldApart) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int half = g.floats("VEC4", {1, 1, 1, 0.5f, 1, 1, 1, 0.5f, 1, 1, 1, 0.5f});
  g.add({{"attributes", {{"POSITION", p}}}, {"material", 0}});
  g.add({{"attributes", {{"POSITION", p}, {"COLOR_0", half}}}, {"material", 0}});
  g.material() = {{"alphaMode", "BLEND"}};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  const Scene& s = r.scene();
  EXPECT_EQ(transmittance_at(s, 0, Vec2(0.2f)), Vec3(0));
  EXPECT_FALSE(may_transmit(s.material_of(0)));
  EXPECT_NEAR(transmittance_at(s, 1, Vec2(0.2f)).r, 0.5f, 1 / 255.0);
}

}  // namespace
}  // namespace oriel::test
