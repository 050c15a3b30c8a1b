#include "bake/run/vertex_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "bake/radiosity/texels/frame_error.h"
#include "formats/core/position_hash.h"

namespace oriel {
namespace {

constexpr float kPlacesATexel = 2;  // along a triangle's longest edge, where the lightmap is asked
constexpr float kMostPlaces = 2048;

struct Triangle {
  std::array<std::uint32_t, 3> corners{};
  std::int32_t page = -1;
  std::uint32_t origin = 0;  // the triangle of the mesh as it was
  double square = 0;         // error², mean over its area
  double area = 0;           // m²
};

// Two places, the lower number first.
std::uint64_t edge_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

std::uint32_t mean_color(std::uint32_t a, std::uint32_t b) {
  std::uint32_t out = 0;
  for (std::uint32_t shift = 0; shift < 32; shift += 8)
    out |= ((a >> shift & 255u) + (b >> shift & 255u) + 1) / 2 << shift;
  return out;
}

Vec4 mean_tangent(const Vec4& a, const Vec4& b) {
  if (a.w != b.w || a.w == 0) return Vec4(0);
  return Vec4(normalize_or(Vec3(a) + Vec3(b), Vec3(a)), a.w);
}

class Divider {
 public:
  Divider(Mesh& mesh, std::span<const LightmapPage> pages, const VertexLightOptions& options)
      : mesh_(mesh), pages_(pages), options_(options) {
    report_.asked = options.error;
    report_.triangles_before = mesh.indices.size() / 3;
    find_floor();
    take_triangles();
    for (Triangle& t : triangles_) measure(t);
  }

  DividedMesh run() {
    while (choose()) split();
    DividedMesh out;
    write(out.first);
    out.light.irradiance = std::move(light_);
    describe();
    out.report = report_;
    return out;
  }

 private:
  struct Side {  // of an edge: a triangle that has it
    std::uint64_t edge = 0;
    std::uint32_t triangle = 0;
    bool operator<(const Side& o) const { return edge != o.edge ? edge < o.edge : triangle < o.triangle; }
  };

  // Dark places count as a tenth of the mean light, as in frames.
  void find_floor() {
    DVec3 sum(0);
    double texels = 0;
    for (const LightmapPage& page : pages_)
      for (std::size_t i = 0; i < page.irradiance.size(); ++i)
        if (page.state[i] == TexelState::kValid) sum += DVec3(page.irradiance[i]), ++texels;
    const DVec3 floor = kFrameFloor * sum / std::max(texels, 1.0);
    floor2_ = floor * floor;
  }

  std::uint32_t place_of(const Vec3& position) {
    return places_.try_emplace(position, static_cast<std::uint32_t>(places_.size())).first->second;
  }

  // Light is that of one page: a vertex of triangles of two is doubled.
  void take_triangles() {
    constexpr std::int32_t kNone = -2;
    std::vector<std::int32_t> page_of(mesh_.positions.size(), kNone);
    std::unordered_map<std::uint64_t, std::uint32_t> twins;
    triangles_.resize(mesh_.indices.size() / 3);
    for (std::uint32_t i = 0; i < 3 * triangles_.size(); ++i)
      triangles_[i / 3].origin = i / 3, triangles_[i / 3].corners[i % 3] = mesh_.indices[i];
    for (const MeshPart& part : mesh_.parts)
      for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
        std::uint32_t v = mesh_.indices[i];
        if (page_of[v] == kNone) page_of[v] = part.lightmap_page;
        if (page_of[v] != part.lightmap_page) {
          const std::uint64_t key = std::uint64_t{v} << 32 | static_cast<std::uint32_t>(part.lightmap_page);
          const auto [at, added] = twins.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
          if (added) add_mean(v, v), page_of.push_back(part.lightmap_page);
          v = at->second;
        }
        triangles_[i / 3].page = part.lightmap_page;
        triangles_[i / 3].corners[i % 3] = v;
      }
    place_.reserve(mesh_.positions.size());
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      place_.push_back(place_of(mesh_.positions[v]));
      light_.push_back(light_at(std::max(page_of[v], -1), mesh_.lightmap_uvs[v]));
    }
  }

