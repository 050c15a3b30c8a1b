#include "bake/radiosity/texels/texel_part.h"

#include <algorithm>
#include <array>

#include "bake/radiosity/texels/seeds.h"
#include "bake/trace/buried.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr float kPartLift = 0.1f;  // of a texel's side
constexpr float kFarEnd = 1.45f;   // steps to the far end of the neighbour: the wall between the two may stand on it
constexpr std::uint32_t kSkyRays = 16;  // that test for the sky
constexpr std::uint32_t kPoints = 32;   // by which the sides of a wall are compared

// The corners of a texel in the plane of its largest fragment, in turn; nothing where that has no area on the page.
std::optional<std::array<Vec3, 4>> corners_of(const Scene& scene, const PageTexel& place) {
  const auto& [atlas, map, texel] = place;
  const auto fragments = std::span(map.fragments).subspan(map.first[texel], map.first[texel + 1] - map.first[texel]);
  const std::uint32_t triangle =
      std::max_element(fragments.begin(), fragments.end(), [](const TexelFragment& a, const TexelFragment& b) {
        return a.area < b.area;
      })->triangle;
  const auto placed = texel_triangle(atlas, triangle);
  const DVec2 a(placed[0]), u = DVec2(placed[1]) - a, v = DVec2(placed[2]) - a;
  const double area = u.x * v.y - u.y * v.x;
  if (area == 0) return std::nullopt;
  const DVec2 lower(map.texel[texel] % map.width, map.texel[texel] / map.width);
  std::array<Vec3, 4> corners;
  for (int k = 0; k < 4; ++k) {
    const DVec2 p = lower + DVec2(k == 1 || k == 2, k >= 2) - a;
    corners[k] = point_on(scene, triangle, Vec2(DVec2(p.x * v.y - p.y * v.x, u.x * p.y - u.y * p.x) / area));
    if (!is_finite(corners[k])) return std::nullopt;
  }
  return corners;
}

}  // namespace

TexelPart::TexelPart(const Transport& transport, const PageTexel& place, const ViewSamples& views, std::uint64_t& rays)
    : accel_(transport.accel) {
  const Scene& scene = accel_.scene();
  const TexelMapPage& map = place.map;
  const std::size_t texel = place.texel;
  const auto corners = corners_of(scene, place);
  if (!corners) return;
  lift_ = kPartLift * std::sqrt(0.5f * length2((*corners)[2] - (*corners)[0]));
  const auto point = [&](const Vec3& u) {
    const TexelPoint p = sample_texel(place.atlas, map, texel, u);
    return point_on_side(scene, p.triangle, p.barycentric);
  };
  const auto is_covered = [&](SurfacePoint p, std::uint32_t k) {
    p.position = lifted(p);
    return is_buried(transport, p, {~seeds::kWalls, map.texel[texel], k}, rays);
  };
  const SurfacePoint middle = point(Vec3(0.5f));
  if (transport.lights.power() != DVec3(0)) find_lamp(*corners, middle.geometric_normal, rays);
  const Vec3 up = lift_ * middle.geometric_normal;
  if (is_free((*corners)[0] + up, (*corners)[2] + up, rays) && is_free((*corners)[1] + up, (*corners)[3] + up, rays) &&
      !is_covered(middle, kPoints)) {
    if (const auto beyond = visible_beyond(place, {*corners, middle.geometric_normal}, views, rays))
      anchors_ = {*beyond};
    return;
  }
  std::vector<Vec3> left;
  bool any = false;
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    Sampler sampler(seeds::kWalls, map.texel[texel], k);
    const Vec2 uv = sampler.next2();
    const SurfacePoint p = point(Vec3(uv, sampler.next1()));
    if (is_buried(transport, p, {seeds::kWalls, map.texel[texel], k}, rays)) continue;
    any = true;
    if (!is_covered(p, k)) left.push_back(lifted(p));
  }
  covered_ = any && left.empty();
  std::vector<Side> sides;
  while (!left.empty()) sides.push_back(extract_side(left, rays));
  ViewSamples::Nearest eyes;
  for (Side& side : sides)
    for (const Vec3& p : side.points)
      side.seen += sides.size() > 1 && views.any() && views.in_sight(p, middle.geometric_normal, eyes, rays);
  Side best;
  for (Side& side : sides)
    if (side.is_before(best)) best = std::move(side);
  anchors_ = std::move(best.anchors);
}

bool TexelPart::is_under_lamp(const Vec3& p, const Vec3& up, float reach_m, std::uint64_t& rays) const {
  ++rays;
  const Hit hit = accel_.intersect({p + 1e-3f * reach_m * up, up, reach_m});
  return hit && is_lamp(accel_.scene(), hit.triangle, hit.front);
}

