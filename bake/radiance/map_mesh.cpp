#include "bake/radiance/map_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <unordered_map>

#include "bake/radiance/quadtree.h"
#include "formats/assets/fields.h"

namespace oriel {
namespace {

constexpr int kSmoothings = 8;
constexpr float kStraightened = 0.5f;  // pixels: most that a vertex of an edge moves
constexpr float kTucked = 0.5f;        // pixels by which a surface goes on behind a nearer one

// Vertices on the edge of what is connected, with the two beside them along it: where just one edge passes.
class Outlines {
 public:
  explicit Outlines(const GridMesh& mesh)
      : before_(mesh.positions.size(), kNone), after_(before_), edges_(before_.size()) {
    std::unordered_map<std::uint64_t, int> sides;
    sides.reserve(mesh.indices.size());
    const auto each = [&](const auto& take) {
      for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        take(mesh.indices[i], mesh.indices[next]);
      }
    };
    each([&](std::uint32_t a, std::uint32_t b) { ++sides[key(a, b)]; });
    each([&](std::uint32_t a, std::uint32_t b) {
      if (sides[key(a, b)] != 1) return;
      after_[a] = b, before_[b] = a;
      ++edges_[a], ++edges_[b];
    });
  }
  bool passes(std::size_t v) const { return edges_[v] == 2 && before_[v] != kNone && after_[v] != kNone; }
  std::uint32_t before(std::size_t v) const { return before_[v]; }
  std::uint32_t after(std::size_t v) const { return after_[v]; }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32u | std::max(a, b);
  }
  std::vector<std::uint32_t> before_, after_, edges_;
};

// Steps of pixels become the lines that they stand for. What ends at something nearer goes on behind it a little, so
// that from beside the map's eye no gap opens along a silhouette.
void straighten(const IVec2& size, GridMesh& mesh) {
  const Outlines outlines(mesh);
  std::vector<Vec2> at(mesh.positions.begin(), mesh.positions.end()), next = at;
  const Vec2 end(size);
  for (int round = 0; round < kSmoothings; ++round) {
    for (std::size_t v = 0; v < at.size(); ++v) {
      const Vec2 own(mesh.positions[v]);
      const bool on_frame = own.x <= 0 || own.y <= 0 || own.x >= end.x || own.y >= end.y;
      if (on_frame || !outlines.passes(v)) continue;
      const Vec2 middle = 0.25f * (at[outlines.before(v)] + at[outlines.after(v)]) + 0.5f * at[v];
      next[v] = own + glm::clamp(middle - own, Vec2(-kStraightened), Vec2(kStraightened));
    }
    std::swap(at, next);
    next = at;
  }
  const float most = static_cast<float>(std::max(size.x, size.y));
  for (std::size_t v = 0; v < at.size(); ++v) {
    const Vec2 own(mesh.positions[v]);
    const bool on_frame = own.x <= 0 || own.y <= 0 || own.x >= end.x || own.y >= end.y;
    if (mesh.behind[v] == 0 || on_frame || !outlines.passes(v)) continue;
    const Vec2 along = at[outlines.after(v)] - at[outlines.before(v)];  // the surface lies to the left
    if (glm::length(along) > 0) next[v] = at[v] + kTucked * glm::normalize(Vec2(along.y, -along.x));
  }
  at = next;
  for (std::size_t v = 0; v < at.size(); ++v) {
    Vec3& p = mesh.positions[v];
    p.z = std::clamp(p.z + glm::dot(mesh.slopes[v], at[v] - Vec2(p)), 0.0f, most);
    p.x = at[v].x, p.y = at[v].y;
  }
}

void simplify(float error, GridMesh& mesh) {
  if (mesh.indices.empty()) return;
  const float* const positions = &mesh.positions[0].x;
  const std::size_t count = mesh.positions.size();
  const float scale = meshopt_simplifyScale(positions, count, sizeof(Vec3));
  std::vector<std::uint32_t> kept(mesh.indices.size());
  kept.resize(meshopt_simplify(kept.data(), mesh.indices.data(), mesh.indices.size(), positions, count, sizeof(Vec3), 0,
                               error / scale, 0, nullptr));
  mesh.indices.resize(kept.size());
  meshopt_optimizeVertexCache(mesh.indices.data(), kept.data(), kept.size(), count);
}

// Vertices in the order in which triangles use them, without those that none does.
MapMesh gathered(const GridMesh& mesh, const IVec2& size) {
  MapMesh out;
  std::vector<std::uint32_t> number(mesh.positions.size(), ~0u);
  const Vec3 scale = 1.0f / Vec3(Vec2(size), std::max(size.x, size.y));
  for (const std::uint32_t v : mesh.indices) {
    if (number[v] == ~0u) {
      number[v] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(glm::clamp(mesh.positions[v] * scale, Vec3(0), Vec3(1)));
    }
    out.indices.push_back(number[v]);
  }
  return out;
}

}  // namespace

MapMesh mesh_of(std::span<const PixelPlane> planes, const IVec2& size, const MeshOptions& options) {
  GridMesh mesh = mesh_squares(SurfaceGrid(planes, size));
  straighten(size, mesh);
  simplify(options.error, mesh);
  return gathered(mesh, size);
}

Result<std::vector<MapMesh>> mesh_maps(const ReflectedSurroundings& surroundings, std::span<const RadianceMap> maps,
                                       const MeshOptions& options, Context& context) {
  std::vector<MapMesh> meshes(maps.size());
  UnitLoop loop{.stage = "map meshes", .count = maps.size(), .rays = 1 << 17};
  loop.inputs = [&](std::size_t i, Archive& key) {
    key(frame_of(maps[i]), hash_of(maps[i].disparity, maps[i].valid), options.error);
  };
  loop.compute = [&](std::size_t i) {
    const IVec2 size(static_cast<int>(maps[i].width), static_cast<int>(maps[i].height));
    meshes[i] = mesh_of(find_planes(surroundings, maps[i]), size, options);
    return std::uint64_t{maps[i].disparity.size()};
  };
  loop.results = [&](std::size_t i, Archive& archive) { archive(meshes[i].vertices, meshes[i].indices); };
  ORIEL_TRY_VOID(parallel_units(context, loop));
  return meshes;
}

}  // namespace oriel
