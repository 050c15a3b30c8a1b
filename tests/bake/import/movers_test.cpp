// bake/import: what is a mover, where it stands and goes, and what is left without it.
#include "bake/import/movers.h"

#include <gtest/gtest.h>

#include "formats/query/mover_pose.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

const json kMover = {{"oriel", {{"mover", true}}}};

// A triangle "wall" that stands still, and a node "door" with a triangle below it.
Gltf with_door() {
  Gltf g = triangle();
  g.doc["nodes"][0]["name"] = "wall";
  g.add_triangle();
  json& nodes = g.doc["nodes"];
  nodes[1]["name"] = "leaf";
  nodes[1]["translation"] = {0, 0, 2};
  nodes.push_back({{"name", "door"}, {"children", {1}}});
  g.doc["scenes"][0]["nodes"] = {0, 2};
  return g;
}

std::vector<std::int32_t> movers_of(const Scene& scene) {
  std::vector<std::int32_t> movers;
  for (const Surface& surface : scene.surfaces) movers.push_back(surface.mover);
  return movers;
}

using Movers = std::vector<std::int32_t>;

TEST(Movers, AreMarkedInTheFileByNameOrByAnimation) {
  EXPECT_EQ(movers_of(import(with_door()).scene()), (Movers{-1, -1}));
  Gltf marked = with_door();
  marked.doc["nodes"][2]["extras"] = kMover;
  Gltf animated = with_door();
  animate(animated, 2, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "LINEAR");
  ImportOptions by_name;
  by_name.objects = {{"door", {{"mover", ""}}}};
  for (const Imported& r : {import(marked), import(animated), import(with_door(), by_name)}) {
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_EQ(movers_of(r.scene()), (Movers{-1, 0}));
    ASSERT_EQ(r.scene().movers.size(), 1u);
    EXPECT_EQ(r.scene().movers[0].name, "door");
    EXPECT_TRUE(r.warnings.empty());
  }
}

TEST(Movers, TheNearestMarkedNodeTakesAMesh) {
  Gltf g = with_door();
  g.doc["nodes"][1]["extras"] = kMover;
  g.doc["nodes"][2]["extras"] = kMover;
  const Imported r = import(g);
  ASSERT_EQ(r.scene().movers.size(), 1u);
  EXPECT_EQ(r.scene().movers[0].name, "leaf");
  EXPECT_TRUE(r.warned("\"door\" shows no mesh"));
}

TEST(Movers, AnUnknownNameListsThoseLikeIt) {
  ImportOptions options;
  options.objects = {{"dor", {{"mover", ""}}}};
  const Imported r = import(with_door(), options);
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(r.result.error().code, ErrorCode::kUsage);
  EXPECT_NE(r.error().find("found the node \"dor\""), std::string::npos) << r.error();
  EXPECT_NE(r.error().find("\"door\", \"leaf\", \"wall\""), std::string::npos) << r.error();
}

TEST(Movers, LightsAndEmittersStandStill) {
  Gltf g = with_door();
  g.doc["nodes"][2]["extras"] = kMover;
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([{"type":"point"}])").value();
  g.doc["nodes"][2]["extensions"] = {{"KHR_lights_punctual", {{"light", 0}}}};
  const Imported lamp = import(g);
  EXPECT_TRUE(lamp.warned("carries the light \"door\""));
  EXPECT_EQ(movers_of(lamp.scene()), (Movers{-1, 0}));

  Gltf shining = with_door();
  shining.doc["nodes"][2]["extras"] = kMover;
  shining.material()["emissiveFactor"] = {1, 1, 1};
  shining.doc["meshes"][1]["primitives"][0]["material"] = 0;
  const Imported r = import(shining);
  EXPECT_TRUE(r.warned("\"door\" has an emissive material"));
  EXPECT_EQ(movers_of(r.scene()), (Movers{-1, -1}));
  EXPECT_TRUE(r.scene().movers.empty());
}

