#include <array>

#include "scenes/generators.h"
#include "scenes/house_furniture.h"
#include "scenes/kit/shapes.h"
#include "scenes/kit/solid_grid.h"
#include "scenes/kit/walk_path.h"

namespace oriel::sample {
namespace {

constexpr int kRoomsX = 3, kRoomsZ = 2, kFloors = 2;
constexpr int kRooms = kRoomsX * kRoomsZ * kFloors;
constexpr float kRoomX = 4.2f, kRoomZ = 4.4f, kRoomY = 2.7f, kWall = 0.2f, kSlab = 0.3f;
constexpr float kStorey = kRoomY + kSlab;
constexpr std::uint64_t kMaxTriangles = 20'000'000;
// Openings of doors and windows: [kDoorX0, kDoorX1] along a room's x, [kDoorZ0, kDoorZ1] along its z. What lies between
// them in both directions stays free of furniture.
constexpr float kDoorX0 = 1.5f, kDoorX1 = 2.7f, kDoorZ0 = 1.6f, kDoorZ1 = 2.8f, kDoorY = 2.1f, kSillY = 0.9f;
// The stairs, in room (1, 1) along its +z wall, going up towards +x.
constexpr int kRisers = 14;
constexpr float kStairX0 = 0.6f, kTread = 0.23f, kStairWidth = 1.1f, kHoleX0 = 1.2f;
constexpr float kStairX1 = kStairX0 + kTread * static_cast<float>(kRisers - 1);

struct Room {
  int x = 0, z = 0, floor = 0;
  Vec3 corner() const {
    return {static_cast<float>(x) * (kRoomX + kWall), static_cast<float>(floor) * kStorey,
            static_cast<float>(z) * (kRoomZ + kWall)};
  }
  bool has_stairs() const { return x == 1 && z == 1; }
  std::string name() const {
    return std::string(floor == 0 ? "ground " : "upper ") + static_cast<char>('1' + x + kRoomsX * z);
  }
};

Room room_at(int index) {
  return {index % kRoomsX, index / kRoomsX % kRoomsZ, index / (kRoomsX * kRoomsZ)};
}

// Tags of air: rooms by index, then doors and windows together.
constexpr int kOpening = kRooms;

std::vector<Block> house_blocks() {
  const float width = kRoomsX * (kRoomX + kWall) - kWall, depth = kRoomsZ * (kRoomZ + kWall) - kWall;
  std::vector<Block> blocks{
      {Vec3(-kWall, -kSlab, -kWall), Vec3(width + kWall, kFloors * kStorey, depth + kWall), true, 0}};
  for (int index = 0; index < kRooms; ++index) {
    const Room room = room_at(index);
    const Vec3 c = room.corner();
    blocks.push_back({c, c + Vec3(kRoomX, kRoomY, kRoomZ), false, index});
    // Doors to the +x and +z neighbours; windows where there is none, and on the -x and -z sides.
    const float x_door_sill = room.x + 1 < kRoomsX ? 0 : kSillY, z_door_sill = room.z + 1 < kRoomsZ ? 0 : kSillY;
    blocks.push_back(
        {c + Vec3(kRoomX, x_door_sill, kDoorZ0), c + Vec3(kRoomX + kWall, kDoorY, kDoorZ1), false, kOpening});
    if (!room.has_stairs()) {
      blocks.push_back(
          {c + Vec3(kDoorX0, z_door_sill, kRoomZ), c + Vec3(kDoorX1, kDoorY, kRoomZ + kWall), false, kOpening});
    }
    if (room.x == 0)
      blocks.push_back({c + Vec3(-kWall, kSillY, kDoorZ0), c + Vec3(0, kDoorY, kDoorZ1), false, kOpening});
    if (room.z == 0)
      blocks.push_back({c + Vec3(kDoorX0, kSillY, -kWall), c + Vec3(kDoorX1, kDoorY, 0), false, kOpening});
  }
  const Vec3 stairs = Room{1, 1, 0}.corner();
  blocks.push_back({stairs + Vec3(kHoleX0, kRoomY, kRoomZ - kStairWidth), stairs + Vec3(kStairX1, kStorey, kRoomZ),
                    false, kOpening});
  return blocks;
}

struct HousePalette {
  std::array<std::uint32_t, kUpholsteries> furniture{};
  std::array<std::uint32_t, 4> walls{};
  std::uint32_t ceiling, floor, trim, outside, polished_floor, polished_wood, mirror, panel, sky;
};

HousePalette make_palette(SampleScene& scene) {
  const auto add = [&](std::string name, const Vec3& color, float metallic, float roughness, float specular,
                       const Vec3& emission = Vec3(0)) {
    return add_material(scene, {.name = std::move(name),
                                .base_color = color,
                                .metallic = metallic,
                                .roughness = roughness,
                                .specular = specular,
                                .emission = emission});
  };
  HousePalette p{};
  p.furniture = {
      add_diffuse(scene, "fabric", Vec3(0.24f, 0.31f, 0.42f)), add("wood", Vec3(0.33f, 0.19f, 0.10f), 0, 0.7f, 1),
      add_diffuse(scene, "ceramic", Vec3(0.70f, 0.36f, 0.22f)), add_diffuse(scene, "linen", Vec3(0.74f, 0.70f, 0.61f)),
      add("bronze", Vec3(0.71f, 0.52f, 0.30f), 1, 0.7f, 1)};
  p.walls = {add_diffuse(scene, "wall white", Vec3(0.78f, 0.76f, 0.71f)),
             add_diffuse(scene, "wall green", Vec3(0.45f, 0.55f, 0.42f)),
             add_diffuse(scene, "wall blue", Vec3(0.42f, 0.51f, 0.62f)),
             add_diffuse(scene, "wall ochre", Vec3(0.68f, 0.54f, 0.30f))};
  p.ceiling = add_diffuse(scene, "ceiling", Vec3(0.82f));
  p.floor = add_diffuse(scene, "floor", Vec3(0.45f, 0.34f, 0.23f));
  p.trim = add_diffuse(scene, "trim", Vec3(0.75f));
  p.outside = add_diffuse(scene, "render", Vec3(0.7f, 0.68f, 0.62f));
  p.polished_floor = add("polished stone", Vec3(0.30f, 0.29f, 0.28f), 0, 0.1f, 1);
  p.polished_wood = add("polished wood", Vec3(0.25f, 0.12f, 0.06f), 0, 0.15f, 1);
  p.mirror = add("mirror", Vec3(0.94f), 1, 0, 1);
  p.panel = add("ceiling panel", Vec3(0.8f), 0, 1, 0, 1600.0f * Vec3(1, 0.93f, 0.82f));
  p.sky = add("sky", Vec3(0), 0, 1, 0, 900.0f * Vec3(0.80f, 0.92f, 1));
  return p;
}

enum class Reflecting { kMirror, kFloor, kTable };

// Which rooms have which reflectors: through all rooms once with changing kinds, then again with the next kind.
bool has_reflector(int room, Reflecting kind, int reflectors) {
  for (int k = 0; k < reflectors; ++k) {
    if (k % kRooms == room && (k % kRooms + k / kRooms) % 3 == static_cast<int>(kind)) return true;
  }
  return false;
}

void add_building(SampleScene& scene, const HousePalette& palette, int reflectors) {
  const std::vector<Block> blocks = house_blocks();
  for (SolidPatch& patch : boundary_patches(blocks)) {
    if (patch.air_tag == kOutside && patch.facing == Facing::kDown) continue;
    static constexpr std::array<const char*, 6> kNames{"east wall", "west wall",  "ceiling",
                                                       "floor",     "south wall", "north wall"};
    const auto facing = static_cast<std::size_t>(patch.facing);
    SampleMesh mesh = std::move(patch.mesh);
    if (patch.air_tag == kOutside) {
      mesh.name = "outside " + std::to_string(facing);
      mesh.material = palette.outside;
    } else if (patch.air_tag == kOpening) {
      mesh.name = "openings " + std::to_string(facing);
      mesh.material = palette.trim;
    } else {
      const int room = patch.air_tag;
      mesh.name = room_at(room).name() + " " + kNames[facing];
      mesh.material =
          patch.facing == Facing::kDown ? palette.ceiling
          : patch.facing == Facing::kUp
              ? (has_reflector(room, Reflecting::kFloor, reflectors) ? palette.polished_floor : palette.floor)
              : palette.walls[static_cast<std::size_t>(room * 5 + 1) % 4];
    }
    place(scene, std::move(mesh));
  }
}

void add_windows_and_lights(SampleScene& scene, const HousePalette& palette) {
  SampleMesh x_pane{"window x", palette.sky}, z_pane{"window z", palette.sky};
  const Vec3 size(kDoorX1 - kDoorX0, kDoorY - kSillY, kDoorZ1 - kDoorZ0);
  const float reach = 0.01f;  // into the reveals
  // Both about the middle of the opening's lower edge, facing +z; the second as wide as z openings.
  add_quad(x_pane,
           {Vec3(-size.x / 2 - reach, -reach, 0), Vec3(size.x + 2 * reach, 0, 0), Vec3(0, size.y + 2 * reach, 0)});
  add_quad(z_pane,
           {Vec3(-size.z / 2 - reach, -reach, 0), Vec3(size.z + 2 * reach, 0, 0), Vec3(0, size.y + 2 * reach, 0)});
  const std::uint32_t on_z = add_mesh(scene, std::move(x_pane)), on_x = add_mesh(scene, std::move(z_pane));
  SampleMesh panel{"ceiling panel", palette.panel}, housing{"panel housing", palette.trim};
  add_quad(panel, {Vec3(-0.45f, -0.05f, -0.45f), Vec3(0.9f, 0, 0), Vec3(0, 0, 0.9f)});
  add_box(housing, Vec3(-0.45f, -0.05f, -0.45f), Vec3(0.45f, 0.01f, 0.45f), kSides);
  const std::uint32_t panel_mesh = add_mesh(scene, std::move(panel)),
                      housing_mesh = add_mesh(scene, std::move(housing));
  const float out = kWall - 0.02f, mid_x = (kDoorX0 + kDoorX1) / 2, mid_z = (kDoorZ0 + kDoorZ1) / 2;
  for (int index = 0; index < kRooms; ++index) {
    const Room room = room_at(index);
    const Vec3 c = room.corner();
    const std::string name = room.name();
    place(scene, panel_mesh, name + " panel", c + Vec3(mid_x, kRoomY, mid_z));
    place(scene, housing_mesh, name + " housing", c + Vec3(mid_x, kRoomY, mid_z));
    if (room.z == 0) place(scene, on_z, name + " north window", c + Vec3(mid_x, kSillY, -out));
    if (room.z + 1 == kRoomsZ && !room.has_stairs()) {
      place(scene, on_z, name + " south window", c + Vec3(mid_x, kSillY, kRoomZ + out), kPi);
    }
    if (room.x == 0) place(scene, on_x, name + " west window", c + Vec3(-out, kSillY, mid_z), kPi / 2);
    if (room.x + 1 == kRoomsX)
      place(scene, on_x, name + " east window", c + Vec3(kRoomX + out, kSillY, mid_z), -kPi / 2);
  }
}

void add_stairs(SampleScene& scene, const HousePalette& palette) {
  const Vec3 c = Room{1, 1, 0}.corner();
  SampleMesh stairs{"stairs", palette.furniture[static_cast<std::size_t>(Upholstery::kWood)]};
  const float rise = kStorey / static_cast<float>(kRisers), reach = 0.01f;
  const float near = kRoomZ - kStairWidth + reach, far = kRoomZ + reach;  // a joint to the slab, and into the wall
  // Each step is a block down to the floor; only what shows: riser, tread, the side to the room. The last riser is the
  // slab's edge, which the last tread reaches into.
  for (int i = 0; i + 1 < kRisers; ++i) {
    const float x0 = kStairX0 + kTread * static_cast<float>(i), x1 = x0 + kTread + (i + 2 == kRisers ? reach : 0);
    const float y0 = i == 0 ? -reach : rise * static_cast<float>(i), y1 = rise * static_cast<float>(i + 1);
    add_quad(stairs, {c + Vec3(x0, y0, near), Vec3(0, 0, far - near), Vec3(0, y1 - y0, 0)});
    add_quad(stairs, {c + Vec3(x0, y1, far), Vec3(x1 - x0, 0, 0), Vec3(0, 0, near - far)});
    add_quad(stairs, {c + Vec3(x1, -reach, near), Vec3(x0 - x1, 0, 0), Vec3(0, y1 + reach, 0)});
  }
  const float top = rise * static_cast<float>(kRisers - 1);
  add_quad(stairs, {c + Vec3(kStairX1 + reach, -reach, far), Vec3(0, 0, near - far), Vec3(0, top + reach, 0)});
  place(scene, std::move(stairs));
  // The parapet around the opening above.
  SampleMesh parapet{"parapet", palette.trim};
  const Vec3 up = c + Vec3(0, kStorey, 0);
  const float z0 = kRoomZ - kStairWidth;
  add_box(parapet, up + Vec3(kHoleX0 - 0.06f, -reach, z0 - 0.06f), up + Vec3(kStairX1, 0.9f, z0 - 0.01f),
          kSides | kTop);
  add_box(parapet, up + Vec3(kHoleX0 - 0.055f, -2 * reach, z0 - 0.015f),
          up + Vec3(kHoleX0 - 0.015f, 0.89f, kRoomZ + reach), kSides | kTop);
  place(scene, std::move(parapet));
}

struct PlacedItem {
  int room = 0;
  Piece piece = Piece::kSofa;
  Vec3 position{0};
  float yaw_rad = 0;
};

// The four corners of each room hold a piece each, its back to the nearer z wall.
std::vector<PlacedItem> furniture_plan() {
  std::vector<PlacedItem> plan;
  for (int index = 0; index < kRooms; ++index) {
    const Room room = room_at(index);
    for (int corner = 0; corner < 4; ++corner) {
      const bool right = corner % 2 == 1, far = corner / 2 == 1;
      if (room.has_stairs() && far) continue;
      // Corner 0 has the table, the next ones change from room to room.
      const auto piece =
          corner == 0 ? Piece::kTable
                      : static_cast<Piece>(std::array{0, 2, 3, 4, 5}[static_cast<std::size_t>(index + 2 * corner) % 5]);
      const float back = piece == Piece::kShelf ? 0.17f : 0.78f;
      const Vec3 position = room.corner() + Vec3(right ? kRoomX - 0.74f : 0.74f, 0, far ? kRoomZ - back : back);
      plan.push_back({index, piece, position, far ? kPi : 0});
    }
  }
  return plan;
}

void add_furniture(SampleScene& scene, const HousePalette& palette, double detail, int reflectors) {
  std::array<std::vector<std::uint32_t>, kPieces> meshes;
  for (std::size_t piece = 0; piece < kPieces; ++piece) {
    for (SampleMesh& mesh : make_piece(static_cast<Piece>(piece), detail)) {
      mesh.material = palette.furniture[mesh.material];
      meshes[piece].push_back(add_mesh(scene, std::move(mesh)));
    }
  }
  const auto add_top = [&](std::string name, std::uint32_t material) {
    SampleMesh top{std::move(name), material};
    add_quad(top, {Vec3(-kTableHalfWidth, kTableHeight, kTableHalfWidth), Vec3(2 * kTableHalfWidth, 0, 0),
                   Vec3(0, 0, -2 * kTableHalfWidth)});
    return add_mesh(scene, std::move(top));
  };
  const std::uint32_t plain = add_top("table top", palette.furniture[static_cast<std::size_t>(Upholstery::kWood)]);
  const std::uint32_t polished = add_top("polished table top", palette.polished_wood);
  for (const PlacedItem& placed : furniture_plan()) {
    const std::string name = room_at(placed.room).name() + " " + piece_name(placed.piece);
    for (const std::uint32_t mesh : meshes[static_cast<std::size_t>(placed.piece)]) {
      place(scene, mesh, name, placed.position, placed.yaw_rad);
    }
    if (placed.piece == Piece::kTable) {
      const bool shines = has_reflector(placed.room, Reflecting::kTable, reflectors);
      place(scene, shines ? polished : plain, name + " top", placed.position, placed.yaw_rad);
    }
  }
}

// On the -z wall, to the right of its opening.
void add_mirrors(SampleScene& scene, const HousePalette& palette, int reflectors) {
  SampleMesh glass{"mirror", palette.mirror}, frame{"mirror frame", palette.trim};
  add_quad(glass, {Vec3(-0.455f, -0.655f, 0.01f), Vec3(0.91f, 0, 0), Vec3(0, 1.31f, 0)});
  add_frame(frame, {0.9f, 1.3f}, 0.05f, 0.03f, 0.01f);
  const std::uint32_t glass_mesh = add_mesh(scene, std::move(glass)), frame_mesh = add_mesh(scene, std::move(frame));
  for (int index = 0; index < kRooms; ++index) {
    const Vec3 at = room_at(index).corner() + Vec3(0.74f, 1.62f, 0);
    if (!has_reflector(index, Reflecting::kMirror, reflectors)) continue;
    place(scene, glass_mesh, room_at(index).name() + " mirror", at);
    place(scene, frame_mesh, room_at(index).name() + " mirror frame", at);
  }
}

void add_house_cameras(SampleScene& scene) {
  const auto in = [](int x, int z, int floor, const Vec3& p) { return Room{x, z, floor}.corner() + p; };
  constexpr float kFov = 1.15f;
  scene.cameras = {
      {"living", in(0, 0, 0, {3.9f, 1.6f, 4.1f}), in(0, 0, 0, {0.6f, 1.1f, 0.4f}), kFov},
      {"polished floor", in(1, 0, 0, {0.4f, 1.2f, 3.9f}), in(1, 0, 0, {3.0f, 0.4f, 0.8f}), kFov},
      {"stairs", in(1, 1, 0, {0.4f, 1.6f, 0.9f}), in(1, 1, 0, {3.0f, 1.2f, 4.0f}), kFov},
      {"landing", in(1, 1, 1, {3.9f, 1.6f, 0.5f}), in(1, 1, 1, {1.4f, 0.7f, 3.8f}), kFov},
      {"upstairs", in(0, 0, 1, {2.1f, 1.6f, 2.2f}), in(2, 0, 1, {2.1f, 1.3f, 2.2f}), kFov},
  };
  const float e = 1.6f, mx = (kDoorX0 + kDoorX1) / 2, mz = (kDoorZ0 + kDoorZ1) / 2, stair_z = kRoomZ - kStairWidth / 2;
  const std::array<Vec3, 11> waypoints{in(0, 0, 0, {mx, e, 3.6f}),
                                       in(0, 0, 0, {mx, e, mz}),
                                       in(1, 0, 0, {mx, e, mz}),
                                       in(1, 1, 0, {mx, e, 1.7f}),
                                       in(1, 1, 0, {0.35f, e, mz + 0.1f}),
                                       in(1, 1, 0, {0.45f, e, stair_z}),
                                       in(1, 1, 0, {kStairX1 + 0.1f, kStorey + e, stair_z}),
                                       in(1, 1, 1, {kRoomX - 0.3f, e, stair_z - 0.2f}),
                                       in(1, 1, 1, {kRoomX - 0.45f, e, mz}),
                                       in(2, 1, 1, {mx, e, mz}),
                                       in(2, 0, 1, {mx, e, 1.2f})};
  TrackOptions options;
  options.corner_radius = 0.8;
  options.look_ahead = 1.1;
  options.vertical_fov_rad = kFov;
  scene.paths.push_back(walk_along("walk", waypoints, options));
}

SampleScene house_without_furniture(HousePalette& palette, const HouseOptions& options) {
  SampleScene scene;
  scene.name = "House";
  palette = make_palette(scene);
  add_building(scene, palette, options.reflectors);
  add_windows_and_lights(scene, palette);
  add_stairs(scene, palette);
  add_mirrors(scene, palette, options.reflectors);
  return scene;
}

std::uint64_t furniture_triangles(double detail) {
  std::array<std::uint64_t, kPieces> by_piece{};
  for (std::size_t piece = 0; piece < kPieces; ++piece)
    by_piece[piece] = count_triangles(static_cast<Piece>(piece), detail);
  std::uint64_t count = 0;
  for (const PlacedItem& placed : furniture_plan()) {
    count += by_piece[static_cast<std::size_t>(placed.piece)] + (placed.piece == Piece::kTable ? 2 : 0);
  }
  return count;
}

// The detail whose furniture is nearest to `wanted` triangles; the count rises with it.
double detail_for(std::uint64_t wanted) {
  double low = 0, high = 2000;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (furniture_triangles(middle) < wanted ? low : high) = middle;
  }
  const std::uint64_t below = furniture_triangles(low), above = furniture_triangles(high);
  return below < wanted && above > wanted && wanted - below < above - wanted ? low : high;
}

struct Sized {
  SampleScene scene;
  HousePalette palette{};
  double detail = 0;
};

Result<Sized> size_house(const HouseOptions& options) {
  if (options.reflectors < 0 || options.reflectors > kMaxHouseReflectors) {
    return fail(ErrorCode::kUsage, "house", "found {} reflectors, expected 0 to {}", options.reflectors,
                kMaxHouseReflectors);
  }
  Sized sized;
  sized.scene = house_without_furniture(sized.palette, options);
  const std::uint64_t fixed = triangle_count(sized.scene), least = fixed + furniture_triangles(0);
  if (options.triangles < least || options.triangles > kMaxTriangles) {
    return fail(ErrorCode::kUsage, "house", "found {} triangles, expected {} to {}", options.triangles, least,
                kMaxTriangles);
  }
  sized.detail = detail_for(options.triangles - fixed);
  return sized;
}

}  // namespace

Result<SampleScene> make_house(const HouseOptions& options) {
  ORIEL_TRY(Sized sized, size_house(options));
  add_furniture(sized.scene, sized.palette, sized.detail, options.reflectors);
  add_house_cameras(sized.scene);
  return std::move(sized.scene);
}

}  // namespace oriel::sample
