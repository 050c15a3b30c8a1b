// Shadows of movers on flat surfaces beside rays, by soft-shadow textures.
#include "study/herf1997/texture_shadows.h"
#include "study/rooms.h"
#include "tests/player/lamp_rays.h"

namespace oriel::study {
namespace {
using namespace oriel::testing;

class FlatShadows : public FrameTest {
 protected:
  // As FrameTest::draw, with shadows by textures.
  Picture draw_textures(const Pack& pack, const Camera& camera, const IVec2& size,
                        const std::vector<MoverPose>& poses = {}) {
    gpu::add_shader_sources(shader_sources());
    auto scene = GpuScene::create(pack, device_);
    auto shadows = TextureShadows::create(device_.dialect);
    EXPECT_TRUE(scene && shadows);
    if (!scene || !shadows) return {};
    FrameOptions options;
    options.poses = poses;
    const View view = make_view(camera, size.x, size.y, (*scene)->bounds());
    const auto stats = renderer_->render(**scene, view, options, &*shadows);
    EXPECT_TRUE(stats) << (stats ? "" : stats.error().text());
    return stats ? Picture{size.x, size.y, renderer_->read_light(), *stats} : Picture();
  }

  // Whether textures change nothing, bit for bit.
  bool is_as_by_maps(const Pack& pack) {
    const Camera camera = look_at({3, 1, 3.5f}, {0.2f, -2, 0}, 0.8f);
    return draw(pack, camera, 48, 32).rgb == draw_textures(pack, camera, {48, 32}).rgb;
  }

  // Illuminance of the floor there, which is white.
  float lux_at(const Pack& pack, const std::vector<MoverPose>& poses, float x, float z) {
    return draw_textures(pack, above_floor(x, z), {5, 5}, poses).at(2, 2).g * kPi;
  }

