// The covered texels of all pages as one list: sample points, and properties that a ray hit looks up.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "bake/radiosity/texels/diffuse_share.h"
#include "bake/radiosity/texels/lightmap_scene.h"
#include "bake/radiosity/texels/reach.h"
#include "bake/radiosity/texels/texel_part.h"
#include "bake/trace/polygon_light.h"

namespace oriel {

inline constexpr std::uint32_t kNoTexel = std::numeric_limits<std::uint32_t>::max();

// A sample point of a texel. Rays start at `origin`, which is offset from the surface. Normals are unit vectors.
struct SamplePoint {
  Vec3 origin{0};
  Vec3 normal{0, 0, 1};            // interpolated, for shading
  Vec3 geometric_normal{0, 0, 1};  // of the real surface
  float rounded = 0;               // height_of_rounded(), m

  Receiver receiver() const { return {origin, normal, geometric_normal, rounded}; }
};

inline void fields(Archive& archive, SamplePoint& point) {
  archive(point.origin, point.normal, point.geometric_normal, point.rounded);
}

// Every estimate has two independent halves, with separate points and directions: their difference measures the error.
inline constexpr int kHalves = 2;
inline constexpr int kSamplePointsPerHalf = 4;
inline constexpr int kSamplePoints = kHalves * kSamplePointsPerHalf;

struct Texels {
  // Arrays by texel.
  std::vector<std::uint32_t> page, index;  // into the texel map: page, and TexelMapPage::texel[index]
  std::vector<std::uint32_t> x, y;         // on the page
  std::vector<std::uint32_t> chart;        // of Atlas
  // At [half * kSamplePointsPerHalf + k]: not buried, stratified over the texel.
  std::vector<std::array<SamplePoint, kSamplePoints>> sample_points;
  // More sample points, by half, of occlusion-heavy texels: those partly hidden, or with an occluder closer than their
  // side. Light varies more over them.
  std::unordered_map<std::uint32_t, std::array<std::vector<SamplePoint>, kHalves>> extra_points;
  std::vector<char> occlusion_heavy;  // true if the texel is in extra_points
  std::vector<char> meets_gap;        // true if a lamp hangs over part of it, or part of it lies in a hidden gap
  std::vector<float> visible;         // fraction neither inside other geometry nor in a gap; 0: no sample point
  std::vector<float> covered;         // fraction with a surface
  std::vector<Reach> reach;
  std::vector<float> area_m2;
  std::vector<Vec3> albedo;  // diffuse, mean over the texel
  std::vector<DiffuseShare> diffuse_share;

  // The texel itself, or where there was no time for its light the near one that stands in (nearest.h); kNoTexel: there
  // is none. Empty: all have their own.
  std::vector<std::uint32_t> nearest;
  std::uint32_t shown_by(std::uint32_t i) const { return nearest.empty() ? i : nearest[i]; }

  std::vector<Vec3> eyes;  // view positions that decide visibility; none: all is visible (trace/view_samples.h)

  std::size_t count() const { return page.size(); }
  std::vector<bool> has_light() const {
    std::vector<bool> has;
    for (const float share : visible) has.push_back(share > 0);
    return has;
  }
  // The distance to the first hit below which a point counts as in a gap, m.
  float gap_reach(std::size_t i) const {
    return std::min(kGapReach_m, kGapTexels * std::sqrt(area_m2[i] / std::max(covered[i], 0.1f)));
  }
  float visible_fraction(std::size_t i) const { return covered[i] * visible[i]; }  // of the square
  // A point of the texel's surface, from the texel's middle, in texels of the page.
  Vec2 offset(std::size_t i, std::uint32_t triangle, const Vec2& barycentric) const {
    return placement[triangle].at(barycentric) - Vec2(x[i], y[i]) - 0.5f;
  }

  std::uint32_t sample_point_count(std::uint32_t i, int half) const {
    return occlusion_heavy[i] ? static_cast<std::uint32_t>(extra_points.at(i)[half].size()) : kSamplePointsPerHalf;
  }
  // The k-th stored sample point of a half, modulo their number. The texel must be visible.
  const SamplePoint& sample_point(std::uint32_t i, int half, std::uint32_t k) const {
    if (!occlusion_heavy[i]) return sample_points[i][half * kSamplePointsPerHalf + k % kSamplePointsPerHalf];
    const std::vector<SamplePoint>& points = extra_points.at(i)[half];
    return points[k % points.size()];
  }

