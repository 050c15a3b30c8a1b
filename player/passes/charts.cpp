#include "player/passes/charts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

struct Corner {
  std::int32_t page;
  std::uint32_t u, v;  // bits
  bool operator==(const Corner&) const = default;
};
struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    std::uint64_t h = std::uint64_t{c.u} << 32 | c.v;
    h = (h ^ static_cast<std::uint64_t>(c.page)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(h ^ h >> 29);
  }
};

// Whether a triangle and the square of a texel have a point in common, by separating axes. corners: in texels.
bool touches(const std::array<Vec2, 3>& corners, const Vec2& texel) {
  const Vec2 centre = texel + 0.5f;
  for (int i = 0; i < 3; ++i) {
    const Vec2 edge = corners[(i + 1) % 3] - corners[i];
    const Vec2 normal(-edge.y, edge.x);
    const float reach = 0.5f * (std::fabs(normal.x) + std::fabs(normal.y));
    const float along = glm::dot(normal, corners[i] - centre), apex = glm::dot(normal, corners[(i + 2) % 3] - centre);
    if (std::min(along, apex) > reach || std::max(along, apex) < -reach) return false;
  }
  return true;  // the caller goes through the box around the triangle: the square's own axes
}

template <class Take>
void touched_texels(std::array<Vec2, 3> corners, const IVec2& size, const Take& take) {
  for (Vec2& c : corners) c = glm::clamp(c, Vec2(0), Vec2(1)) * Vec2(size);
  const Vec2 lower = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const Vec2 upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
  const IVec2 first(glm::floor(lower)), last = glm::min(IVec2(glm::floor(upper)), size - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (touches(corners, Vec2(x, y)))
        take(static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x));
}

}  // namespace

std::vector<std::uint32_t> charts_of(const Mesh& mesh) {
  const std::size_t triangles = mesh.indices.size() / 3;
  std::vector<std::uint32_t> chart(triangles, kNoChart);
  DisjointSets joined(triangles);
  std::unordered_map<Corner, std::uint32_t, CornerHash> first;
  for (const MeshPart& part : mesh.parts) {
    if (part.lightmap_page < 0) continue;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      const Vec2 uv = mesh.lightmap_uvs[mesh.indices[i]];
      chart[i / 3] = 0;
      const Corner corner{part.lightmap_page, std::bit_cast<std::uint32_t>(uv.x), std::bit_cast<std::uint32_t>(uv.y)};
      joined.join(i / 3, first.try_emplace(corner, i / 3).first->second);
    }
  }
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t t = 0; t < triangles; ++t)
    if (chart[t] != kNoChart)
      chart[t] = number.try_emplace(joined.root(t), static_cast<std::uint32_t>(number.size())).first->second;
  return chart;
}

Vec3 chart_color(std::uint32_t chart) {
  // Hues by the golden ratio, in three lightnesses.
  const float hue = glm::fract(static_cast<float>(chart % 100003) * 0.61803399f) * 6;
  const float high = chart % 3 == 0 ? 0.95f : chart % 3 == 1 ? 0.75f : 0.55f, low = 0.3f * high;
  const auto channel = [&](float at) {
    const float d = std::fabs(std::remainder(hue - at, 6.0f));
    return glm::mix(low, high, glm::clamp(2 - d, 0.0f, 1.0f));
  };
  return {channel(0), channel(2), channel(4)};
}

// take(page, texel, chart) for all texels that a triangle touches.
template <class Take>
static void each_touched(const Pack& pack, const Take& take) {
  const Mesh& mesh = pack.mesh;
  const std::vector<std::uint32_t> charts = charts_of(mesh);
  for (const MeshPart& part : mesh.parts) {
    if (part.lightmap_page < 0) continue;
    const auto p = static_cast<std::size_t>(part.lightmap_page);
    const IVec2 size(pack.lightmaps[p].width, pack.lightmaps[p].height);
    for (std::uint32_t i = part.first_index; i + 2 < part.first_index + part.index_count; i += 3) {
      std::array<Vec2, 3> corners;
      for (std::uint32_t c = 0; c < 3; ++c) corners[c] = mesh.lightmap_uvs[mesh.indices[i + c]];
      touched_texels(corners, size, [&](std::size_t texel) { take(p, texel, charts[i / 3]); });
    }
  }
}

std::vector<std::vector<std::uint8_t>> chart_colors(const Pack& pack) {
  std::vector<std::vector<std::uint8_t>> out;
  for (const LightmapPage& page : pack.lightmaps) {
    out.emplace_back(4 * std::size_t{page.width} * page.height, std::uint8_t{0});
    for (std::size_t i = 3; i < out.back().size(); i += 4) out.back()[i] = 255;
  }
  each_touched(pack, [&](std::size_t page, std::size_t texel, std::uint32_t chart) {
    const Vec3 color = chart_color(chart) * 255.0f + 0.5f;
    for (int c = 0; c < 3; ++c)
      out[page][4 * texel + static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(color[c]);
  });
  return out;
}

}  // namespace oriel
