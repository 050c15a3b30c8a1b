// Selection, equation (3) and the reflection that reprojected maps show.
#include <gtest/gtest.h>

#include "tests/bake/radiance/mirror_room.h"
#include "tests/bake/radiance/splat.h"

namespace oriel {
namespace {

using test::Captured;
using test::height_of;
using test::MirrorRoom;
using test::Pinhole;
using test::pinhole_from_camera;
using test::point_size;
using test::ReflectionImage;
using test::render_reflection;
using test::select_maps;
using test::SelectBy;

TEST(Reproject, SpacesAreInversesOfEachOther) {
  Reflector r;
  const Mat3 frame = frame_from_normal(glm::normalize(Vec3(1, -2, 0.5f)));
  r.pack_from_reflector = Mat4(Vec4(frame[0], 0), Vec4(frame[1], 0), Vec4(frame[2], 0), Vec4(100, 20, -300, 1));
  for (const Vec3& p : {Vec3(0), Vec3(1, 2, 3), Vec3(-50, 0.001f, 7)}) {
    const Vec3 q = pack_from_reflector(r, p);
    EXPECT_NEAR(glm::length(q - Vec3(r.pack_from_reflector * Vec4(p, 1))), 0, 1e-4);
    EXPECT_NEAR(glm::length(reflector_from_pack(r, q) - p), 0, 5e-5);
  }
}

TEST(Reproject, DisparityIsOneOnThePlaneAndZeroAtInfinity) {
  RadianceMap map;
  map.eye = {0.2f, 0.1f, -0.7f};
  map.lower = {-1, -1};
  map.upper = {1, 1};
  map.width = map.height = 8;
  EXPECT_EQ(disparity_of(map, 0), 1);
  EXPECT_NEAR(disparity_of(map, 1e-6f), 1, 2e-6);
  EXPECT_LT(disparity_of(map, 1e30f), 1e-29f);
  EXPECT_GT(disparity_of(map, 1e30f), 0);
  for (const float z : {1e-3f, 1.0f, 1e3f}) EXPECT_NEAR(height_of(map, disparity_of(map, z)) / z, 1, 1e-3);
  const Vec4 near = unproject(map, {2.5f, 6}, 1);
  EXPECT_NEAR(glm::length(Vec3(near) / near.w - Vec3(map_point(map, {2.5f, 6}), 0)), 0, 1e-6);
  const Vec4 far = unproject(map, {2.5f, 6}, 0);
  EXPECT_EQ(far.w, 0);
  EXPECT_NEAR(glm::length(glm::normalize(Vec3(far)) - glm::normalize(Vec3(map_point(map, {2.5f, 6}), 0) - map.eye)), 0,
              1e-6);
  const Vec3 p(0.3f, -0.2f, 2);
  const Vec4 back = unproject(map, map_pixel(map, p), disparity_of(map, p.z));
  EXPECT_NEAR(glm::length(Vec3(back) / back.w - p), 0, 1e-5);
}

// The same camera as the map's eye: a pixel of the map is as large as its image, ratio of resolutions included.
TEST(Reproject, PointSizeFollowsEquationThree) {
  RadianceMap map;
  map.eye = {0, 0, -1};
  map.lower = {-1, -1};
  map.upper = {1, 1};
  map.width = 64;
  map.height = 32;
  Pinhole view{.eye = map.eye, .right = {1, 0, 0}, .up = {0, 1, 0}, .forward = {0, 0, 1}};
  view.focal_px = 32;  // 64 pixels over the element
  view.width = view.height = 64;
  EXPECT_NEAR(point_size(map, view, {0, 0, 5}).x, 1, 1e-6);
  EXPECT_NEAR(point_size(map, view, {0, 0, 5}).y, 2, 1e-6);
  view.focal_px = 128;
  EXPECT_NEAR(point_size(map, view, {0, 0, 5}).x, 4, 1e-5);
  view.eye = {0, 0, -4};  // depth 9 against 6
  EXPECT_NEAR(point_size(map, view, {0, 0, 5}).x, 4 * 6.0f / 9, 1e-5);
  view.eye = {-10, 0, -5};  // looks at 45° to the map's x axis
  view.forward = glm::normalize(Vec3(1, 0, 1));
  EXPECT_NEAR(point_size(map, view, {0, 0, 5}).x, 4 * 6.0f / std::sqrt(200.0f) * std::sqrt(0.5f), 1e-5);
  EXPECT_NEAR(point_size(map, view, {0, 0, 5}).y, 8 * 6.0f / std::sqrt(200.0f), 1e-5);
}

struct ThreeMaps {
  Reflector reflector;
  std::vector<RadianceMap> maps;
  ThreeMaps() {
    for (const Vec3& eye :
         {Vec3(0, 0, -1), Vec3(0.7f, 0, -0.7f), Vec3(-0.7f, 0, -0.7f), Vec3(10, 0, -1), Vec3(10.7f, 0, -0.7f)}) {
      RadianceMap map;
      map.eye = eye;
      map.lower = {eye.x < 5 ? -1.0f : 9.0f, -1};
      map.upper = {eye.x < 5 ? 1.0f : 11.0f, 1};
      maps.push_back(map);
    }
    reflector.map_count = 5;
  }
};

TEST(Reproject, SelectionTakesTheNearestAngleOfEachElement) {
  const ThreeMaps t;
  using List = std::vector<std::uint32_t>;
  EXPECT_EQ(select_maps(t.reflector, t.maps, {0.1f, 0, -20}, 1, SelectBy::kAngle), (List{0, 4 - 1 + 0}));
  EXPECT_EQ(select_maps(t.reflector, t.maps, {5, 0, -5}, 1, SelectBy::kAngle), (List{1, 3}));
  EXPECT_EQ(select_maps(t.reflector, t.maps, {-5, 0, -5}, 2, SelectBy::kAngle), (List{2, 0, 3, 4}));
  EXPECT_EQ(select_maps(t.reflector, t.maps, {0, 0, -5}, 3, SelectBy::kAngle),
            (List{0, 1, 2, 3, 4}));  // a tie: by index
  EXPECT_TRUE(select_maps(t.reflector, t.maps, {0, 0, -5}, 0, SelectBy::kAngle).empty());
}

TEST(Reproject, SelectionByDistanceDiffersWhereItShould) {
  const ThreeMaps t;
  // Nearly along map 0's direction by angle, but in the place of map 1.
  const Vec3 eye(0.6f, 0, -0.75f);
  EXPECT_EQ(select_maps(t.reflector, t.maps, eye, 1, SelectBy::kDistance)[0], 1u);
  EXPECT_EQ(select_maps(t.reflector, t.maps, {2, 0, -0.5f}, 1, SelectBy::kDistance)[0], 1u);
  EXPECT_EQ(select_maps(t.reflector, t.maps, {0.1f, 0, -9}, 1, SelectBy::kDistance)[0], 0u);
}

struct Score {
  double covered = 0, right = 0,
         depth_error = 0;  // shares of the pixels inside the mirror; worst depth error, relative
};

// The reflection of the room as analytic rays show it, against the splatted one.
Score compare(const MirrorRoom& room, const Reflector& r, const Pinhole& view, const ReflectionImage& image) {
  const DMat4 to_pack(r.pack_from_reflector);
  std::size_t inside = 0, covered = 0, right = 0;
  Score score;
  for (std::uint32_t y = 0; y < view.height; ++y)
    for (std::uint32_t x = 0; x < view.width; ++x) {
      const std::size_t at = y * view.width + x;
      if (!image.inside[at]) {
        EXPECT_EQ(image.covered[at], 0);
        continue;
      }
      ++inside;
      if (!image.covered[at]) continue;
      ++covered;
      const DVec2 t = (DVec2(x, y) + 0.5 - 0.5 * DVec2(view.width, view.height)) / double{view.focal_px};
      const DVec3 d = DVec3(view.right) * t.x - DVec3(view.up) * t.y + DVec3(view.forward);
      const DVec3 on_plane = DVec3(view.eye) - d * (view.eye.z / d.z);
      std::uint32_t material = 0;
      const DVec3 reflected(d.x, d.y, -d.z);
      const DVec3 p = room.exit_point(DVec3(to_pack * DVec4(on_plane, 1)), DMat3(to_pack) * reflected, material);
      if (image.radiance[at] != MirrorRoom::colour(material)) continue;
      ++right;
      const double depth = view.eye.z / -d.z + glm::length(p - DVec3(to_pack * DVec4(on_plane, 1))) / glm::length(d);
      score.depth_error = std::max(score.depth_error, std::abs(image.depth[at] / depth - 1));
    }
  score.covered = static_cast<double>(covered) / static_cast<double>(std::max<std::size_t>(1, inside));
  score.right = static_cast<double>(right) / static_cast<double>(std::max<std::size_t>(1, covered));
  EXPECT_GT(inside, 1000u);
  return score;
}

TEST(Reproject, TheReflectionShowsTheRoomAsTheMirrorWould) {
  const MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  ViewOptions options;
  options.map_resolution = 128;
  const Captured c = capture(*accel, room, options);
  const Reflector& r = c.reflectors[0].reflector;
  for (const Vec3& eye : {Vec3(2, 1.5f, 3), Vec3(0.5f, 1.6f, 2), Vec3(3.5f, 2.5f, 4), Vec3(2.5f, 0.3f, 1.2f)}) {
    Camera camera;
    camera.eye = eye;
    camera.forward = Vec3(2, 1.5f, 0) - eye;
    const Pinhole view = pinhole_from_camera(r, camera, 160, 120);
    const auto all = select_maps(r, c.plan.maps, mirrored(view.eye), 16, SelectBy::kAngle);
    const auto four = select_maps(r, c.plan.maps, mirrored(view.eye), 4, SelectBy::kAngle);
    const Score with_all = compare(room, r, view, render_reflection(r, c.plan.maps, all, view));
    const Score with_four = compare(room, r, view, render_reflection(r, c.plan.maps, four, view));
    EXPECT_GT(with_all.covered, 0.97) << eye.x;
    EXPECT_GT(with_all.right, 0.9) << eye.x;  // every map's splats reach over the walls' edges by their size
    EXPECT_LT(with_all.depth_error, 0.08) << eye.x;
    EXPECT_GT(with_four.covered, 0.75) << eye.x;
    EXPECT_GT(with_four.right, 0.95) << eye.x;
  }
  // A camera behind the mirror sees none of it.
  Camera behind;
  behind.eye = {2, 1.5f, -2};
  behind.forward = {0, 0, 1};
  const Pinhole view = pinhole_from_camera(r, behind, 32, 32);
  const ReflectionImage image =
      render_reflection(r, c.plan.maps, select_maps(r, c.plan.maps, mirrored(view.eye), 2, SelectBy::kAngle), view);
  EXPECT_EQ(std::count(image.covered.begin(), image.covered.end(), 1), 0);
}

// The comparison above can fail: maps of a room with two walls exchanged do not pass.
TEST(Reproject, AWrongReflectionIsTold) {
  const MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  ViewOptions options;
  options.map_resolution = 64;
  Captured c = capture(*accel, room, options);
  for (RadianceMap& map : c.plan.maps)
    for (Vec3& colour : map.radiance)
      if (colour == MirrorRoom::colour(6)) colour = MirrorRoom::colour(5);
  Camera camera;
  camera.eye = {2, 1.5f, 3};
  const Reflector& r = c.reflectors[0].reflector;
  const Pinhole view = pinhole_from_camera(r, camera, 160, 120);
  const auto all = select_maps(r, c.plan.maps, mirrored(view.eye), 16, SelectBy::kAngle);
  EXPECT_LT(compare(room, r, view, render_reflection(r, c.plan.maps, all, view)).right, 0.7);
}

TEST(Reproject, TheSkyIsSplattedToo) {
  RadianceMap map;
  map.eye = {0, 0, -1};
  map.lower = {-1, -1};
  map.upper = {1, 1};
  map.width = map.height = 16;
  map.radiance.assign(256, Vec3(7));
  map.disparity.assign(256, 0);
  map.valid.assign(256, 2);
  Reflector r;
  r.lower = {-1, -1};
  r.upper = {1, 1};
  r.map_count = 1;
  Camera camera;
  camera.eye = {0, 0, 1};
  camera.forward = {0, 0, -1};
  const Pinhole view = pinhole_from_camera(r, camera, 40, 40);
  const std::vector<RadianceMap> maps{map};
  const std::vector<std::uint32_t> selection{0};
  const ReflectionImage image = render_reflection(r, maps, selection, view);
  for (std::size_t i = 0; i < image.covered.size(); ++i) EXPECT_EQ(image.covered[i], image.inside[i]);
  EXPECT_EQ(image.radiance[20 * 40 + 20], Vec3(7));
  EXPECT_TRUE(std::isinf(image.depth[20 * 40 + 20]));
}

}  // namespace
}  // namespace oriel
