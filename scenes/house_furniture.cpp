#include "scenes/house_furniture.h"

#include <algorithm>
#include <array>

#include "scenes/kit/shapes.h"

namespace oriel::sample {
namespace {

using enum Upholstery;
using Kind = Primitive::Kind;

constexpr float kLegsSunk = 0.01f;  // m: how far legs reach into the floor

constexpr std::array<Primitive, 6> kSofaParts{{
    {Kind::kRoundedBox, kFabric, {0, 0.24f, 0.02f}, {1.30f, 0.26f, 0.70f}, 0.05f, 0.8f},
    {Kind::kRoundedBox, kFabric, {-0.31f, 0.43f, 0.06f}, {0.60f, 0.16f, 0.60f}, 0.06f, 1.3f},
    {Kind::kRoundedBox, kFabric, {0.31f, 0.43f, 0.06f}, {0.60f, 0.16f, 0.60f}, 0.06f, 1.3f},
    {Kind::kRoundedBox, kFabric, {0, 0.50f, -0.31f}, {1.32f, 0.62f, 0.18f}, 0.08f, 1.0f},
    {Kind::kRoundedBox, kLinen, {-0.42f, 0.62f, -0.12f}, {0.36f, 0.34f, 0.14f}, 0.069f, 1.6f},
    {Kind::kRoundedBox, kWood, {0, 0.055f, 0}, {1.10f, 0.13f, 0.50f}, 0.01f, 0.2f},
}};
// The top's upper face is a mesh of its own: it may be a reflector.
constexpr std::array<Primitive, 3> kTableParts{{
    {Kind::kRoundedBox, kWood, {0, 0.365f, 0}, {0.12f, 0.72f, 0.12f}, 0.02f, 0.3f},
    {Kind::kRoundedBox, kWood, {0, 0.02f, 0}, {0.50f, 0.06f, 0.50f}, 0.02f, 0.3f},
    {Kind::kVase, kCeramic, {0.22f, kTableHeight - 0.005f, 0.18f}, {0.16f, 0.28f, 0.16f}, 0, 1.5f},
}};
constexpr std::array<Primitive, 5> kBedParts{{
    {Kind::kRoundedBox, kWood, {0, 0.165f, 0}, {0.96f, 0.36f, 1.44f}, 0.02f, 0.3f},
    {Kind::kRoundedBox, kLinen, {0, 0.40f, 0.01f}, {0.90f, 0.20f, 1.38f}, 0.07f, 1.5f},
    {Kind::kRoundedBox, kFabric, {0, 0.44f, 0.18f}, {0.94f, 0.16f, 0.98f}, 0.06f, 1.5f},
    {Kind::kRoundedBox, kLinen, {0, 0.54f, -0.50f}, {0.60f, 0.14f, 0.34f}, 0.068f, 1.6f},
    {Kind::kRoundedBox, kWood, {0, 0.44f, -0.735f}, {0.98f, 0.90f, 0.05f}, 0.02f, 0.3f},
}};
constexpr std::array<Primitive, 9> kShelfParts{{
    {Kind::kRoundedBox, kWood, {-0.58f, 0.79f, 0}, {0.04f, 1.60f, 0.30f}, 0.005f, 0.2f},
    {Kind::kRoundedBox, kWood, {0.58f, 0.79f, 0}, {0.04f, 1.60f, 0.30f}, 0.005f, 0.2f},
    {Kind::kRoundedBox, kWood, {0, 0.10f, 0}, {1.14f, 0.04f, 0.28f}, 0.005f, 0.2f},
    {Kind::kRoundedBox, kWood, {0, 0.60f, 0}, {1.14f, 0.04f, 0.28f}, 0.005f, 0.2f},
    {Kind::kRoundedBox, kWood, {0, 1.10f, 0}, {1.14f, 0.04f, 0.28f}, 0.005f, 0.2f},
    {Kind::kRoundedBox, kFabric, {-0.25f, 0.74f, 0}, {0.55f, 0.25f, 0.20f}, 0.01f, 0.4f},
    {Kind::kRoundedBox, kLinen, {0.24f, 0.25f, 0}, {0.50f, 0.27f, 0.22f}, 0.01f, 0.4f},
    {Kind::kBall, kCeramic, {0.30f, 0.735f, 0.01f}, {0.24f, 0.24f, 0.24f}, 0, 1.3f},
    {Kind::kVase, kMetal, {-0.20f, 1.115f, 0}, {0.17f, 0.36f, 0.17f}, 0, 1.5f},
}};
constexpr std::array<Primitive, 3> kVasesParts{{
    {Kind::kVase, kCeramic, {-0.15f, -kLegsSunk, 0.05f}, {0.36f, 0.80f, 0.36f}, 0, 2.0f},
    {Kind::kVase, kMetal, {0.25f, -kLegsSunk, -0.10f}, {0.26f, 0.50f, 0.26f}, 0, 1.7f},
    {Kind::kBall, kCeramic, {0.20f, 0.115f, 0.28f}, {0.24f, 0.24f, 0.24f}, 0, 1.3f},
}};
constexpr std::array<Primitive, 5> kArmchairParts{{
    {Kind::kRoundedBox, kFabric, {0, 0.22f, 0}, {0.66f, 0.46f, 0.66f}, 0.06f, 1.2f},
    {Kind::kRoundedBox, kFabric, {0, 0.56f, -0.27f}, {0.68f, 0.60f, 0.16f}, 0.07f, 1.2f},
    {Kind::kRoundedBox, kFabric, {-0.31f, 0.34f, 0.02f}, {0.12f, 0.50f, 0.68f}, 0.05f, 1.0f},
    {Kind::kRoundedBox, kFabric, {0.31f, 0.34f, 0.02f}, {0.12f, 0.50f, 0.68f}, 0.05f, 1.0f},
    {Kind::kRoundedBox, kLinen, {0, 0.50f, 0.04f}, {0.46f, 0.14f, 0.50f}, 0.06f, 1.3f},
}};

int box_resolution(const Primitive& p, double detail) {
  return std::max(1, static_cast<int>(std::lround(p.weight * detail)));
}
int ring_resolution(const Primitive& p, double detail) {
  return std::max(3, static_cast<int>(std::lround(2.0 * p.weight * detail)));
}

std::uint64_t count_triangles(const Primitive& p, double detail) {
  if (p.kind == Kind::kRoundedBox) {
    const auto n = static_cast<std::uint64_t>(box_resolution(p, detail));
    return 12 * n * n;
  }
  const auto n = static_cast<std::uint64_t>(ring_resolution(p, detail));
  // Around 2n; a ball has n rows of which two are fans, a vase n rows and a fan at its mouth.
  return p.kind == Kind::kBall ? 2 * n * (2 * n - 2) : 2 * n * (2 * n + 1);
}

void add_vase(SampleMesh& mesh, const Primitive& p, int n) {
  std::vector<Vec2> profile;
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    const double r = 0.5 * p.size.x * (0.62 + 0.38 * std::sin(t * 5.0 - 0.5));
    profile.emplace_back(static_cast<float>(r), static_cast<float>(t * p.size.y));
  }
  profile.emplace_back(0.0f, 0.8f * p.size.y);
  add_lathe(mesh, p.centre, profile, 2 * n);
}

void add_primitive(SampleMesh& mesh, const Primitive& p, double detail) {
  switch (p.kind) {
    case Kind::kRoundedBox:
      add_rounded_box(mesh, p.centre, p.size, p.radius, box_resolution(p, detail));
      break;
    case Kind::kBall: {
      const int n = ring_resolution(p, detail);
      add_sphere(mesh, p.centre, 0.5f * p.size.x, 2 * n, n);
      break;
    }
    case Kind::kVase:
      add_vase(mesh, p, ring_resolution(p, detail));
      break;
  }
}

}  // namespace

