// Morph targets and skins: meshes stand as the file's weights and joints do at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

// A mesh of one triangle with two targets: the first moves all by (0, 0, 2), the second the third corner by (0, 3, 0).
json& add_morphed(Gltf& g) {
  const int p = g.floats("VEC3", kTriangle);
  const int up = g.floats("VEC3", {0, 0, 2, 0, 0, 2, 0, 0, 2}), tip = g.floats("VEC3", {0, 0, 0, 0, 0, 0, 0, 3, 0});
  json targets = json::array({{{"POSITION", up}}, {{"POSITION", tip}}});
  return g.add({{"attributes", {{"POSITION", p}}}, {"targets", targets}});
}

// Corner k of the first triangle of a surface, in the world.
DVec3 corner(const Scene& scene, std::size_t surface, int k) {
  return scene.origin + DVec3(scene.positions[scene.triangles[scene.surfaces[surface].first_triangle][k]]);
}

void expect_near(const DVec3& found, const DVec3& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
}

TEST(Deform, MorphTargetsStandByTheirDefaultWeights) {
  Gltf g;
  add_morphed(g);
  g.doc["meshes"][0]["weights"] = {0.5, 1};
  json own = {{"mesh", 0}, {"weights", {0, 0.5}}, {"translation", {10, 0, 0}}};
  g.doc["nodes"].push_back(own);
  g.doc["scenes"][0]["nodes"].push_back(1);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(broken_promise(r.scene()), "");
  EXPECT_TRUE(r.warnings.empty());
  expect_near(corner(r.scene(), 0, 0), {0, 0, 1});
  expect_near(corner(r.scene(), 0, 2), {0, 4, 1});
  expect_near(corner(r.scene(), 1, 0), {10, 0, 0});
  expect_near(corner(r.scene(), 1, 2), {10, 2.5, 0});
}

TEST(Deform, TargetsWithoutWeightsDoNothing) {
  Gltf g;
  add_morphed(g);
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  expect_near(corner(r.scene(), 0, 2), {0, 1, 0});
}

// A mesh may be closed in its base shape, and open at rest.
TEST(Deform, ABaseShapeWithoutAreaOpens) {
  Gltf g;
  const int p = g.floats("VEC3", {0, 0, 0, 1, 0, 0, 2, 0, 0}), open = g.floats("VEC3", {0, 0, 0, 0, 0, 0, -2, 1, 0});
  g.add({{"attributes", {{"POSITION", p}}}, {"targets", json::array({{{"POSITION", open}}})}});
  g.doc["meshes"][0]["weights"] = {1};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_NEAR(triangle_area(r.scene(), 0), 0.5, 1e-6);
}

// A skinned triangle as exporters of characters write it: the mesh in metres, the joints in centimetres below an
// armature that is turned and scaled, the mesh's own node anywhere.
Gltf skinned(const json& weights) {
  Gltf g;
  const int p = g.floats("VEC3", kTriangle), n = g.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  std::string bytes;
  for (int i = 0; i < 3; ++i) bytes += std::string("\0\1\0\0", 4);
  const int joints = g.accessor(bytes, 5121, "VEC4", 3);
  std::vector<float> w;
  for (int i = 0; i < 3; ++i) w.insert(w.end(), {weights[0].get<float>(), weights[1].get<float>(), 0, 0});
  json attributes = {{"POSITION", p}, {"NORMAL", n}, {"JOINTS_0", joints}, {"WEIGHTS_0", g.floats("VEC4", w)}};
  g.add({{"attributes", attributes}})["translation"] = {100, 200, 300};
  g.doc["nodes"][0]["skin"] = 0;
  const double h = std::sqrt(0.5);
  g.doc["nodes"].push_back({{"scale", {0.01, 0.01, 0.01}}, {"rotation", {-h, 0, 0, h}}, {"children", {2, 3}}});
  g.doc["nodes"].push_back({{"name", "still"}});
  g.doc["nodes"].push_back({{"name", "moved"}, {"translation", {500, 0, 0}}, {"rotation", {0, 0, h, h}}});
  g.doc["scenes"][0]["nodes"].push_back(1);
  // Both were bound where the armature is: y up and metres to z up and centimetres.
  const std::vector<float> bind{100, 0, 0, 0, 0, 0, 100, 0, 0, -100, 0, 0, 0, 0, 0, 1};
  const std::string matrix(reinterpret_cast<const char*>(bind.data()), bind.size() * sizeof(float));
  const int inverse = g.accessor(matrix + matrix, 5126, "MAT4", 2);
  g.doc["skins"] = json::array({{{"joints", {2, 3}}, {"inverseBindMatrices", inverse}}});
  return g;
}

