#include "player/scene/fewer_triangles.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <map>

namespace oriel {
namespace {

constexpr std::size_t kFewest = 64;  // triangles that are not worth simplifying
constexpr float kFewer = 0.5f;       // of the triangles, from level to level
constexpr float kStalls = 0.85f;     // of them left: borders and seams hold the rest
constexpr float kMostError = 0.25f;  // of the piece's size

using Triangle = std::array<std::uint32_t, 3>;

// The same for a triangle whichever corner comes first.
Triangle turned(const std::uint32_t* corners) {
  Triangle t{corners[0], corners[1], corners[2]};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

// A piece's triangles over vertices of its own, which the simplifier looks at all of.
struct Local {
  std::vector<std::uint32_t> indices, vertices;
  std::vector<Vec3> positions;
};

Local localize(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  Local out;
  out.vertices = triangles;
  std::sort(out.vertices.begin(), out.vertices.end());
  out.vertices.erase(std::unique(out.vertices.begin(), out.vertices.end()), out.vertices.end());
  for (const std::uint32_t v : out.vertices) out.positions.push_back(mesh.positions[v]);
  for (const std::uint32_t v : triangles)
    out.indices.push_back(static_cast<std::uint32_t>(std::lower_bound(out.vertices.begin(), out.vertices.end(), v) -
                                                     out.vertices.begin()));
  return out;
}

float distance_to(const Bounds& bounds, const Vec3& point) {
  return glm::distance(point, glm::clamp(point, bounds.lower, bounds.upper));
}

}  // namespace

FewerTriangles::FewerTriangles(const Mesh& mesh, std::span<const DrawRange> ranges,
                               std::span<const std::uint32_t> indices, const DrawnAgain& again)
    : curved_count_(again.curved.size()) {
  const std::size_t kKept = again.curved.size();
  std::map<Triangle, std::size_t> owners;
  for (std::size_t c = 0; c < again.curved.size(); ++c)
    for (std::size_t i = 0; i + 2 < again.curved[c].size(); i += 3) owners[turned(&again.curved[c][i])] = c;
  for (std::size_t i = 0; i + 2 < again.kept.size(); i += 3) owners[turned(&again.kept[i])] = kKept;

  for (const DrawRange& range : ranges) {
    std::map<std::size_t, std::vector<std::uint32_t>> owned;  // kNone is the last
    for (std::uint32_t i = 0; i < range.index_count; i += 3) {
      const std::uint32_t* corners = &indices[range.first_index + i];
      const auto owner = owners.find(turned(corners));
      auto& list = owned[owner == owners.end() ? kNone : owner->second];
      list.insert(list.end(), corners, corners + 3);
    }
    for (const auto& [owner, triangles] : owned)
      add(mesh, range, owner < kKept ? owner : kNone, owner == kKept, triangles);
  }
}

void FewerTriangles::add(const Mesh& mesh, const DrawRange& range, std::size_t curved, bool kept,
                         const std::vector<std::uint32_t>& triangles) {
  Piece piece{range, curved, {}};
  piece.range.bounds = {};
  for (const std::uint32_t v : triangles) piece.range.bounds.extend(mesh.positions[v]);
  const auto append = [&](const auto& level, float error_m) {
    piece.levels.push_back(
        {static_cast<std::uint32_t>(indices_.size()), static_cast<std::uint32_t>(level.size()), error_m});
    indices_.insert(indices_.end(), level.begin(), level.end());
  };
  append(triangles, 0);
  if (!kept && triangles.size() > 3 * kFewest) {
    Local local = localize(mesh, triangles);
    const float* positions = &local.positions[0].x;
    const float size = meshopt_simplifyScale(positions, local.positions.size(), sizeof(Vec3));
    float error_m = 0;
    std::vector<std::uint32_t> level(local.indices.size());
    while (local.indices.size() > 3 * kFewest) {
      float error = 0;
      level.resize(local.indices.size());
      const auto target = static_cast<std::size_t>(kFewer * static_cast<float>(local.indices.size() / 3)) * 3;
      level.resize(meshopt_simplify(level.data(), local.indices.data(), local.indices.size(), positions,
                                    local.positions.size(), sizeof(Vec3), target, kMostError,
                                    meshopt_SimplifyLockBorder, &error));
      if (static_cast<float>(level.size()) > kStalls * static_cast<float>(local.indices.size())) break;
      error_m += error * size;  // each level is told of the one before
      local.indices = level;
      for (std::uint32_t& v : level) v = local.vertices[v];
      append(level, error_m);
    }
  }
  pieces_.push_back(std::move(piece));
}

void FewerTriangles::follow(std::span<const Bounds> moved) {
  for (Piece& piece : pieces_)
    if (const Bounds& bounds = moved[piece.range.material]; !bounds.empty())
      piece.range.bounds = bounds, piece.range.group = DrawRange::kNoGroup;
}

FewerTriangles::Chosen FewerTriangles::choose(const View& view, float pixels) const {
  Chosen out;
  out.curved.resize(curved_count_);
  const float pixel = 2 * view.tangents.y / static_cast<float>(view.height);  // metres, or radians
  for (const Piece& piece : pieces_) {
    const float away = view.orthographic ? 1.0f : distance_to(piece.range.bounds, Vec3(view.eye));
    const Level* level = &piece.levels[0];
    for (const Level& fewer : piece.levels)
      if (fewer.error_m <= pixels * pixel * away) level = &fewer;
    DrawRange range = piece.range;
    range.first_index = level->first_index, range.index_count = level->index_count;
    if (range.index_count == 0) continue;
    out.ranges.push_back(range);
    if (piece.curved != kNone) out.curved[piece.curved].push_back(range);
  }
  return out;
}

}  // namespace oriel
