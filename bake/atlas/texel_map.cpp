#include "bake/atlas/texel_map.h"

#include <algorithm>
#include <cmath>

#include "bake/atlas/polygon.h"
#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr std::uint32_t kBandRows = 16;
constexpr double kLeastArea = 1e-12;  // the weight of a fragment without area: it counts only among its like

struct Entry {
  std::uint32_t x = 0;
  TexelFragment fragment;
};

// Rows [first, end) of a page, and what lies in them.
struct Band {
  std::uint32_t page = 0, first_row = 0, end_row = 0;
  std::vector<std::uint32_t> triangles;  // ascending
  std::vector<std::vector<Entry>> rows;  // in order of (x, triangle)
};

// The columns that lie wholly inside the triangle, given its part between y = row and row + 1: its sides are convex
// functions of y, so they reach furthest inwards on one of the two lines. Empty where it does not touch both lines.
Interval inner_columns(const ConvexPolygon& part, double row) {
  Interval inner{1, 0};
  for (int side = 0; side < 2; ++side) {
    bool any = false;
    Interval line;
    for (int i = 0; i < part.count; ++i) {
      const DVec2& p = part.at(i);
      if (p.y != row + side) continue;
      line = any ? Interval{std::min(line.lo, p.x), std::max(line.hi, p.x)} : Interval{p.x, p.x};
      any = true;
    }
    if (!any) return {1, 0};
    inner = side == 0 ? line : Interval{std::max(inner.lo, line.lo), std::min(inner.hi, line.hi)};
  }
  return inner;
}

// The part of a triangle that lies in a row of its page.
struct RowPart {
  std::uint32_t triangle = 0;
  int row = 0;
  const ConvexPolygon& polygon;
};

// wanted: of the page's texels; others are left out. Null: all.
void add_row(const RowPart& in, std::uint32_t width, const std::vector<bool>* wanted, std::vector<Entry>& out) {
  const auto& [triangle, row, part] = in;
  const Interval x = extent(part, 0), inner = inner_columns(part, row);
  const CellRange columns = touched_cells(x.lo, x.hi, static_cast<int>(width));
  for (int column = columns.first; column <= columns.last; ++column) {
    if (wanted && !(*wanted)[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)]) continue;
    double covered = 1;
    if (!(column >= inner.lo && column + 1 <= inner.hi)) {
      const ConvexPolygon piece = clip_axis(clip_axis(part, 0, column, 1), 0, column + 1, -1);
      covered = std::clamp(area(piece), kLeastArea, 1.0);
    }
    out.push_back({static_cast<std::uint32_t>(column), {triangle, static_cast<float>(covered)}});
  }
}

void fill_band(const Atlas& atlas, const WantedTexels& mask, Band& band) {
  const AtlasPage& page = atlas.pages[band.page];
  band.rows.resize(band.end_row - band.first_row);
  for (const std::uint32_t t : band.triangles) {
    const Triangle2 triangle = texel_triangle(atlas, t);
    const int first = static_cast<int>(band.first_row), end = static_cast<int>(band.end_row);
    for_each_row_between(triangle, static_cast<int>(page.height), {first, end - 1},
                         [&](int row, const ConvexPolygon& part) {
                           add_row({t, row, part}, page.width, mask.empty() ? nullptr : &mask[band.page],
                                   band.rows[static_cast<std::size_t>(row - first)]);
                         });
  }
  for (auto& row : band.rows) {
    std::stable_sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.x < b.x; });
    row.shrink_to_fit();
  }
}

std::vector<Band> make_bands(const Atlas& atlas) {
  std::vector<Band> bands;
  std::vector<std::size_t> first_band;
  for (std::uint32_t p = 0; p < atlas.pages.size(); ++p) {
    first_band.push_back(bands.size());
    for (std::uint32_t row = 0; row < atlas.pages[p].height; row += kBandRows)
      bands.push_back({p, row, std::min(row + kBandRows, atlas.pages[p].height), {}, {}});
  }
  for (std::uint32_t t = 0; t < atlas.page.size(); ++t) {
    if (atlas.page[t] < 0) continue;
    const auto p = static_cast<std::size_t>(atlas.page[t]);
    const Interval y = extent(ConvexPolygon(texel_triangle(atlas, t)), 1);
    const CellRange rows = touched_cells(y.lo, y.hi, static_cast<int>(atlas.pages[p].height));
    for (std::size_t b = rows.first / kBandRows; b <= rows.last / kBandRows; ++b)
      bands[first_band[p] + b].triangles.push_back(t);
  }
  return bands;
}

