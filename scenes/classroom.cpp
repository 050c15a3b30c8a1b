#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kRoom{9, 3.2f, 8};  // from the origin; the blackboard is at z = 0
constexpr int kAlong = 6, kAcross = 6;
constexpr float kLeg = 0.04f;

struct Materials {
  std::uint32_t beech, steel, oak;
};

void add_room(SampleScene& scene) {
  const Vec3 x(kRoom.x, 0, 0), y(0, kRoom.y, 0), z(0, 0, kRoom.z);
  const std::uint32_t plaster = add_diffuse(scene, "plaster", {0.72f, 0.70f, 0.62f});
  place_quad(scene, "floor", add_diffuse(scene, "linoleum", {0.33f, 0.20f, 0.14f}), {Vec3(0), z, x});
  place_quad(scene, "ceiling", add_diffuse(scene, "ceiling", Vec3(0.8f)), {y, x, z});
  place_quad(scene, "front wall", plaster, {Vec3(0), x, y});
  place_quad(scene, "back wall", plaster, {z, y, x});
  place_quad(scene, "window wall", plaster, {Vec3(0), y, z});
  place_quad(scene, "door wall", plaster, {x, z, y});
}

// Its middle is at x = z = 0, its pupil sits at +z.
void add_desk(SampleMesh& slab, SampleMesh& legs) {
  add_slab(slab, legs, {-0.35f, 0.72f, -0.25f}, {0.35f, 0.75f, 0.25f}, kLeg);
  add_box(legs, {-0.3f, 0.58f, -0.2f}, {0.3f, 0.6f, 0.15f});      // for books
  add_box(slab, {-0.3f, 0.3f, -0.235f}, {0.3f, 0.715f, -0.22f});  // before the knees
}

void add_chair(SampleMesh& slab, SampleMesh& legs) {
  add_slab(slab, legs, {-0.2f, 0.42f, -0.2f}, {0.2f, 0.45f, 0.2f}, 0.03f);
  for (const float x : {-0.2f, 0.17f}) add_box(legs, {x, 0.45f, 0.17f}, {x + 0.03f, 0.85f, 0.2f}, kSides | kTop);
  add_box(slab, {-0.2f, 0.62f, 0.145f}, {0.2f, 0.8f, 0.168f});
}

void add_places(SampleScene& scene, const Materials& m) {
  SampleMesh desk{"desk", m.beech}, desk_legs{"desk frame", m.steel};
  SampleMesh chair{"chair", m.beech}, chair_legs{"chair frame", m.steel};
  add_desk(desk, desk_legs);
  add_chair(chair, chair_legs);
  const std::uint32_t meshes[] = {add_mesh(scene, std::move(desk)), add_mesh(scene, std::move(desk_legs)),
                                  add_mesh(scene, std::move(chair)), add_mesh(scene, std::move(chair_legs))};
  for (int row = 0; row < kAlong; ++row)
    for (int column = 0; column < kAcross; ++column) {
      const int pair = column / 2, right = column % 2;
      const Vec3 at(1.35f + 2.4f * static_cast<float>(pair) + 0.75f * static_cast<float>(right), 0,
                    2.6f + 0.9f * static_cast<float>(row));
      const float askew = 0.05f * static_cast<float>((7 * row + 3 * column) % 5 - 2);
      const std::string name = std::to_string(row + 1) + "." + std::to_string(column + 1);
      place(scene, meshes[0], "desk " + name, at);
      place(scene, meshes[1], "desk frame " + name, at);
      place(scene, meshes[2], "chair " + name, at + Vec3(0, 0, 0.42f), askew);
      place(scene, meshes[3], "chair frame " + name, at + Vec3(0, 0, 0.42f), askew);
    }
  const Vec3 teacher(3, 0, 0.75f);
  place(scene, meshes[2], "teacher's chair", teacher, kPi);
  place(scene, meshes[3], "teacher's chair frame", teacher, kPi);
}

void add_teachers_table(SampleScene& scene, const Materials& m) {
  const Vec3 lower(2.2f, 0.74f, 1.1f), upper(3.8f, 0.78f, 1.8f);
  SampleMesh slab{"teacher's table", m.oak}, legs{"teacher's table legs", m.oak};
  add_box(slab, lower, upper, kSides | kBottom);
  for (const float x : {lower.x, upper.x - 0.06f})
    for (const float z : {lower.z, upper.z - 0.06f}) add_box(legs, {x, 0, z}, {x + 0.06f, lower.y, z + 0.06f}, kSides);
  add_box(legs, {lower.x + 0.1f, 0.2f, lower.z + 0.62f}, {upper.x - 0.1f, 0.72f, lower.z + 0.64f});  // its front
  place(scene, std::move(slab));
  place(scene, std::move(legs));
  place_quad(scene, "teacher's table top",
             add_material(scene, {.name = "polished top",
                                  .base_color = {0.16f, 0.07f, 0.04f},
                                  .roughness = 0.02f,
                                  .specular = 1,
                                  .ior = 1.9f}),
             {{lower.x, upper.y, upper.z}, {upper.x - lower.x, 0, 0}, {0, 0, lower.z - upper.z}});
}

