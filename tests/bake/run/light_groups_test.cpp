// Which lamps are switched together.
#include <gtest/gtest.h>

#include <fstream>

#include "bake/run/light_groups.h"
#include "tests/bake/support/scene_parts.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using test::SceneParts;

// A hall with two panels of one mesh, a desk with a shade and its bulb, a sky, and a wall.
Scene lit_scene() {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f)), lamp = parts.diffuse(Vec3(0.5f), Vec3(100));
  const auto quad = [&](const std::string& path, const std::string& mesh, std::uint32_t material) {
    parts.quad(path.substr(path.rfind('/') + 1), material, Vec3(0), {1, 0, 0}, {0, 0, 1});
    parts.scene().surfaces.back().node_path = path;
    parts.scene().surfaces.back().mesh_name = mesh;
  };
  quad("wall", "wall", wall);
  quad("panel 1", "panel", lamp);
  quad("panel 2", "panel", lamp);
  quad("desk/shade", "shade", lamp);
  Light bulb;
  bulb.name = "bulb", bulb.node_path = "desk/bulb", bulb.intensity = Vec3(10);
  parts.scene().lights.push_back(bulb);
  Scene scene = parts.finish();
  scene.sky = Vec3(10);
  return scene;
}

std::vector<std::string> names(const Scene& scene) {
  std::vector<std::string> out;
  for (const SceneLightGroup& group : scene.light_groups) out.push_back(group.name);
  return out;
}

using Names = std::vector<std::string>;

TEST(LightGroups, FollowMarks) {
  Scene scene = lit_scene();
  Context context;
  ASSERT_TRUE(assign_light_groups({}, scene, context));
  EXPECT_TRUE(scene.light_groups.empty());  // nothing is marked
  std::vector<std::string> warnings;
  context.warn = [&](const Warning& warning) { warnings.push_back(warning.text); };
  scene.surfaces[0].group_mark = "walls";
  scene.surfaces[3].group_mark = scene.lights[0].group_mark = "desk";
  ASSERT_TRUE(assign_light_groups({}, scene, context));
  EXPECT_EQ(names(scene), (Names{"desk", kOtherLamps}));
  EXPECT_EQ(scene.light_groups[0].lamps, (Names{"desk/shade", "desk/bulb"}));
  EXPECT_EQ(scene.light_groups[1].lamps, (Names{"panel 1", "panel 2", "sky"}));
  EXPECT_EQ(scene.surfaces[1].light_group, 1u);
  EXPECT_EQ(scene.surfaces[3].light_group, 0u);
  EXPECT_EQ(scene.lights[0].light_group, 0u);
  EXPECT_EQ(scene.sky_group, 1u);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("\"walls\" has no lamp"), std::string::npos);
}

TEST(LightGroups, HaveNamesOfTheirOwnBesideHours) {
  Context context;
  Scene named = lit_scene(), marked = lit_scene();
  DayHour noon;
  noon.hour = 12, noon.group = 0;
  for (Scene* scene : {&named, &marked}) scene->day.date = "2026-06-21", scene->day.hours = {noon};
  const Status refused =
      assign_light_groups({LightGrouping::kNamed, "groups.json", {{"day 12:00", {"panel*"}}}}, named, context);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().text(),
            "groups.json: found the group \"day 12:00\", expected another name: that is the day's");
  marked.surfaces[3].group_mark = "day 12:00";
  ASSERT_TRUE(assign_light_groups({}, marked, context));
  EXPECT_EQ(names(marked), (Names{"day 12:00", "day 12:00 lamp", kOtherLamps}));
}

