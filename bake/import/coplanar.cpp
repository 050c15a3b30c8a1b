#include "bake/import/coplanar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bake/import/patches.h"
#include "bake/scene/edges.h"

namespace oriel {
namespace {

constexpr double kOnePlace = 4e-6;    // of the scene's radius: rays that leave one start beyond the other (accel.h)
constexpr double kLift = 1e-4;        // of the radius: by which a layer is moved,
constexpr double kMostLift = 1e-3;    // metres, but not less than
constexpr double kLeastLift = 1e-5;   // of the radius
constexpr double kDirections = 512;   // cells of plane normals along each axis of [0, 1]
constexpr double kCellPerPlace = 64;  // cells of plane distances

// Moves patches, and what of their object hangs on them.
class Lifter {
 public:
  explicit Lifter(Scene& scene) : scene_(scene), moved_(scene.positions.size(), Vec3(0)) {}

  // The patch's corners, and what else of its object lies there, but for the other patches of the plane.
  void move(const PlanePatches& plane, const Layer& layer, double by_m) {
    const Vec3 by = static_cast<float>(by_m) * geometric_normal(scene_, layer.triangles.front());
    for (const std::uint32_t v : vertices_at(layer))
      if (!plane.has_elsewhere(v, layer.patch)) moved_[v] += by;
  }

  // Whether it is the face of a body: something that hangs on it goes on behind its plane.
  bool has_body(const Layer& layer, double one_place) {
    const DVec3 n(geometric_normal(scene_, layer.triangles.front()));
    const DVec3 from(scene_.positions[scene_.triangles[layer.triangles.front()].x]);
    for (const std::uint32_t v : vertices_at(layer))
      for (std::uint32_t c = first_corner_[v]; c != kNone; c = next_corner_[c])
        for (int k = 0; k < 3; ++k)
          if (glm::dot(n, DVec3(scene_.positions[scene_.triangles[c / 3][k]]) - from) < -one_place) return true;
    return false;
  }

  // Faces lower than a lift may turn over: they keep their front on the side of their normals.
  void finish() {
    for (std::size_t v = 0; v < moved_.size(); ++v) {
      Vec3& p = scene_.positions[v];
      p += moved_[v];
      scene_.lower = glm::min(scene_.lower, p);
      scene_.upper = glm::max(scene_.upper, p);
    }
    const std::vector<Vec3> before = scene_.face_normals;
    keep_face_normals(scene_);
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t)
      if (Vec3& normal = scene_.face_normals[t]; glm::dot(normal, before[t]) < 0)
        std::swap(scene_.triangles[t].y, scene_.triangles[t].z), normal = -normal;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  // The vertices of the layer's object that lie where its corners do.
  std::set<std::uint32_t> vertices_at(const Layer& layer) {
    if (welded_.empty()) find_places();
    const std::uint32_t of = scene_.triangle_surface[layer.triangles.front()];
    std::set<std::uint32_t> vertices;
    for (const std::uint32_t t : layer.triangles)
      for (int k = 0; k < 3; ++k)
        for (std::uint32_t v = welded_[scene_.triangles[t][k]]; v != kNone; v = next_at_[v])
          if (same_object(surface_of_[v], of)) vertices.insert(v);
    return vertices;
  }

  void find_places() {
    const std::size_t vertices = scene_.positions.size();
    surface_of_.resize(vertices), next_at_.assign(vertices, kNone), first_corner_.assign(vertices, kNone);
    next_corner_.resize(3 * scene_.triangles.size());
    for (std::uint32_t s = 0; s < scene_.surfaces.size(); ++s)
      for (std::uint32_t i = 0; i < scene_.surfaces[s].vertex_count; ++i)
        surface_of_[scene_.surfaces[s].first_vertex + i] = s;
    welded_ = weld(scene_.positions);
    for (std::uint32_t v = 0; v < vertices; ++v)
      if (welded_[v] != v) next_at_[v] = std::exchange(next_at_[welded_[v]], v);
    for (std::uint32_t c = 0; c < next_corner_.size(); ++c)
      next_corner_[c] = std::exchange(first_corner_[scene_.triangles[c / 3][c % 3]], c);
  }

  // Whether both are of one node's mesh.
  bool same_object(std::uint32_t a, std::uint32_t b) const {
    const Surface &x = scene_.surfaces[a], &y = scene_.surfaces[b];
    return a == b || (x.node_path == y.node_path && x.mesh_name == y.mesh_name);
  }

