#include <gtest/gtest.h>

#include "formats/query/camera_spec.h"

namespace oriel {
namespace {

struct Choices {
  std::vector<Camera> cameras;
  std::vector<CameraPath> paths;
  CameraChoices all() const { return {cameras, paths, DVec3(100, 0, 1e6)}; }
};

Choices some() {
  Choices c;
  c.cameras.resize(3);
  c.cameras[0].name = "entrance";
  c.cameras[0].eye = Vec3(1, 0, 0);
  c.cameras[1].name = "room C, north";
  c.cameras[1].eye = Vec3(2, 0, 0);
  c.cameras[2].name = std::string(1, '0');
  c.cameras[2].eye = Vec3(3, 0, 0);
  c.paths.push_back({"walk", 1, {{0, Vec3(0), Vec3(1, 0, 0)}, {10, Vec3(10, 0, 0), Vec3(1, 0, 0)}}});
  return c;
}

TEST(CameraSpec, NamesAndNumbers) {
  const Choices c = some();
  EXPECT_EQ(parse_camera("entrance", c.all())->eye.x, 1);
  EXPECT_EQ(parse_camera("room C, north", c.all())->eye.x, 2);
  EXPECT_EQ(parse_camera("1", c.all())->eye.x, 2);
  EXPECT_EQ(parse_camera("0", c.all())->eye.x, 3) << "a name goes before a number";
}

TEST(CameraSpec, PointsOfPaths) {
  const Choices c = some();
  EXPECT_EQ(parse_camera("walk@2.5", c.all())->eye.x, 2.5f);
  EXPECT_EQ(parse_camera("walk@10.01", c.all())->eye.x, 10);  // as a message may round it
  for (const char* text : {"walk@11", "walk@1e9", "walk@-1"}) {
    const auto camera = parse_camera(text, c.all());
    ASSERT_FALSE(camera) << text;
    EXPECT_NE(camera.error().message.find("expected 0 to 10"), std::string::npos) << camera.error().message;
  }
}

TEST(CameraSpec, EyeAndTargetAreInTheWorld) {
  const auto camera = parse_camera("101,2,1000003,101,2,1000002.5", some().all());
  ASSERT_TRUE(camera) << camera.error().text();
  EXPECT_EQ(camera->eye, Vec3(1, 2, 3));
  EXPECT_EQ(camera->forward, Vec3(0, 0, -1));
  // A direction far below a float's resolution at these coordinates.
  const auto close = parse_camera("0,0,1000000,1e-6,0,1000000", some().all());
  ASSERT_TRUE(close);
  EXPECT_EQ(close->forward, Vec3(1, 0, 0));
}

TEST(CameraSpec, WrongOnesAreUsageErrorsThatListTheNames) {
  const Choices c = some();
  for (const char* text : {"", "kitchen", "7", "-1", "99999999999999999999999", "walk", "walk@", "walk@soon", "run@1",
                           "@", "1,2,3,4,5,x", "1,2,3,nan,5,6", ",,,,,"}) {
    const auto camera = parse_camera(text, c.all());
    ASSERT_FALSE(camera) << text;
    EXPECT_EQ(camera.error().code, ErrorCode::kUsage) << text;
    EXPECT_NE(camera.error().message.find("\"entrance\""), std::string::npos) << camera.error().message;
    EXPECT_NE(camera.error().message.find("walk@SECONDS"), std::string::npos) << camera.error().message;
  }
  for (const char* text : {"1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,3,1,2,3", "1e300,0,0,1,2,3"}) {
    const auto camera = parse_camera(text, c.all());
    ASSERT_FALSE(camera) << text;
    EXPECT_EQ(camera.error().code, ErrorCode::kUsage) << text;
  }
  EXPECT_NE(parse_camera("a", {}).error().message.find("no camera"), std::string::npos);
}

TEST(CameraSpec, TheFirstCameraIsTheStart) {
  Choices c = some();
  EXPECT_EQ(initial_camera(c.all(), Vec3(0), Vec3(1)).name, "entrance");
  c.cameras.clear();
  EXPECT_EQ(initial_camera(c.all(), Vec3(0), Vec3(1)).forward, Vec3(1, 0, 0));
  c.paths.clear();
  // Without either: from outside, looking at the middle.
  const Vec3 lower(-5, 0, -1), upper(5, 3, 1), centre = 0.5f * (lower + upper);
  const Camera start = initial_camera(c.all(), lower, upper);
  EXPECT_GT(glm::length(start.eye - centre), 0.5f * glm::length(upper - lower));
  EXPECT_NEAR(glm::dot(start.forward, glm::normalize(centre - start.eye)), 1, 1e-5f);
}

}  // namespace
}  // namespace oriel
