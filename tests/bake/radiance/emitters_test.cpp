// Lamps that glossy reflectors show in closed form: which, and from where they are seen.
#include "bake/radiance/emitters.h"

#include <gtest/gtest.h>

#include "bake/radiance/capture.h"
#include "bake/radiance/punctual_emitter.h"
#include "bake/radiance/reproject.h"
#include "bake/radiance/sun_emitter.h"
#include "tests/bake/radiance/uniform_views.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

// A floor of 4 x 4 m that reflects, a lamp of 1 x 1 m over its middle, 2 m up, that shines down.
struct LampRoom {
  test::SceneParts parts;
  Scene scene;
  std::vector<FoundReflector> reflectors;
  std::vector<Emitter> emitters;
  std::vector<std::string> omitted;

  explicit LampRoom(float roughness = 0.2f) {
    SceneMaterial floor;
    floor.metallic = 1;
    floor.roughness = roughness;
    parts.add(floor);
    parts.diffuse(Vec3(0.5f), Vec3(1000, 900, 800));
    parts.diffuse(Vec3(0.5f));
    parts.quad("floor", 0, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    lamp({-0.5f, 2, -0.5f});
  }
  void lamp(const Vec3& corner) { parts.quad("lamp", 1, corner, {1, 0, 0}, {0, 0, 1}); }

  // Metals reflect; the floor's material is glossy or not.
  void run(const Accel& accel, bool glossy = true, std::size_t expected_reflectors = 1) {
    std::vector<ReflectorMaterial> materials;
    for (const SceneMaterial& m : scene.materials)
      materials.push_back(m.metallic > 0 ? ReflectorMaterial{m.roughness, Vec3(0.9f), 1}
                                         : ReflectorMaterial{1, Vec3(0), 0});
    ReflectorOptions options;
    options.min_open_share = 0;
    reflectors = find_reflectors(accel, materials, options).reflectors;
    ASSERT_EQ(reflectors.size(), expected_reflectors);
    Context context;
    std::vector<float> lobe_widths(scene.materials.size());
    lobe_widths[0] = glossy ? scene.materials[0].roughness * scene.materials[0].roughness : 0;
    ASSERT_TRUE(leave_out_emitters(accel, {.lobe_widths = lobe_widths}, context, {reflectors, emitters, omitted}));
  }
  float visibility(std::size_t emitter, const Vec2& at) const {
    const Reflector& r = reflectors[0].reflector;
    const Vec2 node = glm::round((at - r.lower) / (r.upper - r.lower) * Vec2(r.visibility_x - 1, r.visibility_y - 1));
    const auto i = static_cast<std::size_t>(node.x), j = static_cast<std::size_t>(node.y);
    return static_cast<float>(r.visibility[(emitter * r.visibility_y + j) * r.visibility_x + i]) / 255;
  }
};

TEST(Emitters, ALampIsOneQuadrangleSeenFromEverywhere) {
  LampRoom room;
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel);
  ASSERT_EQ(room.emitters.size(), 1u);
  const Emitter& lamp = room.emitters[0];
  ASSERT_EQ(lamp.corners.size(), 4u);
  EXPECT_EQ(lamp.radiance, Vec3(1000, 900, 800));
  EXPECT_FALSE(lamp.two_sided);
  const Vec3 normal = glm::normalize(glm::cross(lamp.corners[1] - lamp.corners[0], lamp.corners[2] - lamp.corners[0]));
  EXPECT_NEAR(normal.y, -1, 1e-6) << "counter-clockwise seen from the bright side";
  const Reflector& r = room.reflectors[0].reflector;
  EXPECT_EQ(r.emitters, std::vector<std::uint32_t>{0});
  EXPECT_EQ(room.reflectors[0].emitters, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(r.visibility.size(), std::size_t{r.visibility_x} * r.visibility_y);
  for (const std::uint8_t v : r.visibility) EXPECT_EQ(v, 255);
  EXPECT_TRUE(room.omitted.empty());
}

// No map shows it: the lobe of the floor does, as of a lamp far away.
TEST(Emitters, TheSunIsOneOfThem) {
  LampRoom room;
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(Vec3(1, -1, 0.5f));
  sun.intensity = {900, 800, 700};
  for (const float radius : {0.0f, 0.00465f, 0.3f}) {
    sun.angular_radius_rad = radius;
    room.parts.scene().lights = {sun};
    room.scene = room.parts.finish();
    const auto accel = Accel::build(room.scene);
    ASSERT_TRUE(accel);
    room.emitters.clear();
    room.run(*accel);
    if (radius > 0.2f) {
      EXPECT_EQ(room.emitters.size(), 1u) << "the lamp alone: it is too wide for a square";
      continue;
    }
    ASSERT_EQ(room.emitters.size(), 2u);
    const PolygonLight shown = *sun_polygon(room.scene, sun);
    const Emitter& far = room.emitters[room.emitters[0].radiance == shown.radiance ? 0 : 1];
    ASSERT_EQ(far.corners.size(), 4u);
    const Vec3 n = glm::normalize(glm::cross(far.corners[1] - far.corners[0], far.corners[2] - far.corners[0]));
    EXPECT_NEAR(glm::dot(n, sun.direction), 1, 1e-5) << "counter-clockwise seen from the bright side";
    const Receiver floor{{0.3f, 0, -0.4f}, {0, 1, 0}, {0, 1, 0}};
    EXPECT_NEAR(polygon_irradiance(shown, floor) * shown.radiance.g / (800 / 1.5), 1, 2e-3);
    EXPECT_EQ(sun_of_corners(room.scene, far.corners), 0u);
    // The lamp's shade lies on the floor where the sun comes from behind it.
    const std::size_t e = &far - room.emitters.data();
    EXPECT_GT(room.visibility(room.reflectors[0].reflector.emitters[0] == e ? 0 : 1, {-1.9f, -1.9f}), 0.99f);
  }
}

// Nor does one show points and spots: squares in their place, whose share at each node is what the light sends there.
TEST(Emitters, PointsAndSpotsAreSomeOfThem) {
  LampRoom room;
  Light point, spot;
  point.position = {-1, 1.5f, 0.3f}, point.intensity = {90, 80, 70};
  spot.type = LightType::kSpot, spot.position = {1, 2, 0}, spot.direction = {0, -1, 0},
  spot.intensity = {300, 400, 500};
  spot.inner_cone_rad = 0.2f, spot.outer_cone_rad = 0.4f;
  room.parts.box("over the floor", 2, {-1.05f, 0.5f, 0.25f}, {-0.95f, 0.6f, 0.35f});
  room.parts.scene().lights = {point, spot};
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel);
  const auto& on_floor = room.reflectors[0].reflector.emitters;
  ASSERT_EQ(on_floor.size(), 3u) << "and the lamp";
  const auto light_at = [&](std::uint32_t light, const Vec2& at) {  // cd towards a place of the floor, as it is shown
    for (std::size_t e = 0; e < on_floor.size(); ++e) {
      const Emitter& square = room.emitters[on_floor[e]];
      if (punctual_of_corners(room.scene, square.corners) != light) continue;
      const Vec3 facing = glm::cross(square.corners[1] - square.corners[0], square.corners[3] - square.corners[0]);
      const Vec3 way = glm::normalize(Vec3(at.x, 0, -at.y) - room.scene.lights[light].position);
      return room.visibility(e, at) * square.radiance.g * glm::dot(facing, way);
    }
    return -1.0f;
  };
  for (const Vec2& at : {Vec2(0.5f, 1), Vec2(1.5f, -1.5f), Vec2(-1.5f, 1)})
    EXPECT_NEAR(light_at(0, at) / 80, 1, 0.02) << at.x << ", " << at.y;
  EXPECT_EQ(light_at(0, {-1, -0.25f}), 0) << "in the shade of the box";
  EXPECT_NEAR(light_at(1, {1, 0}) / 400, 1, 0.02);
  EXPECT_GT(light_at(1, {1.625f, 0}), 20) << "in the cone's rim";
  EXPECT_LT(light_at(1, {1.625f, 0}), 380);
  EXPECT_EQ(light_at(1, {-0.5f, 0}), 0) << "beyond the cone";
}

