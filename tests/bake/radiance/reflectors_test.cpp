// The search for planar reflectors on shapes made for it.
#include "bake/radiance/reflectors.h"

#include <gtest/gtest.h>

#include "bake/radiance/patches.h"
#include "bake/radiance/reproject.h"
#include "formats/core/rectangle.h"
#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

constexpr ReflectorMaterial kMirror{.roughness = 0, .f0 = Vec3(0.9f), .f90 = 1};
constexpr ReflectorMaterial kMatte{.roughness = 1, .f0 = Vec3(0), .f90 = 0};

// One glossy material (0), and a matte one (1) of which a sphere all around gives the reflectors something to see.
struct Workshop {
  test::SceneParts parts;
  std::vector<ReflectorMaterial> materials{kMirror, kMatte};

  Workshop() {
    parts.add(SceneMaterial{});
    parts.diffuse(Vec3(0.5f));
  }
  FoundReflectors find(float size = 10, const ReflectorOptions& options = {}) {
    parts.sphere("around", 1, Vec3(0), 2 * size, 2, true);
    scene = parts.finish();
    auto accel = Accel::build(scene);
    EXPECT_TRUE(accel);
    return find_reflectors(*accel, materials, options);
  }
  Scene scene;
};

TEST(Reflectors, TheMirrorOfARoomIsFoundWithItsFrame) {
  const test::MirrorRoom room;
  auto accel = Accel::build(room.scene);
  ASSERT_TRUE(accel);
  const FoundReflectors found = find_reflectors(*accel, room.materials());
  ASSERT_EQ(found.reflectors.size(), 1u);
  const Reflector& r = found.reflectors[0].reflector;
  EXPECT_EQ(r.name, "mirror");
  EXPECT_EQ(r.material, 0u);
  EXPECT_EQ(found.reflectors[0].triangles.size(), 2u);
  EXPECT_TRUE(r.indices.empty());
  EXPECT_NEAR(r.area_m2, 3, 1e-5);
  EXPECT_NEAR(r.upper.x - r.lower.x, 2, 1e-6);
  EXPECT_NEAR(r.upper.y - r.lower.y, 1.5, 1e-6);
  EXPECT_LT(r.flatness_m, 1e-6);
  EXPECT_NEAR(glm::length(pack_from_reflector(r, {0, 0, 1}) - Vec3(2, 1.5f, 1 + test::kMirrorInset)), 0, 1e-6);
  EXPECT_TRUE(found.omitted.empty());  // the walls reflect nothing that could be missed
}

TEST(Reflectors, FramesAreRigidAndTightWhateverTheTilt) {
  for (int i = 0; i < 12; ++i) {
    const float a = 0.3f + 0.5f * static_cast<float>(i);
    const Vec3 n = glm::normalize(Vec3(std::sin(a), std::cos(2.3f * a), std::cos(a)));
    const Mat3 frame = frame_from_normal(n);
    Workshop w;
    const Vec3 u = 3.0f * (std::cos(a) * frame[0] + std::sin(a) * frame[1]);
    const Vec3 v = 2.0f * (std::cos(a) * frame[1] - std::sin(a) * frame[0]);
    w.parts.quad("tilted", 0, Vec3(1, 0.5f, -0.5f), u, v);
    const FoundReflectors found = w.find();
    ASSERT_EQ(found.reflectors.size(), 1u) << i;
    const Reflector& r = found.reflectors[0].reflector;
    const Mat3 m(r.pack_from_reflector);
    EXPECT_NEAR(glm::determinant(m), 1, 1e-5);
    EXPECT_NEAR(glm::length(m[2] - n), 0, 1e-5);
    EXPECT_NEAR(glm::dot(m[0], m[1]), 0, 1e-6);
    EXPECT_NEAR(r.upper.x - r.lower.x, 3, 1e-4) << i;
    EXPECT_NEAR(r.upper.y - r.lower.y, 2, 1e-4) << i;
    for (const std::uint32_t t : found.reflectors[0].triangles)
      for (int corner = 0; corner < 3; ++corner) {
        const Vec3 p = reflector_from_pack(r, w.scene.positions[w.scene.triangles[t][corner]]);
        EXPECT_NEAR(p.z, 0, 1e-5);
        EXPECT_GE(p.x, r.lower.x - 1e-4f);
        EXPECT_LE(p.y, r.upper.y + 1e-4f);
      }
  }
}

