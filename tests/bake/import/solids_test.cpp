// Which glass is solid: KHR_materials_volume on closed surfaces.
#include <gtest/gtest.h>

#include "bake/scene/shade.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

constexpr const char* kGlass = R"({"name":"glass","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},
  "extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.52},
    "KHR_materials_volume":{"thicknessFactor":0.1,"attenuationDistance":0.5,"attenuationColor":[1,0.5,0.25]}}})";

// Faces of the unit cube as quads of four own corners, counter-clockwise from outside.
constexpr int kFaces[6][4][3] = {
    {{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}, {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}},
    {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}},
    {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

// Those faces of the cube, seen from outside or from inside, as one primitive.
void add_faces(Gltf& g, int first, int count, bool inwards = false) {
  std::vector<float> positions;
  std::vector<std::uint16_t> indices;
  for (int f = first; f < first + count; ++f) {
    const auto base = static_cast<std::uint16_t>(positions.size() / 3);
    for (const auto& corner : kFaces[f])
      for (const int x : corner) positions.push_back(static_cast<float>(x));
    for (const int k : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(base + k));
    if (inwards)
      for (std::size_t k = indices.size() - 6; k < indices.size(); k += 3) std::swap(indices[k + 1], indices[k + 2]);
  }
  const int p = g.floats("VEC3", positions), i = g.indices(indices);
  g.add({{"attributes", {{"POSITION", p}}}, {"indices", i}, {"material", 0}});
}
Gltf with(const char* material) {
  Gltf g;
  g.material() = json::parse(material).value();
  g.use("KHR_materials_volume", true);
  return g;
}
const SceneMaterial& material_of(const Scene& scene, std::size_t surface) {
  return scene.materials[scene.surfaces[surface].material];
}

TEST(Solids, AClosedBoxIsSolid) {
  Gltf g = with(kGlass);
  add_faces(g, 0, 6);
  g.doc["materials"][0]["doubleSided"] = true;
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.warnings.size(), 0u) << (r.warnings.empty() ? "" : r.warnings[0]);
  const SceneMaterial& m = material_of(r.scene(), 0);
  EXPECT_TRUE(m.solid);
  EXPECT_FALSE(m.double_sided) << "a solid has one side";
  EXPECT_EQ(m.absorption.r, 0);
  EXPECT_NEAR(m.absorption.g, std::log(2) / 0.5, 1e-6);
  EXPECT_NEAR(m.absorption.b, std::log(4) / 0.5, 1e-6);
  const ShadePoint p = shade_point(r.scene(), 0, Vec2(0.3f));
  EXPECT_FLOAT_EQ(p.eta, 1.52f);
  EXPECT_EQ(p.absorption, m.absorption);
  ImportOptions feet;
  feet.unit_m = 0.3048;
  EXPECT_NEAR(material_of(import(g, feet).scene(), 0).absorption.g, std::log(2) / (0.5 * 0.3048), 1e-5);
}

TEST(Solids, PartsOfOneMaterialCloseEachOther) {
  Gltf g = with(kGlass);
  add_faces(g, 0, 2);
  add_faces(g, 2, 4);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.warnings.empty());
  EXPECT_TRUE(material_of(r.scene(), 0).solid && material_of(r.scene(), 1).solid);
}

TEST(Solids, WhatIsOpenOrInsideOutIsAPane) {
  for (const bool inwards : {false, true}) {
    Gltf g = with(kGlass);
    add_faces(g, 0, inwards ? 6 : 5, inwards);
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_TRUE(r.warned("taken for a thin pane")) << inwards;
    EXPECT_TRUE(r.warned(inwards ? "found its front inwards" : "found 4 open edges, expected a closed surface"));
    EXPECT_FALSE(material_of(r.scene(), 0).solid);
    EXPECT_TRUE(material_of(r.scene(), 0).double_sided);
    EXPECT_EQ(shade_point(r.scene(), 0, Vec2(0.3f)).eta, 0);
  }
}