// A mirror's image has all that has a surface, and neither sun nor point.
TEST(Emitters, OfAMirrorAreWhatHasNoSurface) {
  LampRoom room(0);
  Light sun, point;
  sun.type = LightType::kDirectional, sun.direction = {0, -1, 0}, sun.intensity = Vec3(1000);
  sun.angular_radius_rad = 0.00465f;
  point.position = {-1, 1.5f, 0.3f}, point.intensity = Vec3(100);
  room.parts.scene().lights = {sun, point};
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel, false);
  ASSERT_EQ(room.emitters.size(), 2u);
  EXPECT_EQ(room.reflectors[0].reflector.emitters.size(), 2u);
  EXPECT_TRUE(room.reflectors[0].emitters.empty()) << "no triangles are dark in its image";
  for (const Emitter& emitter : room.emitters)
    EXPECT_NE(sun_of_corners(room.scene, emitter.corners) == 0, punctual_of_corners(room.scene, emitter.corners) == 1);
  const std::size_t e = room.emitters[0].corners[0].y > 10 ? 0 : 1;  // the sun
  EXPECT_EQ(room.visibility(e, {0, 0}), 0) << "under the lamp";
  EXPECT_EQ(room.visibility(e, {1.5f, 0}), 1);
}

TEST(Emitters, AMirrorKeepsThem) {
  LampRoom room(0);
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel, false);
  EXPECT_TRUE(room.emitters.empty());
  EXPECT_TRUE(room.reflectors[0].reflector.emitters.empty());
}