  Vec3 light_at(std::int32_t page, const Vec2& uv) const {
    return page < 0 ? Vec3(0) : irradiance_at(pages_[static_cast<std::size_t>(page)], uv);
  }

  // A vertex in the middle of two, of all but light and place.
  void add_mean(std::uint32_t a, std::uint32_t b) {
    const auto middle = [&](auto& values) { values.push_back((values[a] + values[b]) * 0.5f); };
    middle(mesh_.positions);
    mesh_.normals.push_back(normalize_or(mesh_.normals[a] + mesh_.normals[b], mesh_.normals[a]));
    middle(mesh_.uvs);
    middle(mesh_.lightmap_uvs);
    if (!mesh_.colors.empty()) mesh_.colors.push_back(mean_color(mesh_.colors[a], mesh_.colors[b]));
    if (mesh_.normal_uvs.empty()) return;
    middle(mesh_.normal_uvs);
    mesh_.tangents.push_back(a == b ? mesh_.tangents[a] : mean_tangent(mesh_.tangents[a], mesh_.tangents[b]));
  }

  double metres(std::uint32_t a, std::uint32_t b) const {
    return glm::length(DVec3(mesh_.positions[a]) - DVec3(mesh_.positions[b]));
  }
  float texels(const Triangle& t, int side) const {
    if (t.page < 0) return 0;
    const LightmapPage& page = pages_[static_cast<std::size_t>(t.page)];
    const auto at = [&](int i) { return mesh_.lightmap_uvs[t.corners[static_cast<std::size_t>(i % 3)]]; };
    return glm::length((at(side + 1) - at(side)) * Vec2(page.width, page.height));
  }
  std::uint64_t edge(const Triangle& t, int side) const {
    const auto at = [&](int i) { return place_[t.corners[static_cast<std::size_t>(i % 3)]]; };
    return edge_of(at(side), at(side + 1));
  }
  // Alike in metres, the one of the higher number: its neighbour thinks the same.
  int longest(const Triangle& t) const {
    const auto rank = [&](int i) {
      const std::uint32_t a = t.corners[static_cast<std::size_t>(i)],
                          b = t.corners[static_cast<std::size_t>((i + 1) % 3)];
      return std::pair(metres(a, b), edge(t, i));
    };
    int out = 0;
    for (int i = 1; i < 3; ++i)
      if (rank(i) > rank(out)) out = i;
    return out;
  }

  // How far interpolation between its corners is from the lightmap.
  void measure(Triangle& t) const {
    const auto p = [&](std::size_t i) { return DVec3(mesh_.positions[t.corners[i]]); };
    t.area = 0.5 * glm::length(glm::cross(p(1) - p(0), p(2) - p(0)));
    t.square = 0;
    if (t.page < 0) return;
    float side = 0;
    for (int i = 0; i < 3; ++i) side = std::max(side, texels(t, i));
    const auto n = static_cast<int>(std::clamp(std::ceil(kPlacesATexel * side), 2.0f, kMostPlaces));
    const LightmapPage& page = pages_[static_cast<std::size_t>(t.page)];
    const auto off_at = [&](double u, double v) {
      const auto mix = [&](const auto& values) {
        using T = std::decay_t<decltype(values[0])>;
        return T(static_cast<float>(1 - u - v) * values[t.corners[0]] + static_cast<float>(u) * values[t.corners[1]] +
                 static_cast<float>(v) * values[t.corners[2]]);
      };
      const DVec3 light(irradiance_at(page, mix(mesh_.lightmap_uvs))), off = DVec3(mix(light_)) - light;
      return relative_square(off * off, light * light, floor2_);
    };
    double sum = 0;
    for (int j = 0; j < n; ++j)  // the middles of n² equal triangles
      for (int i = 0; i + j < n; ++i) {
        sum += off_at((i + 1 / 3.0) / n, (j + 1 / 3.0) / n);
        if (i + j + 1 < n) sum += off_at((i + 2 / 3.0) / n, (j + 2 / 3.0) / n);
      }
    t.square = sum / n / n;
  }
  bool is_off(const Triangle& t) const { return t.square > options_.error * options_.error; }

