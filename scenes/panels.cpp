
#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kPanelRoom{8, 2.7f, 4};  // from the origin
constexpr float kSection = 2,
                kMargin = 0.1f;  // along the north wall (z = 0), and what each section leaves free at its ends
constexpr float kSkirting = 0.1f, kCornice = 0.06f;

struct Paints {
  std::uint32_t wall, wood, board, trim, floor, carpet, canvas;
};

std::uint32_t add_glow(SampleScene& scene, std::string name, const Vec3& luminance) {
  return add_material(scene, {.name = std::move(name), .emission = luminance});
}

// A rectangle around a hole that glows.
void place_around_light(SampleScene& scene, SampleMesh wall, SampleMesh light, const Quad& quad, const Hole& hole) {
  const auto& [origin, u, v] = quad;
  const Vec2 size = hole.high - hole.low;
  add_quad_around(wall, quad, hole);
  add_quad(light, {origin + hole.low.x * u + hole.low.y * v, size.x * u, size.y * v});
  place(scene, std::move(wall));
  place(scene, std::move(light));
}

void add_walls(SampleScene& scene, const Paints& paints) {
  const Vec3 x(kPanelRoom.x, 0, 0), y(0, kPanelRoom.y, 0), z(0, 0, kPanelRoom.z);
  const auto wall = [&](const char* name, std::uint32_t material, const Vec3& origin, const Vec3& u, const Vec3& v) {
    SampleMesh mesh{name, material};
    add_quad(mesh, {origin, u, v});
    place(scene, std::move(mesh));
  };
  wall("floor", paints.floor, Vec3(0), z, x);
  wall("north wall", paints.wall, Vec3(0), x, y);
  wall("west wall", paints.wall, z, -z, y);
  wall("east wall", paints.wall, x, z, y);
  SampleMesh window{"window", add_glow(scene, "daylight", Vec3(900, 960, 1000))};
  place_around_light(scene, SampleMesh{"south wall", paints.wall}, std::move(window), {x + z, -x, y},
                     {Vec2(0.1f, 0.3f), Vec2(0.9f, 0.8f)});
  SampleMesh lamp{"lamp", add_glow(scene, "lamp", Vec3(1500, 1400, 1250))};
  place_around_light(scene, SampleMesh{"ceiling", paints.wall}, std::move(lamp), {y, x, z},
                     {Vec2(0.2f, 0.4f), Vec2(0.8f, 0.6f)});
}

// Faces that lie on wall or floor are left out, as in models made by hand; the board's are all there.
void add_sections(SampleScene& scene, const Paints& paints) {
  for (std::size_t i = 0; i < kProud_mm.size(); ++i) {
    const float proud = 1e-3f * static_cast<float>(kProud_mm[i]), left = kSection * static_cast<float>(i) + kMargin,
                right = left + kSection - 2 * kMargin;
    const auto box = [&](const char* name, std::uint32_t material, const Vec3& low, const Vec3& high, unsigned faces) {
      SampleMesh mesh{fmt::format("{} {} mm", name, kProud_mm[i]), material};
      add_box(mesh, low, high, faces);
      place(scene, std::move(mesh));
    };
    box("skirting", paints.trim, Vec3(left, 0, 0), Vec3(right, kSkirting, proud), kLeft | kRight | kTop | kFront);
    box("board", paints.board, Vec3(left + 0.3f, 0.4f, proud / 2), Vec3(right - 0.3f, 0.85f, proud), kAllFaces);
    box("panel", paints.wood, Vec3(left + 0.3f, 1.15f, 0), Vec3(right - 0.3f, 1.85f, proud),
        kAllFaces & ~unsigned{kBack});
  }
}