std::optional<Vec3> TexelPart::visible_beyond(const PageTexel& place, const Square& square, const ViewSamples& views,
                                              std::uint64_t& rays) const {
  if (!views.any()) return std::nullopt;
  const Atlas& atlas = place.atlas;
  const TexelMapPage& map = place.map;
  const std::size_t texel = place.texel;
  const auto& [corners, normal] = square;
  const Vec3 middle = 0.5f * (corners[0] + corners[2]) + lift_ * normal;
  const Vec3 u = corners[1] - corners[0], v = corners[3] - corners[0];
  const auto chart = [&](std::size_t i) { return atlas.chart[map.fragments[map.first[i]].triangle]; };
  const IVec2 at(map.texel[texel] % map.width, map.texel[texel] / map.width);
  for (const IVec2& step : {IVec2(1, 0), IVec2(-1, 0), IVec2(0, 1), IVec2(0, -1)}) {
    const IVec2 neighbour = at + step;
    if (std::min(neighbour.x, neighbour.y) < 0 || neighbour.x >= static_cast<int>(map.width)) continue;
    const auto number = static_cast<std::uint32_t>(neighbour.y) * map.width + static_cast<std::uint32_t>(neighbour.x);
    const auto found = std::ranges::lower_bound(map.texel, number);
    if (found == map.texel.end() || *found != number) continue;
    if (chart(static_cast<std::size_t>(found - map.texel.begin())) != chart(texel)) continue;
    const Vec3 there = middle + kFarEnd * (static_cast<float>(step.x) * u + static_cast<float>(step.y) * v);
    if (is_free(middle, there, rays) || !views.in_sight_of_any(there, normal, rays)) continue;
    if (views.in_sight_of_any(middle, normal, rays) || !is_outdoors(middle, normal, rays)) return std::nullopt;
    return there;
  }
  return std::nullopt;
}

bool TexelPart::is_outdoors(const Vec3& point, const Vec3& normal, std::uint64_t& rays) const {
  const Mat3 frame = frame_from_normal(normal);
  Sampler sampler(seeds::kWalls, 0, 0);
  std::uint32_t escaped = 0;
  for (std::uint32_t k = 0; k < kSkyRays; ++k) {
    const Vec3 direction = glm::normalize(frame * square_to_cosine_hemisphere(sampler.next2()));
    escaped += !accel_.intersect({point, direction});
  }
  rays += kSkyRays;
  return 4 * escaped >= kSkyRays;
}

// A lamp hangs over part of the texel if it does over some of the corners.
void TexelPart::find_lamp(const std::array<Vec3, 4>& corners, const Vec3& up, std::uint64_t& rays) {
  const Vec3 u = corners[1] - corners[0], v = corners[3] - corners[0];
  const float reach = std::min(kGapReach_m, kGapTexels * std::sqrt(glm::length(glm::cross(u, v))));
  const auto under = [&](const Vec3& p) { return is_under_lamp(p, up, reach, rays); };
  const auto count = std::ranges::count_if(corners, under);
  if (count == 0 || count == 4) return;
  for (const IVec2& step :
       {IVec2(1, 0), IVec2(-1, 0), IVec2(0, 1), IVec2(0, -1), IVec2(1, 1), IVec2(1, -1), IVec2(-1, 1), IVec2(-1, -1)}) {
    const Vec3 off = static_cast<float>(step.x) * u + static_cast<float>(step.y) * v;
    if (!std::ranges::all_of(corners, [&](const Vec3& p) { return under(p + off); })) continue;
    gap_m_ = reach, towards_lamp_ = step;
    return;
  }
}

// Points that see one another, directly or by way of others (around a corner of the wall), stand on one side.
TexelPart::Side TexelPart::extract_side(std::vector<Vec3>& left, std::uint64_t& rays) const {
  Side side;
  std::vector<Vec3> reached{left.back()};
  left.pop_back();
  for (std::size_t k = 0; k < reached.size(); ++k) {
    const Vec3 from = reached[k];
    const auto seen = std::partition(left.begin(), left.end(), [&](const Vec3& p) { return !is_free(from, p, rays); });
    if (k == 0 || seen != left.end()) side.anchors.push_back(from);  // between them, they see the whole side
    reached.insert(reached.end(), seen, left.end());
    left.erase(seen, left.end());
  }
  side.points = std::move(reached);
  return side;
}

bool TexelPart::holds(std::uint32_t triangle, const Vec2& barycentric, std::uint64_t& rays) const {
  if (whole()) return true;
  const SurfacePoint on = point_on_side(accel_.scene(), triangle, barycentric);
  if (gap_m_ > 0 && is_under_lamp(on.position, on.geometric_normal, gap_m_, rays)) return false;
  if (anchors_.empty()) return true;
  const Vec3 point = lifted(on);
  return std::any_of(anchors_.begin(), anchors_.end(), [&](const Vec3& a) { return is_free(a, point, rays); });
}

bool TexelPart::is_visible_from(const Vec3& from, std::uint32_t triangle, const Vec2& barycentric,
                                std::uint64_t& rays) const {
  const SurfacePoint on = point_on_side(accel_.scene(), triangle, barycentric);
  return is_free(from + lift_ * on.geometric_normal, lifted(on), rays);
}

Vec3 TexelPart::lifted(const SurfacePoint& point) const {
  return point.position + lift_ * point.geometric_normal;
}

bool TexelPart::is_free(const Vec3& from, const Vec3& to, std::uint64_t& rays) const {
  const float distance = glm::distance(from, to);
  if (!(distance > 0)) return true;
  ++rays;
  return max_component(accel_.transmittance({from, (to - from) / distance, distance})) > 0;
}

}  // namespace oriel
