// Cameras, lights and walks.
#include <gtest/gtest.h>

#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

// A triangle and a camera node (node 1) 5 m before it, turned to look along -X.
Gltf with_camera() {
  Gltf g = triangle();
  g.doc["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
  g.doc["nodes"].push_back({{"camera", 0},
                            {"name", "walk"},
                            {"translation", {0, 0, 5}},
                            {"rotation", {0, 0.7071067811865476, 0, 0.7071067811865476}}});
  g.doc["scenes"][0]["nodes"] = {0, 1};
  return g;
}

TEST(Viewpoints, CamerasStandInSceneSpace) {
  Gltf g = with_camera();
  g.doc["cameras"].push_back({{"type", "orthographic"},
                              {"name", "ortho"},
                              {"orthographic", {{"xmag", 1}, {"ymag", 2}, {"znear", 0}, {"zfar", 1}}}});
  g.doc["nodes"].push_back({{"camera", 1}, {"scale", {1, -3, 1}}});
  g.doc["scenes"][0]["nodes"].push_back(2);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().cameras.size(), 2u);
  const Camera& c = r.scene().cameras[0];
  EXPECT_EQ(c.name, "walk");
  EXPECT_NEAR(glm::length(c.eye - Vec3(-0.5f, -0.5f, 5)), 0, 1e-6);
  EXPECT_NEAR(glm::length(c.forward - Vec3(-1, 0, 0)), 0, 1e-6);
  EXPECT_NEAR(glm::length(c.up - Vec3(0, 1, 0)), 0, 1e-6);
  EXPECT_FLOAT_EQ(c.vertical_fov_rad, 0.8f);
  EXPECT_EQ(r.scene().cameras[1].name, "ortho");
  EXPECT_EQ(r.scene().cameras[1].vertical_fov_rad, 0);
  EXPECT_EQ(r.scene().cameras[1].half_height, 2);
}

TEST(Viewpoints, BrokenCamerasAndLightsAreNamed) {
  Gltf g = with_camera();
  g.doc["nodes"][1]["scale"] = {0, 0, 0};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.scene().cameras.empty());
  EXPECT_TRUE(r.warned("walk"));
}