TEST(Solids, ThinAndOpaqueAsBefore) {
  for (const char* volume : {R"({"thicknessFactor":0})", R"({"attenuationDistance":2})"}) {
    Gltf g = with(kGlass);
    g.doc["materials"][0]["extensions"]["KHR_materials_volume"] = json::parse(volume).value();
    add_faces(g, 0, 3);
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_TRUE(r.warnings.empty()) << volume;
    EXPECT_FALSE(material_of(r.scene(), 0).solid);
  }
  Gltf g = with(kGlass);
  g.doc["materials"][0]["extensions"].erase("KHR_materials_transmission");
  add_faces(g, 0, 3);
  EXPECT_FALSE(material_of(import(g).scene(), 0).solid) << "it transmits nothing";
  g = with(kGlass);
  g.doc["materials"][0]["alphaMode"] = "BLEND";
  g.doc["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
  add_faces(g, 0, 6);
  EXPECT_TRUE(import(g).warned("expected opaque glass"));
}

TEST(Solids, OddNumbersAreToldOf) {
  const auto changed = [](const char* extension, const char* value) {
    Gltf g = with(kGlass);
    g.doc["materials"][0]["extensions"][extension] = json::parse(value).value();
    add_faces(g, 0, 6);
    return import(g);
  };
  const Imported none =
      changed("KHR_materials_volume", R"({"thicknessFactor":1,"attenuationDistance":0,"attenuationColor":[0,0,0]})");
  EXPECT_TRUE(none.warned("expected a distance above 0"));
  EXPECT_EQ(material_of(none.scene(), 0).absorption, Vec3(0));
  const Imported black = changed("KHR_materials_volume",
                                 R"({"thicknessFactor":1,"attenuationDistance":1e-30,"attenuationColor":[0,2,-1]})");
  EXPECT_TRUE(black.warned("found 2, expected 0 to 1"));
  EXPECT_TRUE(is_finite(material_of(black.scene(), 0).absorption));
  EXPECT_EQ(material_of(black.scene(), 0).absorption.g, 0);
  const Imported thin_air = changed("KHR_materials_ior", R"({"ior":0.5})");
  EXPECT_TRUE(thin_air.warned("expected 0 or at least 1: taken as 1"));
  EXPECT_EQ(shade_point(thin_air.scene(), 0, Vec2(0.3f)).eta, 1);
  const Imported mirror = changed("KHR_materials_ior", R"({"ior":0})");
  EXPECT_TRUE(mirror.warned("the solid lets none through"));
  EXPECT_FALSE(material_of(mirror.scene(), 0).solid);
  for (const char* bad : {R"({"thicknessFactor":-1})", R"({"thicknessFactor":"x"})", R"({"attenuationColor":[1]})"})
    EXPECT_NE(changed("KHR_materials_volume", bad).error().find("KHR_materials_volume"), std::string::npos) << bad;
}

TEST(Solids, PanesWithoutAreaAreDropped) {
  Gltf g = with(kGlass);
  add_faces(g, 0, 6);
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 2, 0, 0});
  g.add({{"attributes", {{"POSITION", p}}}, {"material", 0}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().triangles.size(), 12u);
  EXPECT_TRUE(material_of(r.scene(), 0).solid);
}

// Exporters write windows as boxes of glass without a volume, one-sided as is glTF's default.
TEST(Solids, GlassWithoutVolumeIsSeenFromBothSides) {
  Gltf g = with(kGlass);
  g.doc["materials"][0]["extensions"].erase("KHR_materials_volume");
  add_faces(g, 0, 6);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_FALSE(material_of(r.scene(), 0).solid);
  EXPECT_TRUE(material_of(r.scene(), 0).double_sided);
  Gltf matte = with(R"({"pbrMetallicRoughness":{"metallicFactor":0}})");
  add_faces(matte, 0, 6);
  const Imported m = import(matte);
  ASSERT_TRUE(m.ok()) << m.error();
  EXPECT_FALSE(material_of(m.scene(), 0).double_sided);
}

// A cube of 1 m with a cube of air in its middle, as one mesh or as two.
Gltf hollow_cube(float air_m, bool one_mesh) {
  Gltf g = with(kGlass);
  std::vector<float> positions;
  std::vector<std::uint16_t> indices;
  const auto write = [&] {
    const int p = g.floats("VEC3", positions), i = g.indices(indices);
    g.add({{"attributes", {{"POSITION", p}}}, {"indices", i}, {"material", 0}});
    positions.clear(), indices.clear();
  };
  for (const bool inner : {false, true}) {
    for (const auto& face : kFaces) {
      const auto base = static_cast<std::uint16_t>(positions.size() / 3);
      for (const auto& corner : face)
        for (const int x : corner) positions.push_back(0.5f + (inner ? air_m : 1.0f) * (float(x) - 0.5f));
      for (const int k : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(base + k));
      if (inner)
        for (std::size_t k = indices.size() - 6; k < indices.size(); k += 3) std::swap(indices[k + 1], indices[k + 2]);
    }
    if (inner || !one_mesh) write();
  }
  return g;
}