void add_things(SampleScene& scene, const Paints& paints) {
  // Along the north wall, from wall to wall.
  SampleMesh cornice{"cornice", paints.trim};
  add_box(cornice, Vec3(0, kPanelRoom.y - kCornice, 0), Vec3(kPanelRoom.x, kPanelRoom.y, kCornice), kFront | kBottom);
  place(scene, std::move(cornice));
  SampleMesh carpet{"carpet", paints.carpet};
  add_box(carpet, Vec3(2.5f, 0, 1.2f), Vec3(5, 0.008f, 2.8f), kSides | kTop);
  place(scene, std::move(carpet));
  for (const auto& [name, size, z] :
       {std::tuple{"picture 1", Vec2(0.9f, 0.6f), 1.3f}, {"picture 2", Vec2(0.5f, 0.7f), 2.7f}}) {
    SampleMesh frame{std::string(name) + " frame", paints.wood}, canvas{std::string(name) + " canvas", paints.canvas};
    add_frame(frame, size, 0.05f, 0.025f, 0.01f);
    // Before the wall, and a little into the frame's inner sides.
    const Vec2 half = 0.5f * size + 0.004f;
    add_quad(canvas, {Vec3(-half.x, -half.y, 0.008f), Vec3(2 * half.x, 0, 0), Vec3(0, 2 * half.y, 0)});
    const Vec3 at(0, 1.5f, z);
    place(scene, std::move(frame), at, kPi / 2);
    place(scene, std::move(canvas), at, kPi / 2);
  }
  // Set back by 5 cm all around under the cupboard, which stands 1 cm off the east wall.
  const float back = kPanelRoom.x - 0.01f;
  SampleMesh cupboard{"cupboard", paints.board}, plinth{"plinth", paints.trim};
  add_box(cupboard, Vec3(back - 0.5f, 0.08f, 1.3f), Vec3(back, 0.95f, 2.7f));
  add_box(plinth, Vec3(back - 0.45f, 0, 1.35f), Vec3(back - 0.05f, 0.08f, 2.65f), kSides);
  place(scene, std::move(cupboard));
  place(scene, std::move(plinth));
}

void add_panel_cameras(SampleScene& scene) {
  constexpr float kFov = 0.8f;
  for (std::size_t i = 0; i < kProud_mm.size(); ++i) {
    const float middle = kSection * (static_cast<float>(i) + 0.5f);
    scene.cameras.push_back(
        {fmt::format("panel {} mm", kProud_mm[i]), Vec3(middle + 0.3f, 1.6f, 1.7f), Vec3(middle, 1.1f, 0), kFov});
    scene.cameras.push_back(
        {fmt::format("skirting {} mm", kProud_mm[i]), Vec3(middle - 0.4f, 1.4f, 1.3f), Vec3(middle, 0.15f, 0), kFov});
  }
  scene.cameras.push_back({"cornice", Vec3(3.5f, 1.6f, 1.6f), Vec3(4, 2.6f, 0), kFov});
  scene.cameras.push_back({"picture", Vec3(1.7f, 1.6f, 1.8f), Vec3(0, 1.5f, 1.9f), kFov});
  scene.cameras.push_back({"carpet", Vec3(5.4f, 1.6f, 3.4f), Vec3(4.2f, 0, 2.3f), kFov});
  scene.cameras.push_back({"plinth", Vec3(6.2f, 1.2f, 3.2f), Vec3(7.6f, 0.2f, 2.3f), kFov});
}

}  // namespace

SampleScene make_panels() {
  SampleScene scene;
  scene.name = "Panels";
  const Paints paints{
      add_diffuse(scene, "wall", Vec3(0.75f, 0.74f, 0.70f)),  add_diffuse(scene, "wood", Vec3(0.45f, 0.30f, 0.18f)),
      add_diffuse(scene, "board", Vec3(0.35f, 0.45f, 0.42f)), add_diffuse(scene, "trim", Vec3(0.80f)),
      add_diffuse(scene, "floor", Vec3(0.40f, 0.33f, 0.26f)), add_diffuse(scene, "carpet", Vec3(0.50f, 0.22f, 0.18f)),
      add_diffuse(scene, "canvas", Vec3(0.55f, 0.57f, 0.48f))};
  add_walls(scene, paints);
  add_sections(scene, paints);
  add_things(scene, paints);
  add_panel_cameras(scene);
  return scene;
}

}  // namespace oriel::sample
