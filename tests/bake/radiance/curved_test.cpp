// Curved reflectors: what is one, and what is seen around it, against closed forms.
#include <gmock/gmock.h>

#include "bake/radiance/surround_capture.h"
#include "formats/core/octahedral.h"
#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// The room with a ball of the mirror's material.
struct BallRoom : test::MirrorRoom {
  static constexpr Vec3 kCentre{2.5f, 1, 3};
  static constexpr float kRadius = 0.25f;

  explicit BallRoom(int levels = 3) {
    test::SceneParts parts;
    parts.scene() = std::move(scene);
    parts.sphere("ball", 0, kCentre, kRadius, levels);
    scene = parts.finish();
  }
};

FoundCurvedReflectors find(const test::MirrorRoom& room, const CurvedOptions& options = {}) {
  const auto accel = Accel::build(room.scene);
  if (!accel) return {};
  const auto flat = find_reflectors(*accel, room.materials(), room.reflector_options());
  return find_curved_reflectors(room.scene, flat.unplanar, room.materials(), {}, options);
}

FoundCurvedReflectors captured(const test::MirrorRoom& room, FoundCurvedReflectors found, int threads = 2) {
  const auto accel = Accel::build(room.scene);
  Context context;
  context.threads = threads;
  if (!accel || !capture_surroundings(*accel, found, room.outgoing(), context)) found.maps.clear();
  return found;
}

TEST(CurvedReflectors, MapsAreAsFineAsEyesCanTell) {
  constexpr double kBall_m2 = kPi * 0.1 * 0.1;
  EXPECT_EQ(surround_resolution_for_eyes(kBall_m2, 2), 64u);  // 34 pixels across
  EXPECT_EQ(surround_resolution_for_eyes(kBall_m2, 100), 32u);
  EXPECT_GE(surround_resolution_for_eyes(kBall_m2, 0), 2048u);  // an eye at the thing
  const BallRoom room;
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const auto flat = find_reflectors(*accel, room.materials(), room.reflector_options());
  std::vector<SeenOfTriangle> seen(room.scene.triangles.size());
  for (const std::uint32_t t : flat.unplanar) seen[t] = {1, 1 / (20.0f * 20.0f)};
  const auto far = find_curved_reflectors(room.scene, flat.unplanar, room.materials(), seen);
  ASSERT_EQ(far.maps.size(), 1u);
  EXPECT_EQ(far.maps[0].size, surround_resolution_for_eyes(far.reflectors[0].area_m2, 20));
  EXPECT_LT(far.maps[0].size, find(room).maps[0].size);
}

TEST(CurvedReflectors, ABallIsOneAndAPlaneIsNot) {
  const BallRoom room;
  const FoundCurvedReflectors found = find(room);
  ASSERT_EQ(found.reflectors.size(), 1u);
  const FoundCurvedReflector& ball = found.reflectors[0];
  EXPECT_EQ(ball.reflector.name, "ball");
  EXPECT_EQ(ball.reflector.map, 0u);
  EXPECT_EQ(ball.triangles.size(), 20u << 6);
  EXPECT_NEAR(ball.area_m2, 4 * kPi * room.kRadius * room.kRadius, 0.01);
  ASSERT_EQ(found.maps.size(), 1u);
  EXPECT_LT(glm::length(found.maps[0].centre - room.kCentre), 1e-3f);
  EXPECT_EQ(found.maps[0].size, 512u);
  EXPECT_TRUE(found.omitted.empty());
}

// What counts in a model of a few centimetres is its own size.
TEST(CurvedReflectors, SmallScenesReflectAsLargeOnesDo) {
  test::MirrorRoom room(0.01f);
  test::SceneParts parts;
  parts.scene() = std::move(room.scene);
  parts.sphere("ball", 0, 0.01f * BallRoom::kCentre, 0.01f * BallRoom::kRadius, 2);
  room.scene = parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const FoundReflectors flat = find_reflectors(*accel, room.materials());
  EXPECT_EQ(flat.reflectors.size(), 1u);
  EXPECT_EQ(find_curved_reflectors(room.scene, flat.unplanar, room.materials(), {}).reflectors.size(), 1u);
}

