// Each finding on a scene that has it, and none on the same scene mended.
#include <gtest/gtest.h>

#include <algorithm>

#include "bake/plan/doctor.h"
#include "bake/plan/plan.h"
#include "bake/run/judge.h"
#include "bake/trace/sampler.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::Gltf;
using test::SceneParts;

Scene cube(bool inwards, bool double_sided = false) {
  SceneParts parts;
  SceneMaterial material;
  material.name = "paint";
  material.double_sided = double_sided;
  parts.box("cube", parts.add(material), Vec3(-1), Vec3(1), inwards);
  return parts.finish();
}

TEST(LookAround, FromTheMiddleOfACubeEachSideIsASixth) {
  for (const bool inwards : {true, false}) {
    const Scene scene = cube(inwards);
    const Accel accel = *Accel::build(scene);
    const std::vector<Vec3> eyes(512, Vec3(0));
    const ViewShares shares = look_around(accel, eyes, 1);
    double all = 0;
    for (std::uint32_t t = 0; t < 12; ++t) {
      EXPECT_NEAR((inwards ? shares.front : shares.back)[t], 1.0 / 12, 0.01);
      EXPECT_EQ((inwards ? shares.back : shares.front)[t], 0);
      all += shares.front[t] + shares.back[t];
    }
    EXPECT_NEAR(all, 1, 1e-9);
  }
}

std::vector<Finding> walls_of(const Scene& scene) {
  const Accel accel = *Accel::build(scene);
  std::vector<Finding> findings;
  check_walls(scene, look_around(accel, std::vector<Vec3>(64, Vec3(0)), 1), findings);
  return findings;
}

TEST(Doctor, OneSidedWallsSeenFromBehind) {
  const auto found = walls_of(cube(false));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, FindingKind::kOneSidedWall);
  EXPECT_EQ(found[0].object, "cube");
  EXPECT_NE(found[0].found.find("100 %"), std::string::npos) << found[0].found;
  EXPECT_NE(found[0].fix.find("'paint'"), std::string::npos) << found[0].fix;
  EXPECT_NE(found[0].found.find("nothing is drawn"), std::string::npos) << found[0].found;
  EXPECT_TRUE(walls_of(cube(true)).empty());
  EXPECT_TRUE(walls_of(cube(false, true)).empty());
}

TEST(TellBacks, NamesThoseSeenMostAndCountsTheRest) {
  SceneParts parts;
  for (int i = 0; i < 5; ++i) {  // one above the other below the eyes, their backs to these, each half as wide
    SceneMaterial paint;
    const float half = 1.0f / static_cast<float>(1 << i), far = 1 - 0.01f * static_cast<float>(i);
    parts.quad("sheet " + std::to_string(i), parts.add(paint), {-half, -far, -half}, {2 * half, 0, 0},
               {0, 0, 2 * half});
  }
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  std::vector<Warning> findings;
  tell_backs(accel, std::vector<Vec3>(1024, Vec3(0, -0.5f, 0)), 1, findings);
  ASSERT_EQ(findings.size(), 1u);
  // 4 asin 0.8 sr less what the next sheet fills, 4 asin 0.51.
  EXPECT_NE(findings[0].text.find("'sheet 0' (12 %)"), std::string::npos) << findings[0].text;
  EXPECT_LT(findings[0].text.find("'sheet 0'"), findings[0].text.find("'sheet 3'")) << findings[0].text;
  EXPECT_NE(findings[0].text.find("%) and 1 more;"), std::string::npos) << findings[0].text;
  findings.clear();
  tell_backs(accel, std::vector<Vec3>(1024, Vec3(0, -2, 0)), 1, findings);
  EXPECT_TRUE(findings.empty()) << "from below all are fronts";
}

TEST(Doctor, AlbedosAboveSnow) {
  for (const float albedo : {0.85f, 0.95f, 1.0f}) {
    SceneParts parts;
    parts.box("room", parts.diffuse(Vec3(0.5f, albedo, 0.5f)), Vec3(0), Vec3(1), true);
    const Scene scene = parts.finish();
    std::vector<Finding> findings;
    check_albedos(scene, summarize_materials(scene), findings);
    EXPECT_EQ(findings.size(), albedo > 0.9f ? 1u : 0u) << albedo;
  }
}

