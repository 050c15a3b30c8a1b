#include <fmt/format.h>

#include <array>

#include "scenes/generators.h"
#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kRoom{7, 2.8f, 6};  // from the origin
constexpr float kDesk = 0.74f;     // height of desk tops
constexpr unsigned kSeen = kSides | kTop;

void add_room(SampleScene& scene, std::uint32_t plaster) {
  const Vec3 x(kRoom.x, 0, 0), y(0, kRoom.y, 0), z(0, 0, kRoom.z);
  place_quad(scene, "floor", add_diffuse(scene, "carpet", {0.16f, 0.19f, 0.26f}), {Vec3(0), z, x});
  place_quad(scene, "ceiling", add_diffuse(scene, "ceiling", Vec3(0.8f)), {y, x, z});
  place_quad(scene, "north wall", plaster, {Vec3(0), x, y});
  place_quad(scene, "south wall", plaster, {z, y, x});
  place_quad(scene, "west wall", add_diffuse(scene, "ochre wall", {0.66f, 0.48f, 0.26f}), {Vec3(0), y, z});
  place_quad(scene, "east wall", plaster, {x, z, y});
}

void add_lamps(SampleScene& scene) {
  const std::uint32_t glow = add_diffuse(scene, "lamp", Vec3(0.8f), 5000.0f * Vec3(1, 0.95f, 0.88f));
  const std::uint32_t housing = add_diffuse(scene, "lamp housing", Vec3(0.7f));
  const Vec3 half(0.75f, 0.05f, 0.375f);
  for (int i = 0; i < 2; ++i) {
    const Vec3 middle(i == 0 ? 1.9f : 5.1f, kRoom.y - half.y, 2.9f);
    const std::string name = "lamp " + std::to_string(i + 1);
    SampleMesh sides{name + " housing", housing};
    add_box(sides, middle - half, middle + half, kSides);
    place(scene, std::move(sides));
    place_quad(scene, name, glow, {middle - half, {2 * half.x, 0, 0}, {0, 0, 2 * half.z}});
  }
}

// Meshes of one workplace by material; its desk is along x, who works sits at +z.
struct Workplace {
  SampleMesh wood, grey, dark, fabric, cream, screen, white;
};

void add_desk(Workplace& w) {
  add_slab(w.wood, w.grey, {-0.8f, kDesk - 0.03f, -0.4f}, {0.8f, kDesk, 0.4f}, 0.05f);
  add_box(w.cream, {0.3f, 0, -0.3f}, {0.72f, 0.7f, 0.33f}, kSeen);  // drawers
  for (int i = 0; i < 3; ++i) {
    const float y = 0.05f + 0.215f * static_cast<float>(i);
    add_box(w.cream, {0.32f, y, 0.33f}, {0.7f, y + 0.2f, 0.345f}, kAllFaces & ~kBack);
    add_box(w.dark, {0.45f, y + 0.14f, 0.345f}, {0.57f, y + 0.155f, 0.36f}, kAllFaces & ~kBack);
  }
}

// A picture tube: a bezel, what tapers behind it, and a foot.
void add_monitor(Workplace& w) {
  const Vec3 low(-0.22f, kDesk + 0.09f, -0.16f), high(0.22f, kDesk + 0.46f, -0.06f);
  add_box(w.cream, low, high);
  const Vec3 far_low(-0.13f, low.y + 0.05f, -0.37f), far_high(0.13f, high.y - 0.06f, -0.37f);
  const Vec3 near_low = low + Vec3(0.01f, 0.01f, 0), near_high(high.x - 0.01f, high.y - 0.01f, low.z);
  const std::array<Vec3, 4> near{
      near_low, {near_high.x, near_low.y, low.z}, near_high, {near_low.x, near_high.y, low.z}};
  const std::array<Vec3, 4> far{
      far_low, {far_high.x, far_low.y, far_low.z}, far_high, {far_low.x, far_high.y, far_low.z}};
  for (std::size_t i = 0; i < 4; ++i) add_corners(w.cream, near[i], far[i], far[(i + 1) % 4], near[(i + 1) % 4]);
  add_corners(w.cream, far[1], far[0], far[3], far[2]);
  add_box(w.cream, {-0.1f, kDesk, -0.25f}, {0.1f, low.y, -0.09f}, kSides);
  add_quad(w.screen, {{low.x + 0.03f, low.y + 0.04f, high.z + 0.001f}, {0.38f, 0, 0}, {0, 0.29f, 0}});
}

