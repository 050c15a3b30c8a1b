#include "tests/bake/radiosity/rooms.h"

#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

std::ostream& operator<<(std::ostream& out, Feature feature) {
  constexpr const char* kNames[] = {"matt",   "glossy floor", "mirror", "glass",      "cut-out",
                                    "sphere", "point light",  "sky",    "dielectric", "many lamps"};
  return out << kNames[static_cast<std::size_t>(feature)];
}

Scene room(Feature feature) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  SceneMaterial special;
  special.base_color = Vec3(0.6f, 0.4f, 0.3f);
  special.metallic = 0;
  if (feature == Feature::kMirror) special.metallic = 1, special.roughness = 0, special.base_color = Vec3(0.9f);
  if (feature == Feature::kGlossyFloor) special.metallic = 1, special.roughness = 0.4f;
  if (feature == Feature::kDielectric) special.roughness = 0.3f;
  if (feature == Feature::kGlass) special.transmission = 0.8f, special.double_sided = true;
  if (feature == Feature::kCutOut) special.alpha_mode = AlphaMode::kBlend, special.alpha = 0.5f;
  const auto other = feature == Feature::kMatt ? white : parts.add(special);
  const bool floor = feature == Feature::kGlossyFloor || feature == Feature::kMirror || feature == Feature::kDielectric;
  parts.quad("floor", floor ? other : white, {0, 0, 2}, {2, 0, 0}, {0, 0, -2});
  if (feature != Feature::kSky) parts.quad("ceiling", white, {0, 2, 0}, {2, 0, 0}, {0, 0, 2});
  parts.quad("back", white, {0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  parts.quad("left", parts.diffuse({0.6f, 0.05f, 0.05f}), {0, 0, 2}, {0, 0, -2}, {0, 2, 0});
  parts.quad("right", parts.diffuse({0.1f, 0.5f, 0.1f}), {2, 0, 0}, {0, 0, 2}, {0, 2, 0});
  if (feature == Feature::kGlass || feature == Feature::kCutOut)
    parts.quad("pane", other, {0.5f, 1.2f, 0.3f}, {1, 0, 0}, {0, 0, 1.2f});
  else if (feature == Feature::kSphere)
    parts.sphere("ball", white, Vec3(1, 0.5f, 1), 0.4f, 2);
  else
    parts.box("block", white, {0.5f, 0, 0.4f}, {1.1f, 1.1f, 1});
  if (feature == Feature::kPoint)
    parts.scene().lights.push_back(
        {.name = "lamp", .type = LightType::kPoint, .position = Vec3(1, 1.8f, 1.3f), .intensity = Vec3(3)});
  else if (feature == Feature::kSky)
    parts.scene().sky = Vec3(2, 2.5f, 3);
  else if (feature == Feature::kManyLamps)
    parts.sphere("lamp", parts.diffuse(Vec3(0), Vec3(60, 50, 40)), Vec3(1, 1.7f, 1.2f), 0.1f, 2);
  else
    parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10, 7, 4)), {0.7f, 1.99f, 0.7f}, {0.5f, 0, 0}, {0, 0, 0.5f});
  return parts.finish();
}

}  // namespace oriel::test
