// Planned viewpoints: what maps see and how sharp in rooms of closed form.
#include "bake/radiance/planned_views.h"

#include <gtest/gtest.h>

#include <limits>

#include "bake/radiance/reproject.h"
#include "bake/trace/sampler.h"
#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

using test::MirrorRoom;

constexpr float kNever = std::numeric_limits<float>::infinity();

struct Planned {
  std::vector<FoundReflector> reflectors;
  ViewPlan plan;
};

Planned plan_in(const Accel& accel, const MirrorRoom& room, std::span<const Vec3> eyes, PlannedViewOptions options = {},
                int threads = 2) {
  Planned out;
  out.reflectors = find_reflectors(accel, room.materials(), room.reflector_options()).reflectors;
  const auto as_found = out.reflectors;
  Context context;
  context.threads = threads;
  options.eyes = eyes;
  auto plan = plan_views_for_eyes(ReflectedSurroundings(accel, as_found, {}), options, context, out.reflectors);
  EXPECT_TRUE(plan);
  if (plan) out.plan = std::move(*plan);
  return out;
}

std::vector<Vec3> eyes_in_room(std::uint32_t count, std::uint32_t from = 0) {
  std::vector<Vec3> eyes;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler sampler(3, 0, from + i);
    const Vec2 at = sampler.next2();
    eyes.push_back({0.3f + 3.4f * at.x, 1.6f, 0.5f + 4.2f * at.y});
  }
  return eyes;
}

ViewQuality judge(const Accel& accel, const Planned& planned, std::span<const RadianceMap> maps,
                  std::span<const Vec3> eyes) {
  Context context;
  const ReflectedSurroundings surroundings(accel, planned.reflectors, {});
  const auto samples = sample_reflections(surroundings, 0, {eyes, 2048, 77}, context);
  EXPECT_TRUE(samples);
  EXPECT_EQ(samples->size(), 2048u);
  return judge_maps(surroundings, maps, *samples, context);
}

// The mirror's eye and map are on its axis, the wall behind the eye faces both: a pixel of the window of side L, seen
// at distance e, shows the eye 1 / resolution of L / e, wherever the wall is.
TEST(Needs, AreThoseOfSimilarTriangles) {
  const MirrorRoom room;
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
  const ReflectedSurroundings surroundings(*accel, reflectors, {});
  const float depth = 5 - test::kMirrorInset;  // from the mirror to the wall
  for (const float e : {0.5f, 2.0f}) {
    ReflectedSample s;
    s.eye = {0, 0, e};
    s.image = {0, 0, depth, 1};
    s.normal = {0, 0, -1};
    s.spacing = static_cast<float>(kSharpAngleRad) * (depth + e);
    const Element window{{-1, -0.75f}, {1, 0.75f}};
    const float expected = 2 / (e * static_cast<float>(kSharpAngleRad));
    EXPECT_NEAR(needed_resolution(surroundings, 0, {0, 0, -e}, window, s), expected, 1e-4f * expected);
    // From twice as far the window's pixels are half as fine there, less what the eye's own distance makes up for.
    const float far = needed_resolution(surroundings, 0, {0, 0, -2 * e}, window, s);
    EXPECT_NEAR(far, expected * (depth + 2 * e) / (2 * (depth + e)), 1e-4f * expected);
    EXPECT_EQ(needed_resolution(surroundings, 0, {-3, 0, -0.1f}, window, s), kNever) << "past the window";
    s.image.z = 3;
    EXPECT_EQ(needed_resolution(surroundings, 0, {0, 0, -e}, window, s), kNever) << "nothing is there";
  }
}

TEST(PlannedViews, FewMapsShowAnEmptyRoomToEyesThatWereNotPlannedFor) {
  const MirrorRoom room;
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const Planned planned = plan_in(*accel, room, eyes_in_room(1000));
  ASSERT_EQ(planned.reflectors.size(), 1u);
  EXPECT_GE(planned.plan.maps.size(), 1u);
  EXPECT_LE(planned.plan.maps.size(), 8u);
  EXPECT_EQ(planned.reflectors[0].reflector.map_count, planned.plan.maps.size());
  const ViewQuality quality = judge(*accel, planned, planned.plan.maps, eyes_in_room(60, 1000));
  EXPECT_GE(quality.seen, 0.995);
  EXPECT_GE(quality.sharp, 0.95);
}