TEST(CurvedReflectors, LargeOnesAreCutSmallOnesLeftOutAndTheMostImportantKept) {
  test::MirrorRoom room;
  test::SceneParts parts;
  parts.scene() = std::move(room.scene);
  parts.sphere("pearl", 0, {1, 1, 4}, 0.01f, 1);
  parts.sphere("small", 0, {1, 2, 4}, 0.1f, 2);
  std::vector<Vec3> positions, normals;
  std::vector<UVec3> triangles;
  for (std::uint32_t ring = 0; ring <= 20; ++ring)  // a tube 3.8 m long
    for (std::uint32_t i = 0; i < 16; ++i) {
      const float a = static_cast<float>(i) * kPi / 8;
      const Vec3 n(0, std::cos(a), std::sin(a));
      positions.push_back(Vec3(0.1f + 0.19f * static_cast<float>(ring), 2, 3) + 0.05f * n);
      normals.push_back(n);
      const std::uint32_t a0 = 16 * ring + i, b0 = 16 * ring + (i + 1) % 16;
      if (ring < 20) triangles.insert(triangles.end(), {UVec3(a0, a0 + 16, b0), UVec3(b0, a0 + 16, b0 + 16)});
    }
  parts.mesh("tube", 0, positions, normals, triangles);
  room.scene = parts.finish();
  const FoundCurvedReflectors found = find(room);
  ASSERT_EQ(found.reflectors.size(), 3u);
  EXPECT_EQ(found.objects.size(), 2u);
  for (int half = 0; half < 2; ++half) {
    EXPECT_EQ(found.reflectors[half].reflector.name, "tube");
    EXPECT_EQ(found.reflectors[half].triangles.size(), 320u);
  }
  EXPECT_NEAR(std::abs(found.maps[0].centre.x - found.maps[1].centre.x), 1.9f, 0.01f);
  EXPECT_EQ(found.reflectors[2].reflector.name, "small");
  EXPECT_THAT(texts_of(found.omitted), Contains(HasSubstr("'pearl'")));

  CurvedOptions options;
  options.max_reflectors = 1;
  options.memory_bytes = 256 * 256 * kMapBytesPerPixel;
  const FoundCurvedReflectors few = find(room, options);
  ASSERT_EQ(few.reflectors.size(), 1u);
  EXPECT_EQ(few.maps[0].size, 256u);
  EXPECT_THAT(texts_of(few.omitted), Contains(HasSubstr("less important than the 1")));
}

// The rim of a pane, bent at its corners: 2.4 m by 1.2 m, and 5 mm wide. A ball of that diagonal would have 512².
TEST(CurvedReflectors, ThinOnesHaveCoarseMapsHoweverLongTheyAre) {
  test::MirrorRoom room;
  test::SceneParts parts;
  parts.scene() = std::move(room.scene);
  std::vector<Vec3> positions, normals;
  std::vector<UVec3> triangles;
  constexpr std::uint32_t kAround = 32;
  for (std::uint32_t i = 0; i < kAround; ++i) {
    const float a = static_cast<float>(i) * 2 * static_cast<float>(kPi) / kAround;
    for (const float z : {3.0f, 3.005f}) {
      positions.push_back(Vec3(2 + 1.2f * std::cos(a), 1.5f + 0.6f * std::sin(a), z));
      normals.push_back(Vec3(std::cos(a), std::sin(a), 0));
    }
    const std::uint32_t a0 = 2 * i, b0 = 2 * ((i + 1) % kAround);
    triangles.insert(triangles.end(), {UVec3(a0, b0, a0 + 1), UVec3(a0 + 1, b0, b0 + 1)});
  }
  parts.mesh("rim", 0, positions, normals, triangles);
  room.scene = parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const auto flat = find_reflectors(*accel, room.materials(), room.reflector_options());
  const std::vector<SeenOfTriangle> seen(room.scene.triangles.size(), {1, 1});
  const auto found = find_curved_reflectors(room.scene, flat.unplanar, room.materials(), seen, {.max_pieces = 1});
  ASSERT_EQ(found.maps.size(), 1u);
  EXPECT_EQ(found.maps[0].size, 128u);
}