std::vector<Finding> lights_of(const std::vector<Light>& lights, const Vec3& sky = Vec3(0)) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(4, 3, 4), true);  // 80 m²
  Scene scene = parts.finish();
  scene.lights = lights;
  scene.sky = sky;
  std::vector<Finding> findings;
  check_lights(scene, LightSet(scene), 80, findings);
  return findings;
}

Light lamp(float candela) {
  Light light;
  light.name = "bulb";
  light.position = Vec3(2, 2.5f, 2);
  light.intensity = Vec3(candela);
  return light;
}

Light sun(float lux) {
  Light light = lamp(lux);
  light.name = "sun";
  light.type = LightType::kDirectional;
  light.direction = Vec3(0, -1, 0);
  return light;
}

TEST(Doctor, LightsThatLookLikeWatts) {
  const auto watts = lights_of({lamp(9)});  // 113 lm for 80 m²
  ASSERT_EQ(watts.size(), 1u);
  EXPECT_EQ(watts[0].kind, FindingKind::kLightUnits);
  EXPECT_EQ(watts[0].object, "bulb");
  EXPECT_NE(watts[0].fix.find("71.6 cd"), std::string::npos) << watts[0].fix;
  EXPECT_TRUE(lights_of({lamp(72)}).empty()) << "a 9 W LED";
  EXPECT_TRUE(lights_of({lamp(9), lamp(72)}).empty()) << "a candle beside a bulb";
  EXPECT_TRUE(lights_of({lamp(9), sun(50000)}).empty()) << "by day";
  EXPECT_EQ(lights_of({lamp(72 * 683 * 100)}).size(), 1u);
  EXPECT_EQ(lights_of({sun(5)}).size(), 1u) << "W/m²";
  EXPECT_EQ(lights_of({sun(1000 * 683)}).size(), 1u);
  EXPECT_TRUE(lights_of({sun(100000)}).empty());
}

// Blender's exporter: a 60 W point of 683 lm/W, a bulb of emission 12.
TEST(Doctor, LampsThatOutshineWhatShinesOfItself) {
  const auto room = [](float lamp_scale, float emission_scale) {
    SceneParts parts;
    parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(0), Vec3(4, 3, 4), true);  // 80 m²
    SceneMaterial glow;
    glow.name = "disc";
    glow.emission = Vec3(12 * emission_scale);
    parts.quad("bulb", parts.add(glow), {2, 2.5f, 2}, {0.1f, 0, 0}, {0, 0, 0.1f});
    Scene scene = parts.finish();
    scene.lights = {lamp(60 * 683 / (4 * kPi) * lamp_scale)};
    std::vector<Finding> findings;
    check_lights(scene, LightSet(scene), 80, findings);
    return findings;
  };
  const auto found = room(1, 1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, FindingKind::kLightUnits);
  EXPECT_EQ(found[0].object, "bulb");
  // 41 000 lm on 80 m² are 512 lux: paint of 163 cd/m², 13.6 times 12.
  for (const char* part : {"\"disc\" 14 times", "4.1e+04 lm", "163 cd/m²"})
    EXPECT_NE(found[0].found.find(part), std::string::npos) << found[0].found;
  for (const char* part : {"--emission-scale 683", "--lamp-scale 0.02"})
    EXPECT_NE(found[0].fix.find(part), std::string::npos) << found[0].fix;
  EXPECT_TRUE(room(1, 683).empty()) << "mended";
  EXPECT_TRUE(room(0.02f, 1).empty()) << "likewise";
}

TEST(Doctor, NoLightAtAll) {
  const auto found = lights_of({});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, FindingKind::kNoLight);
  EXPECT_TRUE(lights_of({}, Vec3(1000)).empty());
}

std::vector<FindingKind> texels_of(double distance, float texel, double area) {
  Scene scene = cube(true);
  scene.origin = DVec3(distance, 0, 0);
  AtlasOptions atlas;
  atlas.texel_m = texel;
  std::vector<Finding> findings;
  check_texels(scene, atlas, area, findings);
  std::vector<FindingKind> kinds;
  for (const Finding& f : findings) kinds.push_back(f.kind);
  return kinds;
}