  std::span<const Side> sides_of(std::uint64_t wanted) const {
    const auto less = [](const Side& side, std::uint64_t e) { return side.edge < e; };
    const auto from = std::lower_bound(sides_.begin(), sides_.end(), wanted, less);
    auto to = from;
    while (to != sides_.end() && to->edge == wanted) ++to;
    return {from, to};
  }
  bool may_cut(std::uint64_t wanted) const {
    const auto sides = sides_of(wanted);
    return std::any_of(sides.begin(), sides.end(), [&](const Side& side) {
      const Triangle& t = triangles_[side.triangle];
      for (int i = 0; i < 3; ++i)
        if (edge(t, i) == wanted && texels(t, i) > 1) return true;
      return false;
    });
  }

  // Which edges are to be cut now; whether any is.
  bool choose() {
    sides_.clear(), cut_.clear();
    std::vector<std::uint32_t> off;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (int i = 0; i < 3; ++i) sides_.push_back({edge(triangles_[t], i), t});
      if (is_off(triangles_[t])) off.push_back(t);
    }
    std::sort(sides_.begin(), sides_.end());
    std::stable_sort(off.begin(), off.end(), [&](std::uint32_t a, std::uint32_t b) {
      return triangles_[a].square * triangles_[a].area > triangles_[b].square * triangles_[b].area;
    });
    std::size_t total = triangles_.size();
    for (const std::uint32_t t : off) {
      const std::uint64_t wanted = edge(triangles_[t], longest(triangles_[t]));
      if (!may_cut(wanted) || cut_.contains(wanted)) continue;
      if (add_cut(wanted, total)) continue;
      report_.full = true;
      break;
    }
    return !cut_.empty();
  }

  // That edge, and the longest of each triangle that it meets, and so on; nothing where these are too many.
  bool add_cut(std::uint64_t wanted, std::size_t& total) {
    std::vector<std::uint64_t> added{wanted};
    cut_.insert(wanted);
    std::size_t more = 0;
    for (std::size_t k = 0; k < added.size(); ++k)
      for (const Side& side : sides_of(added[k])) {
        ++more;
        const std::uint64_t next = edge(triangles_[side.triangle], longest(triangles_[side.triangle]));
        if (cut_.insert(next).second) added.push_back(next);
      }
    if (total + more > options_.most_triangles) {
      for (const std::uint64_t e : added) cut_.erase(e);
      return false;
    }
    total += more;
    return true;
  }

  void split() {
    std::vector<Triangle> before = std::move(triangles_);
    triangles_.clear(), middles_.clear();
    for (const Triangle& t : before) split(t, false);
  }

  // At its longest edge that is cut; what that leaves may have others. Their middles have no cut yet.
  void split(const Triangle& t, bool changed) {
    int at = -1;
    double length = -1;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t.corners[static_cast<std::size_t>(i)],
                          b = t.corners[static_cast<std::size_t>((i + 1) % 3)];
      if (cut_.contains(edge(t, i)) && metres(a, b) > length) at = i, length = metres(a, b);
    }
    if (at < 0) {
      triangles_.push_back(t);
      if (changed) measure(triangles_.back());
      return;
    }
    const auto corner = [&](int i) { return t.corners[static_cast<std::size_t>((at + i) % 3)]; };
    const std::uint32_t middle = middle_of(corner(0), corner(1), t.page);
    Triangle half = t;
    half.corners = {corner(0), middle, corner(2)};
    split(half, true);
    half.corners = {middle, corner(1), corner(2)};
    split(half, true);
  }

  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b, std::int32_t page) {
    const auto [at, added] = middles_.try_emplace(edge_of(a, b), static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!added) return at->second;
    add_mean(a, b);
    place_.push_back(place_of(mesh_.positions.back()));
    light_.push_back(light_at(page, mesh_.lightmap_uvs.back()));
    return at->second;
  }

  // Triangles lie in the order of those that they were.
  void write(std::vector<std::uint32_t>& first) {
    first.assign(report_.triangles_before + 1, 0);
    for (const Triangle& t : triangles_) ++first[t.origin + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    mesh_.indices.clear();
    for (const Triangle& t : triangles_) mesh_.indices.insert(mesh_.indices.end(), t.corners.begin(), t.corners.end());
    for (MeshPart& part : mesh_.parts) {
      const std::uint32_t from = first[part.first_index / 3], to = first[(part.first_index + part.index_count) / 3];
      part.first_index = 3 * from;
      part.index_count = 3 * (to - from);
    }
  }

  void describe() {
    report_.triangles = triangles_.size();
    report_.vertices = mesh_.positions.size();
    double sum = 0, area = 0;
    for (const Triangle& t : triangles_) {
      if (t.page < 0) continue;
      sum += t.square * t.area, area += t.area;
      report_.coarse += is_off(t) ? 1 : 0;
    }
    report_.error = area > 0 ? std::sqrt(sum / area) : 0;
  }

  Mesh& mesh_;
  std::span<const LightmapPage> pages_;
  const VertexLightOptions& options_;
  VertexLightReport report_;
  DVec3 floor2_{0};
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> place_;  // by vertex: one number for all at one position
  std::unordered_map<Vec3, std::uint32_t, PositionHash> places_;
  std::vector<Vec3> light_;                                   // by vertex
  std::vector<Side> sides_;                                   // sorted
  std::unordered_set<std::uint64_t> cut_;                     // edges
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  // by the two vertices, of this round
};

}  // namespace

