#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

const SampleScene& gallery() {
  static const SampleScene scene = make_gallery();
  return scene;
}
const std::vector<Triangle>& gallery_triangles() {
  static const std::vector<Triangle> triangles = flatten(gallery());
  return triangles;
}

TEST(Gallery, FloorIsAsRoughAsAsked) {
  const auto tiles = [](const SampleScene& scene) {
    return std::find_if(scene.materials.begin(), scene.materials.end(),
                        [](const SampleMaterial& m) { return m.name == "polished tiles"; })
        ->roughness;
  };
  EXPECT_FLOAT_EQ(tiles(gallery()), 0.1f);
  EXPECT_FLOAT_EQ(tiles(make_gallery({.floor_roughness = 0.4f})), 0.4f);
}

TEST(Gallery, HasWhatItPromises) {
  const SampleScene& scene = gallery();
  EXPECT_GE(triangle_count(scene), 20'000u);
  EXPECT_LE(triangle_count(scene), 60'000u);
  std::set<std::string> nodes;
  for (const Node& node : scene.nodes) EXPECT_TRUE(nodes.insert(node.name).second) << node.name << " twice";
  for (const char* name : {"A floor", "B floor", "C floor", "B platform", "mirror", "brushed panel", "window sky",
                           "A column 1 shaft", "A bench seat", "A picture 1 canvas"}) {
    EXPECT_TRUE(nodes.contains(name)) << name;
  }
  std::set<std::string> cameras;
  for (const SampleCamera& camera : scene.cameras) cameras.insert(camera.name);
  for (const char* name : {"entrance", "mirror", "floor", "doorway", "stairs"})
    EXPECT_TRUE(cameras.contains(name)) << name;
  const auto material_of = [&](const char* name) {
    const auto node =
        std::find_if(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) { return n.name == name; });
    return scene.materials[scene.meshes[node->mesh].material];
  };
  EXPECT_EQ(material_of("A floor").roughness, 0.1f);
  EXPECT_EQ(material_of("A floor").metallic, 0);
  EXPECT_EQ(material_of("mirror").roughness, 0);
  EXPECT_EQ(material_of("mirror").metallic, 1);
  EXPECT_EQ(material_of("brushed panel").roughness, 0.3f);
}

TEST(Gallery, IsSound) {
  for (const Triangle& t : gallery_triangles()) ASSERT_EQ(fault(t), "") << gallery().nodes[t.node].name;
}

TEST(Gallery, HasNoCoplanarOverlaps) {
  EXPECT_EQ(coplanar_overlaps(gallery()), std::vector<std::string>{});
}

TEST(Gallery, IsClosedAndShowsOnlyFronts) {
  const SampleScene& scene = gallery();
  std::vector<Vec3> eyes{Vec3(1, 0.3f, 7.7f), Vec3(11, 2.9f, 7), Vec3(6.5f, 3, -8)};
  for (std::size_t i = 0; i < 600; i += 100) eyes.push_back(scene.paths[0].eyes[i]);
  for (const Vec3& eye : eyes) {
    for (const Vec3& direction : directions(120)) {
      const auto seen = cast(gallery_triangles(), eye, direction);
      ASSERT_TRUE(seen) << "a hole seen from " << eye.x << " " << eye.y << " " << eye.z;
      EXPECT_TRUE(seen->front) << "the back of " << scene.nodes[gallery_triangles()[seen->triangle].node].name;
    }
  }
}

TEST(Gallery, RoomCIsLitOnlyThroughItsDoorway) {
  for (const Triangle& t : gallery_triangles()) {
    if (max_component(gallery().materials[t.material].emission) > 0) {
      EXPECT_GT(t.p[0].z, 0) << gallery().nodes[t.node].name;
    }
  }
}

TEST(Gallery, TheWalkGoesThroughAllRoomsAndNoWall) {
  ASSERT_EQ(gallery().paths.size(), 1u);
  const Path& path = gallery().paths[0];
  EXPECT_EQ(path.name, "walk");
  ASSERT_EQ(path.eyes.size(), 600u);
  std::set<char> rooms;
  for (std::size_t i = 0; i < path.eyes.size(); ++i) {
    const Vec3& eye = path.eyes[i];
    EXPECT_FLOAT_EQ(eye.y, 1.6f);
    rooms.insert(eye.x < 6 ? 'A' : eye.z > 0 ? 'B' : 'C');
    if (i % 5 == 0) {
      EXPECT_GT(clearance(gallery_triangles(), eye), 0.4) << i;
    }
    if (i == 0) continue;
    EXPECT_LT(glm::distance(eye, path.eyes[i - 1]), 0.06f) << i;
    EXPECT_GT(glm::dot(path.forwards[i], path.forwards[i - 1]), std::cos(5.0f * kPi / 180)) << i;
  }
  EXPECT_EQ(rooms, (std::set<char>{'A', 'B', 'C'}));
}

}  // namespace
}  // namespace oriel::sample
