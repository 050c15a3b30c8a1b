// Double-sided surfaces: which sides are lit, and that two one-sided surfaces are what one double-sided was.
#include <gtest/gtest.h>

#include "bake/scene/shade.h"
#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

std::uint32_t sheet_material(SceneParts& parts, const Vec3& emission = Vec3(0)) {
  const std::uint32_t material = parts.diffuse(Vec3(0.5f), emission);
  parts.scene().materials[material].double_sided = true;
  return material;
}

void add_sun(SceneParts& parts, const Vec3& direction) {
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(direction);
  sun.intensity = Vec3(10);
  parts.scene().lights.push_back(sun);
}

FoundSides find(const Scene& scene, int threads = 0, std::span<const Vec3> eyes = {}) {
  Context context;
  context.threads = threads;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  return *find_lit_sides({accel, lights, {}}, eyes, context);
}

// The double-sided surfaces of a scene with light on those sides.
Scene split(Scene scene, LitSides lit) {
  std::vector<LitSides> sides(scene.triangles.size(), LitSides::kFront);
  for (std::uint32_t t = 0; t < sides.size(); ++t)
    if (scene.material_of(t).double_sided) sides[t] = lit;
  return split_sides(std::move(scene), sides);
}

TEST(LitSides, AreToldByTheLight) {
  for (const float z : {-1.0f, 1.0f}) {
    SceneParts parts;
    parts.quad("sheet", sheet_material(parts), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});  // faces +z
    add_sun(parts, {0, 0, z});
    EXPECT_EQ(find(parts.scene()).sides[0], z < 0 ? LitSides::kFront : LitSides::kBack);
    add_sun(parts, {0, 0, -0.1f * z});
    EXPECT_EQ(find(parts.scene()).sides[0], LitSides::kBoth);
  }
}

// Thousands of triangles that share no vertex are looked at in patches, with what each would be told alone; in few
// rays.
TEST(LitSides, ThousandsOfPartsAreToldInPatches) {
  SceneParts parts;
  const std::uint32_t material = sheet_material(parts);
  constexpr int kSide = 80;
  for (const float z : {0.0f, 5.0f}) {  // two sheets: the sun is before the first and behind the second
    std::vector<Vec3> positions, normals;
    std::vector<UVec3> triangles;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Vec3 at(static_cast<float>(i % kSide), static_cast<float>(i / kSide), z);
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const Vec3& p : {at, at + Vec3(0.9f, 0, 0), at + Vec3(0, 0.9f, 0)}) positions.push_back(p);
      normals.insert(normals.end(), 3, Vec3(0, 0, 1));
      triangles.push_back(z > 0 ? UVec3(first, first + 2, first + 1) : UVec3(first, first + 1, first + 2));
    }
    parts.mesh(z > 0 ? "second" : "first", material, positions, normals, triangles);
  }
  parts.quad("wall", parts.diffuse(Vec3(0)), {-5, -5, 2}, {0, 90, 0}, {90, 0, 0});
  add_sun(parts, {0, 0, -1});
  add_sun(parts, {0, 0, 1});
  const Scene scene = parts.finish();
  const FoundSides found = find(scene);
  EXPECT_LT(found.report.turned + found.report.doubled, 4097u);
  // The wall keeps one sun from each: the same answer for every triangle of a sheet.
  for (std::uint32_t t = 1; t < kSide * kSide; ++t) ASSERT_EQ(found.sides[t], found.sides[0]) << t;
  EXPECT_EQ(found.sides[0], LitSides::kBack) << "the sun that shines to +z lights its back";
  EXPECT_LT(found.report.rays, 1200000u);
}

// A side that is lit needs no more paths than tell its mean: the outside of a body.
TEST(LitSides, PathsAskOnlyWhatIsDark) {
  SceneParts parts;
  parts.sphere("body", sheet_material(parts), {0, 0, 0}, 1, 2);
  parts.scene().sky = Vec3(1);
  EXPECT_LT(find(parts.finish()).report.rays, 256u * 5);
}

// The sun lights the front. Its back is dark, and counts where eyes see it, through a pane too.
TEST(LitSides, AreThoseThatEyesSeeToo) {
  SceneParts parts;
  parts.quad("sheet", sheet_material(parts), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});  // faces +z
  SceneMaterial glass;
  glass.transmission = 1, glass.specular = 0, glass.metallic = 0;
  parts.quad("pane", parts.add(glass), {-9, -9, -1}, {20, 0, 0}, {0, 20, 0});
  add_sun(parts, {0, 0, -1});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const auto side = [&](const std::vector<Vec3>& eyes) {
    Context context;
    return find_lit_sides({accel, lights, {}}, eyes, context)->sides[0];
  };
  EXPECT_EQ(side({}), LitSides::kFront);
  EXPECT_EQ(side({{0.5f, 0.5f, 2}}), LitSides::kFront);
  EXPECT_EQ(side({{0.5f, 0.5f, -2}}), LitSides::kBoth);
}