DividedMesh divide_by_light(Mesh& mesh, std::span<const LightmapPage> pages, const VertexLightOptions& options) {
  return Divider(mesh, pages, options).run();
}

std::string VertexLightReport::shortfall() const {
  if (!full) return {};
  return fmt::format(
      "--radiosity vertices: {} triangles, as many as are made at most; {} of them are off by more than {:.3g} %, all "
      "together by {:.2g} %",
      triangles, coarse, 100 * asked, 100 * error);
}

VertexLightReport light_pack_vertices(const BakeTask& bake, AssembledMesh& mesh, std::vector<Warning>& omissions) {
  VertexLightOptions wanted;
  if (bake.options.radiosity.error > 0) wanted.error = bake.options.radiosity.error;
  if (bake.options.vertex_error > 0) wanted.error = bake.options.vertex_error;
  DividedMesh divided = divide_by_light(mesh.mesh, bake.pack.lightmaps, wanted);
  const auto start = [&](std::uint32_t index) { return 3 * divided.first[index / 3]; };
  for (std::uint32_t& first : mesh.first_index) {
    mesh.index_count.push_back(start(first + 3) - start(first));
    first = start(first);
  }
  for (std::uint32_t at = 0; TriangleRun & run : bake.pack.visible_sets.runs) {
    const std::uint32_t from = std::exchange(at, at + run.index_count);
    run.index_count = start(at) - start(from);
  }
  bake.pack.vertex_light = std::move(divided.light);
  const VertexLightReport& r = divided.report;
  if (const std::string shortfall = r.shortfall(); !shortfall.empty()) bake.context.warning(shortfall);
  if (!bake.scene().light_groups.empty())
    omissions.emplace_back(
        "light groups: vertices have the light of all lamps as they were baked; where a lamp is switched, dimmed or "
        "moved, surfaces show the lightmap");
  return r;
}

}  // namespace oriel