TEST(Reflectors, AConcavePolygonIsOneReflector) {
  Workshop w;
  // An L of three unit squares.
  w.parts.mesh("L", 0, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
               std::vector<Vec3>(6, Vec3(0, 0, 1)), {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  const FoundReflectors found = w.find();
  ASSERT_EQ(found.reflectors.size(), 1u);
  EXPECT_EQ(found.reflectors[0].triangles.size(), 4u);
  EXPECT_NEAR(found.reflectors[0].reflector.area_m2, 3, 1e-5);
  EXPECT_NEAR(found.reflectors[0].reflector.upper.x, 1, 1e-5);
}

TEST(Reflectors, CoplanarQuadsOfOneNodeJoinAndOthersDoNot) {
  Workshop w;
  w.parts.quad("panes", 0, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  w.parts.quad("panes", 0, {1.5f, 0, 0}, {1, 0, 0}, {0, 1, 0});   // same node, apart
  w.parts.quad("panes", 0, {0, 0, 0.05f}, {1, 0, 0}, {0, 1, 0});  // parallel
  w.parts.quad("panes", 0, {4, 0, 0}, {0, 1, 0}, {1, 0, 0});      // coplanar, facing away
  w.parts.quad("other", 0, {-2, 0, 0}, {1, 0, 0}, {0, 1, 0});     // coplanar, another node
  const FoundReflectors found = w.find();
  std::vector<std::size_t> triangles;
  for (const FoundReflector& f : found.reflectors) triangles.push_back(f.triangles.size());
  ASSERT_EQ(triangles.size(), 4u);  // the pair, the parallel one, the one facing away, and the other node
  EXPECT_EQ(triangles[0], 4u);
}

TEST(Reflectors, RoughWeakAndEmissiveOnesAreLeftOutWithAReasonAndCurvedAndSmallOnesAreNotPlanar) {
  Workshop w;
  w.materials.push_back({.roughness = 0.7f, .f0 = Vec3(0.04f), .f90 = 1});
  w.materials.push_back({.roughness = 0, .f0 = Vec3(0.001f), .f90 = 0.1f});
  w.materials.push_back(kMirror);
  w.materials.push_back({.roughness = 0.55f, .f0 = Vec3(0.04f), .f90 = 1});
  w.materials.push_back({.roughness = 0.8f, .f0 = Vec3(0.9f), .f90 = 1});
  SceneMaterial rough, weak, lamp;
  rough.name = "rough";
  weak.name = "weak";
  lamp.name = "lamp";
  lamp.emission = Vec3(100);
  w.parts.add(rough);
  w.parts.add(weak);
  w.parts.add(lamp);
  w.parts.add({});  // a plastic's and a metal's
  w.parts.add({});
  std::vector<Vec3> positions, normals;
  std::vector<UVec3> triangles;
  for (std::uint32_t i = 0; i < 64; ++i) {  // a cylinder 1 m wide and 2 m high
    const float a = static_cast<float>(i) * kPi / 32;
    const Vec3 n(std::cos(a), 0, -std::sin(a));
    positions.insert(positions.end(), {0.5f * n, 0.5f * n + Vec3(0, 2, 0)});
    normals.insert(normals.end(), {n, n});
    const std::uint32_t j = (i + 1) % 64;
    triangles.insert(triangles.end(), {UVec3(2 * i, 2 * j, 2 * j + 1), UVec3(2 * i, 2 * j + 1, 2 * i + 1)});
  }
  w.parts.mesh("column", 0, positions, normals, triangles);
  w.parts.quad("small", 0, {3, 0, 0}, {0.4f, 0, 0}, {0, 0.4f, 0});
  for (std::uint32_t m = 2; m < 7; ++m) w.parts.quad("wall", m, {-3, static_cast<float>(m), 0}, {1, 0, 0}, {0, 0, 1});
  const FoundReflectors found = w.find();
  EXPECT_TRUE(found.reflectors.empty());
  std::string all;
  for (const std::string& line : texts_of(found.omitted)) all += line + "\n";
  for (const char* expected :
       {"'rough': baked and shown, but its reflections without an image: with a roughness of 0.7", "image: it reflects",
        "image: it emits", "'wall' (1 planar pieces, 1 m²): roughness above"})
    EXPECT_NE(all.find(expected), std::string::npos) << expected << " in\n" << all;
  EXPECT_EQ(found.unplanar.size(), 132u);  // the column, the small quad, and all of the rough metal
}

TEST(Reflectors, APolishedDielectricFloorCounts) {
  Workshop w;
  w.materials[0] = {.roughness = 0.1f, .f0 = Vec3(0.04f), .f90 = 1};
  w.parts.quad("floor", 0, Vec3(0), {0, 0, 4}, {4, 0, 0});
  EXPECT_EQ(w.find().reflectors.size(), 1u);
}

TEST(Reflectors, AFineFlatGridIsOneReflectorEvenWithNoise) {
  for (const float noise : {0.0f, 2e-7f}) {
    Workshop w;
    const std::uint32_t n = 120;
    const Mat3 frame = frame_from_normal(glm::normalize(Vec3(1, 2, 3)));
    std::vector<Vec3> positions;
    std::vector<UVec3> triangles;
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x) {
        const float bump = noise * (static_cast<float>((x * 7919u + y * 104729u) % 101u) / 50 - 1);
        positions.push_back(frame * Vec3(3.0f * static_cast<float>(x) / n, 3.0f * static_cast<float>(y) / n, bump));
        const std::uint32_t i = y * (n + 1) + x;
        if (x < n && y < n)
          triangles.insert(triangles.end(), {UVec3(i, i + 1, i + n + 2), UVec3(i, i + n + 2, i + n + 1)});
      }
    w.parts.mesh("grid", 0, positions, std::vector<Vec3>(positions.size(), frame[2]), triangles);
    const FoundReflectors found = w.find();
    ASSERT_EQ(found.reflectors.size(), 1u);
    EXPECT_EQ(found.reflectors[0].triangles.size(), triangles.size());
    EXPECT_NEAR(found.reflectors[0].reflector.area_m2, 9, 1e-3);
  }
}

TEST(Reflectors, ScaleDoesNotMatter) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    const test::MirrorRoom room(scale);
    auto accel = Accel::build(room.scene);
    ASSERT_TRUE(accel);
    const FoundReflectors found = find_reflectors(*accel, room.materials(), room.reflector_options());
    ASSERT_EQ(found.reflectors.size(), 1u) << scale;
    EXPECT_NEAR(found.reflectors[0].reflector.upper.x / scale, 1, 1e-5);
  }
}

