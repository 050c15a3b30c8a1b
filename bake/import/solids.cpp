#include "bake/import/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "bake/jobs/warning_group.h"
#include "bake/scene/edges.h"
#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

// Triangles of a shell that hang together. Volume: m³, below 0 where fronts face inwards.
struct Piece {
  double volume = 0, area = 0;
  std::vector<std::array<DVec3, 3>> triangles;
  Vec3 lower{std::numeric_limits<float>::infinity()}, upper{-lower};
  bool encloses(const Piece& other) const {
    return glm::all(glm::lessThanEqual(lower, other.lower)) && glm::all(glm::greaterThanEqual(upper, other.upper)) &&
           winds_around(other.triangles[0][0]);
  }
  // By the solid angle of the triangles (Van Oosterom and Strackee 1983).
  bool winds_around(const DVec3& p) const {
    double angle = 0;
    for (const auto& t : triangles) {
      const DVec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      angle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return angle > 2 * kPiD;  // 4π inside, 0 outside
  }
};

// How many edges have another number of triangles on one side than on the other, and the volume enclosed, m³.
struct Shell {
  std::size_t open_edges = 0;
  double volume = 0;
  std::vector<Piece> pieces;
  bool is_closed() const { return open_edges == 0; }
  bool is_solid() const { return is_closed() && volume > 0; }
  std::string fault() const {
    return is_closed() ? "found its front inwards, expected it outwards"
                       : fmt::format("found {} open edges, expected a closed surface", open_edges);
  }
};

// corners: welded, three a triangle.
std::vector<Piece> pieces_of(std::span<const std::uint32_t> corners, std::span<const Piece> each) {
  DisjointSets sets(corners.size());
  for (std::size_t c = 0; c < corners.size(); ++c) sets.join(corners[c], corners[c / 3 * 3]);
  std::map<std::size_t, Piece> found;
  for (std::size_t t = 0; t < each.size(); ++t) {
    Piece& piece = found[sets.root(corners[3 * t])];
    piece.volume += each[t].volume, piece.area += each[t].area;
    piece.triangles.push_back(each[t].triangles[0]);
    piece.lower = glm::min(piece.lower, each[t].lower), piece.upper = glm::max(piece.upper, each[t].upper);
  }
  std::vector<Piece> pieces;
  for (const auto& [root, piece] : found) pieces.push_back(piece);
  return pieces;
}

Shell shell_of(const Scene& scene, const std::vector<std::uint32_t>& surfaces) {
  std::vector<Vec3> places;  // three a triangle
  std::vector<Piece> each;   // by triangle
  Shell shell;
  for (const std::uint32_t s : surfaces) {
    const Surface& surface = scene.surfaces[s];
    for (const UVec3& t : std::span(scene.triangles).subspan(surface.first_triangle, surface.triangle_count)) {
      Piece& piece = each.emplace_back();
      DVec3 p[3];
      for (int k = 0; k < 3; ++k) {
        p[k] = DVec3(places.emplace_back(scene.positions[t[k]]));
        piece.lower = glm::min(piece.lower, places.back()), piece.upper = glm::max(piece.upper, places.back());
      }
      piece.volume = glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
      piece.triangles = {{p[0], p[1], p[2]}};
      piece.area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2;
      shell.volume += piece.volume;
    }
  }
  const std::vector<std::uint32_t> corners = weld(places);
  for_each_edge(edge_uses(corners), [&](std::span<const EdgeUse> uses) {
    if (2 * std::ranges::count_if(uses, &EdgeUse::forward) != std::ssize(uses)) ++shell.open_edges;
  });
  if (shell.is_closed()) shell.pieces = pieces_of(corners, each);
  return shell;
}

bool may_be_solid(const SceneMaterial& m) {
  return m.alpha_mode == AlphaMode::kOpaque && m.metal == Metal::kNone && !m.unlit;
}

// A surface of solid glass that is taken for a pane, and why; nothing to be told where it is right so.
struct Pane {
  std::string fault;
  float wall_m = 0;  // of glass that is crossed with each of its faces
};

// Closed surfaces of one material and mover: bodies, and the walls of hollows in them.
class Hollows {
 public:
  explicit Hollows(const Scene& scene) : scene_(scene) {}
  void add(std::uint32_t surface, std::span<const Piece> pieces) {
    for (const Piece& piece : pieces) (piece.volume > 0 ? bodies_ : cavities_).push_back({surface, piece});
  }
  // Bodies that are mostly air become panes, with their hollows: bulbs, bottles. Their glass is too thin to bend light
  // that matters, and lamps in them would be found by chance alone. Hollows in other bodies stay walls of solid glass.
  void settle(std::map<std::uint32_t, Pane>& panes) const {
    std::map<std::uint32_t, double> air_in, glass_in, area_of;  // m³, m², by surface
    std::vector<const Part*> around;
    for (const Part& cavity : cavities_) {
      const Part* body = body_around(cavity);
      around.push_back(body);
      if (body != nullptr) air_in[body->surface] -= cavity.piece.volume;
    }
    for (const Part& body : bodies_)
      glass_in[body.surface] += body.piece.volume, area_of[body.surface] += body.piece.area;
    for (std::size_t i = 0; i < cavities_.size(); ++i) {
      const Part* body = around[i];
      const std::uint32_t inner = cavities_[i].surface;
      if (body == nullptr) continue;
      panes.erase(inner);  // it faces inwards as it should
      const double glass = glass_in[body->surface], air = air_in[body->surface];
      if (air < kMostlyAir * glass) continue;
      const double wall = std::max(glass - air, 0.0) / area_of[body->surface];
      panes[body->surface] = panes[inner] = {"", rounded(wall / 2)};
    }
  }