const char* piece_name(Piece piece) {
  static constexpr std::array<const char*, kPieces> kNames{"sofa", "table", "bed", "shelf", "vases", "armchair"};
  return kNames[static_cast<std::size_t>(piece)];
}

std::span<const Primitive> piece_primitives(Piece piece) {
  switch (piece) {
    case Piece::kSofa:
      return kSofaParts;
    case Piece::kTable:
      return kTableParts;
    case Piece::kBed:
      return kBedParts;
    case Piece::kShelf:
      return kShelfParts;
    case Piece::kVases:
      return kVasesParts;
    case Piece::kArmchair:
      return kArmchairParts;
  }
  return {};
}

std::uint64_t count_triangles(Piece piece, double detail) {
  std::uint64_t count = piece == Piece::kTable ? 10 : 0;
  for (const Primitive& p : piece_primitives(piece)) count += count_triangles(p, detail);
  return count;
}

std::vector<SampleMesh> make_piece(Piece piece, double detail) {
  static constexpr std::array<const char*, kUpholsteries> kNames{"fabric", "wood", "ceramic", "linen", "metal"};
  std::vector<SampleMesh> meshes;
  for (std::size_t material = 0; material < kUpholsteries; ++material) {
    SampleMesh mesh{std::string(piece_name(piece)) + " " + kNames[material], static_cast<std::uint32_t>(material)};
    for (const Primitive& p : piece_primitives(piece)) {
      if (static_cast<std::size_t>(p.material) == material) add_primitive(mesh, p, detail);
    }
    if (piece == Piece::kTable && material == static_cast<std::size_t>(kWood)) {
      add_box(mesh, Vec3(-kTableHalfWidth, kTableHeight - 0.035f, -kTableHalfWidth),
              Vec3(kTableHalfWidth, kTableHeight, kTableHalfWidth), kSides | kBottom);
    }
    if (!mesh.indices.empty()) meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace oriel::sample