  Scene& scene_;
  std::vector<Vec3> moved_;
  std::vector<std::uint32_t> surface_of_, welded_;         // by vertex
  std::vector<std::uint32_t> next_at_;                     // by vertex: another at its position
  std::vector<std::uint32_t> first_corner_, next_corner_;  // by vertex, by corner: 3 * triangle + k of the vertex
};

// Planes are cut into cells by distance twice, the second time half a cell further: what lies in one place is in one
// cell once at least.
struct Cells {
  const Scene& scene;
  double size;  // m
  bool shifted;
  std::vector<Planar> planar = {};  // sorted

  std::uint64_t cell_of(const DVec3& n, double distance) const {
    const auto number = [](double x) { return static_cast<std::uint64_t>(std::llrint(x)); };
    std::uint64_t h = number(std::floor(distance / size + (shifted ? 0.75 : 0.25)));
    for (int k = 0; k < 3; ++k) h = h * 0x9e3779b97f4a7c15u + number(n[k] * kDirections);
    return h;
  }

  // side: 1, or -1 for the cell of what lies there with its front to the other side.
  std::uint64_t cell_of(std::uint32_t triangle, double side) const {
    const DVec3 n(geometric_normal(scene, triangle));
    return cell_of(side * n, side * glm::dot(n, DVec3(scene.positions[scene.triangles[triangle].x])));
  }

  void sort() {
    planar.reserve(scene.triangles.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) planar.push_back({cell_of(t, 1), t});
    std::sort(planar.begin(), planar.end());
  }

  std::span<const Planar> other_side_of(const Layer& layer) const {
    const std::uint64_t cell = cell_of(layer.triangles.front(), -1);
    const auto first = std::lower_bound(planar.begin(), planar.end(), Planar{cell, 0});
    return {first, std::upper_bound(first, planar.end(), Planar{cell, ~0u})};
  }
};

// One warning: the first few by name.
void tell(const Scene& scene, const std::map<std::uint32_t, std::uint32_t>& told, Context& context) {
  constexpr std::size_t kNamed = 4;
  std::string names;
  std::size_t named = 0;
  for (const auto& [surface, below] : told)
    if (named++ < kNamed)
      names += fmt::format("{}\"{}\" with \"{}\"", named > 1 ? ", " : "", scene.surfaces[surface].name,
                           scene.surfaces[below].name);
  if (named > kNamed) names += fmt::format(" and {} more", named - kNamed);
  context.warning("coplanar-surfaces",
                  "surfaces lie in one place with others, and were moved a little apart: " + names);
}

}  // namespace

void separate_layers(Scene& scene, Context& context) {
  const double radius = scene.radius(), one_place = kOnePlace * radius;
  const double lift = std::max(std::min(kLift * radius, kMostLift), kLeastLift * radius);
  keep_face_normals(scene);
  Lifter lifter(scene);
  PlanePatches plane(scene, one_place, lift);
  std::set<std::vector<std::uint32_t>> done;    // patches
  std::map<std::uint32_t, std::uint32_t> told;  // a surface that was moved, and one that it lay on
  for (const bool shifted : {false, true}) {
    Cells cells{scene, kCellPerPlace * one_place, shifted};
    cells.sort();
    for (std::size_t i = 0, end = 0; i < cells.planar.size() && !context.stopped(); i = end) {
      while (end < cells.planar.size() && cells.planar[end].cell == cells.planar[i].cell) ++end;
      if (end - i < 2) continue;
      for (const Layer& layer : plane.layers(std::span(cells.planar).subspan(i, end - i))) {
        if (!done.insert(layer.triangles).second) continue;
        const std::uint32_t met = plane.met(layer, cells.other_side_of(layer));
        if (layer.level == 0 && met == ~0u) continue;
        const bool stands = met != ~0u && (layer.level == 0 || lifter.has_body(layer, one_place));
        lifter.move(plane, layer, stands ? -lift : layer.level * lift);
        told.try_emplace(scene.triangle_surface[layer.triangles.front()], layer.level == 0 ? met : layer.below);
      }
    }
  }
  if (told.empty()) return;
  lifter.finish();
  tell(scene, told, context);
}

}  // namespace oriel
