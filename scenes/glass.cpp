#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kGlassRoom{3, 2.6f, 3};  // from the origin; open towards +z
constexpr float kGlassPanel = 0.7f;     // side of the ceiling panel

std::uint32_t glass(SampleScene& scene, std::string name, float thickness_m, const Vec3& left_after_1m,
                    float roughness = 0) {
  return add_material(scene, {.name = std::move(name),
                              .base_color = Vec3(1),
                              .roughness = roughness,
                              .specular = 1,
                              .transmission = 1,
                              .ior = 1.52f,
                              .thickness_m = thickness_m,
                              .attenuation_color = left_after_1m,
                              .attenuation_distance_m = 1});
}

void add_walls(SampleScene& scene) {
  const std::uint32_t white = add_diffuse(scene, "white", Vec3(0.73f));
  const Vec3 x(kGlassRoom.x, 0, 0), y(0, kGlassRoom.y, 0), z(0, 0, kGlassRoom.z);
  place_quad(scene, "floor", white, {Vec3(0), z, x});
  place_quad(scene, "back wall", white, {Vec3(0), x, y});
  place_quad(scene, "front wall", white, {z, y, x});
  place_quad(scene, "left wall", add_diffuse(scene, "red", Vec3(0.61f, 0.06f, 0.06f)), {Vec3(0), y, z});
  place_quad(scene, "right wall", add_diffuse(scene, "green", Vec3(0.12f, 0.44f, 0.11f)), {x, z, y});
  const float low = 0.5f * (kGlassRoom.x - kGlassPanel), share = kGlassPanel / kGlassRoom.x;
  SampleMesh ceiling{"ceiling", white};
  add_quad_around(ceiling, {y, x, z}, {Vec2(0.5f - share / 2), Vec2(0.5f + share / 2)});
  place(scene, std::move(ceiling));
  place_quad(scene, "panel", add_diffuse(scene, "panel", Vec3(0.8f), Vec3(4000)),
             {{low, kGlassRoom.y, low}, {kGlassPanel, 0, 0}, {0, 0, kGlassPanel}});
}

// What is seen bent, shifted or blurred behind the glass.
void add_posts(SampleScene& scene) {
  const std::uint32_t colors[] = {add_diffuse(scene, "blue", Vec3(0.08f, 0.15f, 0.5f)),
                                  add_diffuse(scene, "yellow", Vec3(0.7f, 0.5f, 0.08f))};
  for (int i = 0; i < 9; ++i) {
    SampleMesh post{"post " + std::to_string(i), colors[i % 2]};
    const float x = 0.25f + 0.3f * static_cast<float>(i);
    add_box(post, {x, 0, 0.15f}, {x + 0.1f, 2.2f, 0.25f}, kSides | kTop);
    place(scene, std::move(post));
  }
}

}  // namespace

SampleScene make_glass() {
  SampleScene scene;
  scene.name = "Glass";
  add_walls(scene);
  add_posts(scene);
  const std::uint32_t clear = glass(scene, "green glass", 0.5f, {0.35f, 0.85f, 0.6f});
  SampleMesh block{"block", clear};
  add_box(block, {-0.25f, 0, -0.25f}, {0.25f, 1.3f, 0.25f});
  place(scene, std::move(block), {0.85f, 1e-3f, 1.1f}, 0.35f);
  SampleMesh ball{"ball", glass(scene, "clear glass", 0.7f, Vec3(1))};
  add_sphere(ball, Vec3(0), 0.35f, 96, 48);
  place(scene, std::move(ball), {1.45f, 0.351f, 1.15f});
  SampleMesh screen{"screen", glass(scene, "frosted glass", 0.04f, {0.8f, 0.9f, 1}, 0.3f)};
  add_box(screen, {1.75f, 1e-3f, 0.9f}, {2.65f, 1.6f, 0.94f});
  place(scene, std::move(screen));
  scene.cameras.push_back({"camera", {1.5f, 1.3f, 2.97f}, {1.5f, 0.65f, 0}, 1.05f});
  return scene;
}

}  // namespace oriel::sample
