// From where on a reflector a lamp is seen that has moved.
#include "formats/query/emitter_views.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

constexpr float kHalf = 0.1f;  // of the lamp's side

void add_quad(Mesh& mesh, const Vec3& corner, const Vec3& right, const Vec3& up, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {corner, corner + right, corner + right + up, corner + up}) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(glm::normalize(glm::cross(right, up)));
    mesh.uvs.emplace_back(0), mesh.lightmap_uvs.emplace_back(0);
  }
  mesh.parts.push_back({"", static_cast<std::uint32_t>(mesh.indices.size()), 6, material, 0});
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

// A floor of 4 m that reflects, a lamp of 20 cm 2 m over its middle, and halfway a plate over all x < 0.
struct Hall {
  Mesh mesh;
  std::vector<Material> materials{3};
  Reflector floor;
  Emitter lamp;

  Hall() {
    materials[1].emission = Vec3(1000);
    add_quad(mesh, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 0);
    add_quad(mesh, {-kHalf, 2, -kHalf}, {2 * kHalf, 0, 0}, {0, 0, 2 * kHalf}, 1);
    add_quad(mesh, {-9, 1, -9}, {9, 0, 0}, {0, 0, 18}, 2);
    floor.pack_from_reflector = Mat4(Vec4(1, 0, 0, 0), Vec4(0, 0, -1, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 0, 1));
    floor.lower = Vec2(-2), floor.upper = Vec2(2);
    floor.visibility_x = floor.visibility_y = 5;
    floor.indices.assign(mesh.indices.begin(), mesh.indices.begin() + 6);
    lamp.corners = {{-kHalf, 2, -kHalf}, {kHalf, 2, -kHalf}, {kHalf, 2, kHalf}, {-kHalf, 2, kHalf}};
    lamp.radiance = Vec3(1000);
  }
  std::vector<EmitterView> views(const MoverPose& pose, float alpha, std::int64_t of = -1) const {
    Emitter there = lamp;
    for (Vec3& corner : there.corners) corner = Vec3(Mat4(pack_from_object(pose)) * Vec4(corner, 1));
    const LampScene scene({mesh, materials, {}, {}}, {{1}, {Vec3(1000)}, {}});
    const LiveLight point{there.corners[0], Vec3(0), Vec3(1000 * 4 * kHalf * kHalf)};
    return emitter_views({{&floor, 1}, {&alpha, 1}, {&there, 1}, {&of, 1}, {&point, 1}}, scene, pose, nullptr);
  }
};

MoverPose moved_by(const Vec3& by) {
  MoverPose pose;
  pose.position = by;
  return pose;
}

// A node at x sees the lamp's points with a greater x than -x. Those of the border lie 2 cm inwards.
TEST(EmitterViews, AreWhatThePlateLeavesOfTheLamp) {
  const Hall hall;
  for (const auto& [shift, half] : {std::pair(0, 2), {1, 1}, {-1, 3}}) {
    const auto views = hall.views(moved_by(Vec3(shift, 0, 0)), 0.3f);
    ASSERT_EQ(views.size(), 1u);
    EXPECT_EQ(views[0].polygons, (std::vector<std::uint32_t>{0}));
    ASSERT_EQ(std::pair(views[0].x, views[0].y), std::pair(5u, 5u));
    ASSERT_EQ(views[0].visibility.size(), 25u);
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 5; ++i) {
        const int seen = views[0].visibility[static_cast<std::size_t>(5 * j + i)];
        if (i == half)
          EXPECT_NEAR(seen, 127, 40) << "32 rays";
        else
          EXPECT_EQ(seen, i < half ? 0 : 255) << i << ", " << j;
      }
  }
}

// An image shows what is hidden more sharply than a share does, where the lobe is narrow beside the lamp.
TEST(EmitterViews, LeaveLampsSeenInPartToNarrowLobes) {
  const Hall hall;
  EXPECT_EQ(hall.views({}, 0.3f).size(), 1u);
  EXPECT_TRUE(hall.views({}, 0.01f).empty());
  EXPECT_EQ(hall.views(moved_by({5, 0, 0}), 0.01f).size(), 1u) << "seen whole from everywhere";
  EXPECT_NEAR(parted(0.5, 1e-6, 0.3), 0, 1e-5);
  EXPECT_NEAR(parted(0.5, 1, 1e-4), 0.5, 1e-5);
  EXPECT_EQ(parted(0.5, 0, 0.1), 0);
}

TEST(EmitterViews, AreNoneOfWhatDoesNotLightTheReflector) {
  Hall hall;
  EXPECT_TRUE(hall.views({}, 0).empty()) << "a mirror's image has it";
  EXPECT_EQ(hall.views({}, 0, 0).size(), 1u) << "but for a point's glint";
  EXPECT_TRUE(hall.views(moved_by({0, -3, 0}), 0.3f).empty()) << "under the floor";
  EXPECT_TRUE(hall.views({}, 0.3f, 7).empty()) << "another reflector's";
  MoverPose turned;
  turned.rotation = Vec4(1, 0, 0, 0);  // upside down, at y = -2
  turned.position = Vec3(0, 4, 0);
  EXPECT_TRUE(hall.views(turned, 0.3f).empty()) << "it shines upwards";
  hall.lamp.two_sided = true;
  EXPECT_EQ(hall.views(turned, 0.3f).size(), 1u);
  hall.floor.visibility_x = hall.floor.visibility_y = 0;  // the bake listed none
  const auto views = hall.views({}, 0.3f);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(std::pair(views[0].x, views[0].y), std::pair(33u, 33u));
}

// A square that stands for a point is as bright as the point straight below; beside it its share is less, since the
// square is seen at an angle but the point is not.
TEST(EmitterViews, OfPointsHaveWhatThePointSends) {
  const Hall hall;
  const auto views = hall.views({}, 0.3f, 0);
  ASSERT_EQ(views.size(), 1u);
  const std::vector<std::uint8_t>& seen = views[0].visibility;
  EXPECT_EQ(seen[10], 0) << "under the plate";
  EXPECT_GT(seen[13], 250) << "it sends there what the square shows, and more";
  Hall open = hall;
  open.materials[2].alpha_mode = AlphaMode::kBlend;  // the plate lets light through
  open.lamp.radiance = Vec3(4000);                   // four times too bright from straight below
  const auto all = open.views({}, 0.3f, 0);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_NEAR(all[0].visibility[12], 255 / 4.0, 3);
  const float cosine = 2 / std::sqrt(4 + 1.0f);
  EXPECT_NEAR(all[0].visibility[13], 255 / 4.0f / cosine, 8) << "of a point that shines to all sides alike";
}

// A pane is no obstacle, but it reflects.
TEST(EmitterViews, AreThoseOfGlassToo) {
  Hall hall;
  hall.materials[0].transmission = 1;
  EXPECT_EQ(hall.views({}, 0.3f).size(), 1u);
}

TEST(EmitterViews, StopWhenTold) {
  const Hall hall;
  const float alpha = 0.3f;
  const std::int64_t of = -1;
  const LampScene scene({hall.mesh, hall.materials, {}, {}}, {{1}, {Vec3(1000)}, {}});
  const std::atomic<bool> stop{true};
  EXPECT_TRUE(emitter_views({{&hall.floor, 1}, {&alpha, 1}, {&hall.lamp, 1}, {&of, 1}, {}}, scene, {}, &stop).empty());
}

}  // namespace
}  // namespace oriel