 private:
  struct Part {
    std::uint32_t surface;
    Piece piece;
  };
  // To three digits: a hundred bulbs of one mesh have one material.
  static float rounded(double metres) {
    const double digit = std::pow(10.0, std::floor(std::log10(std::max(metres, 1e-30))) - 2);
    return static_cast<float>(std::round(metres / digit) * digit);
  }

  static constexpr double kMostlyAir = 0.5;  // of the volume within the outer surface

  const Part* body_around(const Part& cavity) const {
    const auto kind = [&](const Part& p) {
      return std::pair(scene_.surfaces[p.surface].material, scene_.surfaces[p.surface].mover);
    };
    const Part* best = nullptr;
    for (const Part& body : bodies_)
      if (kind(body) == kind(cavity) && body.piece.volume > -cavity.piece.volume && body.piece.encloses(cavity.piece) &&
          (best == nullptr || body.piece.volume < best->piece.volume))
        best = &body;
    return best;
  }

  const Scene& scene_;
  std::vector<Part> bodies_, cavities_;
};

// The surfaces that are no solids by themselves or together, and why.
std::map<std::uint32_t, Pane> find_panes(const Scene& scene) {
  std::map<std::pair<std::uint32_t, std::int32_t>, std::vector<std::uint32_t>> open;  // by material and mover
  std::map<std::uint32_t, Pane> panes;
  Hollows hollows(scene);
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const SceneMaterial& m = scene.materials[surface.material];
    if (!m.solid) continue;
    if (!may_be_solid(m)) {
      panes[s] = {"found an alpha mode, a metal or an unlit material, expected opaque glass", m.thickness_m};
      continue;
    }
    const Shell shell = shell_of(scene, {s});
    hollows.add(s, shell.pieces);
    if (shell.is_solid()) continue;
    panes[s] = {shell.fault(), m.thickness_m};
    open[{surface.material, surface.mover}].push_back(s);
  }
  for (const auto& [of, surfaces] : open)
    if (surfaces.size() > 1 && shell_of(scene, surfaces).is_solid())
      for (const std::uint32_t s : surfaces) panes.erase(s);
  hollows.settle(panes);
  return panes;
}

}  // namespace

void find_solids(Scene& scene, Context& context) {
  // Light that enters a body of panes leaves it by their backs.
  for (SceneMaterial& m : scene.materials) m.double_sided = m.double_sided || (m.transmission > 0 && !m.solid);
  if (std::ranges::none_of(scene.materials, [](const SceneMaterial& m) { return m.solid; })) return;
  const auto panes = find_panes(scene);
  std::map<std::pair<std::uint32_t, float>, std::uint32_t> copies;  // by material and wall: the pane
  WarningGroup told(context, "surfaces of solid glass that are taken for thin panes", "thin-glass");
  for (const auto& [s, found] : panes) {
    Surface& surface = scene.surfaces[s];
    const auto [copy, is_new] = copies.try_emplace({surface.material, found.wall_m}, scene.materials.size());
    if (is_new) {
      SceneMaterial pane = scene.materials[surface.material];
      pane.name += " (thin)";
      pane.solid = false, pane.double_sided = true;
      pane.base_color *= glm::exp(-pane.absorption * found.wall_m);
      scene.materials.push_back(std::move(pane));
    }
    if (!found.fault.empty())
      told.add(fmt::format("surface \"{}\" of solid glass: {}: taken for a thin pane", surface.name, found.fault));
    surface.material = copy->second;
  }
  told.finish();
  for (SceneMaterial& m : scene.materials) m.double_sided = m.double_sided && !m.solid;
}

}  // namespace oriel