TEST(Solids, WhatIsMostlyAirIsPanesAndABubbleIsAWall) {
  for (const bool one_mesh : {false, true})
    for (const float air_m : {0.5f, 0.9f}) {
      const Imported r = import(hollow_cube(air_m, one_mesh));
      ASSERT_TRUE(r.ok()) << r.error();
      EXPECT_TRUE(r.warnings.empty()) << (r.warnings.empty() ? "" : r.warnings[0]);
      for (std::size_t s = 0; s < r.scene().surfaces.size(); ++s) {
        const SceneMaterial& m = material_of(r.scene(), s);
        EXPECT_EQ(m.solid, air_m < 0.8f);
        EXPECT_EQ(m.double_sided, air_m > 0.8f);
        if (m.solid) continue;
        // Half of the glass over the outside, (1 - 0.9³) / 6, at each of the two faces of a wall.
        EXPECT_NEAR(m.base_color.b, std::exp(-std::log(4) / 0.5 * (1 - 0.729) / 12), 1e-4);
      }
    }
}

TEST(Solids, OpenGlassKeepsTheTintOfItsThickness) {
  Gltf g = with(kGlass);
  add_faces(g, 0, 1);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_NEAR(material_of(r.scene(), 0).base_color.b, std::pow(0.25, 0.1 / 0.5), 1e-5);
  EXPECT_EQ(material_of(r.scene(), 0).base_color.r, 1);
}

// A tube's ring is closed by its first points again, computed at 2π: as three.js and many scripts write it.
void add_tube(Gltf& g, float noise) {
  constexpr int kSides = 12;
  std::vector<float> positions;
  std::vector<std::uint16_t> indices;
  const auto add = [&](double x, double y, double z) {
    for (const double v : {x, y, z}) positions.push_back(static_cast<float>(v));
    return static_cast<std::uint16_t>(positions.size() / 3 - 1);
  };
  for (int i = 0; i <= kSides; ++i) {
    const double angle = 2 * kPiD * i / kSides;
    for (const double y : {0.0, 1.0}) add(std::sin(angle) + (i == kSides ? noise : 0), y, std::cos(angle));
  }
  for (std::uint16_t i = 0; i < kSides; ++i)
    for (const int k : {0, 2, 1, 1, 2, 3}) indices.push_back(static_cast<std::uint16_t>(2 * i + k));
  for (const std::uint16_t top : {0, 1}) {
    const std::uint16_t middle = add(0, top, 0);
    for (std::uint16_t i = 0; i < kSides; ++i) {
      const auto a = static_cast<std::uint16_t>(2 * i + top), b = static_cast<std::uint16_t>(a + 2);
      indices.push_back(middle), indices.push_back(top != 0 ? a : b), indices.push_back(top != 0 ? b : a);
    }
  }
  const int p = g.floats("VEC3", positions), i = g.indices(indices);
  g.add({{"attributes", {{"POSITION", p}}}, {"indices", i}, {"material", 0}});
}

TEST(Solids, ASeamThatRoundingLeftOpenIsClosed) {
  for (const float noise : {0.0f, 1e-6f, 1e-3f}) {
    Gltf g = with(kGlass);
    add_tube(g, noise);
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_EQ(material_of(r.scene(), 0).solid, noise < 1e-4f) << noise;
  }
}

// Open edges may be as near to each other as they like where triangles lie between.
TEST(Solids, ASliverKeepsItsArea) {
  Gltf g = with(kGlass);
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 1, 1e-7f, 0, 0, 1, 0});
  const int i = g.indices(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3});
  g.add({{"attributes", {{"POSITION", p}}}, {"indices", i}, {"material", 0}});
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().triangles.size(), 2u);
  for (std::uint32_t t = 0; t < 2; ++t) EXPECT_GT(triangle_area(r.scene(), t), 0);
}

}  // namespace
}  // namespace oriel::test
