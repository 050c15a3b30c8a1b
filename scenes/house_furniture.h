// Furniture whose tessellation scales: each piece is a list of primitives with a resolution that grows with one number,
// so that triangles can be counted without making them.
#pragma once

#include <span>

#include "scenes/kit/scene_builder.h"

namespace oriel::sample {

enum class Upholstery : std::uint8_t { kFabric, kWood, kCeramic, kLinen, kMetal };
inline constexpr std::size_t kUpholsteries = 5;

struct Primitive {
  enum class Kind : std::uint8_t { kRoundedBox, kVase, kBall } kind = Kind::kRoundedBox;
  Upholstery material = Upholstery::kWood;
  Vec3 centre{0}, size{1};  // metres, the piece's own space: y = 0 is the floor, +z its front
  float radius = 0;         // of the edges of a rounded box
  float weight = 1;         // resolution at detail 1
};

enum class Piece : std::uint8_t { kSofa, kTable, kBed, kShelf, kVases, kArmchair };
inline constexpr std::size_t kPieces = 6;

const char* piece_name(Piece piece);
std::span<const Primitive> piece_primitives(Piece piece);
// The top of Piece::kTable is a square of this half width at this height; the piece itself leaves that face out.
inline constexpr float kTableHalfWidth = 0.45f, kTableHeight = 0.74f;

std::uint64_t count_triangles(Piece piece, double detail);
// One mesh for each material used; their material index is the Upholstery.
std::vector<SampleMesh> make_piece(Piece piece, double detail);

}  // namespace oriel::sample
