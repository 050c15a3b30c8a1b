#include "bake/import/coplanar.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bake/import/patches.h"

namespace oriel {
namespace {

constexpr double kOnePlace = 4e-6;    // of the scene's radius: rays that leave one start beyond the other (accel.h)
constexpr double kLift = 1e-4;        // of the radius: by which a layer is moved,
constexpr double kMostLift = 1e-3;    // metres, but not less than
constexpr double kLeastLift = 1e-5;   // of the radius
constexpr double kDirections = 512;   // cells of plane normals along each axis of [0, 1]
constexpr double kCellPerPlace = 64;  // cells of plane distances

// The entries of a sorted list whose first member has that value. Clang 14 refuses the iterators of
// std::ranges::equal_range, and the fuzzers are compiled by it.
template <class Entry, class Key>
std::span<const Entry> with_key(const std::vector<Entry>& sorted, const std::type_identity_t<Key>& key,
                                Key Entry::*member) {
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), key,
                                      [member](const Entry& entry, const Key& k) { return entry.*member < k; });
  const auto last = std::upper_bound(first, sorted.end(), key,
                                     [member](const Key& k, const Entry& entry) { return k < entry.*member; });
  return {first, last};
}

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
    if (of_vertex_.empty()) find_triangles();
    for (const std::uint32_t v : vertices_at(layer))
      for (const auto& [vertex, t] : with_key(of_vertex_, v, &OfVertex::first))
        for (int k = 0; k < 3; ++k)
          if (glm::dot(n, DVec3(scene_.positions[scene_.triangles[t][k]]) - from) < -one_place) return true;
    return false;
  }

  // Faces lower than a lift may turn over: they keep their front on the side of their normals.
  void finish() {
    std::vector<Vec3> before;
    before.reserve(scene_.triangles.size());
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) before.push_back(geometric_normal(scene_, t));
    for (std::size_t v = 0; v < moved_.size(); ++v) {
      Vec3& p = scene_.positions[v];
      p += moved_[v];
      scene_.lower = glm::min(scene_.lower, p);
      scene_.upper = glm::max(scene_.upper, p);
    }
    scene_.face_normals.clear();
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t)
      if (glm::dot(geometric_normal(scene_, t), before[t]) < 0) std::swap(scene_.triangles[t].y, scene_.triangles[t].z);
    keep_face_normals(scene_);
  }

 private:
  using Place = std::pair<std::size_t, std::uint32_t>;       // a position's hash and a vertex there
  using OfVertex = std::pair<std::uint32_t, std::uint32_t>;  // a vertex and a triangle of it

  // The vertices of the layer's object that lie where its corners do.
  std::set<std::uint32_t> vertices_at(const Layer& layer) {
    if (at_.empty()) find_places();
    const std::uint32_t of = scene_.triangle_surface[layer.triangles.front()];
    std::set<std::uint32_t> vertices;
    for (const std::uint32_t t : layer.triangles)
      for (int k = 0; k < 3; ++k) {
        const Vec3& corner = scene_.positions[scene_.triangles[t][k]];
        for (const auto& [hash, v] : with_key(at_, PositionHash()(corner), &Place::first))
          if (scene_.positions[v] == corner && same_object(surface_of_[v], of)) vertices.insert(v);
      }
    return vertices;
  }

  void find_places() {
    surface_of_.resize(scene_.positions.size());
    for (std::uint32_t s = 0; s < scene_.surfaces.size(); ++s)
      for (std::uint32_t i = 0; i < scene_.surfaces[s].vertex_count; ++i) {
        const std::uint32_t v = scene_.surfaces[s].first_vertex + i;
        surface_of_[v] = s;
        at_.emplace_back(PositionHash()(scene_.positions[v]), v);
      }
    std::ranges::sort(at_);
  }

  void find_triangles() {
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) of_vertex_.emplace_back(scene_.triangles[t][k], t);
    std::ranges::sort(of_vertex_);
  }

  // Whether both are of one node's mesh.
  bool same_object(std::uint32_t a, std::uint32_t b) const {
    const Surface &x = scene_.surfaces[a], &y = scene_.surfaces[b];
    return a == b || (x.node_path == y.node_path && x.mesh_name == y.mesh_name);
  }

  Scene& scene_;
  std::vector<Vec3> moved_;
  std::vector<std::uint32_t> surface_of_;  // by vertex
  std::vector<Place> at_;                  // sorted
  std::vector<OfVertex> of_vertex_;        // sorted
};

// Planes are cut into cells by distance twice, the second time half a cell further: what lies in one place is in one
// cell once at least.
struct Cells {
  const Scene& scene;
  double size;  // m
  bool shifted;
  std::vector<Planar> planar = {};  // sorted

  std::uint64_t cell_of(const DVec3& n, double distance) const {
    const auto number = [](double x) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(x)); };
    std::uint64_t h = number(std::floor(distance / size + (shifted ? 0.75 : 0.25)));
    for (int k = 0; k < 3; ++k) h = h * 0x9e3779b97f4a7c15u + number(std::round(n[k] * kDirections));
    return h;
  }

  // side: 1, or -1 for the cell of what lies there with its front to the other side.
  std::uint64_t cell_of(std::uint32_t triangle, double side) const {
    const DVec3 n(geometric_normal(scene, triangle));
    return cell_of(side * n, side * glm::dot(n, DVec3(scene.positions[scene.triangles[triangle].x])));
  }

  void sort() {
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) planar.push_back({cell_of(t, 1), t});
    std::sort(planar.begin(), planar.end());
  }

  std::span<const Planar> other_side_of(const Layer& layer) const {
    return with_key(planar, cell_of(layer.triangles.front(), -1), &Planar::cell);
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
  context.warning("surfaces lie in one place with others, and were moved a little apart: " + names);
}

}  // namespace

void separate_layers(Scene& scene, Context& context) {
  const double radius = scene.radius(), one_place = kOnePlace * radius;
  const double lift = std::max(std::min(kLift * radius, kMostLift), kLeastLift * radius);
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
