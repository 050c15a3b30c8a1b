// Surround maps are taken from where they see what eyes see in their reflectors.
#include "bake/radiance/surround_viewpoints.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bake/radiance/surround_capture.h"
#include "bake/radiosity/split_sides.h"
#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

// Of the room's curved reflectors, seen from above and beside them.
FoundCurvedReflectors placed(const test::MirrorRoom& room,
                             std::vector<Vec3> eyes = {{3.5f, 2.8f, 4.5f}, {1, 2.9f, 1}}) {
  const auto accel = Accel::build(room.scene);
  if (!accel) return {};
  const auto flat = find_reflectors(*accel, room.materials(), room.reflector_options());
  FoundCurvedReflectors found = find_curved_reflectors(room.scene, flat.unplanar, room.materials(), {});
  Context context;
  EXPECT_TRUE(place_surround_maps(*accel, eyes, context, found));
  return found;
}

template <class Add>
test::MirrorRoom room_with(Add&& add) {
  test::MirrorRoom room;
  test::SceneParts parts;
  parts.scene() = std::move(room.scene);
  add(parts);
  room.scene = parts.finish();
  return room;
}

// Four sides that face inwards.
void sides(test::SceneParts& parts, const std::string& name, std::uint32_t material, const Vec3& o, const Vec3& size) {
  const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  parts.quad(name, material, o, y, z);
  parts.quad(name, material, o + x, z, y);
  parts.quad(name, material, o, x, y);
  parts.quad(name, material, o + z, y, x);
}

TEST(SurroundViewpoints, ABallKeepsItsMiddle) {
  const Vec3 middle(2.5f, 1, 3);
  const auto room = room_with([&](test::SceneParts& parts) { parts.sphere("ball", 0, middle, 0.25f, 3); });
  const FoundCurvedReflectors found = placed(room);
  ASSERT_EQ(found.maps.size(), 1u);
  EXPECT_LT(glm::length(found.maps[0].centre - middle), 1e-3f);
  EXPECT_NE(found.reflectors[0].view, SurroundView::kHollow);
  EXPECT_LT(glm::length(placed(room, {}).maps[0].centre - middle), 1e-3f) << "without eyes";
}

// Four sides hide the lower two thirds of a column: all that eyes see in it is seen from above them.
TEST(SurroundViewpoints, AHiddenMiddleIsLeft) {
  const auto room = room_with([](test::SceneParts& parts) {
    parts.box("column", 0, {2, 0, 3}, {2.1f, 1.5f, 3.1f});
    sides(parts, "screen", 3, {1.9f, 0, 2.9f}, {0.3f, 1, 0.3f});
  });
  const FoundCurvedReflectors found = placed(room);
  ASSERT_EQ(found.maps.size(), 1u);
  EXPECT_GT(found.maps[0].centre.y, 1.0f);
}

// A tray: most of what eyes see in its inside is its own other sides.
TEST(SurroundViewpoints, AHollowThingSeesItself) {
  const auto room = room_with([](test::SceneParts& parts) {
    const Vec3 corner(2, 0.5f, 3);
    parts.quad("tray", 0, corner, {0, 0, 0.4f}, {0.4f, 0, 0});
    sides(parts, "tray", 0, corner, {0.4f, 0.45f, 0.4f});
  });
  const FoundCurvedReflectors found = placed(room);
  ASSERT_EQ(found.maps.size(), 1u);
  EXPECT_EQ(found.reflectors[0].view, SurroundView::kHollow);
}

constexpr std::uint32_t kBulb = 7;  // its material, and so its light in the map

// Both sides of all that has that name are lit.
void split(test::MirrorRoom& room, const std::string& name) {
  std::vector<LitSides> lit;
  for (const std::uint32_t s : room.scene.triangle_surface)
    lit.push_back(room.scene.surfaces[s].name == name ? LitSides::kBoth : LitSides::kFront);
  room.scene = split_sides(std::move(room.scene), lit);
}

void capture(const test::MirrorRoom& room, FoundCurvedReflectors& found) {
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  Context context;
  ASSERT_TRUE(capture_surroundings(*accel, found, room.outgoing(), context));
}

bool shows_bulb(const SurroundMap& map) {
  return std::ranges::count(map.radiance, test::MirrorRoom::colour(kBulb)) > 0;
}

// A shade of one sheet, open below, a bulb in its mouth. From outside no ray goes from the sheet to the bulb, not even
// one of a wide lobe, though most of the bounds' middle's rays do.
TEST(SurroundViewpoints, TheOutsideOfAShadeDoesNotShowItsBulb) {
  auto room = room_with([](test::SceneParts& parts) {
    const Vec3 corner(2, 1.5f, 3), size(0.4f);
    sides(parts, "shade", 0, corner, size);
    parts.quad("shade", 0, corner + Vec3(0, size.y, 0), {size.x, 0, 0}, {0, 0, size.z});  // faces down
    parts.diffuse(Vec3(0.5f));
    parts.box("bulb", kBulb, {2.15f, 1.5f, 3.15f}, {2.25f, 1.6f, 3.25f});
  });
  room.scene.materials[0].double_sided = true;
  room.scene.materials[0].roughness = 0.25f;
  split(room, "shade");
  FoundCurvedReflectors found = placed(room, {{2.2f, 2.1f, 4}, {2.2f, 1.7f, 2.2f}, {2.8f, 0.2f, 3.2f}});
  ASSERT_EQ(found.maps.size(), 2u);
  capture(room, found);
  Light point;  // beside the bulb
  point.position = {2.33f, 1.55f, 3.33f};
  point.intensity = Vec3(100);
  room.scene.lights = {point};
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const std::vector<SurroundMap> before = found.maps;
  add_punctual_lights(*accel, found);
  for (const FoundCurvedReflector& side : found.reflectors) {
    const std::uint32_t t = side.triangles.front();
    const bool inside = room.scene.twin[t] > t;  // fronts face inwards
    EXPECT_EQ(shows_bulb(found.maps[side.reflector.map]), inside);
    EXPECT_EQ(found.maps[side.reflector.map].radiance != before[side.reflector.map].radiance, inside);
  }
}

// A globe of thin glass round a bulb. From far no ray that its walls mirror ends at the bulb.
TEST(SurroundViewpoints, AGlobeDoesNotMirrorTheBulbInIt) {
  const Vec3 middle(2, 1.5f, 3);
  auto room = room_with([&](test::SceneParts& parts) {
    parts.sphere("globe", 0, middle, 0.2f, 3);
    parts.diffuse(Vec3(0.5f));
    parts.box("bulb", kBulb, middle - 0.02f, middle + 0.02f);
  });
  SceneMaterial& glass = room.scene.materials[0];
  glass.double_sided = true, glass.metallic = 0, glass.transmission = 1, glass.base_color = Vec3(1);
  split(room, "globe");
  FoundCurvedReflectors found = placed(room, {{2.2f, 2.1f, 4.5f}, {3.5f, 1.7f, 1.5f}, {0.5f, 1.2f, 3.2f}});
  ASSERT_EQ(found.maps.size(), 2u);
  capture(room, found);
  for (const SurroundMap& map : found.maps) EXPECT_FALSE(shows_bulb(map));
}

}  // namespace
}  // namespace oriel
