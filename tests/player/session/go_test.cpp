// A click on the floor, and on what stands on it.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/query/camera.h"
#include "player/session/session.h"

namespace oriel {
namespace {

void add_quad(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up) {
  Mesh& mesh = pack.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {corner, corner + right, corner + right + up, corner + up}) mesh.positions.push_back(p);
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

// A floor of 8 x 8 m around the origin; a wall of 3 m at its far end, z = -4.
class GoTest : public ::testing::Test {
 protected:
  void SetUp() override {
    add_quad(pack_, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
    add_quad(pack_, {-4, 0, -4}, {8, 0, 0}, {0, 3, 0});
    WalkGrid grid;
    grid.lower = {-4, -4};
    grid.cell_m = 0.25f;
    grid.width = grid.height = 32;
    grid.floor_y.assign(1024, 0.0f);
    pack_.walk_grids.push_back(grid);
    session_.camera = look_at({0, 1.6f, 3}, {0, 1.1f, 0}, 1);
  }
  // The place of a point in the window.
  Vec2 place_of(const Vec3& point) const {
    const Vec4 clip = view().clip_from_pack * Vec4(point, 1);
    return {0.5f + 0.5f * clip.x / clip.w, 0.5f - 0.5f * clip.y / clip.w};
  }
  View view() const { return make_view(session_.camera, 160, 90, {{-4, 0, -4}, {4, 3, 4}}); }
  std::string go_to(const Vec3& point) { return go(place_of(point), pack_, view(), floors(), session_); }
  Floors floors() const { return Floors(pack_.walk_grids); }
  void wait(float seconds, const MoveInput& input = {}) {
    for (float t = 0; t < seconds; t += 1 / 60.0f) move_on(input, floors(), 1 / 60.0f, session_);
  }
  Pack pack_;
  Session session_;
};

TEST_F(GoTest, ToTheFloorAndToTheFootOfAWall) {
  const Vec3 forward = session_.camera.forward;
  ASSERT_EQ(go_to({1, 0, -2}), "");
  wait(6);
  EXPECT_LT(glm::distance(session_.camera.eye, Vec3(1, 1.6f, -2)), 0.2f);
  EXPECT_EQ(session_.camera.forward, forward);
  EXPECT_FALSE(session_.walker.on());
  ASSERT_EQ(go_to({-1, 1.7f, -4}), "") << "the wall";
  wait(6);
  EXPECT_NEAR(session_.camera.eye.x, -0.7f, 0.15f) << "some way before it, seen from the right";
  EXPECT_LT(session_.camera.eye.z, -3);
  EXPECT_NEAR(session_.camera.eye.y, 1.6f, 0.01f);
}

TEST_F(GoTest, AnyMotionEndsIt) {
  ASSERT_EQ(go_to({1, 0, -2}), "");
  wait(0.2f);
  EXPECT_TRUE(session_.walker.on());
  MoveInput back;
  back.back = true;
  wait(0.1f, back);
  EXPECT_FALSE(session_.walker.on());
  const Vec3 here = session_.camera.eye;
  wait(1);
  EXPECT_LT(glm::distance(session_.camera.eye, here), 1e-4f);
  ASSERT_EQ(go_to({1, 0, -2}), "");
  perform({Action::kHome, 0}, pack_, session_);
  EXPECT_FALSE(session_.walker.on());
  // Looking around does not.
  session_.camera = look_at({0, 1.6f, 3}, {0, 1.1f, 0}, 1);
  ASSERT_EQ(go_to({1, 0, -2}), "");
  MoveInput look;
  look.mouse_x_px = 1;
  wait(0.2f, look);
  EXPECT_TRUE(session_.walker.on());
}

TEST_F(GoTest, WhereNobodyCanGoItGoesNear) {
  EXPECT_EQ(go({0.5f, 0.5f}, pack_, view(), Floors({}), session_), "the pack knows no floor to walk on; F flies");
  EXPECT_FALSE(session_.walker.on());
  // A floor that ends: the far half of what is seen cannot be stood on.
  WalkGrid near = pack_.walk_grids[0];
  for (std::size_t cell = 0; cell < near.floor_y.size(); ++cell)
    if (cell / near.width < 16) near.floor_y[cell] = std::nanf("");
  const Floors half({near});
  const std::string said = go(place_of({1, 0, -2}), pack_, view(), half, session_);
  EXPECT_NE(said.find("walking to the nearest place, 2."), std::string::npos) << said;
  for (int i = 0; i < 360; ++i) move_on({}, half, 1 / 60.0f, session_);
  EXPECT_LT(glm::distance(session_.camera.eye, Vec3(1, 1.6f, 0.125f)), 0.3f) << "the edge before it";
  // Where nothing is seen: ahead.
  session_.camera = look_at({0, 1.6f, 3}, {0, 1.1f, 0}, 1);
  go({0.5f, 0.01f}, pack_, view(), floors(), session_);
  wait(6);
  EXPECT_LT(session_.camera.eye.z, 0);
}

TEST_F(GoTest, FromWhereNobodyStandsItFlies) {
  session_.camera = look_at({50, 9, 3}, {0, 0, 0}, 1);
  EXPECT_EQ(go({0.5f, 0.5f}, pack_, view(), floors(), session_),
            "nobody can walk from here: flying to the nearest floor");
  wait(7);
  EXPECT_LT(glm::distance(session_.camera.eye, Vec3(0, 1.6f, 0)), 0.5f);
  MoveInput ahead;
  ahead.forward = true;
  wait(0.5f, ahead);
  EXPECT_NEAR(session_.camera.eye.y, 1.6f, 0.01f) << "there it walks";
}

TEST_F(GoTest, TallPeopleWalkAsTall) {
  const Floors tall(pack_.walk_grids, 4);
  EXPECT_FLOAT_EQ(tall.size(), 2.5f);
  MoveInput ahead;
  ahead.forward = true;
  for (int i = 0; i < 60; ++i) move_on(ahead, tall, 1 / 60.0f, session_);
  EXPECT_NEAR(session_.camera.eye.y, 4, 0.01f) << "it rises from the camera's height";
}

TEST_F(GoTest, OrbitsStayOnThisSideOfWalls) {
  add_quad(pack_, {4, 0, 4}, {-8, 0, 0}, {0, 3, 0});  // a wall behind the eye, z = 4
  session_.camera = look_at({0, 1.5f, 1}, {0, 1.5f, 0}, 1);
  add_quad(pack_, {-0.2f, 1, 0}, {0.4f, 0, 0}, {0, 1, 0});  // what it turns around
  perform({Action::kOrbit, 0}, pack_, session_);
  ASSERT_TRUE(session_.move.orbit);
  MoveInput away;
  away.back = true;
  const auto orbit = [&](const MoveInput& input, float seconds) {
    for (float t = 0; t < seconds; t += 1 / 60.0f) {
      const Camera before = session_.camera;
      move_on(input, floors(), 1 / 60.0f, session_);
      stay_in_sight(before, pack_, session_);
    }
  };
  orbit(away, 3);
  EXPECT_LT(session_.camera.eye.z, 4);
  EXPECT_GT(session_.camera.eye.z, 3);
  // Around the thing, behind which nothing stands in the way.
  MoveInput around;
  around.left = true;
  session_.move.orbit_m = 1;
  orbit(around, 3.2f);
  EXPECT_LT(session_.camera.eye.z, 0) << "behind it";
}

TEST_F(GoTest, OrbitsTurnAroundWhatIsSeen) {
  session_.camera = look_at({0, 1.5f, 3}, {0, 1.5f, 0}, 1);
  perform({Action::kOrbit, 0}, pack_, session_);
  ASSERT_TRUE(session_.move.orbit);
  EXPECT_LT(glm::distance(*session_.move.orbit, Vec3(0, 1.5f, -4)), 1e-4f) << "the wall";
  MoveInput look;
  look.mouse_y_px = 100;
  wait(0.1f, look);
  EXPECT_GT(session_.camera.eye.y, 2) << "it does not fall";
  perform({Action::kOrbit, 0}, pack_, session_);
  EXPECT_FALSE(session_.move.orbit);
  EXPECT_TRUE(session_.move.fly) << "nor now";
  perform({Action::kFly, 0}, pack_, session_);
  wait(3);
  EXPECT_NEAR(session_.camera.eye.y, 1.6f, 0.02f) << "now it does";
  perform({Action::kOrbit, 0}, pack_, session_);
  perform({Action::kFly, 0}, pack_, session_);
  EXPECT_FALSE(session_.move.orbit);
  EXPECT_FALSE(session_.move.fly) << "F ends it on the floor";
}

}  // namespace
}  // namespace oriel