  // Along a line over the floor: textures take what rays say. An edge of a shadow goes through some eight of the lamp's
  // 64 cells, each of which then has its sample on either side: three times the deviation of that is let pass.
  void expect_as_rays(const Pack& pack, const std::vector<MoverPose>& poses, const Vec2& from, const Vec2& to,
                      int edges = 1) {
    const double deviation = std::sqrt(edges * 8 * 0.25) / 64;
    double squares = 0, taken = 0;
    constexpr int kPlaces = 24;
    for (int i = 0; i < kPlaces; ++i) {
      const Vec2 at = glm::mix(from, to, (static_cast<float>(i) + 0.5f) / kPlaces);
      const Lit lit = by_rays(pack, poses, DVec3(at.x, -2, at.y));
      const double found = 100 - lux_at(pack, poses, at.x, at.y);
      EXPECT_NEAR(found, lit.taken, 3 * deviation * lit.open + 1e-3) << at.x << " " << at.y;
      squares += (found - lit.taken) * (found - lit.taken) / (lit.open * lit.open + 1e-12) / kPlaces;
      taken += lit.taken;
    }
    EXPECT_LT(std::sqrt(squares), deviation);
    EXPECT_GT(taken, 1) << "the line has some shadow";
  }
};

const float kHalf = std::sqrt(0.5f);
const MoverPose kLevel{{0, 0, 0}, {-kHalf, 0, 0, kHalf}};   // the square of 2 m faces up
const MoverPose kUpright{{0, 0, 0}, {0, kHalf, 0, kHalf}};  // it faces along x

MoverPose at(MoverPose pose, const Vec3& position) {
  pose.position = position;
  return pose;
}

TEST_F(FlatShadows, OfASquareUnderASquareLamp) {
  const Pack pack = lamp_scene();
  expect_as_rays(pack, {kLevel}, {0, 0.1f}, {3.5f, 0.3f});
  expect_as_rays(pack, {at(kLevel, {0.3f, -0.8f, 0.2f})}, {0.5f, 0}, {2.4f, 1.9f});
}

TEST_F(FlatShadows, OfOneThatIsHalfBehindTheLampsPlane) {
  expect_as_rays(lamp_scene(), {at(kUpright, {0.9f, 2, 0})}, {0.5f, 0.2f}, {3.9f, 0.2f});
}

TEST_F(FlatShadows, OfOneThroughTheFloor) {
  expect_as_rays(lamp_scene(), {at(kUpright, {0.8f, -2, 0.3f})}, {-0.5f, 0.2f}, {3, 0.2f});
}

TEST_F(FlatShadows, OfTwoCountOnce) {
  Pack pack = lamp_scene();
  pack.movers.push_back(pack.movers[0]);
  pack.movers[1].name = "second";
  expect_as_rays(pack, {kLevel, at(kLevel, {0.4f, -1, 0.5f})}, {-2.5f, 0.1f}, {3.5f, 0.3f}, 2);
}

// A wall that shades half of the floor already: there the mover takes nothing, beside it what the wall lets through.
TEST_F(FlatShadows, TakeNothingFromWhatTheSceneShades) {
  Pack pack = lamp_scene();
  add_quad(pack, {-0.7f, 1, -3}, {0, 0, 6}, {3, 0, 0}, 1, 0);
  add_quad(pack, {-0.7f, 1, 3}, {0, 0, -6}, {3, 0, 0}, 1, 0);
  const MoverPose pose = at(kLevel, {-1.6f, -0.5f, 0});
  EXPECT_NEAR(lux_at(pack, {pose}, -1.2f, 0.2f), 100, 1e-3f);
  expect_as_rays(pack, {pose}, {-3.9f, 0.2f}, {-1.4f, 0.2f}, 2);
}

// A surface whose normals are bent is none for textures: its shadows are those of the maps, bit for bit.
TEST_F(FlatShadows, OnCurvedSurfacesAreShadowMaps) {
  Pack pack = lamp_scene();
  EXPECT_EQ(find_flat_surfaces(pack).planes.size(), 1u);
  for (std::size_t i = 0; i < pack.mesh.normals.size(); ++i)
    pack.mesh.normals[i] = glm::normalize(pack.mesh.normals[i] + Vec3(i % 2 == 0 ? 0.1f : -0.1f, 0, 0));
  EXPECT_TRUE(find_flat_surfaces(pack).planes.empty());
  EXPECT_EQ(find_flat_surfaces(pack).rest.size(), 1u);
  EXPECT_TRUE(is_as_by_maps(pack));
}

TEST_F(FlatShadows, AreNothingWithoutMovers) {
  Pack pack = lamp_scene();
  EXPECT_FALSE(is_as_by_maps(pack)) << "textures are drawn where there is a mover";
  pack.movers.clear();
  EXPECT_TRUE(is_as_by_maps(pack));
}

TEST_F(FlatShadows, ExtremesStayFinite) {
  const Pack pack = lamp_scene();
  const Camera camera = look_at({0, 1, 3}, Vec3(0), 1.0f);
  for (const Vec3& p : {Vec3(0, 2, 0), Vec3(0, -2, 0), Vec3(0, -3, 0), Vec3(1e4f, 0, 0), Vec3(-4, 0, 4)})
    for (const float scale : {1e-4f, 1.0f, 1e4f}) {
      Pack scaled = pack;
      for (Vec3& v : scaled.movers[0].mesh.positions) v *= scale;
      EXPECT_TRUE(draw_textures(scaled, camera, {8, 8}, {at(kLevel, p)}).finite()) << scale << " " << p.y;
    }
}

// A stick goes through the floor at a slant, towards a lamp at its side. Its shadow begins where it goes through.
TEST(ShadowRects, OfAStickThatGoesThroughAtASlantBeginWhereItDoes) {
  FlatPlane floor;
  floor.x = {1, 0, 0}, floor.y = {0, 0, -1}, floor.normal = {0, 1, 0};
  BrightLight lamp;
  lamp.corners = {{-10, 2, -0.1f}, {-9.9f, 2, -0.1f}, {-9.9f, 2, 0.1f}};
  std::array<Vec3, 8> stick, shaft;
  for (int i = 0; i < 8; ++i) {
    const Vec3 side(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const Vec3 p(side.x, 0.01f * side.y, 0.1f * side.z);  // then turned from (1, 0) to (-1, 1)
    stick[i] = std::sqrt(0.5f) * Vec3(-p.x - p.y, p.x - p.y, 0) + Vec3(0, 0, p.z);
    shaft[i] = 20.0f * side;
  }
  const PlaneRect rect = shadow_rect(floor, lamp, stick, shaft);
  ASSERT_FALSE(rect.empty());
  EXPECT_LE(rect.lower.x, -0.01);
  EXPECT_GE(rect.upper.x, 0.01);
}

}  // namespace
}  // namespace oriel::study