// Four bars around x0..x1, y0..y1 that stand proud of a wall at z = 0 by `deep`.
void add_bars(SampleMesh& mesh, const Vec2& low, const Vec2& high, float bar, float deep) {
  constexpr unsigned kFaces = kAllFaces & ~kBack;
  add_box(mesh, {low.x - bar, low.y - bar, 0}, {low.x, high.y + bar, deep}, kFaces);
  add_box(mesh, {high.x, low.y - bar, 0}, {high.x + bar, high.y + bar, deep}, kFaces);
  const float left = low.x - 0.5f * bar, right = high.x + 0.5f * bar, proud = 0.98f * deep;  // no faces in one plane
  add_box(mesh, {left, low.y - 0.98f * bar, 0}, {right, low.y, proud}, kFaces);
  add_box(mesh, {left, high.y, 0}, {right, high.y + 0.98f * bar, proud}, kFaces);
}

void add_blackboard(SampleScene& scene, const Materials& m) {
  const Vec2 low(2.5f, 0.95f), high(6.5f, 2.15f);
  SampleMesh frame{"blackboard frame", m.oak};
  add_bars(frame, low, high, 0.06f, 0.03f);
  add_box(frame, {3, 0.83f, 0}, {6, 0.86f, 0.1f}, kAllFaces & ~kBack);  // for chalk
  place(scene, std::move(frame));
  place_quad(scene, "blackboard", add_diffuse(scene, "slate", {0.03f, 0.06f, 0.045f}),
             {{low, 0.01f}, {high.x - low.x, 0, 0}, {0, high.y - low.y, 0}});
  SampleMesh sponge{"sponge", add_diffuse(scene, "sponge", {0.7f, 0.55f, 0.2f})};
  add_box(sponge, {3.3f, 0.861f, 0.035f}, {3.45f, 0.91f, 0.09f}, kSides | kTop);
  place(scene, std::move(sponge));
}

// Three windows whose blinds are down: twenty slats each.
void add_windows(SampleScene& scene, const Materials& m) {
  const Vec2 low(-0.9f, 1), high(0.9f, 2.6f);
  SampleMesh frame{"window frame", m.beech};
  SampleMesh blind{"blind", add_diffuse(scene, "blind", {0.55f, 0.62f, 0.66f})};
  add_bars(frame, low, high, 0.07f, 0.08f);
  for (int i = 0; i < 20; ++i) {
    const float y = low.y + 0.08f * static_cast<float>(i);
    add_box(blind, {low.x + 0.02f, y + 0.01f, 0.02f}, {high.x - 0.02f, y + 0.07f, 0.03f});
  }
  const std::uint32_t meshes[] = {add_mesh(scene, std::move(frame)), add_mesh(scene, std::move(blind))};
  for (int i = 0; i < 3; ++i) {
    const Vec3 at(0, 0, 1.6f + 2.4f * static_cast<float>(i));
    place(scene, meshes[0], "window frame " + std::to_string(i + 1), at, kPi / 2);
    place(scene, meshes[1], "blind " + std::to_string(i + 1), at, kPi / 2);
  }
}

void add_lamps(SampleScene& scene) {
  const std::uint32_t glow = add_diffuse(scene, "lamp", Vec3(0.8f), 6000.0f * Vec3(1, 0.95f, 0.86f));
  const std::uint32_t housing = add_diffuse(scene, "lamp housing", Vec3(0.75f));
  const Vec3 half(0.75f, 0.06f, 0.3f);
  for (int i = 0; i < 4; ++i) {
    const Vec3 middle(i % 2 ? 6.75f : 2.25f, kRoom.y - half.y, i / 2 ? 6.0f : 2.4f);
    const std::string name = "lamp " + std::to_string(i + 1);
    SampleMesh sides{name + " housing", housing};
    add_box(sides, middle - half, middle + half, kSides);
    place(scene, std::move(sides));
    place_quad(scene, name, glow, {middle - half, {2 * half.x, 0, 0}, {0, 0, 2 * half.z}});
  }
}

}  // namespace

SampleScene make_classroom() {
  SampleScene scene;
  scene.name = "Classroom";
  add_room(scene);
  const Materials m{add_diffuse(scene, "beech", {0.58f, 0.42f, 0.24f}), add_diffuse(scene, "steel", Vec3(0.22f)),
                    add_diffuse(scene, "oak", {0.32f, 0.18f, 0.09f})};
  add_places(scene, m);
  add_teachers_table(scene, m);
  add_blackboard(scene, m);
  add_windows(scene, m);
  add_lamps(scene);
  scene.cameras = {{"back", {8.2f, 2.1f, 7.4f}, {3.4f, 0.8f, 1.6f}, 1.0f},
                   {"teacher", {3, 1.6f, 0.5f}, {4.6f, 0.6f, 5}, 1.1f},
                   {"table", {4.6f, 1.3f, 3.4f}, {2.9f, 0.8f, 1.2f}, 0.8f}};
  return scene;
}

}  // namespace oriel::sample
