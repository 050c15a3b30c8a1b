// What the panel changes, saves and bakes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/core/file.h"
#include "preview/frame/background_bake.h"
#include "preview/frame/scene_edits.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"
#include "tests/bake/import/gltf_maker.h"
#include "tests/support/waiting.h"

namespace oriel {
namespace {

using ::testing::HasSubstr;

Bytes tail_of(const Bytes& glb) {
  std::uint32_t json = 0;
  std::memcpy(&json, glb.data() + 12, 4);
  return {glb.begin() + 20 + json, glb.end()};
}

TEST(SceneEdits, ACopyHasThemAndNothingElse) {
  test::TempFolder folder;
  Context context;
  const Bytes glb = *sample::write_glb(sample::make_glass_sphere());
  const auto file = folder.path() / "box.glb", copy = folder.path() / "copy.glb";
  ASSERT_TRUE(write_file_atomically(file, glb));
  const auto before = *load_preview_scene({.file = file, .import = {}}, context);
  SceneEdits edits;
  edits.materials[3] = {{0.25f, 0.5f, 0.75f}, 0.5f, {100, 2000, 30}};  // the light
  const auto edited = edited_file(glb, "box.glb", edits);
  ASSERT_TRUE(edited) << edited.error().text();
  EXPECT_EQ(tail_of(*edited), tail_of(glb));
  ASSERT_TRUE(write_file_atomically(copy, *edited));
  const auto after = load_preview_scene({.file = copy, .import = {}}, context);
  ASSERT_TRUE(after) << after.error().text();
  const SceneMaterial& m = (*after)->scene().materials[3];
  EXPECT_LT(glm::distance(m.base_color, Vec3(0.25f, 0.5f, 0.75f)), 1e-6f);
  EXPECT_LT(glm::distance(m.emission, Vec3(100, 2000, 30)), 1e-2f);
  EXPECT_FLOAT_EQ(m.roughness, 0.5f);
  for (const std::size_t other : {0, 1, 2, 4, 5}) {
    EXPECT_EQ((*after)->scene().materials[other].base_color, before->scene().materials[other].base_color) << other;
    EXPECT_EQ((*after)->scene().materials[other].emission, before->scene().materials[other].emission) << other;
  }
  // The scene that is edited in place is the one that is read.
  edit_scene(*std::const_pointer_cast<PreviewScene>(before), edits);
  const DVec3 power = (*after)->lights->power();
  EXPECT_LT(glm::distance(before->lights->power(), power), 1e-3 * glm::length(power));
}

TEST(SceneEdits, LightsByTheirNodesName) {
  test::Gltf g = test::triangle();
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10.0}},
                                                          {{"type", "point"}, {"name", "spare"}, {"intensity", 5.0}}};
  for (const int light : {0, 1}) {
    g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size());
    g.doc["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  }
  g.doc["nodes"][g.doc["nodes"].size() - 2]["name"] = "lamp";
  SceneEdits edits;
  edits.lights["lamp"] = {{1, 0.5f, 0.25f}, 40};
  const auto edited = edited_file(bytes_of_text(g.text()), "a.gltf", edits);
  ASSERT_TRUE(edited) << edited.error().text();
  test::TempFolder folder;
  Context context;
  ASSERT_TRUE(write_file_atomically(folder.path() / "a.gltf", *edited));
  const auto scene = load_preview_scene({.file = folder.path() / "a.gltf", .import = {}}, context);
  ASSERT_TRUE(scene) << scene.error().text();
  ASSERT_EQ((*scene)->scene().lights.size(), 2u);
  EXPECT_EQ((*scene)->scene().lights[0].intensity, Vec3(40, 20, 10));
  EXPECT_EQ((*scene)->scene().lights[1].intensity, Vec3(5));
  edits.lights["nobody"] = {};
  const auto wrong = edited_file(bytes_of_text(g.text()), "a.gltf", edits);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().text(), HasSubstr("nobody"));
  EXPECT_FALSE(edited_file(bytes_of_text("no json"), "a.gltf", edits));
}