void add_keyboard(Workplace& w) {
  const Vec3 low(-0.23f, kDesk, 0.1f);
  add_box(w.cream, low, low + Vec3(0.46f, 0.02f, 0.16f), kSeen);
  for (int row = 0; row < 4; ++row)
    for (int key = 0; key < 14; ++key) {
      const Vec3 at =
          low + Vec3(0.012f + 0.0315f * static_cast<float>(key), 0.02f, 0.012f + 0.036f * static_cast<float>(row));
      add_box(w.dark, at, at + Vec3(0.026f, 0.012f, 0.029f), kSeen);
    }
  add_box(w.cream, {0.3f, kDesk, 0.13f}, {0.36f, kDesk + 0.03f, 0.23f}, kSeen);  // the mouse
}

void add_desk_things(Workplace& w) {
  const std::array<Vec2, 6> shade{
      {{0.09f, 0}, {0.09f, 0.015f}, {0.012f, 0.03f}, {0.012f, 0.34f}, {0.1f, 0.36f}, {0.03f, 0.44f}}};
  add_lathe(w.dark, {-0.62f, kDesk, -0.2f}, shade, 12);
  const std::array<Vec2, 5> mug{{{0.038f, 0}, {0.042f, 0.09f}, {0.038f, 0.09f}, {0.034f, 0.01f}, {0, 0.01f}}};
  add_lathe(w.white, {0.5f, kDesk, 0.05f}, mug, 10);
  const std::array<Vec2, 3> bin{{{0.12f, 0}, {0.15f, 0.32f}, {0.11f, 0.02f}}};
  add_lathe(w.grey, {-0.6f, 0, 0.1f}, bin, 12);
}

void add_chair(SampleMesh& fabric, SampleMesh& dark) {
  add_box(fabric, {-0.24f, 0.43f, -0.22f}, {0.24f, 0.51f, 0.24f});
  add_box(fabric, {-0.21f, 0.62f, 0.22f}, {0.21f, 1.02f, 0.28f});
  add_box(dark, {-0.03f, 0.08f, -0.03f}, {0.03f, 0.43f, 0.03f}, kSides);
  add_box(dark, {-0.03f, 0.47f, 0.241f}, {0.03f, 0.75f, 0.265f}, kSides);
  add_box(dark, {-0.3f, 0.04f, -0.025f}, {0.3f, 0.08f, 0.025f});
  add_box(dark, {-0.025f, 0.041f, -0.3f}, {0.025f, 0.079f, 0.3f});
}

void add_workplaces(SampleScene& scene) {
  Workplace w{
      SampleMesh{"desk", add_diffuse(scene, "maple", {0.56f, 0.40f, 0.23f})},
      SampleMesh{"legs", add_diffuse(scene, "grey", Vec3(0.35f))},
      SampleMesh{"keys and lamp", add_diffuse(scene, "dark", Vec3(0.07f))},
      SampleMesh{"chair", add_diffuse(scene, "fabric", {0.42f, 0.09f, 0.08f})},
      SampleMesh{"monitor and drawers", add_diffuse(scene, "cream", {0.62f, 0.58f, 0.48f})},
      SampleMesh{
          "screen",
          add_material(
              scene, {.name = "screen", .base_color = Vec3(0.02f, 0.025f, 0.03f), .roughness = 0.04f, .specular = 1})},
      SampleMesh{"mug", add_diffuse(scene, "porcelain", Vec3(0.78f))}};
  add_desk(w);
  add_monitor(w);
  add_keyboard(w);
  add_desk_things(w);
  SampleMesh chair_frame{"chair frame", w.dark.material};
  add_chair(w.fabric, chair_frame);
  struct Placed {
    Vec3 at;
    float yaw_rad, chair_rad;
  };
  static const std::array<Placed, 4> kPlaced{{{{1.5f, 0, 0.55f}, 0, 0.3f},
                                              {{3.9f, 0, 0.55f}, 0, -0.6f},
                                              {{6.4f, 0, 2.3f}, -kPi / 2, 0.2f},
                                              {{6.4f, 0, 4.5f}, -kPi / 2, 0.9f}}};
  const auto chair = add_mesh(scene, std::move(w.fabric)), frame = add_mesh(scene, std::move(chair_frame));
  std::vector<std::uint32_t> parts;
  for (SampleMesh* part : {&w.wood, &w.grey, &w.dark, &w.cream, &w.screen, &w.white})
    parts.push_back(add_mesh(scene, std::move(*part)));
  for (std::size_t i = 0; i < kPlaced.size(); ++i) {
    const auto& [at, yaw, chair_yaw] = kPlaced[i];
    const auto named = [i](const std::string& what) { return fmt::format("{} {}", what, i + 1); };
    for (const std::uint32_t part : parts) place(scene, part, named(scene.meshes[part].name), at, yaw);
    const Vec3 behind = at + 0.75f * Vec3(std::sin(yaw), 0, std::cos(yaw));
    place(scene, chair, named("chair"), behind, yaw + chair_yaw);
    place(scene, frame, named("chair frame"), behind, yaw + chair_yaw);
  }
}