TEST(Deform, SkinsStandWhereTheirJointsAre) {
  const Imported still = import(skinned({1, 0}));
  ASSERT_TRUE(still.ok()) << still.error();
  EXPECT_EQ(broken_promise(still.scene()), "");
  EXPECT_TRUE(still.warnings.empty());
  expect_near(corner(still.scene(), 0, 0), {0, 0, 0});
  expect_near(corner(still.scene(), 0, 1), {1, 0, 0});
  expect_near(corner(still.scene(), 0, 2), {0, 1, 0});
  // Turned by 90° about the armature's z, which is up, and 5 m along x: x goes to −z, z to x.
  const Imported moved = import(skinned({0, 1}));
  ASSERT_TRUE(moved.ok()) << moved.error();
  expect_near(corner(moved.scene(), 0, 0), {5, 0, 0});
  expect_near(corner(moved.scene(), 0, 1), {5, 0, -1});
  expect_near(corner(moved.scene(), 0, 2), {5, 1, 0});
  EXPECT_NEAR(moved.scene().normals[0].x, 1, 1e-6);
  const Imported half = import(skinned({0.5, 0.5}));
  ASSERT_TRUE(half.ok()) << half.error();
  expect_near(corner(half.scene(), 0, 1), {3, 0, -0.5});
}

TEST(Deform, WhatAJointMirrorsKeepsItsFront) {
  Gltf g = skinned({1, 0});
  g.doc["nodes"][2]["scale"] = {-1, 1, 1};
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(broken_promise(r.scene()), "");
  EXPECT_TRUE(r.warnings.empty());
  EXPECT_NEAR(geometric_normal(r.scene(), 0).z, 1, 1e-6);
}

TEST(Deform, AnimatedDeformationIsToldOf) {
  Gltf g = skinned({1, 0});
  animate(g, 3, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0}, "LINEAR");
  const Imported r = import(g);
  ASSERT_TRUE(r.ok()) << r.error();
  EXPECT_TRUE(r.warned("animations of skins and of morph targets are left out"));
}

TEST(Deform, BadSkinsAreRefused) {
  Gltf few = skinned({1, 0});
  few.doc["skins"][0]["joints"] = {2};
  EXPECT_TRUE(import(few).ok()) << "the second joint has no weight";
  Gltf used = skinned({0, 1});
  used.doc["skins"][0]["joints"] = {2};
  EXPECT_NE(import(used).error().find("found joint 1"), std::string::npos) << import(used).error();
  Gltf elsewhere = skinned({1, 0});
  elsewhere.doc["scenes"][0]["nodes"] = {0};
  EXPECT_NE(import(elsewhere).error().find("the joint nodes[2] outside of the scene"), std::string::npos);
  Gltf empty = skinned({1, 0});
  empty.doc["skins"][0]["joints"] = json::array();
  EXPECT_NE(import(empty).error().find("at least one joint"), std::string::npos) << import(empty).error();
  Gltf bind = skinned({1, 0});
  bind.doc["skins"][0]["inverseBindMatrices"] = 0;
  EXPECT_NE(import(bind).error().find("MAT4"), std::string::npos) << import(bind).error();
}

}  // namespace
}  // namespace oriel::test