// Below a parent that turns by a quarter about +Y and doubles: a metre along +X of the world is half a unit along its
// +Z.
TEST(SceneEdits, LightsAreMovedWhereverTheyHang) {
  test::Gltf g = test::triangle();
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10.0}}};
  const std::size_t parent = g.doc["nodes"].size();
  g.doc["scenes"][0]["nodes"].push_back(parent);
  const float half = std::sqrt(0.5f);
  g.doc["nodes"].push_back({{"rotation", {0, half, 0, half}}, {"scale", {2, 2, 2}}, {"children", {parent + 1}}});
  g.doc["nodes"].push_back(
      {{"name", "lamp"}, {"translation", {0, 1, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  test::TempFolder folder;
  Context context;
  const auto load = [&](const Bytes& bytes) {
    EXPECT_TRUE(write_file_atomically(folder.path() / "a.gltf", bytes));
    return *load_preview_scene({.file = folder.path() / "a.gltf", .import = {}}, context);
  };
  const Bytes file = bytes_of_text(g.text());
  const auto before = load(file);
  SceneEdits edits;
  LightEdit& edit = edits.lights["lamp"] = edit_of(before->scene().lights[0]);
  const Vec3 by(1, -0.5f, 0.25f);
  edit.place += by, edit.moved += by;
  const auto edited = edited_file(file, "a.gltf", edits);
  ASSERT_TRUE(edited) << edited.error().text();
  const auto after = load(*edited);
  EXPECT_LT(glm::distance(after->scene().lights[0].position, before->scene().lights[0].position + by), 1e-5f);
  edit_scene(*std::const_pointer_cast<PreviewScene>(before), edits);
  EXPECT_LT(glm::distance(after->scene().lights[0].position, before->scene().lights[0].position), 1e-5f);
  // The file is saved with the lamp elsewhere: what the panel moved stays where it is, what it coloured goes along.
  SceneEdits originals = edits_of(after->scene()), coloured = edits;
  originals.lights["lamp"].place += Vec3(0, 3, 0);
  coloured.lights["lamp"].moved = Vec3(0);
  follow_places(originals, Vec3(0), edits), follow_places(originals, Vec3(0), coloured);
  EXPECT_LT(glm::distance(edits.lights["lamp"].moved, Vec3(0, -3, 0)), 1e-5f);
  EXPECT_LT(glm::distance(coloured.lights["lamp"].place, originals.lights["lamp"].place), 1e-5f);
  g.doc["nodes"][parent]["scale"] = {0, 0, 0};
  EXPECT_FALSE(edited_file(bytes_of_text(g.text()), "a.gltf", edits));
}

// Two nodes without a name share a light: a colour is of both, a place of neither.
TEST(SceneEdits, LightsOfOneNameStayWhereTheyAre) {
  test::Gltf g = test::triangle();
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10.0}}};
  for (const double x : {1.0, 2.0}) {
    g.doc["scenes"][0]["nodes"].push_back(g.doc["nodes"].size());
    g.doc["nodes"].push_back({{"translation", {x, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  test::TempFolder folder;
  Context context;
  ASSERT_TRUE(write_file_atomically(folder.path() / "a.gltf", bytes_of_text(g.text())));
  const auto scene = *load_preview_scene({.file = folder.path() / "a.gltf", .import = {}}, context);
  const auto places = [&] { return std::array{scene->scene().lights[0].position, scene->scene().lights[1].position}; };
  const auto before = places();
  ASSERT_NE(before[0], before[1]);
  EXPECT_FALSE(is_alone(scene->scene(), scene->scene().lights[0].name));
  SceneEdits edits, originals = edits_of(scene->scene());
  LightEdit edit = edit_of(scene->scene().lights[0]);
  edit.color = Vec3(1, 0, 0);
  edits.lights[scene->scene().lights[0].name] = edit;
  for (const SceneEdits* each : {&edits, &originals}) {
    edit_scene(*std::const_pointer_cast<PreviewScene>(scene), *each);
    EXPECT_EQ(places(), before);
  }
}

bool wait_for(BackgroundBake& bake) {
  bool well = false;
  return testing::wait_until([&] { return (well = bake.ended_well()) || !bake.runs(); }) && well;
}

TEST(BackgroundBakes, TellHowFarTheyAreAndWhatFailed) {
  BackgroundBake bake;
  const std::string progress = R"({"event":"progress","stage":"radiosity","fraction":0.5,"seconds_left":12})";
  ASSERT_TRUE(bake.start({"/bin/sh", "-c", "echo '" + progress + "' >&2"}));
  EXPECT_TRUE(wait_for(bake));
  EXPECT_EQ(bake.stage(), "radiosity");
  EXPECT_EQ(bake.fraction(), 0.5);
  EXPECT_EQ(bake.left_s(), 12);
  ASSERT_TRUE(bake.start({"/bin/sh", "-c", R"(echo '{"event":"error","message":"no such light"}' >&2; exit 3)"}));
  EXPECT_FALSE(wait_for(bake));
  EXPECT_EQ(bake.failure(), "no such light");
  EXPECT_FALSE(bake.start({"/nowhere/oriel-bake"}));
  ASSERT_TRUE(bake.start({"/bin/sleep", "100"}));
  EXPECT_TRUE(bake.runs());
  bake.stop();
  EXPECT_FALSE(bake.runs());
}

}  // namespace
}  // namespace oriel