// Two cases of four shelves with 40 books each, along the west wall: x = 0, it faces +x.
void add_books(SampleScene& scene, std::uint32_t wood) {
  constexpr float kWide = 1.6f, kDeep = 0.3f, kBoard = 0.02f, kShelf = 0.4f;
  constexpr int kBooks = 40;
  const std::array<std::uint32_t, 4> covers{
      add_diffuse(scene, "red book", {0.45f, 0.08f, 0.06f}), add_diffuse(scene, "blue book", {0.07f, 0.13f, 0.35f}),
      add_diffuse(scene, "green book", {0.08f, 0.26f, 0.12f}), add_diffuse(scene, "white book", {0.7f, 0.66f, 0.55f})};
  for (int side = 0; side < 2; ++side) {
    const float z = side == 0 ? 1.9f : 3.9f;
    SampleMesh shelf{"bookcase " + std::to_string(side + 1), wood};
    for (const float end : {z, z + kWide - kBoard}) add_box(shelf, {0.002f, 0.002f, end}, {kDeep, 1.85f, end + kBoard});
    add_box(shelf, {0.003f, 0.06f, z + 0.5f * kBoard}, {0.012f, 1.84f, z + kWide - 0.5f * kBoard});
    for (int i = 0; i < 5; ++i) {
      const float y = 0.05f + kShelf * static_cast<float>(i);
      add_box(shelf, {0.006f, y, z + 0.6f * kBoard}, {kDeep - 0.001f, y + kBoard, z + kWide - 0.6f * kBoard});
    }
    place(scene, std::move(shelf));
    for (std::size_t c = 0; c < covers.size(); ++c) {
      SampleMesh books{"books " + std::to_string(side + 1) + "." + std::to_string(c + 1), covers[c]};
      for (int i = 0; i < 4 * kBooks; ++i) {
        const int shelf_of = i / kBooks, at = i % kBooks;
        if ((static_cast<std::uint32_t>(i + 4 * kBooks * side + 1) * 2654435761u >> 28) % covers.size() != c) continue;
        const float spread = static_cast<float>((13 * i) % 7) / 7, y = 0.07f + kShelf * static_cast<float>(shelf_of);
        const float from = z + 0.03f + 0.0385f * static_cast<float>(at);
        add_box(books, {0.03f, y + 0.001f, from}, {0.2f + 0.06f * spread, y + 0.25f + 0.09f * spread, from + 0.033f},
                kSeen);
      }
      place(scene, std::move(books));
    }
  }
}

void add_wall_things(SampleScene& scene, std::uint32_t grey, std::uint32_t wood) {
  SampleMesh frame{"whiteboard frame", grey};
  add_frame(frame, {2, 1}, 0.03f, 0.02f, 0);
  add_box(frame, {-0.8f, -0.56f, 0}, {0.8f, -0.54f, 0.08f}, kAllFaces & ~kBack);  // for pens
  const Vec3 middle(2.9f, 1.6f, 0);
  place(scene, std::move(frame), middle);
  place_quad(scene, "whiteboard", add_diffuse(scene, "enamel", Vec3(0.82f)),
             {middle + Vec3(-1, -0.5f, 0.005f), {2, 0, 0}, {0, 1, 0}});
  SampleMesh door{"door", wood}, handle{"door handle", grey};
  add_box(door, {4.6f, 0, kRoom.z - 0.03f}, {5.5f, 2.05f, kRoom.z}, kLeft | kRight | kTop | kBack);
  add_box(handle, {4.68f, 1.02f, kRoom.z - 0.09f}, {4.82f, 1.04f, kRoom.z - 0.03f}, kAllFaces & ~kFront);
  SampleMesh radiator{"radiator", add_diffuse(scene, "lacquer", Vec3(0.72f))};
  for (int i = 0; i < 24; ++i) {
    const float x = 1.4f + 0.06f * static_cast<float>(i);
    add_box(radiator, {x, 0.12f, kRoom.z - 0.1f}, {x + 0.045f, 0.72f, kRoom.z - 0.02f}, kAllFaces & ~kFront);
  }
  place(scene, std::move(radiator));
  place(scene, std::move(door));
  place(scene, std::move(handle));
}

