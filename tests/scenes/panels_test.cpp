#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

struct Extent {
  Vec3 lower{1e9f}, upper{-1e9f};
};

Extent extent_of(const SampleScene& scene, const std::string& name) {
  Extent extent;
  for (const Triangle& t : flatten(scene))
    if (scene.nodes[t.node].name == name)
      for (const Vec3& p : t.p) extent.lower = glm::min(extent.lower, p), extent.upper = glm::max(extent.upper, p);
  return extent;
}

TEST(Panels, IsSoundAndClosed) {
  const SampleScene scene = make_panels();
  const auto triangles = flatten(scene);
  for (const Triangle& t : triangles) EXPECT_EQ(fault(t), "") << scene.nodes[t.node].name;
  EXPECT_EQ(coplanar_overlaps(scene), std::vector<std::string>{});
  for (const SampleCamera& camera : scene.cameras)
    for (const Vec3& direction : directions(500)) {
      const auto seen = cast(triangles, camera.eye, direction);
      ASSERT_TRUE(seen) << "a hole seen from " << camera.name;
      EXPECT_TRUE(seen->front) << scene.nodes[triangles[seen->triangle].node].name;
    }
}

TEST(Panels, EverySectionIsAsProudAsItsNameSays) {
  const SampleScene scene = make_panels();
  for (const int proud : kProud_mm) {
    const double metres = 1e-3 * proud;
    for (const char* what : {"panel", "skirting"}) {
      const Extent extent = extent_of(scene, fmt::format("{} {} mm", what, proud));
      EXPECT_NEAR(extent.upper.z, metres, 1e-6) << what;
      EXPECT_EQ(extent.lower.z, 0) << what;
    }
    const Extent board = extent_of(scene, fmt::format("board {} mm", proud));
    EXPECT_NEAR(board.upper.z, metres, 1e-6);
    EXPECT_NEAR(board.lower.z, metres / 2, 1e-6);
  }
}

TEST(Panels, EveryCameraSeesItsEdges) {
  const SampleScene scene = make_panels();
  const auto triangles = flatten(scene);
  for (const SampleCamera& camera : scene.cameras) {
    const Vec3 forward = glm::normalize(camera.target - camera.eye);
    int seen_of_it = 0;
    for (const Vec3& direction : directions(8000)) {
      if (glm::dot(direction, forward) < std::cos(0.5f * camera.vertical_fov_rad)) continue;
      const auto seen = cast(triangles, camera.eye, direction);
      ASSERT_TRUE(seen);
      const std::string& name = scene.nodes[triangles[seen->triangle].node].name;
      seen_of_it += name.rfind(camera.name, 0) == 0;
    }
    EXPECT_GT(seen_of_it, camera.name == "plinth" ? 0 : 3) << camera.name;
    EXPECT_GT(clearance(triangles, camera.eye), 0.25) << camera.name;
  }
}

}  // namespace
}  // namespace oriel::sample
