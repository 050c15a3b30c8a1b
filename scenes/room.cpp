#include <array>

#include "scenes/generators.h"
#include "scenes/house_furniture.h"
#include "scenes/kit/shapes.h"
#include "scenes/kit/solid_grid.h"

namespace oriel::sample {
namespace {

constexpr Vec3 kRoom{6, 2.7f, 6};  // from the origin
constexpr float kWall = 0.2f, kSlab = 0.3f, kGround = -0.15f;
constexpr double kDetail = 5;  // of the furniture
// The window in the south wall (+z).
constexpr float kWindowX0 = 1.5f, kWindowX1 = 4.5f, kWindowY0 = 0.9f, kWindowY1 = 2.1f;

enum Air { kInside, kOpening };

void add_walls(SampleScene& scene, const RoomOptions& options) {
  const std::uint32_t white = add_diffuse(scene, "white", Vec3(0.78f)),
                      oak = add_diffuse(scene, "oak", {0.42f, 0.28f, 0.16f}),
                      ochre = add_diffuse(scene, "ochre", {0.68f, 0.54f, 0.30f}),
                      render = add_diffuse(scene, "render", {0.62f, 0.58f, 0.52f});
  std::vector<Block> blocks{{Vec3(-kWall, -kSlab, -kWall), kRoom + Vec3(kWall), true, 0},
                            {Vec3(0), kRoom, false, kInside}};
  if (!options.closed)
    blocks.push_back(
        {Vec3(kWindowX0, kWindowY0, kRoom.z), Vec3(kWindowX1, kWindowY1, kRoom.z + kWall), false, kOpening});
  static constexpr std::array<const char*, 6> kNames{"east wall", "west wall",  "ceiling",
                                                     "floor",     "south wall", "north wall"};
  for (SolidPatch& patch : boundary_patches(blocks)) {
    if (patch.air_tag == kOutside && (options.closed || patch.facing == Facing::kDown)) continue;
    const char* place_of = patch.air_tag == kOutside ? "outside " : patch.air_tag == kOpening ? "opening " : "";
    SampleMesh mesh = std::move(patch.mesh);
    mesh.name = std::string(place_of) + kNames[static_cast<std::size_t>(patch.facing)];
    mesh.material = patch.air_tag == kOutside        ? render
                    : patch.air_tag == kOpening      ? white
                    : patch.facing == Facing::kUp    ? oak
                    : patch.facing == Facing::kRight ? ochre
                                                     : white;
    place(scene, std::move(mesh));
  }
}

void add_furniture(SampleScene& scene) {
  const std::array<std::uint32_t, kUpholsteries> covers{
      add_diffuse(scene, "fabric", {0.24f, 0.31f, 0.42f}), add_diffuse(scene, "wood", {0.33f, 0.19f, 0.10f}),
      add_diffuse(scene, "ceramic", {0.70f, 0.36f, 0.22f}), add_diffuse(scene, "linen", {0.74f, 0.70f, 0.61f}),
      add_diffuse(scene, "bronze", {0.36f, 0.26f, 0.15f})};
  struct Placed {
    Piece piece;
    Vec3 position;
    float yaw_rad;
  };
  static const std::array<Placed, 6> kPlaced{{{Piece::kSofa, {1.7f, 0, 0.55f}, 0},
                                              {Piece::kTable, {1.7f, 0, 2.0f}, 0},
                                              {Piece::kArmchair, {3.3f, 0, 1.9f}, -kPi / 2},
                                              {Piece::kShelf, {4.6f, 0, 0.17f}, 0},
                                              {Piece::kVases, {5.3f, 0, 5.3f}, kPi},
                                              {Piece::kBed, {0.74f, 0, 5.0f}, kPi}}};
  for (const Placed& placed : kPlaced)
    for (SampleMesh& mesh : make_piece(placed.piece, kDetail)) {
      mesh.material = covers[mesh.material];
      place(scene, std::move(mesh), placed.position, placed.yaw_rad);
    }
  SampleMesh top{"table top", covers[static_cast<std::size_t>(Upholstery::kWood)]};
  add_quad(top, {Vec3(-kTableHalfWidth, kTableHeight, kTableHalfWidth), Vec3(2 * kTableHalfWidth, 0, 0),
                 Vec3(0, 0, -2 * kTableHalfWidth)});
  place(scene, std::move(top), kPlaced[1].position);
}

void add_lamp(SampleScene& scene) {
  SampleMesh panel{"ceiling panel",
                   add_material(scene, {.name = "ceiling panel", .emission = 2500.0f * Vec3(1, 0.93f, 0.82f)})};
  SampleMesh housing{"panel housing", add_diffuse(scene, "housing", Vec3(0.7f))};
  add_quad(panel, {Vec3(-0.6f, -0.05f, -0.6f), Vec3(1.2f, 0, 0), Vec3(0, 0, 1.2f)});
  add_box(housing, Vec3(-0.6f, -0.05f, -0.6f), Vec3(0.6f, 0.01f, 0.6f), kSides);
  const Vec3 middle(kRoom.x / 2, kRoom.y, kRoom.z / 2);
  place(scene, std::move(panel), middle);
  place(scene, std::move(housing), middle);
}

// Ground under the room too, and a dome seen from inside whose rim is sunk, so that it meets the eye below the ground's
// far edge. It reflects nothing, as sky domes are painted.
void add_surroundings(SampleScene& scene) {
  const Vec3 middle(kRoom.x / 2, kGround, kRoom.z / 2);
  SampleMesh ground{"ground", add_diffuse(scene, "paving", Vec3(kGroundReflectance))};
  add_quad(ground, {Vec3(-kGroundSide / 2, 0, kGroundSide / 2), Vec3(kGroundSide, 0, 0), Vec3(0, 0, -kGroundSide)});
  place(scene, std::move(ground), middle);
  SampleMesh dome{"sky dome",
                  add_material(scene, {.name = "sky", .base_color = Vec3(0), .emission = Vec3(kSkyLuminance)})};
  constexpr int kRings = 16;
  constexpr float kRim = -0.02f * kDomeRadius;
  std::vector<Vec2> profile;  // from the top: its front is the inside
  for (int i = 0; i <= kRings; ++i) {
    const double elevation = kPiD / 2 * (kRings - i) / kRings;
    profile.emplace_back(i == 0 ? 0.0f : kDomeRadius * static_cast<float>(std::cos(elevation)),
                         kDomeRadius * static_cast<float>(std::sin(elevation)));
  }
  profile.emplace_back(kDomeRadius, kRim);
  add_lathe(dome, Vec3(0), profile, 4 * kRings);
  place(scene, std::move(dome), middle);
}

}  // namespace

SampleScene make_room(const RoomOptions& options) {
  SampleScene scene;
  scene.name = options.closed ? "Room" : "Room in a landscape";
  add_walls(scene, options);
  add_furniture(scene);
  if (options.closed) {
    add_lamp(scene);
    return scene;
  }
  if (options.surroundings) add_surroundings(scene);
  scene.cameras = {{"inside", Vec3(5.5f, 1.6f, 3.7f), Vec3(1.2f, 0.9f, 1.6f), 1.05f},
                   {"window", Vec3(3.4f, 1.6f, 0.9f), Vec3(2.8f, 1.3f, 6), 1.05f}};
  return scene;
}

}  // namespace oriel::sample
