// Bodies of solid glass: what the eye looks through bent, and how a ray finds its way out of them. Frosted panes: what
// it looks through blurred.
#pragma once

#include <span>
#include <vector>

#include "formats/pack/pack.h"
#include "player/scene/gpu_mesh.h"

namespace oriel {

// Roughness below which glass does not blur.
inline constexpr float kClearGlass = 0.02f;

// Planes of a body at most; with more it is taken as curved (shaders/passes/glass.frag has as many).
inline constexpr std::size_t kMaxBodyPlanes = 24;

// Triangles of a hollow or branched body at most; with more it is drawn thin.
inline constexpr std::size_t kMaxTreeTriangles = std::size_t{1} << 16;

// The part of one of Pack::frosted_panes that is a body's.
struct LitSide {
  std::uint32_t pane = 0;
  std::uint32_t first_index = 0, index_count = 0;
};

struct GlassBody {
  std::uint32_t material = 0;  // into Pack::materials
  std::uint32_t solid = 0;     // into Pack::solids
  bool pane = false;           // thin and frosted: no body, and of no solid
  Bounds bounds;
  Vec3 centre{0};    // its middle; but for hollow and branched ones all of the surface is seen from there
  float radius = 0;  // of the sphere around the centre that holds it
  // Convex polyhedra: xyz the outward normal, inside where dot(xyz, p) + w <= 0. None: curved.
  std::vector<Vec4> planes;
  std::vector<Vec4> tree;         // of hollow and branched ones: glass_tree()
  std::vector<DrawRange> ranges;  // a lightmap page each
  std::vector<LitSide> lit;       // of a frosted pane
};

// Connected surfaces of `ranges`' triangles that are of solid materials become bodies where they are star-shaped about
// their middle, or where they are closed: vases with thick walls, tubes. They may be of any lightmap pages. So do
// connected frosted panes, of any shape. Their indices are appended, and `ranges` keeps what is none: other materials,
// clear panes, open glass, and the inner shells of hollow glass that is made of two.
std::vector<GlassBody> take_glass_bodies(const Pack& pack, std::vector<std::uint32_t>& indices,
                                         std::vector<DrawRange>& ranges);

// What of the pack's frosted panes is whose, their triangles appended to the indices that ranges are of.
void find_lit_sides(const Pack& pack, std::vector<std::uint32_t>& indices, std::span<GlassBody> bodies);

// Whether a point is inside of a body, by the solid angle of its triangles (Van Oosterom and Strackee 1983). indices:
// those that its ranges are of.
bool is_inside(const GlassBody& body, const Mesh& mesh, std::span<const std::uint32_t> indices, const Vec3& point);

}  // namespace oriel