TEST(Doctor, PositionsAndTexelsThatDoNotMatch) {
  using Kinds = std::vector<FindingKind>;
  EXPECT_EQ(texels_of(0, 0.1f, 100), Kinds{});
  EXPECT_EQ(texels_of(5000, 0.1f, 100), Kinds{});
  EXPECT_EQ(texels_of(1e6, 0.1f, 100), Kinds{FindingKind::kFarFromOrigin}) << "steps of 12 cm";
  EXPECT_EQ(texels_of(0, 0.001f, 100), Kinds{FindingKind::kTexelDensity}) << "100 million texels";
  EXPECT_EQ(texels_of(0, 0.1f, 0.5), Kinds{FindingKind::kTexelDensity}) << "50 texels";
}

std::vector<Finding> findings_of(const Gltf& g, const std::function<void(BakeOptions&)>& change = {}) {
  const test::TempFolder folder;
  BakeOptions options;
  options.scene = folder.write("scene.gltf", g.text());
  options.import.sky = Vec3(1000);
  options.atlas.texel_m = 0.02f;
  if (change) change(options);
  Context context;
  auto plan = make_plan(options, false, context);
  EXPECT_TRUE(plan) << plan.error().text();
  return plan ? plan->findings : std::vector<Finding>{};
}

bool has(const std::vector<Finding>& findings, FindingKind kind) {
  for (const Finding& f : findings)
    if (f.kind == kind) return true;
  return false;
}

TEST(Doctor, WhatTheImporterMends) {
  EXPECT_FALSE(has(findings_of(test::triangle()), FindingKind::kFlippedNormals));
  Gltf turned = test::triangle();
  turned.doc["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      turned.floats("VEC3", {0, 0, -1, 0, 0, -1, 0, 0, -1});
  EXPECT_TRUE(has(findings_of(turned), FindingKind::kFlippedNormals));
  Gltf flat = test::triangle();
  flat.add({{"attributes", {{"POSITION", flat.floats("VEC3", {0, 0, 1, 1, 0, 1, 0, 1, 1, 2, 0, 1})}}},
            {"indices", flat.indices({0, 1, 2, 0, 1, 3})}});
  EXPECT_TRUE(has(findings_of(flat), FindingKind::kDegenerate));
}

TEST(Doctor, LightmapCoordinatesThatOverlapOrAreMissing) {
  const auto uv1 = [](BakeOptions& options) {
    options.atlas.source = AtlasOptions::Source::kUv1;
    options.atlas.resolution = 64;
  };
  Gltf good = test::triangle();
  good.doc["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = good.floats("VEC2", {0, 0, 1, 0, 0, 1});
  EXPECT_FALSE(has(findings_of(good, uv1), FindingKind::kLightmapUv));
  Gltf missing = good;
  missing.add_triangle()["translation"] = {0, 0, 1};
  EXPECT_TRUE(has(findings_of(missing, uv1), FindingKind::kLightmapUv));
  Gltf overlapping = missing;
  overlapping.doc["meshes"][1]["primitives"][0]["attributes"]["TEXCOORD_1"] =
      overlapping.floats("VEC2", {0, 0, 1, 0, 0, 1});
  const auto found = findings_of(overlapping, uv1);
  const auto at =
      std::find_if(found.begin(), found.end(), [](const Finding& f) { return f.kind == FindingKind::kLightmapUv; });
  ASSERT_NE(at, found.end());
  EXPECT_NE(at->found.find("overlaps that of"), std::string::npos) << at->found;
}

TEST(Allowed, ByKindNumberAndObject) {
  const Finding curtain{FindingKind::kOneSidedWall, "Curtain 12", "", "", ""},
      wall{FindingKind::kOneSidedWall, "Wall", "", "", ""}, snow{FindingKind::kAlbedo, "snow", "", "", ""};
  const auto allowed = parse_allowed(" albedo, one-sided wall:Curtain*");
  ASSERT_TRUE(allowed) << allowed.error().text();
  EXPECT_TRUE(is_allowed(curtain, *allowed));
  EXPECT_FALSE(is_allowed(wall, *allowed));
  EXPECT_TRUE(is_allowed(snow, *allowed));
  EXPECT_TRUE(is_allowed(wall, *parse_allowed("D1:W?ll")));
  EXPECT_FALSE(is_allowed(wall, *parse_allowed("D1:W?l")));
  EXPECT_TRUE(parse_allowed("")->empty());
  const auto unknown = parse_allowed("one-sided wal");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("one-sided wall"), std::string::npos) << unknown.error().message;
  EXPECT_FALSE(parse_allowed("@/nowhere"));
}

}  // namespace
}  // namespace oriel