// The wall is a bracket that shines not, the leaf its shade; a bulb and a sun hang on it.
Gltf with_swinging_lamp() {
  Gltf g = with_door();
  g.material()["emissiveFactor"] = {1, 1, 1};
  g.doc["meshes"][1]["primitives"][0]["material"] = 0;
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] =
      json::parse(R"([{"type":"point"},{"type":"directional"}])").value();
  json& nodes = g.doc["nodes"];
  nodes.push_back({{"name", "bulb"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  nodes.push_back({{"name", "sun"}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
  nodes[2]["children"] = {1, 3, 4};
  return g;
}

TEST(Movers, LampsThatTheFileAnimatesHaveItsMotion) {
  Gltf g = with_swinging_lamp();
  animate(g, 2, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  const Scene& scene = r.scene();
  EXPECT_EQ(movers_of(scene), (Movers{-1, -1})) << "their light is baked where they rest";
  EXPECT_TRUE(scene.movers.empty());
  ASSERT_EQ(scene.lamp_motions.size(), 1u);
  EXPECT_EQ(scene.lamp_motions[0].name, "door");
  EXPECT_EQ(scene.lamp_motions[0].keys.size(), 2u);
  EXPECT_EQ(scene.surfaces[0].motion, -1);
  EXPECT_EQ(scene.surfaces[1].motion, 0);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].motion, 0);
  EXPECT_EQ(scene.lights[1].motion, -1) << "a sun is no lamp that moves";
  EXPECT_TRUE(r.warned("carries the light \"sun\""));
}

TEST(Movers, WhatDoesNotShineOfAnAnimatedLampGoesAlong) {
  Gltf g = with_swinging_lamp();
  g.doc["nodes"][2]["children"].push_back(0);  // the wall as the lamp's arm
  g.doc["scenes"][0]["nodes"] = {2};
  animate(g, 2, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().movers.size(), 1u);
  EXPECT_EQ(r.scene().movers[0].keys.size(), 2u);
  ASSERT_EQ(r.scene().lamp_motions.size(), 1u);
  EXPECT_EQ(r.scene().lamp_motions[0].name, "door light") << "the body has the node's name";
  for (const Surface& surface : r.scene().surfaces) {
    EXPECT_EQ(surface.mover, surface.name == "wall" ? 0 : -1);
    EXPECT_EQ(surface.motion, surface.name == "wall" ? -1 : 0);
  }
}

TEST(Movers, LampsArePutElsewhereByTheirMiddle) {
  Scene scene = import(with_swinging_lamp()).scene();
  const Scene before = scene;
  const std::vector<MoverMove> moves{{"leaf", DVec3(1, 2, 3), kPiD / 2}, {"bulb", DVec3(0, 5, 0), 0}};
  ASSERT_TRUE(move_nodes(moves, scene));
  Vec3 lower(1e9f), upper(-1e9f);
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t leaf = scene.triangles[1][c], wall = scene.triangles[0][c];
    EXPECT_EQ(scene.positions[wall], before.positions[wall]);
    lower = glm::min(lower, scene.positions[leaf]), upper = glm::max(upper, scene.positions[leaf]);
  }
  EXPECT_LT(glm::distance(0.5f * (lower + upper), Vec3(DVec3(1, 2, 3) - scene.origin)), 1e-5f);
  EXPECT_LT(glm::distance(scene.lights[0].position, Vec3(DVec3(0, 5, 0) - scene.origin)), 1e-5f);
  EXPECT_GT(scene.upper.y, before.upper.y);
  const auto refused = [&](const char* name) {
    const std::vector<MoverMove> one{{name, DVec3(0), 0}};
    return move_nodes(one, scene).error().text();
  };
  EXPECT_NE(
      refused("lea").find("found \"lea\", expected a mover or a lamp of the scene: the nearest are \"leaf\", \"bulb\""),
      std::string::npos)
      << refused("lea");
  Gltf animated = with_swinging_lamp();
  animate(animated, 2, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "LINEAR");
  scene = import(animated).scene();
  EXPECT_NE(refused("leaf").find("expected one that the file does not animate"), std::string::npos);
}

// Turned, scaled, mirrored, far from the origin: object space is rigid, and its vertices come back where they were.
TEST(Movers, ComeBackWhereTheyWere) {
  for (const double mirror : {1.0, -1.0}) {
    Gltf g = with_door();
    g.doc["nodes"][2]["extras"] = kMover;
    g.doc["nodes"][2]["translation"] = {7, -3, 1000};
    g.doc["nodes"][2]["rotation"] = {0.5, 0.5, 0.5, 0.5};
    g.doc["nodes"][2]["scale"] = {2, 3 * mirror, 4};
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    Scene scene = r.scene();
    const auto taken = take_movers(scene);
    ASSERT_TRUE(taken) << taken.error().text();
    ASSERT_EQ(taken->size(), 1u);
    const Scene& object = (*taken)[0].scene;
    EXPECT_EQ(broken_promise(scene), "");
    EXPECT_EQ(broken_promise(object), "");
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_TRUE(scene.movers.empty());
    EXPECT_LT(scene.upper.z - scene.lower.z, 1e-4);
    ASSERT_EQ(object.triangles.size(), 1u);
    EXPECT_LT(glm::length(object.positions[0]), 10);
    const DMat4 m = pack_from_object((*taken)[0].mover.rest);
    EXPECT_NEAR(glm::determinant(DMat3(m)), 1, 1e-9);
    for (int c = 0; c < 3; ++c) {
      const Vec3 p(m * DVec4(DVec3(object.positions[object.triangles[0][c]]), 1));
      const Vec3 before = r.scene().positions[r.scene().triangles[1][c]];
      EXPECT_NEAR(glm::length(p - before), 0, 1e-4);
    }
    const Vec3 normal(DMat3(m) * DVec3(geometric_normal(object, 0)));
    EXPECT_NEAR(glm::dot(normal, geometric_normal(r.scene(), 1)), 1, 1e-6);
  }
}

TEST(Movers, AreMovedWithTheirSurfaces) {
  Gltf g = with_door();
  g.doc["nodes"][2]["extras"] = kMover;
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  Scene scene = r.scene();
  const MoverPose rest = scene.movers[0].rest;
  const MoverPose there = moved(rest, {"door", DVec3(3, 40, -2), kPiD / 2}, scene.origin);
  const std::vector<MoverMove> away{{"door", DVec3(3, 40, -2), kPiD / 2}};
  ASSERT_TRUE(move_nodes(away, scene));
  const DMat4 change = pack_from_object(there) * glm::inverse(pack_from_object(rest));
  for (int c = 0; c < 3; ++c) {
    const UVec3 wall = scene.triangles[0], door = scene.triangles[1];
    EXPECT_EQ(scene.positions[wall[c]], r.scene().positions[wall[c]]);
    const Vec3 expected(change * DVec4(DVec3(r.scene().positions[door[c]]), 1));
    EXPECT_NEAR(glm::length(scene.positions[door[c]] - expected), 0, 1e-4);
  }
  EXPECT_GT(scene.upper.y, 30);
  const std::vector<MoverMove> back{{"door", DVec3(rest.position) + scene.origin, -kPiD / 2}};
  ASSERT_TRUE(move_nodes(back, scene));
  for (std::size_t v = 0; v < scene.positions.size(); ++v)
    EXPECT_NEAR(glm::length(scene.positions[v] - r.scene().positions[v]), 0, 1e-4);
}

TEST(Movers, KeysTellPlaceAndTurn) {
  Gltf g = with_door();
  // The hinge turns by a right angle about Y; the leaf is 2 m along its Z.
  animate(g, 2, "rotation", {0, 2}, {0, 0, 0, 1, 0, 0.70710678f, 0, 0.70710678f}, "LINEAR");
  const Imported door = import(g);
  ASSERT_EQ(door.scene().movers.size(), 1u);
  const std::vector<MoverKey>& keys = door.scene().movers[0].keys;
  ASSERT_EQ(keys.size(), 19u);
  EXPECT_EQ(keys.back().time_s, 2);
  EXPECT_NEAR(std::abs(keys.back().pose.rotation.y), 0.70710678, 1e-6);
  EXPECT_EQ(keys.back().pose.position, keys.front().pose.position);
  // As a mover of its own the leaf swings round the hinge.
  g.doc["nodes"][1]["extras"] = kMover;
  const std::vector<MoverKey> leaf = import(g).scene().movers.at(0).keys;
  EXPECT_NEAR(leaf.back().pose.position.x - leaf.front().pose.position.x, 2, 1e-5);
  EXPECT_NEAR(leaf.back().pose.position.z - leaf.front().pose.position.z, -2, 1e-5);
  for (std::size_t i = 1; i < leaf.size(); ++i) EXPECT_GT(leaf[i].time_s, leaf[i - 1].time_s);
}

TEST(Movers, ASceneOfMoversAloneIsRefused) {
  ImportOptions options;
  options.objects = {{"door", {{"mover", ""}}}, {"wall", {{"mover", ""}}}};
  const Imported r = import(with_door(), options);
  ASSERT_TRUE(r.ok()) << r.error();
  Scene scene = r.scene();
  const auto taken = take_movers(scene);
  ASSERT_FALSE(taken);
  EXPECT_NE(taken.error().text().find("movers only"), std::string::npos);
}

}  // namespace
}  // namespace oriel::test
