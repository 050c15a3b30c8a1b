#include <array>

#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kHall{40, 6, 20};  // from the origin
constexpr int kColumnsAlong = 20, kColumnsAcross = 10;
constexpr Vec2 kPanel{2.4f, 0.6f};  // of the ceiling, 5 cm below it

void add_hall(SampleScene& scene) {
  const Vec3 x(kHall.x, 0, 0), y(0, kHall.y, 0), z(0, 0, kHall.z);
  const std::uint32_t plaster = add_diffuse(scene, "plaster", Vec3(0.7f));
  const auto side = [&](std::string name, std::uint32_t material, const Vec3& origin, const Vec3& u, const Vec3& v) {
    SampleMesh mesh{std::move(name), material};
    add_quad(mesh, {origin, u, v});
    place(scene, std::move(mesh));
  };
  side("floor", add_diffuse(scene, "flags", Vec3(0.4f, 0.36f, 0.3f)), Vec3(0), z, x);
  side("ceiling", plaster, y, x, z);
  side("north wall", plaster, Vec3(0), x, y);
  side("south wall", plaster, z, y, x);
  side("west wall", plaster, Vec3(0), y, z);
  side("east wall", plaster, x, z, y);
}

// A square base, a round shaft and a square capital just under the ceiling's lamps.
void add_column(SampleScene& scene, std::uint32_t stone, const Vec3& foot, std::string name) {
  constexpr float kRadius = 0.18f, kHalf = 0.26f, kFoot = 0.3f, kHead = 5.2f, kEnd = 5.5f;
  SampleMesh mesh{std::move(name), stone};
  const auto block = [&](float low, float high, unsigned faces) {
    add_box(mesh, foot + Vec3(-kHalf, low, -kHalf), foot + Vec3(kHalf, high, kHalf), faces);
  };
  block(0, kFoot, kSides | kTop);
  const std::array<Vec2, 2> shaft{{{kRadius, kFoot}, {kRadius, kHead}}};
  add_lathe(mesh, foot, shaft, 24);
  block(kHead, kEnd, kAllFaces);
  place(scene, std::move(mesh));
}

}  // namespace

SampleScene make_colonnade() {
  SampleScene scene;
  scene.name = "Colonnade";
  add_hall(scene);
  const std::uint32_t stone = add_diffuse(scene, "stone", Vec3(0.6f, 0.57f, 0.5f));
  for (int i = 0; i < kColumnsAlong; ++i)
    for (int j = 0; j < kColumnsAcross; ++j)
      add_column(scene, stone, Vec3(static_cast<float>(i) * 2 + 1, 0, static_cast<float>(j) * 2 + 1),
                 "column " + std::to_string(i + 1) + "." + std::to_string(j + 1));
  const std::uint32_t lamp = add_diffuse(scene, "lamp", Vec3(0.8f), Vec3(9000, 8600, 8000));
  for (int k = 0; k < 8; ++k) {
    SampleMesh mesh{"lamp " + std::to_string(k + 1), lamp};
    const Vec3 middle(static_cast<float>(k % 4) * 10 + 5, kHall.y - 0.05f, static_cast<float>(k / 4) * 10 + 5);
    add_quad(mesh, {middle - 0.5f * Vec3(kPanel.x, 0, kPanel.y), Vec3(kPanel.x, 0, 0), Vec3(0, 0, kPanel.y)});
    place(scene, std::move(mesh));
  }
  scene.cameras.push_back({"aisle", Vec3(2, 1.7f, 10), Vec3(30, 1.2f, 9), 0.9f});
  scene.cameras.push_back({"across", Vec3(20, 1.7f, 1), Vec3(22, 0.8f, 18), 0.9f});
  scene.cameras.push_back({"floor", Vec3(10, 2.2f, 6), Vec3(14, 0, 9), 0.9f});
  return scene;
}

}  // namespace oriel::sample