TEST(LightGroups, AreOfLampsThatMoveTogether) {
  std::vector<std::string> warnings;
  Context context;
  context.warn = [&](const Warning& warning) { warnings.push_back(warning.text); };
  Scene scene = lit_scene();
  scene.lamp_motions.push_back({"desk", {}, {{0, {}}, {1, {}}}});
  scene.surfaces[3].motion = scene.lights[0].motion = 0;
  Scene by_mesh = scene, off = scene, marked = scene;
  ASSERT_TRUE(assign_light_groups({}, scene, context));
  EXPECT_EQ(names(scene), (Names{"desk", kOtherLamps})) << "nothing is marked, but one moves";
  EXPECT_EQ(scene.light_groups[0].motion, 0);
  EXPECT_EQ(scene.light_groups[1].motion, -1);
  by_mesh.surfaces[1].motion = 0;  // one of two panels
  ASSERT_TRUE(assign_light_groups({LightGrouping::kAuto, {}, {}}, by_mesh, context));
  EXPECT_EQ(names(by_mesh), (Names{"panel", "desk", "sky", "desk 2"}));
  EXPECT_EQ(by_mesh.light_groups[0].motion, -1);
  EXPECT_EQ(by_mesh.light_groups[1].motion, 0);
  EXPECT_EQ(by_mesh.light_groups[3].motion, 0);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].find("\"panel 1\" is animated: it leaves the group \"panel\""), std::string::npos)
      << warnings[0];
  for (int m = 1; m < 10; ++m) {  // ten lamps
    marked.lamp_motions.push_back(marked.lamp_motions[0]);
    marked.lights.push_back(marked.lights[0]);
    marked.lights.back().motion = m, marked.lights.back().node_path = fmt::format("lamp {}", m);
  }
  ASSERT_TRUE(assign_light_groups({}, marked, context));
  ASSERT_EQ(marked.light_groups.size(), kMostMotions + 1);
  EXPECT_EQ(marked.light_groups[7].motion, 7);
  EXPECT_EQ(marked.light_groups[8].motion, -1) << "the others, which do not go together";
  EXPECT_NE(warnings.back().find("\"other lamps\" has lamps that are animated and others"), std::string::npos);
  ASSERT_TRUE(assign_light_groups({LightGrouping::kOff, {}, {}}, off, context));
  EXPECT_TRUE(off.light_groups.empty());
  EXPECT_NE(warnings.back().find("1 lamps are animated: without light groups they stand still"), std::string::npos);
}

TEST(LightGroups, FollowPlacesAndLamps) {
  Context context;
  Scene by_place = lit_scene(), each = lit_scene(), off = lit_scene();
  ASSERT_TRUE(assign_light_groups({LightGrouping::kAuto, {}, {}}, by_place, context));
  EXPECT_EQ(names(by_place), (Names{"panel", "desk", "sky"}));
  ASSERT_TRUE(assign_light_groups({LightGrouping::kEach, {}, {}}, each, context));
  EXPECT_EQ(names(each), (Names{"panel 1", "panel 2", "shade", "bulb", "sky"}));
  ASSERT_TRUE(assign_light_groups({LightGrouping::kOff, {}, {}}, off, context));
  EXPECT_TRUE(off.light_groups.empty());
  Scene many = lit_scene();
  for (int i = 0; i < 40; ++i) {
    many.lights.push_back(many.lights[0]);
    many.lights.back().node_path = "bulb " + std::to_string(i);
  }
  ASSERT_TRUE(assign_light_groups({LightGrouping::kEach, {}, {}}, many, context));
  EXPECT_EQ(many.light_groups.size(), kMostLightGroups);
  EXPECT_EQ(many.light_groups.back().name, kOtherLamps);
}

TEST(LightGroups, FollowAFile) {
  const testing::TemporaryFolder folder;
  const std::string file = (folder.path() / "groups.json").string();
  Context context;
  const auto assign = [&](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    const auto options = parse_light_groups(file);
    if (!options) return options.error().text();
    Scene scene = lit_scene();
    const Status done = assign_light_groups(*options, scene, context);
    if (!done) return done.error().text();
    std::string all;
    for (const SceneLightGroup& group : scene.light_groups) all += group.name + fmt::format(":{} ", group.lamps.size());
    return all;
  };
  EXPECT_EQ(assign(R"({"hall": ["panel *"], "desk": ["desk/*"]})"), "hall:2 desk:2 other lamps:1 ");
  EXPECT_EQ(assign(R"({"all": ["*"]})"), "all:5 ");
  const auto expect = [&](const std::string& text, const std::string& words) {
    EXPECT_NE(assign(text).find(words), std::string::npos) << assign(text);
  };
  expect(R"({"a": ["panel *"], "b": ["panel 2"]})", "found the lamp \"panel 2\" in \"a\" and in \"b\"");
  expect(R"({"a": ["panle 1"]})", "found \"panle 1\" in the group \"a\", expected lamps of the scene");
  expect(R"({"a": ["wall"]})", "which does not shine");
  expect(R"({"a": []})", "found no lamp in the group \"a\"");
  expect(R"({"a": "panel 1"})", "found no list of names");
  expect(R"([])", "found no JSON object");
  expect(R"({})", "found no group");
  EXPECT_FALSE(parse_light_groups((folder.path() / "none.json").string()));
  EXPECT_FALSE(parse_light_groups(""));
}

}  // namespace
}  // namespace oriel