TEST(Reflectors, ADoubleSidedPaneReflectsOnBothSidesAndABuriedOneOnNone) {
  Workshop w;
  w.parts.scene().materials[0].double_sided = true;
  w.parts.quad("pane", 0, Vec3(0), {1, 0, 0}, {0, 1, 0});
  const FoundReflectors both = w.find();
  ASSERT_EQ(both.reflectors.size(), 2u);
  EXPECT_NEAR(both.reflectors[0].reflector.pack_from_reflector[2].z,
              -both.reflectors[1].reflector.pack_from_reflector[2].z, 1e-6);

  Workshop buried;
  buried.parts.quad("pane", 0, Vec3(0), {1, 0, 0}, {0, 1, 0});
  buried.parts.quad("cover", 1, Vec3(-1, -1, 0.01f), {3, 0, 0}, {0, 3, 0});
  const FoundReflectors none = buried.find();
  EXPECT_TRUE(none.reflectors.empty());
  ASSERT_FALSE(none.omitted.empty());
}

TEST(Reflectors, OnlyTheMostImportantAreKept) {
  Workshop w;
  for (int i = 0; i < 5; ++i)
    w.parts.quad(fmt::format("q{}", i), 0, {0, 0, 0.5f * static_cast<float>(i) - 1},
                 {1.0f + 0.1f * static_cast<float>(i), 0, 0}, {0, 1, 0});
  ReflectorOptions options;
  options.max_reflectors = 2;
  const FoundReflectors found = w.find(10, options);
  ASSERT_EQ(found.reflectors.size(), 2u);
  EXPECT_EQ(found.reflectors[0].reflector.name, "q4");
  EXPECT_EQ(found.reflectors[1].reflector.name, "q3");
  ASSERT_FALSE(found.omitted.empty());
  EXPECT_EQ(found.omitted.back().text, "3 reflectors ('q2' and others): less important than the 2 kept");
}

TEST(Rectangle, IsTightAndPrefersTheGivenAxes) {
  const std::vector<DVec2> diamond{{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
  EXPECT_NEAR(tight_rectangle(diamond, {1, 0}).area(), 2, 1e-12);
  const std::vector<DVec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}};
  const Rectangle r = tight_rectangle(square, {1, 0});
  EXPECT_NEAR(r.area(), 1, 1e-12);
  EXPECT_NEAR(std::abs(r.axis.x), 1, 1e-12);
  EXPECT_EQ(tight_rectangle(std::vector<DVec2>{{3, 4}}, {1, 0}).area(), 0);
  EXPECT_EQ(tight_rectangle(std::vector<DVec2>{{0, 0}, {1, 1}}, {1, 0}).area(), 0);
}

TEST(Rectangle, ClippedAreasAddUp) {
  const std::array<DVec2, 3> triangle{DVec2(0.1, 0.2), DVec2(3.7, 0.4), DVec2(1.5, 2.9)};
  const double whole = clipped_area(triangle, {-10, -10}, {10, 10});
  EXPECT_NEAR(whole, 0.5 * (3.6 * 2.7 - 1.4 * 0.2), 1e-12);
  double sum = 0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) sum += clipped_area(triangle, {x, y}, {x + 1, y + 1});
  EXPECT_NEAR(sum, whole, 1e-12);
  EXPECT_EQ(clipped_area(triangle, {5, 5}, {6, 6}), 0);
}

}  // namespace
}  // namespace oriel
