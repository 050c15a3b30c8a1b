// The Cornell box's energy: what the lamp emits is absorbed by the walls or leaves through the open front.
#include <gtest/gtest.h>
#include <unistd.h>

#include "bake/import/import.h"
#include "bake/radiosity/radiosity.h"
#include "bake/scene/shade.h"
#include "tests/frames/frames.h"

namespace oriel {
namespace {
namespace fs = std::filesystem;

// Closes the box's open front (its smallest z, where the camera stands) with a black surface: it absorbs what would
// escape and changes nothing else.
void add_portal(Scene& scene) {
  const Vec3 lo = scene.lower, hi = scene.upper;
  SceneMaterial black;
  black.name = "portal";
  black.base_color = Vec3(0);
  black.metallic = 0;
  black.specular = 0;
  scene.materials.push_back(black);
  Surface surface;
  surface.name = surface.mesh_name = "portal";
  surface.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
  surface.first_triangle = static_cast<std::uint32_t>(scene.triangles.size());
  surface.triangle_count = 2;
  surface.first_vertex = static_cast<std::uint32_t>(scene.positions.size());
  surface.vertex_count = 4;
  for (const Vec3& p : {lo, Vec3(hi.x, lo.y, lo.z), Vec3(hi.x, hi.y, lo.z), Vec3(lo.x, hi.y, lo.z)}) {
    scene.positions.push_back(p);
    scene.normals.push_back({0, 0, 1});
    scene.uv0.emplace_back();
    scene.uv1.emplace_back();
  }
  const std::uint32_t v = surface.first_vertex;
  scene.triangles.push_back({v, v + 1, v + 2});
  scene.triangles.push_back({v, v + 2, v + 3});
  scene.triangle_surface.insert(scene.triangle_surface.end(), 2, static_cast<std::uint32_t>(scene.surfaces.size()));
  scene.surfaces.push_back(surface);
}

TEST(CornellEnergy, EmittedIsAbsorbedOrEscapes) {
  const fs::path folder = fs::temp_directory_path() / ("oriel-energy-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  ASSERT_EQ(test::run(folder, "oriel-scenes cornell -o cornell.glb"), 0);
  Context context;
  Scene scene = import_gltf(folder / "cornell.glb", {}, context)->scene;
  fs::remove_all(folder);
  add_portal(scene);
  AtlasOptions options;
  options.texel_m = 0.02f;
  const Atlas atlas = *build_atlas(scene, options, context);
  const auto map = *build_texel_map(atlas, context);
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Radiosity baked = *bake_radiosity({{accel, lights, {}}, atlas, map}, {.samples = 256, .dilation = 0}, context);
  DVec3 absorbed(0), escaped(0);
  for (std::size_t p = 0; p < map.size(); ++p)
    for (std::size_t i = 0; i < map[p].texel.size(); ++i) {
      if (baked.pages[p].state[map[p].texel[i]] != TexelState::kValid) continue;
      double area = 0;
      for (std::uint32_t f = map[p].first[i]; f < map[p].first[i + 1]; ++f) area += map[p].fragments[f].area;
      const std::uint32_t triangle = map[p].fragments[map[p].first[i]].triangle;
      const DVec3 flux = DVec3(baked.pages[p].irradiance[map[p].texel[i]]) *
                         (baked.visible[p][i] * area * atlas.texel_m * atlas.texel_m);
      const bool portal = scene.surfaces[scene.triangle_surface[triangle]].name == "portal";
      (portal ? escaped : absorbed) += flux * DVec3(Vec3(1) - shade_point(scene, triangle, Vec2(1.0f / 3)).diffuse);
    }
  for (int c = 0; c < 3; ++c) {
    const double emitted = lights.power()[c];
    std::printf("cornell, channel %d: emitted %.4f lm, absorbed %.4f, escaped %.4f, balance %+.3f %%\n", c, emitted,
                absorbed[c], escaped[c], 100 * ((absorbed[c] + escaped[c]) / emitted - 1));
    EXPECT_NEAR((absorbed[c] + escaped[c]) / emitted, 1, 0.005);
  }
}

}  // namespace
}  // namespace oriel