TEST(Surroundings, TellWhatCountsOfALight) {
  const BallRoom room(1);
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  FoundCurvedReflectors found = find(room);
  ASSERT_EQ(found.reflectors.size(), 1u);
  EXPECT_EQ(found.reflectors[0].reflectance, reflectance_at_60_deg(room.materials()[0]));
  found.reflectors[0].reflectance = 0.25f;
  found.reflectors[0].alpha = 0.5f;
  found.maps[0].size = 8;
  Context context;
  std::atomic<int> asked{0}, others{0};
  const OutgoingRadiance outgoing = [&](const SeenSurface& seen) {
    ++asked;
    others += seen.throughput != Vec3(0.25f) || seen.averaged != 16;
    return Vec3(1);
  };
  ASSERT_TRUE(capture_surroundings(*accel, found, outgoing, context));
  EXPECT_EQ(asked, 64);
  EXPECT_EQ(others, 0);
}

TEST(Surroundings, AreThoseOfTheClosedForm) {
  const BallRoom room;
  const FoundCurvedReflectors found = captured(room, find(room));
  ASSERT_EQ(found.maps.size(), 1u);
  const SurroundMap& map = found.maps[0];
  int mirror = 0;
  for (std::uint32_t y = 0; y < map.size; ++y)
    for (std::uint32_t x = 0; x < map.size; ++x) {
      const std::size_t i = y * map.size + x;
      const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(map.size) * 2.0f - 1.0f;
      const DVec3 direction = glm::normalize(DVec3(direction_from_octahedral(at)));
      std::uint32_t material = 0;
      const DVec3 p = room.exit_point(DVec3(map.centre), direction, material);
      ASSERT_EQ(map.valid[i], 1);
      if (map.radiance[i] == room.colour(0)) {  // the mirror before the -z wall
        ++mirror;
        continue;
      }
      int walls = 0;  // two along the room's edges, where either colour is right
      for (int axis = 0; axis < 3; ++axis)
        walls += std::min(p[axis] - room.scene.lower[axis], room.scene.upper[axis] - p[axis]) < 1e-4;
      if (walls == 1) {
        EXPECT_EQ(map.radiance[i], room.colour(material));
      }
      EXPECT_NEAR(1 / map.inverse_distance[i], glm::length(p - DVec3(map.centre)), 1e-4);
    }
  EXPECT_GT(mirror, 1000);
}

struct AddedLight {
  DVec3 lux{0}, direction{0};  // integral over the map; where its middle lies
};

AddedLight added_light(const BallRoom& room) {
  FoundCurvedReflectors found = captured(room, find(room));
  const auto accel = Accel::build(room.scene);
  if (!accel || found.maps.size() != 1) return {};
  const SurroundMap before = found.maps[0];
  add_punctual_lights(*accel, found);
  const SurroundMap& map = found.maps[0];
  AddedLight sum;
  for (std::uint32_t i = 0; i < map.size * map.size; ++i) {
    const Vec2 at = (Vec2(i % map.size, i / map.size) + 0.5f) / static_cast<float>(map.size) * 2.0f - 1.0f;
    const DVec3 p(direction_from_octahedral(at));
    const double steradians = 4 / std::pow(glm::length(p), 3) / map.size / map.size;
    const DVec3 light = steradians * DVec3(map.radiance[i] - before.radiance[i]);
    sum.lux += light;
    sum.direction += light.x * glm::normalize(p);
  }
  return sum;
}

// What they have together is the illuminance at the centre; where they lie is the light's direction, also across the
// map's edge, which is straight down the -z axis.
TEST(Surroundings, PointsAndSunsAreLampsOfTheirTexels) {
  for (const Vec3& way : {Vec3(0.3f, 1.2f, 0.4f), Vec3(0, 0, -1.5f), Vec3(0.001f, 0.6f, -1.5f)}) {
    BallRoom room;
    Light point;
    point.position = BallRoom::kCentre + way;
    point.intensity = Vec3(100, 50, 0);
    room.scene.lights = {point};
    const AddedLight found = added_light(room);
    const double lux = 100 / glm::dot(DVec3(way), DVec3(way));
    EXPECT_NEAR(found.lux.x, lux, 0.01 * lux);
    EXPECT_NEAR(found.lux.y, 0.5 * lux, 0.01 * lux);
    EXPECT_EQ(found.lux.z, 0);
    EXPECT_GT(glm::dot(glm::normalize(found.direction), glm::normalize(DVec3(way))), std::cos(0.01));
  }
  BallRoom room;
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(Vec3(0.2f, -1, 0.1f));
  sun.angular_radius_rad = 0.05f;
  sun.intensity = Vec3(1000);
  room.scene.lights = {sun};
  EXPECT_EQ(added_light(room).lux.x, 0) << "the room is closed";
  SceneMaterial& ceiling = room.scene.materials[4];
  ceiling.alpha_mode = AlphaMode::kBlend, ceiling.alpha = 0;
  EXPECT_NEAR(added_light(room).lux.x, 1000, 10);
}