// Two boxes stand between the mirror and the walls.
MirrorRoom furnished() {
  MirrorRoom room;
  test::SceneParts parts;
  parts.scene() = room.scene;
  parts.box("pillar", 1, {0.8f, 0, 1.5f}, {1.2f, 3, 1.9f});
  parts.box("sideboard", 2, {2.4f, 0, 2}, {3.6f, 1.2f, 2.6f});
  room.scene = parts.finish();
  return room;
}

TEST(PlannedViews, MatchManyUniformOnesAmongFurniture) {
  const MirrorRoom room = furnished();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  Planned planned = plan_in(*accel, room, eyes_in_room(1000));
  const auto eyes = eyes_in_room(60, 1000);
  const ViewQuality few = judge(*accel, planned, planned.plan.maps, eyes);
  Planned uniform = planned;
  ViewOptions options;
  options.views_per_element = 64;
  options.map_resolution = planned.plan.maps[0].width;
  const ViewPlan plan = plan_views(room.scene, uniform.reflectors, options);
  ASSERT_GT(plan.maps.size(), 32u);
  const ViewQuality many = judge(*accel, planned, plan.maps, eyes);
  std::printf("%zu planned maps of %u: seen %.2f %%, sharp %.1f %%; %zu uniform: %.2f %%, %.1f %%\n",
              planned.plan.maps.size(), planned.plan.maps[0].width, 100 * few.seen, 100 * few.sharp, plan.maps.size(),
              100 * many.seen, 100 * many.sharp);
  EXPECT_LE(planned.plan.maps.size(), 8u);
  EXPECT_GE(few.seen, 0.995);
  EXPECT_GE(few.sharp, 0.95);
  // One map alone must fail where eight pass, or this test proves nothing.
  EXPECT_LT(judge(*accel, planned, std::span(planned.plan.maps).first(1), eyes).sharp, few.sharp);
}

TEST(PlannedViews, AreTheSameForAnyThreadsAndStopWhenAsked) {
  const MirrorRoom room = furnished();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const Planned a = plan_in(*accel, room, eyes_in_room(100), {}, 1),
                b = plan_in(*accel, room, eyes_in_room(100), {}, 3);
  ASSERT_EQ(a.plan.maps.size(), b.plan.maps.size());
  for (std::size_t i = 0; i < a.plan.maps.size(); ++i) {
    EXPECT_EQ(a.plan.maps[i].eye, b.plan.maps[i].eye);
    EXPECT_EQ(a.plan.maps[i].width, b.plan.maps[i].width);
  }
  Context context;
  context.stop = true;
  auto reflectors = a.reflectors;
  const std::vector<Vec3> eyes = eyes_in_room(10);
  PlannedViewOptions options;
  options.eyes = eyes;
  const auto stopped =
      plan_views_for_eyes(ReflectedSurroundings(*accel, a.reflectors, {}), options, context, reflectors);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kStopped);
}

// However many an element is allowed, the player must be able to blend them all.
TEST(PlannedViews, AreNoMoreThanThePlayerBlends) {
  MirrorRoom room;
  test::SceneParts parts;
  parts.scene() = room.scene;
  for (int i = 0; i < 100; ++i) {  // pillars hide something from each viewpoint
    const float x = 0.4f + 0.34f * static_cast<float>(i % 10), z = 0.6f + 0.4f * static_cast<float>(i / 10);
    parts.box("pillar", 1, {x, 0, z}, {x + 0.1f, 3, z + 0.1f});
  }
  room.scene = parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  PlannedViewOptions options;
  options.samples = 2048;
  options.choice.max_maps = 64;
  options.pixel_price = 0;
  options.choice.resolutions = {256};
  options.max_elements = 1;
  const Planned planned = plan_in(*accel, room, eyes_in_room(200), options);
  EXPECT_EQ(planned.plan.maps.size(), kMostMapsPerElement);
}

