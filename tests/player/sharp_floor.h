// A floor below a board, with records of sharp light.
#pragma once

#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel::testing {

inline constexpr float kFloorAlbedo = 0.5f;
inline constexpr std::uint32_t kFloorTexels = 4;  // texels
inline constexpr float kFloorWidth = 4;           // metres, about the origin
inline const Vec3 kCandela(400, 300, 200), kLampAbove(0.1f, 2, -0.05f);
inline constexpr float kWest = -0.3f, kEast = 0.4f, kNorth = -0.25f, kSouth = 0.2f,
                       kBoardHeight = 1;  // a board between

constexpr std::uint32_t edges(std::uint32_t flags) {
  return flags << kSharpEdgeShift;
}

// A floor whose texels have no record yet.
inline Pack dark_floor() {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].base_color = Vec3(kFloorAlbedo);
  add_quad(pack, {-kFloorWidth / 2, 0, -kFloorWidth / 2}, {0, 0, kFloorWidth}, {kFloorWidth, 0, 0}, 0,
           0);  // u is z, v is x
  LightmapPage page = page_of(kFloorTexels, [](auto, auto) { return Vec3(7); });
  page.sharp.assign(kFloorTexels * kFloorTexels, Vec3(7));
  page.sharp_at.assign(kFloorTexels * kFloorTexels, 1);
  pack.lightmaps = {page};
  pack.sharp_light.words = {0};
  return pack;
}

inline SharpLamp point_above() {
  SharpLamp lamp;
  lamp.position = kLampAbove, lamp.intensity = kCandela;
  return lamp;
}

// Two triangles, without their common edge.
inline void add_board(SharpLight& light, float west, float east, float north, float south) {
  const Vec3 a(west, kBoardHeight, north), b(east, kBoardHeight, north), c(east, kBoardHeight, south),
      d(west, kBoardHeight, south);
  light.triangles.push_back({a, b, c});
  light.triangles.push_back({a, c, d});
}

inline std::vector<std::uint32_t> shine_past_board(std::uint32_t lamp = 0) {
  return {SharpShine{lamp, false, 2}.code(), edges(3) | 0, edges(6) | 1};
}

inline void add_record(Pack& pack, std::vector<std::uint32_t> words, std::uint32_t lamps = 1) {
  words.insert(words.begin(), lamps);
  pack.sharp_light.words.insert(pack.sharp_light.words.end(), words.begin(), words.end());
}

inline Pack floor_below_board(const SharpLamp& lamp = point_above()) {
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {lamp};
  add_board(pack.sharp_light, kWest, kEast, kNorth, kSouth);
  add_record(pack, shine_past_board());
  return pack;
}

// Straight down; +x is right, +z is down.
inline Camera down_from(const Vec3& eye, float half_height) {
  return {"c", eye, {0, -1, 0}, {0, 0, -1}, 0, half_height};
}

struct FloorFrame {
  int side;
  float half;
  Vec2 middle{0};
  Vec3 at(int x, int y) const {
    const Vec2 in = (2.0f * (Vec2(x, y) + 0.5f) / static_cast<float>(side) - 1.0f) * half + middle;
    return {in.x, 0, in.y};
  }
  float pixel() const { return 2 * half / static_cast<float>(side); }
};

}  // namespace oriel::testing