// A half plane at half the lamp's height ends under its middle: the node below that edge sees half of the lamp, those
// 1 m to the sides all or nothing of it.
TEST(Emitters, VisibilityIsTheShareThatIsSeen) {
  LampRoom room;
  room.parts.quad("screen", 2, {0, 1, -9}, {9, 0, 0}, {0, 0, 18});
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel);
  ASSERT_EQ(room.emitters.size(), 1u);
  EXPECT_NEAR(room.visibility(0, {0, 0}), 0.5f, 0.04f);
  EXPECT_EQ(room.visibility(0, {-1, 0}), 1);
  EXPECT_EQ(room.visibility(0, {1, 0}), 0);
  EXPECT_NEAR(room.visibility(0, {0.5f, 1}), 0, 0.04f);
}

// Slats at half the lamp's height hide half of it from everywhere. A lobe narrower than the lamp sees slats and gaps:
// that is the maps' to show. One that holds all of the lamp sees the mean.
TEST(Emitters, AHalfHiddenLampStaysInTheMapsOfANarrowLobe) {
  for (const float roughness : {0.15f, 0.5f}) {
    LampRoom room(roughness);
    for (int i = -40; i < 40; ++i)
      room.parts.quad("slat", 2, {0.1f * static_cast<float>(i), 1, -4}, {0.05f, 0, 0}, {0, 0, 8});
    room.scene = room.parts.finish();
    const auto accel = Accel::build(room.scene);
    ASSERT_TRUE(accel);
    room.run(*accel);
    const bool narrow = roughness < 0.2f;
    EXPECT_EQ(room.reflectors[0].emitters.empty(), narrow);
    ASSERT_EQ(room.omitted.size(), narrow ? 1u : 0u);
    if (narrow) {
      EXPECT_NE(room.omitted[0].find("1 are hidden in part and large"), std::string::npos);
    }
  }
}

TEST(Emitters, TheMapsOfTheReflectorDoNotShowThem) {
  LampRoom room;
  room.parts.box("walls", 2, {-3, -0.1f, -3}, {3, 3, 3}, true);
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const auto shown = [](const SeenSurface& s) { return s.emission ? Vec3(1) : Vec3(0); };
  Context context;
  for (const bool glossy : {true, false}) {
    room.run(*accel, glossy);
    ViewOptions options;
    options.views_per_element = 1;
    options.map_resolution = 32;
    options.element_m = 10;
    ViewPlan plan = plan_views(room.scene, room.reflectors, options);
    ASSERT_TRUE(capture_maps({ReflectedSurroundings(*accel, room.reflectors, {}), shown}, context, plan.maps));
    const RadianceMap& map = plan.maps.at(0);
    EXPECT_EQ(map.has_emission, !glossy);
    std::size_t dark = 0;
    for (const Vec3& c : map.radiance) dark += c == Vec3(0);
    EXPECT_EQ(dark > 0, glossy);
  }
}