TEST(PlannedViews, KeepTheMemory) {
  const MirrorRoom room;
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  PlannedViewOptions options;
  options.samples = 512;
  for (const std::uint64_t limit : {std::uint64_t{1} << 20, std::uint64_t{5000}, std::uint64_t{10}}) {
    options.memory_bytes = limit;
    if (limit == 5000) options.pixel_price = 0;  // it must rise from there too
    const Planned planned = plan_in(*accel, room, eyes_in_room(200), options);
    std::uint64_t bytes = 0;
    for (const RadianceMap& map : planned.plan.maps) bytes += kMapBytesPerPixel * map.width * map.height;
    EXPECT_LE(bytes, limit);
    EXPECT_EQ(planned.plan.maps.empty(), limit < 100);
    ASSERT_EQ(planned.plan.omitted.size(), 1u);
  }
}

TEST(SeenReflectors, ThoseThatNobodySeesAreLeftOutWithAReason) {
  MirrorRoom room;
  test::SceneParts parts;
  parts.scene() = room.scene;
  // A mirror in a closet of its own, and one on the ceiling side of a shelf over everybody's head.
  parts.box("closet", 1, {10, 0, 0}, {12, 3, 2}, true);
  parts.quad("hidden mirror", 0, {10.2f, 0.2f, 0.05f}, {1.5f, 0, 0}, {0, 2, 0});
  parts.quad("high mirror", 0, {0.5f, 2.5f, 3}, {0, 0, 1}, {2, 0, 0});
  room.scene = parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  FoundReflectors found = find_reflectors(*accel, room.materials(), room.reflector_options());
  ASSERT_EQ(found.reflectors.size(), 3u);
  Context context;
  ASSERT_TRUE(keep_seen_reflectors(*accel, eyes_in_room(200), 32, context, found));
  ASSERT_EQ(found.reflectors.size(), 1u);
  EXPECT_EQ(found.reflectors[0].reflector.name, "mirror");
  ASSERT_EQ(found.omitted.size(), 2u);
  for (const std::string& line : texts_of(found.omitted))
    EXPECT_NE(line.find("from nowhere where people walk is anything seen in it"), std::string::npos) << line;
}

// A frame around a hole, and a part of the same plane that does not touch it: one reflector, and samples on it alone.
TEST(SeenReflectors, HolesAndSeparatePartsAreNotReflector) {
  MirrorRoom room;
  test::SceneParts parts;
  parts.add(room.scene.materials[0]);
  parts.diffuse(Vec3(0.5f));
  parts.quad("wall", 1, {-5, -5, 5}, {0, 10, 0}, {10, 0, 0});
  parts.quad("mirror", 0, {-2, -2, 0}, {4, 0, 0}, {0, 1, 0});
  parts.quad("mirror", 0, {-2, 1, 0}, {4, 0, 0}, {0, 1, 0});
  parts.quad("mirror", 0, {-2, -1, 0}, {1, 0, 0}, {0, 2, 0});
  parts.quad("mirror", 0, {1, -1, 0}, {1, 0, 0}, {0, 2, 0});
  parts.quad("mirror", 0, {3, -2, 0}, {1, 0, 0}, {0, 1, 0});
  room.scene = parts.finish();
  const auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const auto reflectors = find_reflectors(*accel, room.materials()).reflectors;
  ASSERT_EQ(reflectors.size(), 1u);
  EXPECT_NEAR(reflectors[0].reflector.area_m2, 13, 1e-4);
  Context context;
  const std::vector<Vec3> eyes{{0, 0, 2}, {1, 1, 3}};
  const auto samples = sample_reflections(ReflectedSurroundings(*accel, reflectors, {}), 0, {eyes, 1000, 1}, context);
  ASSERT_TRUE(samples);
  ASSERT_EQ(samples->size(), 1000u);
  for (const ReflectedSample& s : *samples) {
    const Vec3 p = pack_from_reflector(reflectors[0].reflector, s.on_plane);
    EXPECT_FALSE(std::abs(p.x) < 0.999f && std::abs(p.y) < 0.999f) << "in the hole";
    EXPECT_FALSE(p.x > 2.001f && (p.x < 2.999f || p.y > -0.999f)) << "between the parts";
  }
}

}  // namespace
}  // namespace oriel
