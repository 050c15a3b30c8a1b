#include "formats/query/page_points.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace oriel {
namespace {

constexpr float kTexelReach = 0.75f, kDetailReach = 1.5f;  // texels from a chart that its light is still wanted at
constexpr float kInside = 0.01f;  // of the way to the triangle's middle: off the edge that it shares with a wall

struct Nearest {
  float distance2 = std::numeric_limits<float>::infinity();
  std::uint32_t part = 0, first_index = 0;
  Vec2 at{0};     // shares of the second and third corner
  Vec2 texel{0};  // that it is the nearest to
};

float cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}

// The place in a flat triangle nearest to p.
Nearest nearest_in(const std::array<Vec2, 3>& corners, const Vec2& p) {
  const Vec2 ab = corners[1] - corners[0], ac = corners[2] - corners[0], to = p - corners[0];
  const float area = cross(ab, ac);
  Nearest out;
  if (area != 0) {
    const Vec2 at(cross(to, ac) / area, cross(ab, to) / area);
    if (at.x >= 0 && at.y >= 0 && at.x + at.y <= 1) return {0, 0, 0, at, p};
  }
  constexpr std::array<Vec2, 3> kAt{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};
  for (std::size_t e = 0; e < 3; ++e) {
    const Vec2 a = corners[e], side = corners[(e + 1) % 3] - a;
    const float length2 = glm::dot(side, side);
    const float along = length2 > 0 ? std::clamp(glm::dot(p - a, side) / length2, 0.0f, 1.0f) : 0.0f;
    const Vec2 off = p - a - along * side;
    if (const float d2 = glm::dot(off, off); d2 < out.distance2)
      out = {d2, 0, 0, glm::mix(kAt[e], kAt[(e + 1) % 3], along), p};
  }
  return out;
}

// By texel, then by point of details.
class Search {
 public:
  Search(const LightmapPage& page) : page_(page), found_(page.irradiance.size() + page.detail.size()) {}

  // corners: in texels, (0, 0) the centre of the first.
  void add(const std::array<Vec2, 3>& corners, std::uint32_t part, std::uint32_t first_index) {
    const Vec2 lower = glm::min(corners[0], glm::min(corners[1], corners[2])),
               upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const IVec2 last(static_cast<int>(page_.width) - 1, static_cast<int>(page_.height) - 1);
    const IVec2 from = glm::clamp(IVec2(glm::floor(lower - 2.0f)), IVec2(0), last),
                to = glm::clamp(IVec2(glm::ceil(upper + 1.0f)), IVec2(0), last);
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) {
        const std::size_t texel = static_cast<std::size_t>(y) * page_.width + static_cast<std::size_t>(x);
        offer(texel, Vec2(x, y), corners, {part, first_index});
        if (page_.cell.empty() || page_.cell[texel] == 0) continue;
        const DetailBlock block = DetailBlock::of(page_.cell[texel]);
        for (std::uint32_t j = 0; j <= block.side(); ++j)
          for (std::uint32_t i = 0; i <= block.side(); ++i)
            offer(page_.irradiance.size() + std::size_t{block.y + j} * page_.detail_width + block.x + i,
                  Vec2(x, y) + Vec2(i, j) / static_cast<float>(block.side()), corners, {part, first_index});
      }
  }
  const std::vector<Nearest>& found() const { return found_; }

 private:
  void offer(std::size_t index, const Vec2& p, const std::array<Vec2, 3>& corners,
             std::pair<std::uint32_t, std::uint32_t> triangle) {
    Nearest& best = found_[index];
    if (best.distance2 == 0) return;
    Nearest here = nearest_in(corners, p);
    std::tie(here.part, here.first_index) = triangle;
    if (here.distance2 < best.distance2) best = here;
  }

  const LightmapPage& page_;
  std::vector<Nearest> found_;
};

PagePoint point_at(const Mesh& mesh, const Nearest& nearest) {
  const std::uint32_t* corners = &mesh.indices[nearest.first_index];
  const Vec2 at = glm::mix(nearest.at, Vec2(1.0f / 3), kInside);
  const auto between = [&](const std::vector<Vec3>& values) {
    return values[corners[0]] * (1 - at.x - at.y) + values[corners[1]] * at.x + values[corners[2]] * at.y;
  };
  return {0,
          nearest.texel,
          between(mesh.positions),
          normalize_or(between(mesh.normals), Vec3(0, 1, 0)),
          nearest.part,
          nearest.first_index,
          at};
}

}  // namespace

std::vector<PagePoint> page_points(const Mesh& mesh, std::span<const std::uint32_t> without, std::uint32_t number,
                                   const LightmapPage& page) {
  Search search(page);
  const Vec2 size(page.width, page.height);
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    if (part.lightmap_page != static_cast<std::int32_t>(number) || std::ranges::find(without, p) != without.end())
      continue;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3) {
      const auto corner = [&](std::uint32_t c) { return mesh.lightmap_uvs[mesh.indices[i + c]] * size - 0.5f; };
      search.add({corner(0), corner(1), corner(2)}, p, i);
    }
  }
  std::vector<PagePoint> points;
  const std::size_t texels = page.irradiance.size();
  for (std::size_t i = 0; i < search.found().size(); ++i) {
    const Nearest& nearest = search.found()[i];
    const float reach = i < texels ? kTexelReach : kDetailReach;
    if (!(nearest.distance2 <= reach * reach) || (i < texels && page.state[i] != TexelState::kValid)) continue;
    points.push_back(point_at(mesh, nearest));
    points.back().index = static_cast<std::uint32_t>(i);
  }
  return points;
}

Vec2 shares_beside(const Mesh& mesh, const PagePoint& point, const Vec2& offset) {
  const auto corner = [&](std::uint32_t c) { return mesh.lightmap_uvs[mesh.indices[point.first_index + c]]; };
  const Vec2 ab = corner(1) - corner(0), ac = corner(2) - corner(0);
  const float area = cross(ab, ac);
  if (area == 0) return point.shares;
  const Vec2 at = point.shares + Vec2(cross(offset, ac), cross(ab, offset)) / area;
  return at.x >= 0 && at.y >= 0 && at.x + at.y <= 1 ? at : point.shares;
}

TexelsAround texels_around(const LightmapPage& page, const PagePoint& point) {
  return texels_around((point.at + 0.5f) / Vec2(page.width, page.height), page.width, page.height);
}

void fill_from_neighbours(const LightmapPage& page, std::vector<std::uint8_t>& known, std::span<Vec3> values) {
  const int width = static_cast<int>(page.width), height = static_cast<int>(page.height);
  std::vector<std::uint32_t> pending;
  for (std::uint32_t i = 0; i < page.state.size(); ++i)
    if (known[i] == 0 && page.state[i] != TexelState::kEmpty && page.state[i] != TexelState::kValid)
      pending.push_back(i);
  while (!pending.empty()) {
    std::vector<std::uint32_t> left, filled;
    for (const std::uint32_t texel : pending) {
      const int x = static_cast<int>(texel) % width, y = static_cast<int>(texel) / width;
      Vec3 sum(0);
      float count = 0;
      for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, height - 1); ++ny)
        for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, width - 1); ++nx) {
          const auto n = static_cast<std::size_t>(ny) * page.width + static_cast<std::size_t>(nx);
          if (known[n] == 1) sum += values[n], count += 1;
        }
      if (count > 0) values[texel] = sum / count;
      (count > 0 ? filled : left).push_back(texel);
    }
    if (filled.empty()) return;
    for (const std::uint32_t texel : filled) known[texel] = 1;
    pending = std::move(left);
  }
}

}  // namespace oriel