TEST(LitSides, AreTheSameForAnyThreads) {
  SceneParts parts;
  const auto sheet = sheet_material(parts);
  for (int i = 0; i < 40; ++i)
    parts.quad("sheet", sheet, {0, 0, 0.01f * static_cast<float>(i)}, {1, 0, 0.3f}, {0, 1, 0});
  add_sun(parts, {0.3f, 0, -1});
  const FoundSides one = find(parts.finish(), 1), two = find(parts.finish(), 2);
  EXPECT_EQ(one.sides, two.sides);
  EXPECT_EQ(one.report.rays, two.report.rays);
}

TEST(LitSides, OfOneSidedUnlitAndClosedSurfacesStayAsTheyAre) {
  SceneParts parts;
  const auto sheet = sheet_material(parts), unlit = sheet_material(parts);
  parts.scene().materials[unlit].unlit = true;
  parts.sphere("body", sheet, {0, 0, 0}, 1, 2);
  parts.quad("unlit", unlit, {3, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.quad("one-sided", parts.diffuse(Vec3(0.5f)), {6, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.scene().sky = Vec3(1);
  EXPECT_FALSE(find(parts.finish()).change_scene());
}

TEST(LitSides, OfOneSidedSurfacesTakeNoRay) {
  SceneParts parts;
  parts.quad("one-sided", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.scene().sky = Vec3(1);
  EXPECT_EQ(find(parts.finish(), 0, {{Vec3(0, 0, 1)}}).report.rays, 0u);
}

TEST(SplitSides, KeepsEachPartApart) {
  SceneParts parts;
  const auto sheet = sheet_material(parts);
  parts.box("box", sheet, Vec3(0), Vec3(1));
  parts.quad("plain", parts.diffuse(Vec3(1)), {3, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Scene in = parts.finish();
  for (std::uint32_t t = 0; t < in.triangles.size(); ++t) in.face_normals.push_back(geometric_normal(in, t));
  std::vector<LitSides> sides(in.triangles.size(), LitSides::kFront);
  sides[2] = sides[3] = LitSides::kBack;
  sides[4] = sides[5] = LitSides::kBoth;
  const Scene out = split_sides(in, sides);
  ASSERT_EQ(out.surfaces.size(), 5u);
  ASSERT_EQ(out.triangles.size(), in.triangles.size() + 2);
  EXPECT_EQ(out.surfaces[4].name, "box (back)");
  std::size_t vertices = 0;
  for (const Surface& s : out.surfaces) {
    EXPECT_EQ(s.first_vertex, vertices);
    vertices += s.vertex_count;
    for (std::uint32_t t = s.first_triangle; t < s.first_triangle + s.triangle_count; ++t) {
      EXPECT_EQ(&out.surfaces[out.triangle_surface[t]], &s);
      for (int k = 0; k < 3; ++k) EXPECT_LT(out.triangles[t][k] - s.first_vertex, s.vertex_count);
      EXPECT_GT(glm::dot(geometric_normal(out, t), out.normals[out.triangles[t].x]), 0.99f);
    }
  }
  EXPECT_EQ(vertices, out.positions.size());
  EXPECT_TRUE(out.materials[out.surfaces[0].material].double_sided);
  EXPECT_TRUE(out.materials[out.surfaces[1].material].double_sided);
  EXPECT_FALSE(out.materials[out.surfaces[2].material].double_sided);
  EXPECT_EQ(out.surfaces[4].material, out.surfaces[2].material);
  for (std::uint32_t t = 0; t < out.triangles.size(); ++t) {
    const bool pair = out.triangle_surface[t] == 2 || out.triangle_surface[t] == 4;
    ASSERT_EQ(out.twin[t] != ~0u, pair);
    if (!pair) continue;
    EXPECT_EQ(out.twin[out.twin[t]], t);
    EXPECT_LT(glm::dot(geometric_normal(out, t), geometric_normal(out, out.twin[t])), -0.99f);
  }
}

TEST(SplitSides, RaysMeetTheFrontOfEither) {
  SceneParts parts;
  parts.quad("sheet", sheet_material(parts), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Scene scene = split(parts.finish(), LitSides::kBoth);
  const Accel accel = *Accel::build(scene);
  for (const float z : {1.0f, -1.0f}) {
    const Ray ray{{0.7f, 0.2f, z}, {0, 0, -z}};
    Hit packet;
    accel.intersect(std::span(&ray, 1), std::span(&packet, 1));
    for (const Hit& hit : {accel.intersect(ray), packet}) {
      ASSERT_TRUE(hit);
      EXPECT_TRUE(hit.front);
      EXPECT_EQ(scene.triangle_surface[hit.triangle], z > 0 ? 0u : 1u);
      EXPECT_LT(glm::distance(point_on(scene, hit.triangle, hit.barycentric), Vec3(0.7f, 0.2f, 0)), 1e-6f);
    }
  }
}

// Glass and cut-outs act once on a ray that crosses them; a lamp sends the same light to both sides.
TEST(SplitSides, LightIsWhatItWas) {
  for (const int kind : {0, 1, 2}) {
    SceneParts parts;
    const auto sheet = sheet_material(parts, kind == 2 ? Vec3(5) : Vec3(0));
    SceneMaterial& m = parts.scene().materials[sheet];
    if (kind == 0) m.transmission = 0.8f;
    if (kind == 1) m.alpha_mode = AlphaMode::kBlend, m.alpha = 0.4f;
    parts.box("room", parts.diffuse(Vec3(0.6f)), {-1, -1, -1}, {2, 2, 2}, true);
    parts.quad("sheet", sheet, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(3)), {0, 1.9f, 1}, {1, 0, 0}, {0, 0, 0.5f});
    const Scene whole = parts.finish(), parted = split(whole, LitSides::kBoth);
    const LightSet lights_of_whole(whole), lights_of_parted(parted);
    EXPECT_LT(glm::distance(lights_of_whole.power(), lights_of_parted.power()), 1e-6 * lights_of_whole.power().g);
    const Accel a = *Accel::build(whole), b = *Accel::build(parted);
    const Ray through{{0.3f, 0.6f, 1}, {0, 0, -1}, 1.5f};
    EXPECT_LT(glm::distance(a.transmittance(through), b.transmittance(through)), 1e-6f);
    double light[2] = {0, 0};
    std::uint64_t rays = 0;
    constexpr std::uint32_t kSamples = 1 << 15;
    for (int scene = 0; scene < 2; ++scene) {
      const Transport t{scene == 0 ? a : b, scene == 0 ? lights_of_whole : lights_of_parted, {}};
      for (std::uint32_t k = 0; k < kSamples; ++k) {
        Sampler sampler(7, static_cast<std::uint64_t>(scene), k);
        light[scene] += sample_irradiance(t, point_on_side(t.accel.scene(), 5, Vec2(0.3f)), sampler, rays).direct.g +
                        sample_irradiance(t, point_on_side(t.accel.scene(), 4, Vec2(0.3f)), sampler, rays).indirect.g;
      }
    }
    EXPECT_NEAR(light[1] / light[0], 1, 0.02) << kind;
  }
}

// The normal that a map tilts is the same on the back of a sheet and on the front of its twin.
TEST(SplitSides, NormalMapsTiltAsBefore) {
  for (const bool tangents : {false, true}) {
    SceneParts parts;
    const auto sheet = sheet_material(parts);
    parts.normal_map(sheet, 4, [](float, float) { return Vec3(0.4f, 0.2f, 1); });
    parts.quad("sheet", sheet, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    if (tangents) parts.scene().tangents.assign(4, Vec4(glm::normalize(Vec3(1, 0.5f, 0)), -1));
    const Scene whole = parts.finish(), parted = split(whole, LitSides::kBoth), turned = split(whole, LitSides::kBack);
    const Accel a = *Accel::build(whole), b = *Accel::build(parted), c = *Accel::build(turned);
    const Ray ray{{0.7f, 0.2f, -1}, {0, 0, 1}};
    const Vec3 expected = surface_at(whole, a.intersect(ray), ray.direction).normal;
    EXPECT_GT(std::abs(expected.x), 0.1f);
    EXPECT_LT(glm::distance(surface_at(parted, b.intersect(ray), ray.direction).normal, expected), 1e-6f);
    EXPECT_LT(glm::distance(surface_at(turned, c.intersect(ray), ray.direction).normal, expected), 1e-6f);
  }
}

TEST(BakedSides, BackLitSheetIsTurned) {
  SceneParts parts;
  parts.quad("sheet", sheet_material(parts), {0, 0, 0}, {0, 1, 0}, {1, 0, 0});  // faces -z
  add_sun(parts, {0.5f, 0, -1});
  RadiosityOptions options;
  options.samples = 16;
  options.directional = true;
  const Baked b = test::bake(parts.finish(), 0.25f, options);
  EXPECT_EQ(b.sides.turned, 1u);
  EXPECT_GT(geometric_normal(b.scene, 0).z, 0);
  b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t) {
    EXPECT_NEAR(page.irradiance[texel].g, 10 / std::sqrt(1.25f), 1e-4f);
    EXPECT_LT(glm::length(page.direction[texel] - glm::normalize(Vec3(-0.5f, 0, 1))), 1e-5f);
  });
}

// A sheet with the sun on one side and a tenth of it on the other.
TEST(BakedSides, SheetLitFromBothSidesHoldsTwoLights) {
  for (const Estimator estimator : {Estimator::kReference, Estimator::kCached}) {
    SceneParts parts;
    parts.quad("sheet", sheet_material(parts), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_sun(parts, {0, 0, -1});
    add_sun(parts, {0, 0, 1});
    parts.scene().lights[1].intensity = Vec3(1);
    RadiosityOptions options;
    options.estimator = estimator;
    options.samples = 1024;
    const Baked b = test::bake(parts.finish(), 0.25f, options);
    EXPECT_EQ(b.sides.doubled, 1u);
    b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t triangle) {
      EXPECT_NEAR(page.irradiance[texel].g / (geometric_normal(b.scene, triangle).z > 0 ? 10 : 1), 1, 0.02);
    });
  }
}

}  // namespace
}  // namespace oriel
