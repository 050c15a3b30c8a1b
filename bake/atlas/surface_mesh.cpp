#include "bake/atlas/surface_mesh.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <numeric>
#include <span>
#include <vector>

#include "bake/scene/edges.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

constexpr std::uint32_t kMaxFan = 512;  // corners at a vertex: OpenMesh's work at a vertex grows with their square
constexpr double kFoldCos = -0.9;       // between normals: below it a surface folds back onto itself
constexpr std::size_t kMaxUses = 64;    // of an edge; beyond it none of its triangles are joined

std::uint32_t next_corner(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

// Corners that will share a vertex: a forest with the size of each set, at most kMaxFan.
class CornerSets {
 public:
  explicit CornerSets(std::size_t count) : parent_(count), size_(count, 1) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    if (a == b || size_[a] + size_[b] > kMaxFan) return;
    if (a > b) std::swap(a, b);
    parent_[b] = a;
    size_[a] += size_[b];
  }
  // By corner: the root of its set.
  std::vector<std::uint32_t> roots() && {
    for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = parent_[parent_[i]];  // a root comes before its set
    return std::move(parent_);
  }

 private:
  std::vector<std::uint32_t> parent_, size_;
};

void join_edge(CornerSets& sets, const EdgeUse& a, const EdgeUse& b) {
  sets.join(a.corner, next_corner(b.corner));
  sets.join(next_corner(a.corner), b.corner);
}

// Joins triangles across one edge, given all its uses: two by two, the most alike first.
void pair_uses(const Scene& scene, std::uint32_t first_triangle, std::span<const EdgeUse> uses, CornerSets& sets) {
  if (uses.size() < 2 || uses.size() > kMaxUses) return;
  const auto alike = [&](const EdgeUse& a, const EdgeUse& b) {
    return glm::dot(triangle_frame(scene, first_triangle + a.corner / 3).normal,
                    triangle_frame(scene, first_triangle + b.corner / 3).normal);
  };
  if (uses.size() == 2) {  // as nearly everywhere
    if (uses[0].forward != uses[1].forward && alike(uses[0], uses[1]) > kFoldCos) join_edge(sets, uses[0], uses[1]);
    return;
  }
  struct Candidate {
    double cos;
    std::size_t a, b;
  };
  std::vector<Candidate> candidates;
  for (std::size_t a = 0; a < uses.size(); ++a) {
    for (std::size_t b = a + 1; b < uses.size(); ++b) {
      const double cos = alike(uses[a], uses[b]);
      if (uses[a].forward != uses[b].forward && cos > kFoldCos) candidates.push_back({cos, a, b});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.cos > y.cos; });
  std::vector<bool> taken(uses.size());
  for (const Candidate& c : candidates) {
    if (taken[c.a] || taken[c.b]) continue;
    taken[c.a] = taken[c.b] = true;
    join_edge(sets, uses[c.a], uses[c.b]);
  }
}

// By corner: the first of those that share its vertex.
std::vector<std::uint32_t> joined_corners(const Scene& scene, const Surface& surface) {
  CornerSets sets(std::size_t{3} * surface.triangle_count);
  for_each_edge(edge_uses(welded_corners(scene, surface)),
                [&](std::span<const EdgeUse> uses) { pair_uses(scene, surface.first_triangle, uses, sets); });
  return std::move(sets).roots();
}

// What OpenMesh asks of a new face: it would refuse (and print) otherwise.
bool can_add(const SurfaceMesh& mesh, const std::array<SurfaceMesh::VertexHandle, 3>& v) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (!mesh.is_boundary(v[k])) return false;
    const auto halfedge = mesh.find_halfedge(v[k], v[(k + 1) % 3]);
    if (halfedge.is_valid() && !mesh.is_boundary(halfedge)) return false;
  }
  return true;
}

}  // namespace

SurfaceMesh build_surface_mesh(const Scene& scene, const Surface& surface) {
  static std::once_flag quiet;  // a face refused all the same gets vertices of its own: nothing to tell the user
  std::call_once(quiet, [] { omerr().disable(); });

  const std::vector<std::uint32_t> joined = joined_corners(scene, surface);
  SurfaceMesh mesh;
  mesh.reserve(surface.triangle_count, surface.triangle_count * std::size_t{3} / 2, surface.triangle_count);
  std::vector<SurfaceMesh::VertexHandle> vertex(std::size_t{3} * surface.triangle_count);
  const auto new_vertex = [&](std::uint32_t t, std::uint32_t k) {
    const Vec3& p = scene.positions[scene.triangles[surface.first_triangle + t][static_cast<int>(k)]];
    return mesh.add_vertex(SurfaceMesh::Point(p.x, p.y, p.z));
  };
  for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
    std::array<SurfaceMesh::VertexHandle, 3> corner;
    for (std::uint32_t k = 0; k < 3; ++k) {
      SurfaceMesh::VertexHandle& handle = vertex[joined[3 * t + k]];
      if (!handle.is_valid()) handle = new_vertex(t, k);
      corner[k] = handle;
    }
    SurfaceMesh::FaceHandle face;
    if (can_add(mesh, corner)) face = mesh.add_face(corner[0], corner[1], corner[2]);
    if (!face.is_valid()) face = mesh.add_face(new_vertex(t, 0), new_vertex(t, 1), new_vertex(t, 2));
    ORIEL_CHECK_EQ(face.idx(), static_cast<int>(t));
  }
  return mesh;
}

std::vector<std::uint32_t> edges_across(const SurfaceMesh& mesh) {
  // A face's own halfedge is the last that add_face was given: from corner 2 to corner 0.
  const auto edge_of = [&](SurfaceMesh::HalfedgeHandle halfedge) {
    const auto face = mesh.face_handle(halfedge);
    const auto last = mesh.halfedge_handle(face);
    const int k = halfedge == last ? 2 : halfedge == mesh.next_halfedge_handle(last) ? 0 : 1;
    return static_cast<std::uint32_t>(3 * face.idx() + k);
  };
  std::vector<std::uint32_t> across(3 * mesh.n_faces(), kNoEdge);
  for (std::size_t i = 0; i < mesh.n_halfedges(); ++i) {
    const SurfaceMesh::HalfedgeHandle halfedge(static_cast<int>(i));
    const auto other = mesh.opposite_halfedge_handle(halfedge);
    if (!mesh.is_boundary(halfedge) && !mesh.is_boundary(other)) across[edge_of(halfedge)] = edge_of(other);
  }
  return across;
}

TriangleFrame triangle_frame(const Scene& scene, std::uint32_t triangle) {
  const UVec3 v = scene.triangles[triangle];
  const DVec3 a(scene.positions[v.x]), b(scene.positions[v.y]), c(scene.positions[v.z]);
  // Any two edges give the same vector; the two shorter ones lose the least to cancellation in a sliver.
  const DVec3 ab = b - a, ac = c - a, bc = c - b;
  const double ab2 = glm::dot(ab, ab), ac2 = glm::dot(ac, ac), bc2 = glm::dot(bc, bc);
  DVec3 cross = glm::cross(ab, ac);
  if (ab2 >= ac2 && ab2 >= bc2) {
    cross = glm::cross(ac, bc);
  } else if (ac2 >= bc2) {
    cross = glm::cross(ab, bc);
  }
  const double length = glm::length(cross);
  if (!(length > 0)) return {};
  return {cross / length, 0.5 * length};
}

}  // namespace oriel
