#include "bake/radiosity/texels/nearest.h"

#include "formats/core/position_hash.h"

namespace oriel {
namespace {

constexpr float kFirstCell = 2;  // sides of a texel, of the cells of space in which one is looked for first
constexpr int kDoublings = 40;   // of that side: from millimetres to more than a scene

// The cell of a texel's place, and the side of a box that it faces as its digits behind the point.
Vec3 cell_of(const SamplePoint& at, float side, bool facing) {
  const Vec3 size = glm::abs(at.geometric_normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  Vec3 cell = glm::floor(at.origin / side);
  if (facing) cell[axis] += at.geometric_normal[axis] < 0 ? 0.25f : 0.5f;
  return cell;
}

}  // namespace

void leave_out(std::span<const std::uint32_t> unfinished, Texels& texels) {
  if (unfinished.empty()) return;
  if (texels.nearest.empty()) {
    texels.nearest.resize(texels.count());
    for (std::uint32_t i = 0; i < texels.count(); ++i) texels.nearest[i] = i;
  }
  for (const std::uint32_t i : unfinished) texels.visible[i] = 0, texels.nearest[i] = kNoTexel;
  std::vector<std::uint32_t> lit, pending;
  double area = 0;
  for (std::uint32_t i = 0; i < texels.count(); ++i)
    if (const std::uint32_t of = texels.nearest[i]; of != i && (of == kNoTexel || texels.nearest[of] != of))
      pending.push_back(i);
    else if (texels.visible[i] > 0)
      lit.push_back(i), area += texels.area_m2[i];
  for (const std::uint32_t i : pending) texels.nearest[i] = kNoTexel;
  if (lit.empty()) return;
  float side = kFirstCell * static_cast<float>(std::sqrt(area / static_cast<double>(lit.size())));
  std::unordered_map<Vec3, std::uint32_t, PositionHash> in_cell;
  for (int k = 0; k < kDoublings && !pending.empty() && side > 0; ++k, side *= 2) {
    const bool facing = k + 1 < kDoublings;
    in_cell.clear();
    for (const std::uint32_t i : lit) {
      std::uint32_t& largest = in_cell.try_emplace(cell_of(texels.sample_points[i][0], side, facing), i).first->second;
      if (texels.area_m2[i] > texels.area_m2[largest]) largest = i;
    }
    std::erase_if(pending, [&](std::uint32_t i) {
      const auto found = in_cell.find(cell_of(texels.sample_points[i][0], side, facing));
      if (found == in_cell.end()) return false;
      // A wall does not show the light of a screw, nor that of a shade a centimetre from its lamp.
      if (k < kDoublings / 5 && texels.area_m2[found->second] < 0.5f * texels.area_m2[i]) return false;
      texels.nearest[i] = found->second;
      return true;
    });
  }
}

}  // namespace oriel
