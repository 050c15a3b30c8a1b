#include <array>

#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

// Corners in the published unit, taken as millimetres, counter-clockwise from the front.
using Corners = std::array<Vec3, 4>;

void add(SampleMesh& mesh, const Corners& corners) {
  const auto metres = [](const Vec3& p) { return Vec3(DVec3(p) / 1000.0); };
  add_corners(mesh, metres(corners[0]), metres(corners[1]), metres(corners[2]), metres(corners[3]));
}

constexpr Corners kBoxFloor{{{552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f}}};
constexpr Corners kCeiling{{{556, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, 548.8f, 559.2f}, {0, 548.8f, 0}}};
constexpr Corners kLight{{{343, 548.8f, 227}, {343, 548.8f, 332}, {213, 548.8f, 332}, {213, 548.8f, 227}}};
constexpr Corners kBackWall{{{549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f}}};
constexpr Corners kGreenWall{{{0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}}};
constexpr Corners kRedWall{{{552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}}};
// Tops of the blocks, seen from above.
constexpr Corners kShortTop{{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}};
constexpr Corners kTallTop{{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}};

// A block standing on the floor; its bottom is never seen.
SampleMesh block(std::string name, std::uint32_t material, const Corners& top, bool with_top = true) {
  SampleMesh mesh{std::move(name), material};
  if (with_top) add(mesh, top);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 a = top[i], b = top[(i + 1) % 4];
    add(mesh, {{{a.x, 0, a.z}, {b.x, 0, b.z}, b, a}});
  }
  return mesh;
}

SampleMesh wall(std::string name, std::uint32_t material, const Corners& corners) {
  SampleMesh mesh{std::move(name), material};
  add(mesh, corners);
  return mesh;
}

struct BoxMaterials {
  std::uint32_t white, red, green, light;
};

BoxMaterials add_materials(SampleScene& scene) {
  const auto material = [&](std::string name, const Vec3& color, const Vec3& emission = Vec3(0)) {
    return add_material(scene, {.name = std::move(name), .base_color = color, .emission = emission});
  };
  // The published reflectance spectra as linear Rec. 709.
  const std::uint32_t white = material("white", Vec3(0.73f));
  const std::uint32_t red = material("red", Vec3(0.61f, 0.06f, 0.06f));
  const std::uint32_t green = material("green", Vec3(0.12f, 0.44f, 0.11f));
  // Its emission has the published spectrum's hue; its strength lights the floor like an office, about 500 lux.
  return {white, red, green, material("light", Vec3(0.78f), 300.0f * Vec3(17, 12, 4))};
}

// The box, its light and the published camera: focal length 0.035 behind a film of 0.025 squared.
void add_walls(SampleScene& scene, const BoxMaterials& m, SampleMesh ceiling, const Corners& light) {
  place(scene, wall("floor", m.white, kBoxFloor));
  place(scene, std::move(ceiling));
  place(scene, wall("light", m.light, light));
  place(scene, wall("back wall", m.white, kBackWall));
  place(scene, wall("green wall", m.green, kGreenWall));
  place(scene, wall("red wall", m.red, kRedWall));
  const float fov_rad = 2.0f * std::atan(0.0125f / 0.035f);
  scene.cameras.push_back({"camera", Vec3(0.278f, 0.273f, -0.8f), Vec3(0.278f, 0.273f, 0), fov_rad});
}

}  // namespace

SampleScene make_cornell() {
  SampleScene scene;
  scene.name = "Cornell box";
  const BoxMaterials m = add_materials(scene);
  SampleMesh ceiling{"ceiling", m.white};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    add(ceiling, {{kCeiling[i], kCeiling[next], kLight[next], kLight[i]}});
  }
  add_walls(scene, m, std::move(ceiling), kLight);
  place(scene, block("short block", m.white, kShortTop));
  place(scene, block("tall block", m.white, kTallTop));
  return scene;
}

SampleScene make_glass_sphere() {
  SampleScene scene;
  scene.name = "Cornell box with a glass sphere";
  const BoxMaterials m = add_materials(scene);
  Corners light = kLight;
  for (Vec3& corner : light) corner.y -= 2;  // the ceiling has no hole
  add_walls(scene, m, wall("ceiling", m.white, kCeiling), light);
  place(scene, block("short block", m.white, kShortTop, false));
  place(scene, wall("short block's top",
                    add_material(scene, {.name = "mirror", .base_color = Vec3(0.9f), .metallic = 1, .roughness = 0}),
                    kShortTop));
  place(scene, block("tall block", m.white, kTallTop));
  SampleMesh sphere{"glass sphere", add_material(scene, {.name = "glass",
                                                         .base_color = Vec3(1),
                                                         .roughness = 0,
                                                         .specular = 1,
                                                         .transmission = 1,
                                                         .ior = 1.5f,
                                                         .thickness_m = 0.16f})};
  add_sphere(sphere, Vec3(0), 0.08f, 20, 10);
  place(scene, std::move(sphere), {0.41f, 0.081f, 0.12f});
  return scene;
}

}  // namespace oriel::sample
