// What a plan says of scenes that lack one thing each, and that a bake of them does nothing for it.
#include <gtest/gtest.h>

#include <set>

#include "bake/plan/plan.h"
#include "bake/run/pipeline.h"
#include "formats/core/json.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel {
namespace {

using test::Gltf;

// A floor of 3 m x 3 m in the plane y = 0, its front up, under a lamp of that size 3 m above. `finish` may change the
// document; material 0 is the floor's: metallic 0, a specular weight of 0 (matte).
struct Room {
  test::TempFolder folder;
  BakeOptions options;
  explicit Room(const std::function<void(Gltf&)>& change = {}) {
    Gltf g;
    json_quad(g, 0, {0, 0, 0, 3, 0, 0, 3, 0, -3, 0, 0, -3});
    json_quad(g, 1, {0, 3, 0, 0, 3, -3, 3, 3, -3, 3, 3, 0});
    test::json& floor = g.material();
    floor["name"] = "floor";
    floor["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"baseColorFactor", {0.5, 0.5, 0.5, 1}}};
    floor["extensions"]["KHR_materials_specular"]["specularFactor"] = 0;
    test::json& lamp = g.material();
    lamp["name"] = "lamp";
    lamp["emissiveFactor"] = {1, 1, 1};
    lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1000;
    lamp["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"baseColorFactor", {0.5, 0.5, 0.5, 1}}};
    lamp["extensions"]["KHR_materials_specular"]["specularFactor"] = 0;
    g.use("KHR_materials_specular");
    g.use("KHR_materials_emissive_strength");
    if (change) change(g);
    options.atlas.texel_m = 0.25f;
    options.radiosity.error = 0.05;
    options.radiosity.estimator = Estimator::kCached;
    options.radiosity.samples = 1024;
    options.eyes = {EyeSource::kFile, {{1.5, 1.6, -1.5}, {1, 1.6, -2}}, {}};
    options.scene = folder.write("scene.gltf", g.text());
  }

  static void json_quad(Gltf& g, int material, const std::vector<float>& corners) {
    g.add({{"attributes", {{"POSITION", g.floats("VEC3", corners)}}},
           {"indices", g.indices({0, 1, 2, 0, 2, 3})},
           {"material", material}})["name"] = material == 0 ? "floor" : "lamp";
  }
};

void make_mirror(Gltf& g) {
  g.doc["materials"][0]["pbrMetallicRoughness"] = {{"metallicFactor", 1}, {"roughnessFactor", 0}};
}

const StageCensus& stage(const Census& census, const std::string& name) {
  for (const StageCensus& s : census.stages)
    if (s.name == name) return s;
  ADD_FAILURE() << "no stage " << name;
  return census.stages.front();
}

// The stages that a bake tells progress of.
struct Watched {
  Result<BakeResult> result;
  std::set<std::string> progress;
};
Watched watch(const BakeOptions& options) {
  Context context;
  std::set<std::string> names;
  context.progress = [&](const Progress& p) { names.emplace(p.stage); };
  auto result = bake(options, context);
  return {std::move(result), std::move(names)};
}

bool timed(const BakeResult& result, const std::string& name) {
  for (const StageTime& t : result.times)
    if (t.stage == name) return true;
  return false;
}

std::uint64_t rays_of(const BakeResult& result, const std::string& name) {
  std::uint64_t rays = 0;
  for (const StageTime& t : result.times) rays += t.stage == name ? t.rays : 0;
  return rays;
}

TEST(Census, AMatteRoomNeedsItsLightmapAlone) {
  const Room room;
  Context context;
  const auto plan = make_plan(room.options, false, context);
  ASSERT_TRUE(plan) << plan.error().text();
  for (const StageCensus& s : plan->census.stages) EXPECT_EQ(s.runs, s.name == "radiosity") << s.name << ": " << s.why;
  EXPECT_NE(stage(plan->census, "radiance").why.find("no radiance maps: no planar surface"), std::string::npos);
  EXPECT_EQ(plan->census.materials.size(), 2u);
  EXPECT_EQ(plan->census.materials[0].lobe, LobeKind::kMatte);
  EXPECT_EQ(plan->census.lights.emitting_triangles, 2u);
  EXPECT_NEAR(plan->census.lights.power_lm, kPiD * 9 * 1000, 1);
  EXPECT_TRUE(plan->findings.empty()) << plan->findings[0].found;
}

TEST(Census, TellsWhichLampsComeByThePixel) {
  const Room room([](Gltf& g) {
    g.use("KHR_lights_punctual");
    test::json& lights = g.doc["extensions"]["KHR_lights_punctual"]["lights"];
    for (const float candela : {100.0f, 0.0f}) {
      lights.push_back({{"type", "point"}, {"intensity", candela}});
      g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size());
      g.doc["nodes"].push_back({{"name", candela > 0 ? "bulb" : "dead"}, {"translation", {1.5, 1.5, -1.5}}});
      g.doc["nodes"].back()["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    }
  });
  Context context;
  BakeOptions options = room.options;
  options.radiosity.sharp = true;
  const auto plan = make_plan(options, false, context);
  ASSERT_TRUE(plan) << plan.error().text();
  const StageCensus& sharp = stage(plan->census, "sharp light");
  EXPECT_TRUE(sharp.runs);
  EXPECT_EQ(sharp.why, "light of 1 of 2 points, spots and suns by the pixel, on flat charts; dead in texels: dark");
  EXPECT_EQ(sharp.amounts[0].second, 2u);
  options.radiosity.sharp = false;
  const auto texels = make_plan(options, false, context);
  ASSERT_TRUE(texels) << texels.error().text();
  EXPECT_FALSE(stage(texels->census, "sharp light").runs);
}

TEST(Census, WithoutReflectorsNoRayIsTracedForThem) {
  const Room matte, shiny(make_mirror);
  BakeOptions maps = shiny.options;
  maps.ways = WaysWanted::kMaps;
  const auto without = watch(matte.options), with = watch(maps);
  ASSERT_TRUE(without.result) << without.result.error().text();
  ASSERT_TRUE(with.result) << with.result.error().text();
  EXPECT_GT(rays_of(*with.result, "radiance"), 0u) << "the counter counts";
  EXPECT_TRUE(with.progress.contains("views"));
  EXPECT_EQ(rays_of(*without.result, "radiance"), 0u);
  EXPECT_FALSE(without.progress.contains("views"));
  EXPECT_TRUE(without.result->pack.radiance_maps.empty());
}

TEST(Census, WithoutMoversNothingIsDoneForThem) {
  const Room still, moving([](Gltf&g) {
    g.add_triangle()["extras"]["oriel"]["mover"] = true;
    g.doc["nodes"].back()["name"] = "kite";
  });
  const auto without = watch(still.options), with = watch(moving.options);
  ASSERT_TRUE(without.result);
  ASSERT_TRUE(with.result) << with.result.error().text();
  EXPECT_TRUE(timed(*with.result, "transfer") && timed(*with.result, "probes"));
  EXPECT_FALSE(timed(*without.result, "transfer") || timed(*without.result, "probes"));
  EXPECT_EQ(without.result->pack.light_field.bands, 0);
}

TEST(Census, OneMatteMaterialHasNoKernel) {
  const Room room, mirror(make_mirror);
  const auto without = watch(room.options), with = watch(mirror.options);
  ASSERT_TRUE(without.result && with.result);
  EXPECT_EQ(with.result->pack.kernels.size(), 1u);
  EXPECT_TRUE(without.result->pack.kernels.empty());
  EXPECT_TRUE(without.result->pack.fresnel_maps.empty());
}

TEST(Census, ADarkRoomIsBlackWithoutSweepsOrGathers) {
  const auto unlit = [](Gltf& g) { g.doc["materials"][1].erase("emissiveFactor"); };
  const Room dark(unlit), lit;
  const auto black = watch(dark.options), bright = watch(lit.options);
  ASSERT_TRUE(black.result && bright.result);
  EXPECT_TRUE(bright.progress.contains("gather"));
  for (const char* name : {"gather", "direct light", "certificate"})
    EXPECT_FALSE(black.progress.contains(name)) << name;
  EXPECT_LT(5 * rays_of(*black.result, "radiosity"), rays_of(*bright.result, "radiosity"));
  EXPECT_EQ(black.result->radiosity.texels, bright.result->radiosity.texels) << "texels are there all the same";
  for (const LightmapPage& page : black.result->pack.lightmaps)
    for (const Vec3& e : page.irradiance) EXPECT_EQ(e, Vec3(0));
  Context context;
  const auto plan = make_plan(dark.options, true, context);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(stage(plan->census, "radiosity").runs);
  ASSERT_EQ(plan->findings.size(), 1u);
  EXPECT_EQ(plan->findings[0].kind, FindingKind::kNoLight);
}

// The eye over the middle of the floor sees it in the solid angle of the square; R of a mirror is 1.
TEST(Census, WhatIsLeftOutIsReflectanceTimesWhatIsSeen) {
  Room room(make_mirror);
  room.options.eyes.points = {{1.5, 1.5, -1.5}};
  room.options.reflectors.max_reflectors = 0;
  Context context;
  const auto plan = make_plan(room.options, false, context);
  ASSERT_TRUE(plan) << plan.error().text();
  const MaterialCensus& floor = plan->census.materials[0];
  EXPECT_EQ(floor.lobe, LobeKind::kMirror);
  EXPECT_NEAR(floor.seen, 1.0 / 6, 0.01) << "the cube's side";
  EXPECT_NEAR(floor.left_out, floor.seen * floor.reflectance, 1e-9);
  EXPECT_FALSE(stage(plan->census, "radiance").runs);
  room.options.reflectors.max_reflectors = 32;
  const auto kept = make_plan(room.options, false, context);
  EXPECT_EQ(kept->census.materials[0].left_out, 0);
  EXPECT_EQ(kept->census.reflectors.size(), 1u);
}

TEST(Census, JsonHasItsFieldsAndIsTheSameTwice) {
  const Room room(make_mirror);
  Context context;
  const auto text = [&] { return plan_as_json(*make_plan(room.options, false, context)); };
  const std::string first = text();
  EXPECT_EQ(first, text());
  const auto json = Json::parse(first).value();
  EXPECT_EQ(json["schema"], 1);
  for (const char* key : {"scene", "lights", "materials", "reflectors", "stages", "omitted", "findings", "prediction"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_TRUE(json["prediction"].is_null());
  EXPECT_EQ(json["materials"][0]["lobe"], "mirror");
  EXPECT_EQ(json["reflectors"][0]["kind"], "planar");
}

}  // namespace
}  // namespace oriel