// The closed form shows the lamp itself, not its image in a mirror beside the floor: that stays in the map.
TEST(Emitters, TheirImagesInOtherMirrorsStayInTheMaps) {
  for (const bool has_mirror : {true, false}) {
    LampRoom room;
    SceneMaterial wall;
    wall.metallic = has_mirror ? 1 : 0;
    wall.roughness = 0;
    room.parts.quad("wall", room.parts.add(wall), {1, 0, -2}, {0, 0, 4}, {0, 2, 0});
    room.parts.box("walls", 2, {-3, -0.1f, -3}, {3, 3, 3}, true);
    room.scene = room.parts.finish();
    const auto accel = Accel::build(room.scene);
    ASSERT_TRUE(accel);
    room.run(*accel, true, has_mirror ? 2 : 1);
    ASSERT_EQ(room.reflectors[0].reflector.name, "floor");
    ASSERT_EQ(room.reflectors[0].emitters, (std::vector<std::uint32_t>{2, 3}));
    const auto lamp = [&](const SeenSurface& s) {
      return s.emission && room.scene.surfaces[room.scene.triangle_surface[s.hit.triangle]].material == 1 ? Vec3(1)
                                                                                                          : Vec3(0);
    };
    ViewOptions options;
    options.views_per_element = 8;
    options.map_resolution = 64;
    options.element_m = 10;
    ViewPlan plan = plan_views(room.scene, room.reflectors, options);
    Context context;
    ASSERT_TRUE(capture_maps({ReflectedSurroundings(*accel, room.reflectors, {}), lamp}, context, plan.maps));
    std::size_t lit = 0;
    for (const RadianceMap& map : plan.maps)
      for (const Vec3& c : map.radiance) lit += map.reflector == 0 && c != Vec3(0);
    EXPECT_EQ(lit > 0, has_mirror);
  }
}

TEST(Emitters, NoMoreThanTheLimitAndTheRestIsNamed) {
  LampRoom room;
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 8; ++j)
      room.lamp({-9.0f + 1.5f * static_cast<float>(i), 3, -9.0f + 1.5f * static_cast<float>(j)});
  room.scene = room.parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel);
  EXPECT_EQ(room.reflectors[0].reflector.emitters.size(), kMaxReflectorEmitters);
  ASSERT_EQ(room.omitted.size(), 1u);
  EXPECT_NE(room.omitted[0].find("9 of its lamps are blurred with its image"), std::string::npos) << room.omitted[0];
}

TEST(Emitters, FineMeshesAndTexturesStayInTheMapsAndAreNamed) {
  LampRoom room;
  constexpr std::uint32_t kSides = 24;
  std::vector<Vec3> positions{{1.5f, 2, 0}};
  std::vector<UVec3> triangles;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / kSides;
    positions.emplace_back(1.5f + 0.3f * std::cos(angle), 2, 0.3f * std::sin(angle));
    triangles.emplace_back(0, 1 + i, 1 + (i + 1) % kSides);  // faces down
  }
  room.parts.mesh("disc", 1, positions, std::vector<Vec3>(positions.size(), Vec3(0, -1, 0)), triangles);
  room.scene = room.parts.finish();
  SceneMaterial screen = room.scene.materials[1];
  screen.emission_texture.image = 0;
  room.scene.materials.push_back(screen);
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  room.run(*accel);
  EXPECT_EQ(room.reflectors[0].reflector.emitters.size(), 1u);
  ASSERT_EQ(room.omitted.size(), 2u);
  EXPECT_NE(room.omitted[0].find(
                "1 of its lamps are blurred with its image instead of shown exactly (their edges are softer, "
                "their light is the same): 1 have more than 16"),
            std::string::npos)
      << room.omitted[0];
  EXPECT_NE(room.omitted[1].find("textured"), std::string::npos);
}

}  // namespace
}  // namespace oriel