TEST(Viewpoints, PunctualLights) {
  Gltf g = triangle();
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = json::parse(R"([
    {"type":"point","color":[1,0.5,0],"intensity":100,"range":3},
    {"type":"spot","intensity":7,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
    {"type":"directional"}])")
                                                             .value();
  for (int i = 0; i < 3; ++i) {
    g.doc["nodes"].push_back({{"translation", {1, 2, 3}},
                              {"rotation", {-0.7071067811865476, 0, 0, 0.7071067811865476}},
                              {"scale", {9, 9, 9}},
                              {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    g.doc["scenes"][0]["nodes"].push_back(i + 1);
  }
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().lights.size(), 3u);
  EXPECT_TRUE(r.warned("range 3"));
  const Light& point = r.scene().lights[0];
  EXPECT_EQ(point.intensity, Vec3(100, 50, 0));
  EXPECT_NEAR(glm::length(point.position - Vec3(0.5f, 1.5f, 3)), 0, 1e-6);
  EXPECT_EQ(r.scene().lights[1].type, LightType::kSpot);
  EXPECT_FLOAT_EQ(r.scene().lights[1].outer_cone_rad, 0.2f);
  EXPECT_NEAR(glm::length(r.scene().lights[1].direction - Vec3(0, -1, 0)), 0, 1e-6);
  EXPECT_EQ(r.scene().lights[2].type, LightType::kDirectional);
  EXPECT_EQ(r.scene().lights[2].intensity, Vec3(1));

  json& first = g.doc["extensions"]["KHR_lights_punctual"]["lights"][0];
  for (const char* bad : {R"({"type":"sun"})", R"({"type":"point","color":[1,-1,0]})"}) {
    first = json::parse(bad).value();
    EXPECT_NE(import(g).error().find("lights[0]"), std::string::npos) << bad;
  }
  // A hard edge; and angles that glTF does not allow, with a word.
  struct Cone {
    const char* spot;
    float inner, outer;
    bool warns;
  };
  for (const Cone& cone : {Cone{R"({"innerConeAngle":0.2,"outerConeAngle":0.2})", 0.2f, 0.2f, false},
                           Cone{R"({"innerConeAngle":0.3,"outerConeAngle":0.2})", 0.2f, 0.2f, true},
                           Cone{R"({"innerConeAngle":-1,"outerConeAngle":2})", 0, kPi / 2, true}}) {
    first = {{"type", "spot"}, {"spot", json::parse(cone.spot).value()}};
    const Imported spot = import(g);
    ASSERT_TRUE(spot.ok()) << spot.error();
    EXPECT_FLOAT_EQ(spot.scene().lights[0].inner_cone_rad, cone.inner);
    EXPECT_FLOAT_EQ(spot.scene().lights[0].outer_cone_rad, cone.outer);
    EXPECT_EQ(spot.warned("cone angles are taken as"), cone.warns) << cone.spot;
  }
  first = {{"type", "point"}, {"intensity", -1}};
  EXPECT_TRUE(import(g).warned("lights[0].intensity: the intensity is negative"));
  EXPECT_EQ(import(g).scene().lights[0].intensity, Vec3(0));
}

// Radians are often written as degrees.
TEST(Viewpoints, CamerasThatCannotSeeAreLeftOut) {
  Gltf g = with_camera();
  ASSERT_EQ(import(g).scene().cameras.size(), 1u);
  for (const double yfov : {0.0, 45.0, -1.0}) {
    g.doc["cameras"][0]["perspective"]["yfov"] = yfov;
    const Imported r = import(g);
    ASSERT_TRUE(r.ok()) << r.error();
    EXPECT_TRUE(r.scene().cameras.empty());
    EXPECT_TRUE(r.warned("cameras[0].perspective.yfov: no angle between 0 and π rad"));
  }
}

// An IES profile turns with its node, and is mirrored with it.
TEST(Viewpoints, AxesOfLampsAreThoseOfTheirNode) {
  Gltf g = triangle();
  g.use("KHR_lights_punctual");
  g.doc["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  g.doc["nodes"].push_back({{"scale", {-1, 1, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  g.doc["scenes"][0]["nodes"].push_back(1);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(r.scene().lights[0].right, Vec3(-1, 0, 0));
  EXPECT_TRUE(r.scene().lights[0].mirrored);
  EXPECT_EQ(r.scene().lights[0].direction, Vec3(0, 0, -1));
}

TEST(Paths, TranslationKeys) {
  Gltf g = with_camera();
  animate(g, 1, "translation", {0, 1, 3}, {0, 0, 5, 1, 0, 5, 1, 2, 5}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  ASSERT_EQ(r.scene().paths.size(), 1u);
  const CameraPath& path = r.scene().paths[0];
  EXPECT_EQ(path.name, "walk");
  EXPECT_FLOAT_EQ(path.vertical_fov_rad, 0.8f);
  ASSERT_EQ(path.keys.size(), 3u);
  EXPECT_EQ(path.keys[2].time_s, 3);
  EXPECT_NEAR(glm::length(path.keys[2].eye - Vec3(0.5f, 1.5f, 5)), 0, 1e-6);
  EXPECT_NEAR(glm::length(path.keys[2].forward - Vec3(-1, 0, 0)), 0, 1e-6);
  EXPECT_TRUE(r.warnings.empty());
}

TEST(Paths, StepsJump) {
  Gltf g = with_camera();
  animate(g, 1, "translation", {0, 1}, {0, 0, 5, 4, 0, 5}, "STEP");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  const auto& keys = r.scene().paths.at(0).keys;
  ASSERT_EQ(keys.size(), 3u);  // at 0, just before 1, at 1
  EXPECT_EQ(keys[1].time_s, 1);
  EXPECT_EQ(keys[1].eye, keys[0].eye);
  EXPECT_EQ(keys[2].time_s, 1);
  EXPECT_NEAR(keys[2].eye.x - keys[0].eye.x, 4, 1e-6);
}

TEST(Paths, TurnsAreFollowedInSmallSteps) {
  Gltf g = with_camera();
  // Half a turn about Y in one interval.
  animate(g, 1, "rotation", {0, 2}, {0, 0, 0, 1, 0, 1, 0, 0}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  const auto& keys = r.scene().paths.at(0).keys;
  ASSERT_GE(keys.size(), 36u);
  for (std::size_t i = 1; i < keys.size(); ++i) {
    EXPECT_GT(keys[i].time_s, keys[i - 1].time_s);
    EXPECT_GT(glm::dot(keys[i].forward, keys[i - 1].forward), 0.99f);
  }
  EXPECT_NEAR(glm::length(keys.back().forward - Vec3(0, 0, 1)), 0, 1e-6);
}

TEST(Paths, ParentsCarryTheirCameraAlong) {
  Gltf g = with_camera();
  g.doc["nodes"].push_back({{"children", {1}}});
  g.doc["scenes"][0]["nodes"] = {0, 2};
  animate(g, 2, "translation", {0, 1}, {0, 0, 0, 0, 7, 0}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_NEAR(r.scene().paths.at(0).keys.back().eye.y, 6.5, 1e-6);
}

TEST(Paths, OtherAnimationsStandStillWithAWarning) {
  Gltf g = triangle();
  animate(g, 0, "scale", {0, 1}, {1, 1, 1, 1, 2, 1}, "LINEAR");
  g.doc["nodes"].push_back({{"name", "empty"}});
  g.doc["scenes"][0]["nodes"].push_back(1);
  animate(g, 1, "translation", {0, 1}, {0, 0, 0, 1, 1, 1}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.warned("stand still"));
  EXPECT_TRUE(r.scene().paths.empty());
  EXPECT_TRUE(r.scene().movers.empty());
}

TEST(Paths, BrokenTracksAreRefused) {
  Gltf g = with_camera();
  animate(g, 1, "translation", {0, 1}, {0, 0, 5}, "LINEAR");
  EXPECT_NE(import(g).error().find("animations[0].channels[0]"), std::string::npos);
  g = with_camera();
  animate(g, 1, "translation", {1, 1}, {0, 0, 5, 0, 0, 6}, "LINEAR");
  EXPECT_NE(import(g).error().find("increasing"), std::string::npos);
  g = with_camera();
  animate(g, 1, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}, "LINEAR");
  EXPECT_NE(import(g).error().find("zero"), std::string::npos);
  g = with_camera();
  animate(g, 1, "translation", {0, 1}, {0, 0, 5, 0, 0, 6}, "BEZIER");
  EXPECT_NE(import(g).error().find("interpolation"), std::string::npos);
}

}  // namespace
}  // namespace oriel::test