// A pot whose leaves lean outwards, each with two sides.
void add_plant(SampleScene& scene) {
  SampleMesh pot{"pot", add_diffuse(scene, "clay", {0.5f, 0.22f, 0.12f})};
  const std::array<Vec2, 4> profile{{{0.16f, 0}, {0.21f, 0.36f}, {0.18f, 0.36f}, {0, 0.33f}}};
  add_lathe(pot, Vec3(0), profile, 12);
  SampleMesh leaves{"leaves", add_diffuse(scene, "leaf", {0.06f, 0.22f, 0.05f})};
  for (int i = 0; i < 30; ++i) {
    const float turn = 2.4f * static_cast<float>(i), lean = 0.12f + 0.016f * static_cast<float>(i);
    const float height = 1.15f - 0.02f * static_cast<float>(i);
    const Vec3 out(std::cos(turn), 0, std::sin(turn)), wide = 0.05f * Vec3(-out.z, 0, out.x);
    const Vec3 foot = 0.03f * out + Vec3(0, 0.33f, 0), knee = foot + 0.4f * lean * out + Vec3(0, 0.7f * height, 0),
               tip = foot + 1.1f * lean * out + Vec3(0, height, 0);
    add_corners(leaves, foot - 0.2f * wide, foot + 0.2f * wide, knee + wide, knee - wide);
    add_corners(leaves, knee - wide, knee + wide, tip + 0.1f * wide, tip - 0.1f * wide);
    const Vec3 thick = 0.002f * out;
    add_corners(leaves, foot + 0.2f * wide + thick, foot - 0.2f * wide + thick, knee - wide + thick,
                knee + wide + thick);
    add_corners(leaves, knee + wide + thick, knee - wide + thick, tip - 0.1f * wide + thick, tip + 0.1f * wide + thick);
  }
  const Vec3 corner(0.45f, 0, 0.45f);
  place(scene, std::move(pot), corner);
  place(scene, std::move(leaves), corner);
}

// Sheets and heaps of paper on the desks.
void add_paper(SampleScene& scene, int sheets) {
  SampleMesh paper{"paper", add_diffuse(scene, "paper", Vec3(0.78f))};
  for (int i = 0; i < sheets; ++i) {
    const float turn = 1.9f * static_cast<float>(i), at = 0.06f * static_cast<float>(i % 5);
    const Vec3 u = 0.21f * Vec3(std::cos(turn), 0, std::sin(turn)), v = 0.297f * Vec3(u.z, 0, -u.x) / 0.21f;
    const Vec3 middle(i % 2 ? 4.35f + at : 0.85f + at, kDesk + 0.0015f * static_cast<float>(i + 1), 0.68f);
    add_quad(paper, {middle - 0.5f * (u + v), u, v});
  }
  place(scene, std::move(paper));
}

}  // namespace

SampleScene make_office() {
  SampleScene scene;
  scene.name = "Office";
  const std::uint32_t plaster = add_diffuse(scene, "plaster", {0.74f, 0.73f, 0.68f});
  const std::uint32_t walnut = add_diffuse(scene, "walnut", {0.22f, 0.13f, 0.07f});
  add_room(scene, plaster);
  add_lamps(scene);
  add_workplaces(scene);
  add_books(scene, walnut);
  add_wall_things(scene, add_diffuse(scene, "aluminium", Vec3(0.5f)), walnut);
  add_plant(scene);
  add_paper(scene, 12);
  scene.cameras = {{"door", {5.2f, 1.7f, 5.6f}, {2.6f, 0.9f, 1}, 1.05f},
                   {"desk", {2.4f, 1.5f, 2.2f}, {1.3f, 0.8f, 0.5f}, 0.9f},
                   {"books", {4.2f, 1.5f, 2.2f}, {0.2f, 0.9f, 3.8f}, 0.9f}};
  return scene;
}

}  // namespace oriel::sample