// The ball as a sheet that is seen from both sides, its fronts inside.
void turn_inside_out(BallRoom& room) {
  const Scene& scene = room.scene;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (scene.surfaces[scene.triangle_surface[t]].name == "ball")
      std::swap(room.scene.triangles[t].x, room.scene.triangles[t].y);
  room.scene.materials[0].double_sided = true;
}

class SurroundingsOfBalls : public ::testing::TestWithParam<bool> {};

TEST_P(SurroundingsOfBalls, WhatLiesInsideTheObjectIsNotSeen) {
  BallRoom room;
  if (GetParam()) turn_inside_out(room);
  test::SceneParts parts;
  parts.scene() = std::move(room.scene);
  parts.box("core", 3, room.kCentre - 0.1f, room.kCentre + 0.1f);
  parts.box("chamber", 3, room.kCentre - 0.05f, room.kCentre + 0.05f, true);
  room.scene = parts.finish();
  BallRoom empty;
  if (GetParam()) turn_inside_out(empty);
  const FoundCurvedReflectors found = captured(room, find(room)), expected = captured(empty, find(empty));
  ASSERT_EQ(found.maps.size(), 1u);
  EXPECT_EQ(found.maps[0].valid, expected.maps[0].valid);
  // But for rays that meet an edge of the room: they start again from the ball, with another rounding.
  int differ = 0;
  for (std::size_t i = 0; i < found.maps[0].radiance.size(); ++i)
    differ += found.maps[0].radiance[i] != expected.maps[0].radiance[i];
  EXPECT_LT(differ, 100);
}

INSTANTIATE_TEST_SUITE_P(InsideOut, SurroundingsOfBalls, ::testing::Bool());

TEST(Surroundings, DoNotDependOnThreads) {
  const BallRoom room(1);
  CurvedOptions options;
  options.memory_bytes = 64 * 64 * kMapBytesPerPixel;
  const FoundCurvedReflectors one = captured(room, find(room, options), 1),
                              four = captured(room, find(room, options), 4);
  ASSERT_EQ(one.maps.size(), 1u);
  EXPECT_EQ(one.maps[0].size, 64u);
  EXPECT_EQ(one.maps[0].radiance, four.maps[0].radiance);
  EXPECT_EQ(one.maps[0].inverse_distance, four.maps[0].inverse_distance);
}

// A ball on the floor, half in it: nothing that a pack cannot hold, at any scale.
TEST(Surroundings, AreFiniteWhereTheObjectTouches) {
  for (const float sink : {0.0f, 0.125f, 0.25f}) {
    test::MirrorRoom room;
    test::SceneParts parts;
    parts.scene() = std::move(room.scene);
    parts.sphere("ball", 0, {2, 0.25f - sink, 3}, 0.25f, 2);
    room.scene = parts.finish();
    CurvedOptions options;
    options.memory_bytes = 64 * 64 * kMapBytesPerPixel;
    const FoundCurvedReflectors found = captured(room, find(room, options));
    ASSERT_EQ(found.maps.size(), 1u);
    for (const float d : found.maps[0].inverse_distance) ASSERT_TRUE(d >= 0 && d <= 1e5f) << d;
    for (const Vec3& c : found.maps[0].radiance) ASSERT_TRUE(is_finite(c));
  }
}

TEST(Surroundings, StopWhenAsked) {
  const BallRoom room(1);
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  Context context;
  context.stop = true;
  FoundCurvedReflectors found = find(room);
  const Status status = capture_surroundings(*accel, found, room.outgoing(), context);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace oriel
