#include <array>

#include "scenes/gallery_items.h"
#include "scenes/generators.h"
#include "scenes/kit/shapes.h"
#include "scenes/kit/solid_grid.h"
#include "scenes/kit/walk_path.h"

namespace oriel::sample {
namespace {

// Air, by room or opening.
enum Air { kRoomA, kRoomB, kRoomC, kDoorAb, kDoorBc, kWindow, kEntrance };
// Solids.
enum Solid { kBuilding, kPlatform };

constexpr float kStep = 0.15f;  // rise of a stair
constexpr int kSteps = 4;       // below the platform

std::vector<Block> building() {
  std::vector<Block> blocks = {
      {{-0.2f, -0.2f, -0.2f}, {12.4f, 3.6f, 8.2f}, true, kBuilding},
      {{6.0f, -0.2f, -8.4f}, {12.4f, 3.6f, 0}, true, kBuilding},
      {{0, 0, 0}, {6, kGalleryHeight, 8}, false, kRoomA},
      {{6.2f, 0, 0}, {12.2f, kGalleryHeight, 8}, false, kRoomB},
      {{6.2f, 0, -8.2f}, {12.2f, kGalleryHeight, -0.2f}, false, kRoomC},
      {{6, 0, 2.7f}, {6.2f, 2.4f, 4.5f}, false, kDoorAb},
      {{8.2f, 0, -0.2f}, {10, 2.4f, 0}, false, kDoorBc},
      {{12.2f, 0.9f, 1}, {12.4f, 2.5f, 3.4f}, false, kWindow},
      {{2.4f, 0, 8}, {3.6f, 2.2f, 8.08f}, false, kEntrance},
  };
  // Stairs up to the platform in B's south-east corner.
  for (int i = 1; i <= kSteps; ++i) {
    const float front = 5.2f - 0.3f * static_cast<float>(kSteps + 1 - i);
    blocks.push_back({{9.8f, 0, front}, {12.2f, kStep * static_cast<float>(i), front + 0.3f}, true, kPlatform});
  }
  blocks.push_back({{9.8f, 0, 5.2f}, {12.2f, kStep * static_cast<float>(kSteps + 1), 8}, true, kPlatform});
  return blocks;
}

const char* air_name(int air) {
  static constexpr std::array<const char*, 7> kNames{"A", "B", "C", "door A-B", "door B-C", "window", "entrance"};
  return air == kOutside ? "outside" : kNames[static_cast<std::size_t>(air)];
}

const char* facing_name(const SolidPatch& patch) {
  // A wall on the west side of a room faces east.
  using Names = std::array<const char*, 6>;
  static constexpr Names kInside{"east wall", "west wall", "ceiling", "floor", "south wall", "north wall"};
  static constexpr Names kOutdoors{"west", "east", "underside", "roof", "north", "south"};
  static constexpr Names kStairs{"platform west side", "platform east side",  "platform underside",
                                 "platform",           "platform north side", "platform south side"};
  const auto i = static_cast<std::size_t>(patch.facing);
  return (patch.air_tag == kOutside ? kOutdoors : patch.solid_tag == kPlatform ? kStairs : kInside)[i];
}

struct Palette {
  std::uint32_t tiles, oak, concrete, stone, wood;
  std::uint32_t ceiling, warm_white, sage, sand, terracotta, outside, lining;
};

Palette make_palette(SampleScene& scene, float floor_roughness) {
  scene.textures = {dark_tiles(512), oak_planks(512)};
  const auto diffuse = [&](std::string name, const Vec3& color) { return add_diffuse(scene, std::move(name), color); };
  Palette p{};
  p.tiles = add_material(
      scene,
      {.name = "polished tiles", .base_color = Vec3(1), .roughness = floor_roughness, .specular = 1, .texture = 0});
  p.oak = add_material(scene, {.name = "oak", .base_color = Vec3(1), .texture = 1});
  p.concrete = diffuse("concrete", Vec3(0.42f, 0.41f, 0.39f));
  p.stone = diffuse("stone", Vec3(0.55f, 0.52f, 0.46f));
  p.wood = add_material(
      scene, {.name = "dark wood", .base_color = Vec3(0.16f, 0.085f, 0.045f), .roughness = 0.7f, .specular = 1});
  p.ceiling = diffuse("ceiling white", Vec3(0.82f));
  p.warm_white = diffuse("warm white", Vec3(0.76f, 0.72f, 0.65f));
  p.sage = diffuse("sage", Vec3(0.46f, 0.54f, 0.44f));
  p.sand = diffuse("sand", Vec3(0.68f, 0.60f, 0.46f));
  p.terracotta = diffuse("terracotta", Vec3(0.62f, 0.22f, 0.12f));
  p.outside = diffuse("render", Vec3(0.7f, 0.68f, 0.62f));
  p.lining = diffuse("door lining", Vec3(0.8f, 0.79f, 0.76f));
  return p;
}

std::uint32_t room_material(const Palette& p, const SolidPatch& patch) {
  const bool floor = patch.facing == Facing::kUp, ceiling = patch.facing == Facing::kDown;
  switch (patch.air_tag) {
    case kRoomA:
      return floor ? p.tiles : ceiling ? p.ceiling : p.warm_white;
    case kRoomB:
      if (ceiling) return p.ceiling;
      if (floor) return p.oak;
      return patch.facing == Facing::kFront ? p.sage : p.warm_white;  // the wall around the doorway to C
    case kRoomC:
      if (ceiling) return p.ceiling;
      if (floor) return p.concrete;
      return patch.facing == Facing::kRight ? p.terracotta : p.sand;
    case kEntrance:
      return patch.facing == Facing::kBack ? p.wood : p.lining;
    case kOutside:
      return p.outside;
    default:
      return floor ? p.stone : p.lining;
  }
}

void add_building(SampleScene& scene, const Palette& palette) {
  const std::vector<Block> blocks = building();
  for (SolidPatch& patch : boundary_patches(blocks)) {
    // Nobody sees the ground under the slab.
    if (patch.air_tag == kOutside && patch.facing == Facing::kDown) continue;
    SampleMesh mesh = std::move(patch.mesh);
    mesh.name = std::string(air_name(patch.air_tag)) + " " + facing_name(patch);
    mesh.material = patch.solid_tag == kPlatform ? palette.stone : room_material(palette, patch);
    if (mesh.material == palette.tiles) project_uvs(mesh, Vec3(0), Vec3(0.5f, 0, 0), Vec3(0, 0, 0.5f));
    if (mesh.material == palette.oak) project_uvs(mesh, Vec3(6.2f, 0, 0), Vec3(0, 0, 0.7f), Vec3(0.35f, 0, 0));
    place(scene, std::move(mesh));
  }
}

void add_lights(SampleScene& scene) {
  const std::uint32_t glow = add_material(
      scene, {.name = "ceiling panel", .base_color = Vec3(0.8f), .emission = 1700.0f * Vec3(1, 0.93f, 0.82f)});
  const std::uint32_t metal = add_diffuse(scene, "luminaire", Vec3(0.7f));
  const Vec2 half(0.8f, 0.4f);
  const float below = -0.06f, above = 0.01f;  // about the ceiling; the housing reaches into it
  SampleMesh housing{"luminaire housing", metal};
  add_box(housing, Vec3(-half.x, below, -half.y), Vec3(half.x, above, half.y), kSides);
  SampleMesh light{"luminaire panel", glow};
  add_quad(light, {Vec3(-half.x, below, -half.y), Vec3(2 * half.x, 0, 0), Vec3(0, 0, 2 * half.y)});
  const std::uint32_t housing_mesh = add_mesh(scene, std::move(housing)),
                      light_mesh = add_mesh(scene, std::move(light));
  const std::array<std::pair<const char*, Vec3>, 5> places{{{"A luminaire 1", Vec3(3, kGalleryHeight, 1.4f)},
                                                            {"A luminaire 2", Vec3(3, kGalleryHeight, 4)},
                                                            {"A luminaire 3", Vec3(3, kGalleryHeight, 6.6f)},
                                                            {"B luminaire 1", Vec3(8.6f, kGalleryHeight, 2.2f)},
                                                            {"B luminaire 2", Vec3(9.2f, kGalleryHeight, 6)}}};
  for (const auto& [name, position] : places) {
    place(scene, housing_mesh, std::string(name) + " housing", position);
    place(scene, light_mesh, std::string(name) + " panel", position);
  }
}

// The sky behind B's window: a bright panel that closes the opening near its outer side, and glazing bars before it.
void add_window(SampleScene& scene) {
  SampleMesh panel{
      "window sky",
      add_material(scene, {.name = "sky", .base_color = Vec3(0), .emission = 1400.0f * Vec3(0.80f, 0.92f, 1)})};
  add_quad(panel, {Vec3(12.38f, 0.89f, 0.99f), Vec3(0, 0, 2.42f), Vec3(0, 1.62f, 0)});
  place(scene, std::move(panel));
  SampleMesh bars{"window bars", add_diffuse(scene, "window frame", Vec3(0.75f))};
  for (const float z : {1.8f, 2.6f}) {
    add_box(bars, Vec3(12.30f, 0.89f, z - 0.025f), Vec3(12.35f, 2.51f, z + 0.025f), kSides);
  }
  for (const auto& [z0, z1] : {std::pair{0.99f, 1.78f}, {1.82f, 2.58f}, {2.62f, 3.41f}}) {
    add_box(bars, Vec3(12.305f, 1.68f, z0), Vec3(12.345f, 1.72f, z1), kLeft | kRight | kTop | kBottom);
  }
  place(scene, std::move(bars));
}

void add_cameras(SampleScene& scene) {
  constexpr float kWide = 1.1f;
  scene.cameras = {
      {"entrance", Vec3(3.4f, 1.6f, 7.5f), Vec3(2.9f, 1.15f, 0), kWide},
      {"floor", Vec3(2.3f, 0.8f, 7.5f), Vec3(3.9f, 0.35f, 1.0f), 0.95f},
      {"mirror", Vec3(9.5f, 1.6f, 2.0f), Vec3(7.9f, 1.35f, 8), 0.95f},
      {"doorway", Vec3(8.2f, 1.6f, 4.6f), Vec3(9.2f, 1.25f, -4), 0.9f},
      {"stairs", Vec3(7.0f, 1.6f, 1.6f), Vec3(11.2f, 0.9f, 6.4f), 1.0f},
      {"panel", Vec3(3.9f, 1.55f, 3.5f), Vec3(2.75f, 1.2f, 0), 0.9f},
      {"room C", Vec3(8.3f, 1.6f, -7.7f), Vec3(9.6f, 1.15f, -0.5f), 1.1f},
  };
  const float y = 1.6f;
  const std::array<Vec3, 9> waypoints{Vec3(3.4f, y, 7.1f),  Vec3(3.4f, y, 3.6f),   Vec3(8.6f, y, 3.6f),
                                      Vec3(9.1f, y, 1.0f),  Vec3(9.1f, y, -1.6f),  Vec3(7.95f, y, -3.6f),
                                      Vec3(8.4f, y, -6.6f), Vec3(10.2f, y, -6.6f), Vec3(10.4f, y, -2.9f)};
  TrackOptions options;
  options.vertical_fov_rad = kWide;
  scene.paths.push_back(walk_along("walk", waypoints, options));
}

}  // namespace

SampleScene make_gallery(const GalleryOptions& options) {
  SampleScene scene;
  scene.name = "Gallery";
  const Palette palette = make_palette(scene, options.floor_roughness);
  add_building(scene, palette);
  add_lights(scene);
  add_window(scene);
  add_columns(scene, palette.stone);
  add_pictures(scene, palette.wood);
  add_mirror_and_panel(scene, palette.wood);
  add_benches(scene, palette.wood);
  add_sculptures(scene, palette.stone);
  add_cameras(scene);
  return scene;
}

}  // namespace oriel::sample
