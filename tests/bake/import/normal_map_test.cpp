// Normal maps: what is read of them, and how they tilt normals (docs/notes/conventions.md, "Normal maps").
#include <gtest/gtest.h>

#include "bake/scene/shade.h"
#include "formats/assets/normal_map.h"
#include "tests/bake/import/gltf_maker.h"

namespace oriel::test {
namespace {

// 1 x 1 texels: (218, 128, 218), tilted by 45 degrees along +x, and (128, 218, 218), up in the image.
constexpr const char* kAlongX =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGO41XALAARsAjUQ4/"
    "RCAAAAAElFTkSuQmCC";
constexpr const char* kUp =
    "data:image/"
    "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGNouHULAAQSAjVDXWrsAAAAAElFTkSuQmCC";

// The triangle (0,0,0) (1,0,0) (0,1,0) with normals +Z and the texture upright on it: u along +X, v down along -Y.
Gltf mapped(const std::vector<float>& tangents = {}, const char* image = kAlongX) {
  Gltf g;
  json attributes = {{"POSITION", g.floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})},
                     {"NORMAL", g.floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1})},
                     {"TEXCOORD_0", g.floats("VEC2", {0, 1, 1, 1, 0, 0})},
                     {"TEXCOORD_1", g.floats("VEC2", {0, 0, 0, 1, 1, 0})}};
  if (!tangents.empty()) attributes["TANGENT"] = g.floats("VEC4", tangents);
  g.add({{"attributes", attributes}, {"material", 0}});
  g.material() = {{"normalTexture", {{"index", 0}}}};
  g.doc["images"] = {{{"uri", image}}};
  g.doc["textures"] = {{{"source", 0}}};
  return g;
}

Vec3 normal_of(const Gltf& g) {
  const Imported r = import(g);
  EXPECT_TRUE(r.ok()) << r.error();
  EXPECT_EQ(broken_promise(r.scene()), "");
  EXPECT_TRUE(r.warnings.empty()) << r.warnings.front();
  const UVec3& t = r.scene().triangles[0];
  return mapped_normal(r.scene(), 0, Vec2(1.0f / 3), r.scene().normals[t.x]);
}

// Of texels stored in 8 bits: within a code, 2/255.
void expect_direction(const Vec3& found, const Vec3& expected) {
  EXPECT_LT(glm::length(found - glm::normalize(expected)), 2.0f / 255) << found.x << " " << found.y << " " << found.z;
}

TEST(NormalMap, FollowsTheTextureCoordinates) {
  expect_direction(normal_of(mapped()), {1, 0, 1});
  expect_direction(normal_of(mapped({}, kUp)), {0, 1, 1});
  Gltf g = mapped();
  g.doc["materials"][0]["normalTexture"]["texCoord"] = 1;  // u along +Y, v along +X: not mirrored
  expect_direction(normal_of(g), {0, 1, 1});
  g = mapped({}, kUp);
  g.doc["materials"][0]["normalTexture"]["texCoord"] = 1;
  expect_direction(normal_of(g), {-1, 0, 1});
}

TEST(NormalMap, MirroredCoordinatesKeepUpInTheImage) {
  Gltf g = mapped({}, kUp);
  json& transform = g.doc["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"];
  transform = {{"scale", {-1, 1}}};
  expect_direction(normal_of(g), {0, 1, 1});
  transform = {{"scale", {1, -1}}};
  expect_direction(normal_of(g), {0, -1, 1});
  g.doc["images"][0]["uri"] = kAlongX;
  transform = {{"scale", {-1, 1}}};
  expect_direction(normal_of(g), {-1, 0, 1});
}

TEST(NormalMap, ScaleStretchesTheTilt) {
  Gltf g = mapped();
  json& scale = g.doc["materials"][0]["normalTexture"]["scale"];
  for (const float s : {0.5f, 2.0f, -1.0f, 0.0f}) {
    scale = s;
    expect_direction(normal_of(g), {s, 0, 1});
  }
  scale = 1e300;
  EXPECT_TRUE(is_finite(normal_of(g)));
}

