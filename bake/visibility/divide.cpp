#include "bake/visibility/divide.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "bake/scene/box_tree.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

using Corners = std::array<Vec3, 3>;

struct Piece {
  UVec3 vertex{0};        // into the scene's vertices, then those added
  std::uint32_t of = 0;   // the triangle that it is a piece of
  std::uint32_t cut = 0;  // the first of its two halves, which stand for it; 0: it is whole
};

// Both ends of an edge by their positions, whatever vertices stand there and in whichever order.
struct EdgeKey {
  std::array<std::uint32_t, 6> bits{};
  bool operator==(const EdgeKey&) const = default;
};
struct EdgeHash {
  std::size_t operator()(const EdgeKey& key) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15;
    for (const std::uint32_t b : key.bits) hash = (hash ^ b) * 0xff51afd7ed558ccd, hash ^= hash >> 32;
    return hash;
  }
};

class Divider {
 public:
  explicit Divider(Scene& scene, float shortest = 0) : scene_(scene), shortest_(shortest) {
    vertex_surface_.resize(scene.positions.size());
    for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
      for (std::uint32_t v = 0; v < scene.surfaces[s].vertex_count; ++v)
        vertex_surface_[scene.surfaces[s].first_vertex + v] = s;
  }

  bool divide(const std::function<bool(const Corners&)>& wanted) {
    const auto is_wanted = [&](const UVec3& v) { return may_be_cut(v) && wanted(corners(v)); };
    std::vector<std::uint32_t> work;
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t)
      if (is_wanted(scene_.triangles[t])) work.push_back(t);
    if (work.empty()) return false;
    begin([](std::uint32_t) { return true; });
    while (!work.empty()) {
      const std::uint32_t p = work.back();
      work.pop_back();
      if (pieces_[p].cut || !is_wanted(pieces_[p].vertex)) continue;
      const std::size_t before = pieces_.size();
      cut_edge(longest_of_path(p));
      if (!pieces_[p].cut) work.push_back(p);  // a longer edge had to go first
      for (std::size_t added = before; added < pieces_.size(); ++added)
        work.push_back(static_cast<std::uint32_t>(added));
    }
    write();
    return true;
  }

  bool cut() {
    if (scene_.cuts.empty()) return false;
    std::vector<bool> is_near(scene_.triangles.size());
    std::vector<std::vector<std::uint32_t>> near = triangles_near_cuts(is_near);
    begin([&](std::uint32_t t) { return is_near[t]; });
    const std::size_t before = pieces_.size();
    for (std::size_t c = 0; c < near.size(); ++c) {
      std::size_t next = pieces_.size();
      for (const std::uint32_t p : whole_pieces(std::move(near[c]), scene_.cuts[c])) cut_piece(p, scene_.cuts[c]);
      for (; next < pieces_.size(); ++next) cut_piece(static_cast<std::uint32_t>(next), scene_.cuts[c]);
    }
    if (pieces_.size() == before) return false;
    write();
    return true;
  }

 private:
  template <class Takes>
  void begin(const Takes& takes) {
    ORIEL_CHECK_EQ(scene_.twin.size(), std::size_t{0});
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) pieces_.push_back({scene_.triangles[t], t, 0});
    for (std::uint32_t p = 0; p < pieces_.size(); ++p)
      if (takes(p)) add_edges(p);
  }

  // Whether the line passes their box, with room for its tolerance.
  static bool passes(const ChartCut& line, const Corners& corners) {
    TreeBox box;
    for (const Vec3& corner : corners) box.add(DVec3(corner));
    box.widen(2 * line.tolerance_m());
    double first = 0, last = 1;
    for (int k = 0; k < 3; ++k) {
      const double from = line.from[k], step = line.to[k] - from;
      const double a = (box.lower[k] - from) / step, b = (box.upper[k] - from) / step;
      first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
    }
    return first <= last;
  }

  // Those of what stands still, by cut.
  std::vector<std::vector<std::uint32_t>> triangles_near_cuts(std::vector<bool>& is_near) const {
    const BoxTree tree = tree_of(scene_.cuts);
    std::vector<std::vector<std::uint32_t>> near(scene_.cuts.size());
    std::vector<std::uint32_t> found;
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
      if (scene_.surfaces[scene_.triangle_surface[t]].mover >= 0) continue;
      const Corners c = corners(scene_.triangles[t]);
      TreeBox box;
      for (const Vec3& corner : c) box.add(DVec3(corner));
      tree.near(box, found);
      for (const std::uint32_t i : found)
        if (passes(scene_.cuts[i], c)) near[i].push_back(t), is_near[t] = true;
    }
    return near;
  }

  // What is left of pieces where the line passes, ascending.
  std::vector<std::uint32_t> whole_pieces(std::vector<std::uint32_t> work, const ChartCut& line) const {
    std::vector<std::uint32_t> whole;
    while (!work.empty()) {
      const Piece& piece = pieces_[work.back()];
      if (piece.cut == 0) whole.push_back(work.back());
      work.pop_back();
      for (const std::uint32_t half : {piece.cut, piece.cut + 1})
        if (piece.cut != 0 && passes(line, corners(pieces_[half].vertex))) work.push_back(half);
    }
    std::ranges::sort(whole);
    return whole;
  }

  // Its pieces come after it, and are cut in their turn.
  void cut_piece(std::uint32_t p, const ChartCut& line) {
    if (pieces_[p].cut) return;
    const UVec3 v = pieces_[p].vertex;
    const Corners c = corners(v);
    const Vec3 n = geometric_normals_[pieces_[p].of];
    const double near = line.tolerance_m();
    if (std::abs(glm::dot(n, line.from - c[0])) > near || std::abs(glm::dot(n, line.to - c[0])) > near) return;
    const float length = glm::distance(line.from, line.to);
    const Vec3 along = (line.to - line.from) / length, across = glm::cross(n, along);
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = c[k] - line.from, b = c[(k + 1) % 3] - line.from;
      const float da = glm::dot(across, a), db = glm::dot(across, b);
      if (std::min(std::abs(da), std::abs(db)) <= near || (da > 0) == (db > 0)) continue;
      const float at = da / (da - db), place = glm::dot(along, a + at * (b - a));
      if (place < -near || place > length + near) continue;
      const auto found = pieces_at_.find(edge_key(v, k));
      if (found == pieces_at_.end()) continue;  // of what moves
      cut_edge(found->first, c[k] + at * (c[(k + 1) % 3] - c[k]));
      return;
    }
  }

  Corners corners(const UVec3& v) const {
    return {scene_.positions[v.x], scene_.positions[v.y], scene_.positions[v.z]};
  }

  // The edge from corner k to the next.
  int longest_edge(const UVec3& v) const {
    const Corners c = corners(v);
    int best = 0;
    float length = -1;
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = c[(k + 1) % 3] - c[k];
      if (glm::dot(e, e) > length) length = glm::dot(e, e), best = k;
    }
    return best;
  }
  float longest(const UVec3& v) const {
    const int k = longest_edge(v);
    const Corners c = corners(v);
    return glm::distance(c[k], c[(k + 1) % 3]);
  }

  EdgeKey edge_key(const UVec3& v, int k) const {
    const auto bits_of = [&](std::uint32_t vertex) {
      const Vec3 p = scene_.positions[vertex] + 0.0f;  // -0 is 0
      return std::array{std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                        std::bit_cast<std::uint32_t>(p.z)};
    };
    auto a = bits_of(v[k]), b = bits_of(v[(k + 1) % 3]);
    if (b < a) std::swap(a, b);
    return {{a[0], a[1], a[2], b[0], b[1], b[2]}};
  }

  // Far from the origin the middle of a short edge is one of its ends.
  bool may_be_cut(const UVec3& v) const {
    const float rounding = 8 * std::numeric_limits<float>::epsilon() * max_component(glm::abs(scene_.positions[v.x]));
    return longest(v) > std::max(shortest_, rounding);
  }

  // Only of those that may be cut.
  void add_edges(std::uint32_t p) {
    if (!may_be_cut(pieces_[p].vertex)) return;
    for (int k = 0; k < 3; ++k) {
      std::vector<std::uint32_t>& at = pieces_at_[edge_key(pieces_[p].vertex, k)];
      std::erase_if(at, [&](std::uint32_t other) { return pieces_[other].cut; });
      at.push_back(p);
    }
  }

  // From a piece across its longest edge to one with a longer one, and on: the edge at the end is the longest of all
  // that share it, and cutting it makes no slivers (Rivara 1997, longest-edge propagation path).
  EdgeKey longest_of_path(std::uint32_t p) const {
    for (;;) {
      const UVec3 v = pieces_[p].vertex;
      const EdgeKey key = edge_key(v, longest_edge(v));
      std::uint32_t next = p;
      for (const std::uint32_t other : pieces_at_.at(key))
        if (!pieces_[other].cut && longest(pieces_[other].vertex) > longest(pieces_[next].vertex) * (1 + 1e-5f))
          next = other;
      if (next == p) return key;
      p = next;
    }
  }

  // Every piece that has the edge becomes two, at its middle or, where it is given, at a place on it.
  void cut_edge(const EdgeKey& edge, const std::optional<Vec3>& place = std::nullopt) {
    const EdgeKey key = edge;
    const std::vector<std::uint32_t> sharing = std::move(pieces_at_[key]);
    pieces_at_.erase(key);  // a half has it again where two corners of its piece are in one place
    for (const std::uint32_t p : sharing) {
      if (pieces_[p].cut) continue;
      const UVec3 v = pieces_[p].vertex;
      for (int k = 0; k < 3; ++k) {
        if (!(edge_key(v, k) == key)) continue;
        const std::uint32_t a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3], m = vertex_on(a, b, place);
        pieces_[p].cut = static_cast<std::uint32_t>(pieces_.size());
        for (const UVec3& half : {UVec3(a, m, c), UVec3(m, b, c)}) {
          pieces_.push_back({half, pieces_[p].of, 0});
          add_edges(static_cast<std::uint32_t>(pieces_.size() - 1));
        }
        break;
      }
    }
  }

  std::uint32_t vertex_on(std::uint32_t a, std::uint32_t b, const std::optional<Vec3>& place) {
    const auto [at, added] =
        middles_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(scene_.positions.size()));
    if (!added) return at->second;
    const Vec3 edge = scene_.positions[b] - scene_.positions[a];
    const float to = place ? glm::dot(*place - scene_.positions[a], edge) / glm::dot(edge, edge) : 0.5f;
    const float from = 1 - to;
    const auto unit_or = [](const Vec3& v, const Vec3& otherwise) {
      const float length = glm::length(v);
      return length > 1e-6f ? v / length : otherwise;
    };
    scene_.positions.push_back(place ? *place : from * scene_.positions[a] + to * scene_.positions[b]);
    scene_.normals.push_back(unit_or(from * scene_.normals[a] + to * scene_.normals[b], scene_.normals[a]));
    scene_.uv0.push_back(from * scene_.uv0[a] + to * scene_.uv0[b]);
    scene_.uv1.push_back(from * scene_.uv1[a] + to * scene_.uv1[b]);
    if (!scene_.colors.empty()) scene_.colors.push_back(color_between(scene_.colors[a], scene_.colors[b], to));
    if (!scene_.tangents.empty()) {
      const Vec4 &ta = scene_.tangents[a], &tb = scene_.tangents[b];
      scene_.tangents.push_back(Vec4(unit_or(from * Vec3(ta) + to * Vec3(tb), Vec3(ta)), ta.w == tb.w ? ta.w : 0));
    }
    vertex_surface_.push_back(vertex_surface_[a]);
    return at->second;
  }

  static std::uint32_t color_between(std::uint32_t a, std::uint32_t b, float to) {
    std::uint32_t color = 0;
    for (int shift = 0; shift < 32; shift += 8) {
      const auto from = static_cast<float>(a >> shift & 255u), other = static_cast<float>(b >> shift & 255u);
      color |= static_cast<std::uint32_t>(from + to * (other - from) + 0.5f) << shift;
    }
    return color;
  }

  template <class T>
  static void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
    if (values.empty()) return;
    std::vector<T> out;
    out.reserve(order.size());
    for (const std::uint32_t i : order) out.push_back(values[i]);
    values = std::move(out);
  }

  // Vertices and triangles in the order of surfaces, as Scene wants them; triangles in the order of those they are of.
  void write() {
    std::vector<std::uint32_t> order(scene_.positions.size()), place(order.size()), kept;
    for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return vertex_surface_[a] < vertex_surface_[b]; });
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    reorder(scene_.positions, order), reorder(scene_.normals, order), reorder(scene_.uv0, order);
    reorder(scene_.uv1, order), reorder(scene_.colors, order), reorder(scene_.tangents, order);
    for (std::uint32_t p = 0; p < pieces_.size(); ++p)
      if (!pieces_[p].cut) kept.push_back(p);
    std::stable_sort(kept.begin(), kept.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return pieces_[a].of < pieces_[b].of; });
    std::vector<UVec3> triangles;
    std::vector<std::uint32_t> surface_of;
    std::vector<Vec3> normals;
    std::vector<std::uint32_t> vertices(scene_.surfaces.size()), count(scene_.surfaces.size());
    for (const std::uint32_t s : vertex_surface_) ++vertices[s];
    for (const std::uint32_t p : kept) {
      const Piece& piece = pieces_[p];
      const std::uint32_t s = scene_.triangle_surface[piece.of];
      triangles.push_back({place[piece.vertex.x], place[piece.vertex.y], place[piece.vertex.z]});
      surface_of.push_back(s);
      normals.push_back(geometric_normals_[piece.of]);
      ++count[s];
    }
    std::uint32_t first_triangle = 0, first_vertex = 0;
    for (std::uint32_t s = 0; s < scene_.surfaces.size(); ++s) {
      Surface& surface = scene_.surfaces[s];
      surface.first_triangle = first_triangle, surface.triangle_count = count[s];
      surface.first_vertex = first_vertex, surface.vertex_count = vertices[s];
      first_triangle += count[s], first_vertex += vertices[s];
    }
    scene_.triangles = std::move(triangles);
    scene_.triangle_surface = std::move(surface_of);
    scene_.face_normals = std::move(normals);
  }

  Scene& scene_;
  float shortest_;
  std::vector<Piece> pieces_;
  std::unordered_map<EdgeKey, std::vector<std::uint32_t>, EdgeHash> pieces_at_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles_;
  std::vector<std::uint32_t> vertex_surface_;
  std::vector<Vec3> geometric_normals_ = [this] {
    std::vector<Vec3> normals;
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) normals.push_back(geometric_normal(scene_, t));
    return normals;
  }();
};

}  // namespace

bool divide_triangles(Scene& scene, float shortest_m, const std::function<bool(const std::array<Vec3, 3>&)>& wanted) {
  return Divider(scene, shortest_m).divide(wanted);
}

bool cut_triangles(Scene& scene) {
  return Divider(scene).cut();
}

}  // namespace oriel