void append_band(Band& band, TexelMapPage& page) {
  for (std::size_t r = 0; r < band.rows.size(); ++r) {
    const std::uint32_t row_start = static_cast<std::uint32_t>(band.first_row + r) * page.width;
    for (const Entry& entry : band.rows[r]) {
      const std::uint32_t texel = row_start + entry.x;
      if (page.texel.empty() || page.texel.back() != texel) {
        page.texel.push_back(texel);
        page.first.push_back(static_cast<std::uint32_t>(page.fragments.size()));
      }
      page.fragments.push_back(entry.fragment);
    }
  }
  band = {};
}

// Area-preserving, little distorted: Heitz 2019, "A Low-Distortion Map Between Triangle and Square". Weights of the
// second and third corner.
DVec2 square_to_triangle(double x, double y) {
  if (y > x) {
    x *= 0.5;
    y -= x;
  } else {
    y *= 0.5;
    x -= y;
  }
  return {x, y};
}

// Picks an index by weights(i) >= 0, i < count, and leaves in u what remains of it, again in [0, 1).
template <class Weights>
std::size_t pick(std::size_t count, const Weights& weights, double& u) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += weights(i);
  double target = u * sum;
  std::size_t i = 0;
  while (i + 1 < count && target >= weights(i)) target -= weights(i++);
  const double weight = weights(i);
  u = weight > 0 ? std::clamp(target / weight, 0.0, 1 - 0x1p-53) : 0;
  return i;
}

// Uniform in a convex polygon: one triangle of a fan around its first corner, then a point of that.
DVec2 sample_polygon(const ConvexPolygon& polygon, const DVec2& u, double pick_u) {
  const auto twice_area = [&](std::size_t i) {
    const int k = static_cast<int>(i);
    return std::abs(cross2(polygon.at(k + 1) - polygon.at(0), polygon.at(k + 2) - polygon.at(0)));
  };
  const int fan = static_cast<int>(pick(static_cast<std::size_t>(polygon.count - 2), twice_area, pick_u));
  const DVec2 w = square_to_triangle(u.x, u.y);
  return polygon.at(0) + (polygon.at(fan + 1) - polygon.at(0)) * w.x + (polygon.at(fan + 2) - polygon.at(0)) * w.y;
}

DVec2 inside(DVec2 w) {
  w = glm::clamp(w, DVec2(0), DVec2(1));
  const double sum = w.x + w.y;
  return sum > 1 ? w / sum : w;
}

// A triangle that is a line (or a point) on the page: a point of it across the middle, where its line lies in the cell.
DVec2 sample_line(const Triangle2& t, const DVec2& cell, const DVec2& u) {
  std::size_t a = 0;  // the corner at which the longest side begins
  double longest = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    const DVec2 side = t[(i + 1) % 3] - t[i];
    if (glm::dot(side, side) > longest) longest = glm::dot(side, side), a = i;
  }
  const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
  if (!(longest > 0)) return square_to_triangle(u.x, u.y);
  const DVec2 side = t[b] - t[a];
  double lo = 0, hi = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (side[axis] == 0) continue;
    const double s0 = (cell[axis] - t[a][axis]) / side[axis], s1 = (cell[axis] + 1 - t[a][axis]) / side[axis];
    lo = std::max(lo, std::min(s0, s1)), hi = std::min(hi, std::max(s0, s1));
  }
  if (lo > hi) lo = hi = std::clamp(0.5 * (lo + hi), 0.0, 1.0);
  const double s = lo + (hi - lo) * u.x;                                              // along the longest side
  const double corner = std::clamp(glm::dot(t[c] - t[a], side) / longest, 0.0, 1.0);  // where the third corner stands
  const double height = s < corner ? s / corner : (corner < 1 ? (1 - s) / (1 - corner) : 1);
  DVec3 weight(0);
  const double up = u.y * height;  // towards the third corner
  weight[static_cast<int>(c)] = up;
  weight[static_cast<int>(b)] = std::max(0.0, s - up * corner);
  weight[static_cast<int>(a)] = std::max(0.0, 1 - up - weight[static_cast<int>(b)]);
  return {weight.y, weight.z};
}

