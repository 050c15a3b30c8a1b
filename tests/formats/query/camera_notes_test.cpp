// Cameras as texts beside pictures.
#include "formats/query/camera_notes.h"

#include <gtest/gtest.h>

#include "formats/query/camera.h"

namespace oriel {
namespace {

TEST(CameraNotes, ComeBackInAnotherSpace) {
  Camera camera = look_at({1, 2, 3}, {4, 1, 7}, 0.8f);
  camera.name = "entrance, east";
  const auto found = camera_of_notes(camera_notes(camera, {100, 0, -50}), {99, 0, -50});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, camera.name);
  EXPECT_LT(glm::distance(found->eye, Vec3(2, 2, 3)), 1e-5f);
  EXPECT_LT(glm::distance(found->forward, camera.forward), 1e-6f);
  EXPECT_LT(glm::distance(found->up, camera.up), 1e-6f);
  EXPECT_NEAR(found->vertical_fov_rad, 0.8f, 1e-5f);
  camera.vertical_fov_rad = 0;
  camera.half_height = 2.5f;
  EXPECT_EQ(camera_of_notes(camera_notes(camera, {}), {})->half_height, 2.5f);
}

TEST(CameraNotes, ThatMeanNothingAreNoCamera) {
  const auto whole = camera_notes(look_at({1, 2, 3}, {4, 1, 7}, 0.8f), {});
  ASSERT_TRUE(camera_of_notes(whole, {}));
  for (const char* name : {"oriel.eye", "oriel.forward", "oriel.up", "oriel.vertical_fov_deg"}) {
    auto notes = whole;
    notes.erase(name);
    EXPECT_FALSE(camera_of_notes(notes, {})) << "without " << name;
    for (const char* text : {"", "1,2", "nan,0,0", "1,2,3,4", "inf", "-1", "180", "0"}) {
      notes = whole;
      notes[name] = text;
      EXPECT_FALSE(camera_of_notes(notes, {})) << name << " " << text;
    }
  }
  auto notes = whole;
  notes["oriel.up"] = notes["oriel.forward"];
  EXPECT_FALSE(camera_of_notes(notes, {}));
}

}  // namespace
}  // namespace oriel