TEST(NormalMap, TangentsAreTaken) {
  const auto all = [](float x, float y, float z, float w) {
    return std::vector<float>{x, y, z, w, x, y, z, w, x, y, z, w};
  };
  expect_direction(normal_of(mapped(all(0, 1, 0, 1))), {0, 1, 1});
  expect_direction(normal_of(mapped(all(0, 1, 0, 1), kUp)), {-1, 0, 1});
  expect_direction(normal_of(mapped(all(0, 1, 0, -1), kUp)), {1, 0, 1});
  // Without a length they are not there.
  expect_direction(normal_of(mapped(all(0, 0, 0, 1))), {1, 0, 1});
  // Not without normals: the triangle's coordinates are taken.
  Gltf g = mapped(all(0, 1, 0, 1));
  g.doc["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  expect_direction(normal_of(g), {1, 0, 1});
}

// A mirrored node mirrors what the map shows, with and without tangents.
TEST(NormalMap, MirroredNodes) {
  for (const char* image : {kAlongX, kUp})
    for (const bool with_tangents : {false, true}) {
      Gltf g =
          mapped(with_tangents ? std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1} : std::vector<float>{}, image);
      const Vec3 plain = normal_of(g);
      g.doc["nodes"][0]["scale"] = {-1, 1, 1};
      expect_direction(normal_of(g), plain * Vec3(-1, 1, 1));
      g.doc["nodes"][0]["scale"] = {1, 1, -1};  // its front faces -Z then
      expect_direction(normal_of(g), plain * Vec3(1, 1, -1));
      g.doc["nodes"][0]["scale"] = {2, 2, 2};
      expect_direction(normal_of(g), plain);
    }
}

TEST(NormalMap, BrokenTangentsAreRefused) {
  Gltf three = mapped();
  auto& attributes = three.doc["meshes"][0]["primitives"][0]["attributes"];
  attributes["TANGENT"] = three.floats("VEC3", {1, 0, 0, 1, 0, 0, 1, 0, 0});
  EXPECT_NE(import(three).error().find("attributes.TANGENT: found 3 components, expected 4"), std::string::npos)
      << import(three).error();
  Gltf few = mapped();
  few.doc["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = few.floats("VEC4", {1, 0, 0, 1});
  EXPECT_NE(import(few).error().find("found 1 elements, expected 3"), std::string::npos) << import(few).error();
}

TEST(NormalMap, NothingToGoByLeavesTheNormal) {
  const Vec3 n = glm::normalize(Vec3(1, 2, 3));
  const Vec3 texel(1, 0.5f, 1);
  EXPECT_EQ(tilted_normal(n, Vec4(0), texel, 1), n);
  EXPECT_EQ(tilted_normal(n, Vec4(n, 1), texel, 1), n) << "a tangent along the normal";
  EXPECT_EQ(tilted_normal(n, Vec4(1, 0, 0, 1), Vec3(0.5f, 0.5f, 0), 1), n) << "a black texel";
  EXPECT_EQ(Vec3(tangent_of_steps(n, {1, 0, 0}, {0, 1, 0}, Vec2(0.5f), Vec2(0.5f))), Vec3(0));
  // At every scale of space and texture.
  for (const float space : {1e-6f, 1.0f, 1e6f})
    for (const float uv : {1e-6f, 1.0f, 1e4f}) {
      const Vec4 t = tangent_of_steps({0, 0, 1}, Vec3(space, 0, 0), Vec3(0, space, 0), {uv, 0}, {0, -uv});
      expect_direction(tilted_normal({0, 0, 1}, t, Vec3(0.8536f, 0.5f, 0.8536f), 1), {1, 0, 1});
    }
}

}  // namespace
}  // namespace oriel::test