DVec2 sample_fragment(const Triangle2& texels, const DVec2& cell, bool whole, const DVec2& u, double pick_u) {
  // Relative to the texel: differences of small numbers, wherever on the page it lies.
  const Triangle2 t{texels[0] - cell, texels[1] - cell, texels[2] - cell};
  const DVec2 e = t[1] - t[0], f = t[2] - t[0], g = t[2] - t[1];
  const double det = cross2(e, f), longest = std::max({glm::dot(e, e), glm::dot(f, f), glm::dot(g, g)});
  if (!(std::abs(det) > 1e-9 * longest)) return sample_line(t, DVec2(0), u);
  DVec2 p = u;
  if (!whole) {
    const ConvexPolygon part = clip_to_cell(t, 0, 0);
    if (part.count < 3 || !(area(part) > 0)) return sample_line(t, DVec2(0), u);
    p = sample_polygon(part, u, pick_u);
  }
  return {cross2(p - t[0], f) / det, cross2(e, p - t[0]) / det};
}

}  // namespace

float covered_share(const TexelMapPage& page, std::size_t i) {
  float sum = 0;
  for (std::uint32_t f = page.first[i]; f < page.first[i + 1]; ++f) sum += page.fragments[f].area;
  return std::min(sum, 1.0f);
}

std::array<DVec2, 3> texel_triangle(const Atlas& atlas, std::uint32_t triangle) {
  const AtlasPage& page = atlas.pages[static_cast<std::size_t>(atlas.page[triangle])];
  const DVec2 size(page.width, page.height);
  const auto& uv = atlas.uv[triangle];
  return {DVec2(uv[0]) * size, DVec2(uv[1]) * size, DVec2(uv[2]) * size};
}

Result<std::vector<TexelMapPage>> build_texel_map(const Atlas& atlas, Context& context, const WantedTexels& wanted) {
  std::vector<Band> bands = make_bands(atlas);
  ORIEL_TRY_VOID(
      parallel_for(context, "texels", bands.size(), [&](std::size_t b) { fill_band(atlas, wanted, bands[b]); }));
  std::vector<TexelMapPage> pages(atlas.pages.size());
  for (std::size_t p = 0; p < pages.size(); ++p)
    pages[p].width = atlas.pages[p].width, pages[p].height = atlas.pages[p].height;
  for (Band& band : bands) append_band(band, pages[band.page]);
  for (TexelMapPage& page : pages) page.first.push_back(static_cast<std::uint32_t>(page.fragments.size()));
  return pages;
}

TexelPoint sample_texel(const Atlas& atlas, const TexelMapPage& page, std::size_t i, const Vec3& u) {
  const std::uint32_t begin = page.first[i], count = page.first[i + 1] - begin;
  double pick_u = u.z;
  std::size_t chosen = 0;
  if (count > 1)
    chosen = pick(
        count, [&](std::size_t k) { return static_cast<double>(page.fragments[begin + k].area); }, pick_u);
  const TexelFragment& fragment = page.fragments[begin + chosen];
  const DVec2 cell(page.texel[i] % page.width, page.texel[i] / page.width);
  const DVec2 w = sample_fragment(texel_triangle(atlas, fragment.triangle), cell, fragment.area == 1, DVec2(u), pick_u);
  return {fragment.triangle, Vec2(inside(w))};
}

double texel_area_m2(const Scene& scene, const Atlas& atlas, const TexelMapPage& map, std::size_t i) {
  double area = 0;
  for (std::uint32_t f = map.first[i]; f < map.first[i + 1]; ++f) {
    const TexelFragment& fragment = map.fragments[f];
    const auto& uv = atlas.uv[fragment.triangle];
    const DVec2 size(map.width, map.height);
    const DVec2 a = DVec2(uv[1] - uv[0]) * size, b = DVec2(uv[2] - uv[0]) * size;
    const double texels = 0.5 * std::abs(a.x * b.y - a.y * b.x);
    if (texels > 0) area += std::min(1.0, fragment.area / texels) * triangle_area(scene, fragment.triangle);
  }
  return area;
}

}  // namespace oriel
