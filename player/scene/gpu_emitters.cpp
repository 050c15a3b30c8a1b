#include "player/scene/gpu_emitters.h"

#include <algorithm>
#include <array>

#include "formats/query/clipped_polygon.h"

namespace oriel {
namespace {

using Texel = std::array<std::uint8_t, 4>;

// Four corners each: a quad that the plane cuts may have five, which make two.
std::vector<std::array<Vec3, 4>> before_plane(const Emitter& emitter, const Mat4& reflector_from_pack, float size) {
  ClippedPolygon polygon;
  for (const Vec3& corner : emitter.corners)
    polygon.v[polygon.count++] = Vec3(reflector_from_pack * Vec4(corner, 1)) / size;
  polygon = clip(polygon, Vec3(0, 0, 1));
  const auto& v = polygon.v;
  std::vector<std::array<Vec3, 4>> out;
  if (polygon.count >= 3) out.push_back({v[0], v[1], v[2], v[std::min(polygon.count - 1, 3)]});
  if (polygon.count == 5) out.push_back({v[0], v[3], v[4], v[4]});
  return out;
}

// The corners' shares of an emitter, cell by cell.
std::vector<Texel> cells_of(const ListedEmitters& listed, std::size_t emitter) {
  const std::size_t width = listed.visibility_x, height = listed.visibility_y;
  const std::uint8_t* const nodes = listed.visibility.data() + emitter * width * height;
  std::vector<Texel> cells;
  for (std::size_t y = 0; y + 1 < height; ++y)
    for (std::size_t x = 0; x + 1 < width; ++x) {
      const std::uint8_t* const node = nodes + y * width + x;
      cells.push_back({node[0], node[1], node[width], node[width + 1]});
    }
  return cells;
}

}  // namespace

GpuEmitters upload_emitters(const Pack& pack, const ListedEmitters& listed, const Mat4& reflector_from_pack,
                            float size) {
  static_assert(2 * kMaxReflectorEmitters <= 128);  // polygons, a bit each
  GpuEmitters out;
  if (listed.emitters.empty() || !(size > 0)) return out;
  out.cells_x = static_cast<int>(listed.visibility_x) - 1;
  out.cells_y = static_cast<int>(listed.visibility_y) - 1;
  std::vector<Vec4> polygons;
  std::vector<Texel> visibility;
  std::vector<std::array<std::uint32_t, 4>> seen(static_cast<std::size_t>(out.cells_x) *
                                                 static_cast<std::size_t>(out.cells_y));
  for (std::size_t e = 0; e < listed.emitters.size(); ++e) {
    const Emitter& emitter = pack.emitters[listed.emitters[e]];
    const std::vector<Texel> cells = cells_of(listed, e);
    for (const std::array<Vec3, 4>& v : before_plane(emitter, reflector_from_pack, size)) {
      const std::size_t polygon = polygons.size() / 4;
      const std::uint32_t bit = 1u << polygon % 32;
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i] != Texel{}) seen[i][polygon / 32] |= bit;
      const auto number = static_cast<float>(e + 1);
      polygons.insert(polygons.end(), {Vec4(v[0], v[1].x), Vec4(v[1].y, v[1].z, v[2].x, v[2].y), Vec4(v[2].z, v[3]),
                                       Vec4(emitter.radiance, emitter.two_sided ? -number : number)});
    }
    visibility.insert(visibility.end(), cells.begin(), cells.end());
  }
  if (polygons.empty()) return out;
  const auto count = static_cast<int>(listed.emitters.size());
  out.polygons = {gpu::kRgba32f, 4, static_cast<int>(polygons.size() / 4), polygons.data()};
  out.visibility = {gpu::kRgba8, out.cells_x, out.cells_y * count, visibility.data()};
  out.seen = {gpu::kRgba32ui, out.cells_x, out.cells_y, seen.data()};
  return out;
}

}  // namespace oriel
