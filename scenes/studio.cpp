#include <array>

#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kStudioRoom{4, 2.7f, 5};  // from the origin
constexpr float kPanel = 0.6f;           // side of the ceiling panel

std::uint32_t metal(SampleScene& scene, std::string name, const Vec3& color, float roughness) {
  return add_material(
      scene, {.name = std::move(name), .base_color = color, .metallic = 1, .roughness = roughness, .specular = 1});
}

void add_walls(SampleScene& scene) {
  const std::uint32_t white = add_diffuse(scene, "white", Vec3(0.75f));
  const std::uint32_t floor = add_diffuse(scene, "oak", Vec3(0.42f, 0.28f, 0.16f));
  const Vec3 x(kStudioRoom.x, 0, 0), y(0, kStudioRoom.y, 0), z(0, 0, kStudioRoom.z);
  place_quad(scene, "floor", floor, {Vec3(0), z, x});
  place_quad(scene, "north wall", white, {Vec3(0), x, y});
  place_quad(scene, "south wall", add_diffuse(scene, "yellow", Vec3(0.7f, 0.55f, 0.15f)), {z, y, x});
  place_quad(scene, "west wall", add_diffuse(scene, "red", Vec3(0.6f, 0.1f, 0.08f)), {Vec3(0), y, z});
  place_quad(scene, "east wall", add_diffuse(scene, "blue", Vec3(0.1f, 0.2f, 0.55f)), {x, z, y});
  // The ceiling around its panel: four strips, and the panel in the hole.
  const Vec3 low = 0.5f * (kStudioRoom - kPanel), high = low + kPanel;
  SampleMesh ceiling{"ceiling", white};
  const auto strip = [&](float x0, float z0, float x1, float z1) {
    add_quad(ceiling, {Vec3(x0, kStudioRoom.y, z0), Vec3(x1 - x0, 0, 0), Vec3(0, 0, z1 - z0)});
  };
  strip(0, 0, kStudioRoom.x, low.z);
  strip(0, high.z, kStudioRoom.x, kStudioRoom.z);
  strip(0, low.z, low.x, high.z);
  strip(high.x, low.z, kStudioRoom.x, high.z);
  place(scene, std::move(ceiling));
  place_quad(scene, "panel", add_diffuse(scene, "panel", Vec3(0.8f), Vec3(2500)),
             {Vec3(low.x, kStudioRoom.y, low.z), Vec3(kPanel, 0, 0), Vec3(0, 0, kPanel)});
}

void add_balls(SampleScene& scene) {
  const auto ball = [&](std::string name, std::uint32_t material, const Vec3& centre, float radius) {
    SampleMesh mesh{std::move(name), material};
    add_sphere(mesh, centre, radius, 96, 48);
    place(scene, std::move(mesh));
  };
  ball("mirror ball", metal(scene, "chrome", Vec3(0.9f), 0), Vec3(1.3f, 0.4f, 2), 0.4f);
  ball("brushed ball", metal(scene, "brass", Vec3(0.9f, 0.7f, 0.35f), 0.25f), Vec3(2.4f, 0.3f, 2.5f), 0.3f);
  SampleMesh block{"block", add_diffuse(scene, "green", Vec3(0.15f, 0.45f, 0.18f))};
  add_box(block, Vec3(1.75f, 0, 1.2f), Vec3(2.15f, 0.7f, 1.6f), kSides | kTop);
  place(scene, std::move(block));
}

// A standing lamp: foot and stem of satin steel, a glowing globe on top.
void add_studio_lamp(SampleScene& scene) {
  const Vec3 foot(3.2f, 0, 1);
  SampleMesh stand{"lamp stand", metal(scene, "satin steel", Vec3(0.7f), 0.15f)};
  const std::array<Vec2, 6> profile{
      {{0.16f, 0}, {0.16f, 0.02f}, {0.12f, 0.035f}, {0.02f, 0.05f}, {0.02f, 1.42f}, {0, 1.42f}}};
  add_lathe(stand, foot, profile, 32);
  place(scene, std::move(stand));
  SampleMesh globe{"lamp globe", add_diffuse(scene, "globe", Vec3(0.8f), Vec3(3000, 2400, 1500))};
  add_sphere(globe, foot + Vec3(0, 1.54f, 0), 0.12f, 32, 16);
  place(scene, std::move(globe));
}

}  // namespace

SampleScene make_studio() {
  SampleScene scene;
  scene.name = "Studio";
  add_walls(scene);
  add_balls(scene);
  add_studio_lamp(scene);
  scene.cameras.push_back({"balls", Vec3(2.1f, 1.1f, 4.6f), Vec3(1.8f, 0.4f, 2), 0.7f});
  scene.cameras.push_back({"ball", Vec3(1.9f, 0.9f, 3.2f), Vec3(1.3f, 0.4f, 2), 0.75f});
  scene.cameras.push_back({"lamp", Vec3(2.2f, 1.2f, 2.4f), Vec3(3.2f, 0.8f, 1), 0.8f});
  return scene;
}

}  // namespace oriel::sample
