#include "bake/visibility/eye_cells.h"

#include "bake/jobs/parallel.h"
#include "bake/trace/sampler.h"

namespace oriel {
namespace {

constexpr float kFromWall_m = 0.01f;                           // an eye stays so far from what ends its way
constexpr std::uint64_t kCellStream = std::uint64_t{1} << 62;  // of random numbers, apart from those of texels

// The eye, or where the way to it ends.
Vec3 reached(const Accel& accel, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const float length = glm::length(way);
  if (!(length > 0)) return from;
  const Hit hit = accel.intersect({from, way / length, length + kFromWall_m});
  return hit ? from + way * (std::max(hit.distance - kFromWall_m, 0.0f) / length) : to;
}

}  // namespace

Result<std::vector<CellOfEyes>> eyes_by_cell(const Accel& accel, std::span<const WalkGrid> grids, std::uint32_t side,
                                             std::uint32_t count, Context& context) {
  const EyeCells numbered = number_eye_cells(grids, side);
  struct Standing {
    Vec3 eye;
    float cell_m;
  };
  std::vector<std::vector<Standing>> standing(numbered.count);
  for (std::size_t g = 0; g < grids.size(); ++g)
    for (std::size_t c = 0; c < grids[g].floor_y.size(); ++c)
      if (const std::int32_t cell = numbered.of_walk_cell[g][c]; cell >= 0)
        standing[static_cast<std::size_t>(cell)].push_back({grids[g].eye(c), grids[g].cell_m});
  std::vector<CellOfEyes> cells(numbered.count);
  ORIEL_TRY_VOID(parallel_for(context, "", cells.size(), [&](std::size_t i) {
    CellOfEyes& cell = cells[i];
    cell.lower = cell.upper = standing[i].front().eye;
    for (const Standing& s : standing[i]) {
      cell.lower = glm::min(cell.lower, s.eye - Vec3(1.5f * s.cell_m, kEyeBelow_m, 1.5f * s.cell_m));
      cell.upper = glm::max(cell.upper, s.eye + Vec3(1.5f * s.cell_m, kEyeAbove_m, 1.5f * s.cell_m));
    }
    for (std::uint32_t e = 0; e < count; ++e) {
      Sampler sampler(context.seed, kCellStream + i, e);
      const auto& s = standing[i][std::min(
          static_cast<std::size_t>(sampler.next1() * static_cast<float>(standing[i].size())), standing[i].size() - 1)];
      // Every fourth may stand beside.
      const Vec2 aside = (2.0f * sampler.next2() - 1.0f) * (e % 4 == 3 ? 1.5f : 0.5f) * s.cell_m;
      const float up = glm::mix(-kEyeBelow_m, kEyeAbove_m, sampler.next1());
      cell.eyes.push_back(reached(accel, s.eye, s.eye + Vec3(aside.x, up, aside.y)));
    }
  }));
  return cells;
}

}  // namespace oriel