  std::unordered_map<std::uint32_t, TexelPart> cut;  // texels divided by a wall
  std::vector<char> is_cut;                          // true if the texel is in `cut`

  // The texel whose light applies at a point of a triangle: the texel under it, or a neighbour where a wall or a lamp
  // separates that one from the point. kNoTexel where the triangle has no lightmap or both are separated.
  std::uint32_t find(std::uint32_t triangle, const Vec2& barycentric) const {
    return place(triangle, barycentric).texel;
  }
  // in_lit_gap: the point lies under a lamp and `texel` is the one next to the gap. Its light ends within centimetres,
  // which no texel resolves.
  struct Place {
    std::uint32_t texel = kNoTexel;
    bool in_lit_gap = false;
    std::uint32_t lies_on = kNoTexel;  // the texel under the point, walls ignored

    // True where no texel holds the point's light: a path must evaluate it.
    bool is_unevaluated() const { return in_lit_gap || (texel == kNoTexel && lies_on != kNoTexel); }
  };
  Place place(std::uint32_t triangle, const Vec2& barycentric) const;
  // The neighbour that holds the light under the lamp, for a texel whose part has_lamp().
  std::uint32_t under_lamp(std::uint32_t texel) const { return chart_neighbour(texel, cut.at(texel).towards_lamp()); }
  // Texel density of a triangle, texels per m²; 0 where it has no area or no page.
  float texels2_per_m2(const Scene& scene, std::uint32_t triangle) const;
  // True if the texels around a place of a page, whole numbers at their centres, are there, whole, and near no
  // occluder.
  bool open_around(std::uint32_t page_number, const Vec2& at_place) const;
  // True if a wall separates that point from the texel under it.
  bool parts(std::uint32_t triangle, const Vec2& barycentric) const;
  // The texel at a pixel of a page; kNoTexel without one.
  std::uint32_t at(std::uint32_t page_number, int px, int py) const;

  struct Page {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> number;  // by y * width + x; empty for a sparse page, which has instead
    std::vector<std::uint32_t> place;   // y * width + x of each texel, ascending,
    std::uint32_t first = 0;            // and the number of the first
  };
  std::vector<Page> pages;
  struct Placement {  // of a triangle on its page, in texels
    Vec2 corner{0}, edge1{0}, edge2{0};
    std::int32_t page = -1;

    Vec2 at(const Vec2& barycentric) const { return corner + barycentric.x * edge1 + barycentric.y * edge2; }
  };
  std::vector<Placement> placement;

 private:
  Place place_of_own_light(std::uint32_t triangle, const Vec2& barycentric) const;
  // The texel a step away in the same chart, or else the texel itself.
  std::uint32_t chart_neighbour(std::uint32_t texel, const IVec2& step) const;
  std::uint32_t across_wall(std::uint32_t texel, std::uint32_t triangle, const Vec2& barycentric, const Vec2& p) const;
};

// Options of list_texels().
struct TexelUse {
  std::span<const Vec3> eyes{};  // view positions: a gap into which none of them sees is hidden. None: no gap is
  // For the points of finer cells, `side` of which are a texel's side long: the texels themselves. No ray hits points,
  // so albedo and diffuse_share are not filled. A point between texels that are open has no test of its own.
  const Texels* coarse = nullptr;
  std::uint32_t side = 1;
  std::uint32_t point_divisor = 1;  // divides the number of points tried in partly hidden texels
  // That it may take. Where it would take longer, fewer points are tried; texels that are not done by then are left out
  // (nearest.h).
  double seconds = std::numeric_limits<double>::infinity();
};
// Lists the texels of all pages in the order of the texel map, with their sample points and visibility. Error kStopped.
Result<Texels> list_texels(const LightmapScene& scene, const Stage& stage, TexelUse use = {});

}  // namespace oriel
