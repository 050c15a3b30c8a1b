// A room on a wide plain in the sun, which comes in by a window.
#pragma once

#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

constexpr float kSunLux = 1000, kWindow_m2 = 1;

// Walls of a reflectance, 4 x 2.5 x 4 m; the sun stands 45 degrees high behind -z, the window is 1 m a side.
inline Scene sunlit_room(const Vec3& walls) {
  SceneParts parts;
  const std::uint32_t wall = parts.diffuse(walls), floor = parts.diffuse(Vec3(0.5f)), plain = parts.diffuse(Vec3(0.3f));
  parts.quad("plain", plain, {-60, -0.1f, 60}, {120, 0, 0}, {0, 0, -120});
  parts.quad("floor", floor, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  parts.quad("ceiling", wall, {-2, 2.5f, -2}, {4, 0, 0}, {0, 0, 4});
  parts.quad("left", wall, {-2, 0, 2}, {0, 0, -4}, {0, 2.5f, 0});
  parts.quad("right", wall, {2, 0, -2}, {0, 0, 4}, {0, 2.5f, 0});
  parts.quad("back", wall, {2, 0, 2}, {-4, 0, 0}, {0, 2.5f, 0});
  parts.quad("below", wall, {-2, 0, -2}, {4, 0, 0}, {0, 1, 0});
  parts.quad("above", wall, {-2, 2, -2}, {4, 0, 0}, {0, 0.5f, 0});
  parts.quad("beside", wall, {-2, 1, -2}, {1.5f, 0, 0}, {0, 1, 0});
  parts.quad("beyond", wall, {0.5f, 1, -2}, {1.5f, 0, 0}, {0, 1, 0});
  Scene scene = parts.finish();
  Light sun;
  sun.type = LightType::kDirectional;
  sun.intensity = Vec3(kSunLux);
  sun.direction = glm::normalize(Vec3(0, -1, 1));
  scene.lights = {sun};
  return scene;
}

}  // namespace oriel::test
