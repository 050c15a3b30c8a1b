#include "player/images/sharp_texels.h"

#include <algorithm>

#include "formats/core/parallel.h"
#include "formats/query/sharp_light.h"

namespace oriel {
namespace {

Vec3 share_of(const Vec3& now, const Vec3& once, const Vec3& elsewhere) {
  Vec3 share = elsewhere;
  for (int c = 0; c < 3; ++c)
    if (once[c] > 0) share[c] = now[c] / once[c];
  return share;
}

}  // namespace

std::vector<Vec3> sharp_at_points(const SharpLight& light, const LightmapPage& page, std::span<const PagePoint> points,
                                  std::span<const Vec3> factors) {
  if (page.sharp_at.empty()) return {};
  std::vector<Vec3> out(points.size());
  const Vec2 size(page.width, page.height);
  for_each_run(points.size(), core_count(), [&](std::size_t first, std::size_t end) {
    for (std::size_t k = first; k < end; ++k)
      out[k] =
          sharp_irradiance(light, page, {(points[k].at + 0.5f) / size, points[k].position, points[k].normal}, factors);
  });
  return out;
}

std::vector<Vec3> sharp_texels(const SharpLight& light, const Mesh& mesh, std::uint32_t number,
                               const LightmapPage& page, std::span<const Vec3> factors) {
  std::vector<Vec3> out = page.sharp;
  if (out.empty()) return out;
  std::vector<PagePoint> points = page_points(mesh, {}, number, page);
  points.erase(std::ranges::lower_bound(points, out.size(), {}, &PagePoint::index), points.end());
  const std::vector<Vec3> once = sharp_at_points(light, page, points, {});
  const std::vector<Vec3> now = sharp_at_points(light, page, points, factors);
  Vec3 all_once(0), all_now(0);
  for (std::size_t k = 0; k < points.size(); ++k) all_once += once[k], all_now += now[k];
  const Vec3 whole = share_of(all_now, all_once, Vec3(1));
  std::vector<Vec3> shares(out.size(), whole);
  for (std::size_t k = 0; k < points.size(); ++k) shares[points[k].index] = share_of(now[k], once[k], whole);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] *= shares[i];
  return out;
}

}  // namespace oriel
