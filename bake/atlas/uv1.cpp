#include "bake/atlas/uv1.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>

#include "bake/atlas/layout.h"
#include "bake/jobs/parallel.h"
#include "bake/jobs/warning_group.h"

namespace oriel {
namespace {

constexpr double kSlack = 1e-6;
constexpr double kThinTexels = 1e-3;  // what rounding of float coordinates may do between neighbours
constexpr double kOverlapTexels2 = 1e-4;
constexpr double kNegligibleShare = 1e-6;  // of a surface's area may lie in triangles without area on the page
constexpr double kLineRatio = 1e-9;        // twice the area over the longest side squared: a line
constexpr int kMostMargin = 8;             // texels: the third mip mixes what is so near
constexpr int kMarginPage = 512;           // texels a side, on which charts are looked at for how near they lie
constexpr double kTooSmall = 8;            // times smaller than the others' in each direction: a mistake of scale

std::string name_of(const Surface& surface) {
  if (surface.mesh_name.empty()) return fmt::format("'{}'", surface.name);
  return fmt::format("'{}' (mesh '{}')", surface.name, surface.mesh_name);
}

Triangle2 uv1_of(const Scene& scene, std::uint32_t triangle, double scale = 1) {
  const UVec3& v = scene.triangles[triangle];
  return {scale * DVec2(scene.uv1[v.x]), scale * DVec2(scene.uv1[v.y]), scale * DVec2(scene.uv1[v.z])};
}

// What TEXCOORD_1 of a surface is, at a glance.
struct Extent {
  double world_m2 = 0, uv_area = 0;
  DVec2 lower{1e300}, upper{-1e300};

  double metres() const { return std::sqrt(world_m2 / uv_area); }  // a unit
  double side() const { return std::max(upper.x - lower.x, upper.y - lower.y); }
  bool in_page() const {
    return lower.x >= -kSlack && lower.y >= -kSlack && upper.x <= 1 + kSlack && upper.y <= 1 + kSlack;
  }
};

const Extent kUnitSquare{.lower = DVec2(0), .upper = DVec2(1)};

Extent extent_of(const Scene& scene, const Surface& surface) {
  Extent e;
  for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
    const Triangle2 uv = uv1_of(scene, t);
    e.world_m2 += triangle_area(scene, t);
    e.uv_area += std::abs(signed_area(uv));
    for (const DVec2& p : uv) e.lower = glm::min(e.lower, p), e.upper = glm::max(e.upper, p);
  }
  return e;
}

bool has_area(const Triangle2& t) {
  const double longest = std::max(
      {glm::dot(t[1] - t[0], t[1] - t[0]), glm::dot(t[2] - t[1], t[2] - t[1]), glm::dot(t[0] - t[2], t[0] - t[2])});
  return 2 * std::abs(signed_area(t)) > kLineRatio * longest;
}

// For each triangle of the surface which of its parts it belongs to that hang together in position and coordinates,
// counted from 0 in the order of their first triangles.
std::vector<std::uint32_t> islands_of(const Scene& scene, const Surface& surface) {
  std::vector<std::uint32_t> order(surface.vertex_count), parent(surface.vertex_count);
  std::iota(order.begin(), order.end(), 0u);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = scene.positions[surface.first_vertex + v];
    const Vec2& uv = scene.uv1[surface.first_vertex + v];
    return std::array<float, 5>{p.x, p.y, p.z, uv.x, uv.y};
  };
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  };
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1])) join(order[i], order[i - 1]);
  for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
    const UVec3 v = scene.triangles[surface.first_triangle + t] - UVec3(surface.first_vertex);
    join(v.x, v.y), join(v.x, v.z);
  }
  std::vector<std::uint32_t> id(surface.vertex_count, ~0u), island(surface.triangle_count);
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
    std::uint32_t& own = id[root(scene.triangles[surface.first_triangle + t].x - surface.first_vertex)];
    if (own == ~0u) own = count++;
    island[t] = own;
  }
  return island;
}

// The charts of a page as texels, by number; -1: none.
class ChartGrid {
 public:
  ChartGrid(double texels_a_unit, const Extent& extent)
      : scale_(texels_a_unit),
        lower_(extent.lower),
        size_((extent.upper - extent.lower) * texels_a_unit + 1.0),
        chart_(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y), -1) {}

  struct Gap {
    int texels = 0;  // between the two, Chebyshev's distance
    DVec2 uv{0};
  };
  using Gaps = std::map<std::pair<int, int>, Gap>;  // by the numbers of two charts

  void draw(const Triangle2& uv, int chart) {
    const Triangle2 t{(uv[0] - lower_) * scale_, (uv[1] - lower_) * scale_, (uv[2] - lower_) * scale_};
    for_each_row(t, size_.y, [&](int row, const ConvexPolygon& part) {
      const Interval x = extent(part, 0);
      const CellRange columns = touched_cells(x.lo, x.hi, size_.x);
      for (int column = columns.first; column <= columns.last; ++column) {
        int& texel = at(column, row);
        if (texel >= 0 && texel != chart) note(texel, chart, 0, column, row);
        texel = chart;
      }
    });
  }

  // Pairs that have been drawn nearer together than so many texels.
  Gaps nearer_than(int texels) {
    for (int row = 0; row < size_.y; ++row)
      for (int column = 0; column < size_.x; ++column)
        for (int dy = 0; at(column, row) >= 0 && dy <= std::min(texels, size_.y - 1 - row); ++dy)
          for (int dx = dy == 0 ? 1 : std::max(-texels, -column); dx <= std::min(texels, size_.x - 1 - column); ++dx)
            if (const int other = at(column + dx, row + dy); other >= 0 && other != at(column, row))
              note(at(column, row), other, std::max(std::abs(dx), dy) - 1, column, row);
    return std::move(gaps_);
  }

 private:
  int& at(int column, int row) {
    return chart_[static_cast<std::size_t>(row) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(column)];
  }
  void note(int a, int b, int texels, int column, int row) {
    const Gap gap{texels, lower_ + DVec2(column, row) / scale_};
    const auto [known, added] = gaps_.try_emplace(std::minmax(a, b), gap);
    if (!added && gap.texels < known->second.texels) known->second = gap;
  }

  double scale_;
  DVec2 lower_;
  glm::ivec2 size_;
  std::vector<int> chart_;
  Gaps gaps_;
};

class Checker {
 public:
  Checker(const Scene& scene, const AtlasOptions& options, Context& context)
      : scene_(scene),
        options_(options),
        context_(context),
        faulty_(context, "surfaces without usable TEXCOORD_1; charts are made for them", "uv1-faulty"),
        moved_(context, "findings in TEXCOORD_1 that packing mends", "uv1-moved") {}

  Uv1Check run(const std::vector<std::uint32_t>& surfaces) {
    for (const std::uint32_t s : surfaces) {
      const Surface& surface = scene_.surfaces[s];
      const Extent extent = surface.has_uv1 ? extent_of(scene_, surface) : Extent{};
      const std::string fault = surface.has_uv1 ? fault_of(surface, extent) : "has no TEXCOORD_1";
      if (!fault.empty()) faulty_.add(fmt::format("{}: {}; charts are made for it", name_of(surface), fault));
      (fault.empty() ? out_.own : out_.faulty).push_back(s);
      if (fault.empty()) extents_.push_back(extent);
    }
    if (options_.resolution > 0) out_.one_page = make_one_page();
    if (!out_.one_page) check_scales();
    check_margins();
    faulty_.finish();
    moved_.finish();
    return std::move(out_);
  }

 private:
  double texels_a_unit(const Extent& extent) const {
    return options_.resolution > 0 ? options_.resolution : extent.metres() / static_cast<double>(options_.texel_m);
  }

  OverlapTolerance tolerance(const Extent& extent, double scale) const {
    const double largest = std::max({1.0, glm::length(extent.lower), glm::length(extent.upper)});
    return {kOverlapTexels2, std::max(kThinTexels, scale * largest * 0x1p-22)};  // coordinates near 1 step by 2^-24
  }

  // Why the coordinates of one surface cannot be taken; empty: they can.
  std::string fault_of(const Surface& surface, const Extent& extent) {
    double lost = 0;
    std::uint32_t count = 0;
    for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t)
      if (!has_area(uv1_of(scene_, t))) lost += triangle_area(scene_, t), ++count;
    if (lost > kNegligibleShare * extent.world_m2 || !(extent.uv_area > 0))
      return fmt::format("{} of {} triangles ({:.3g} m²) have no area in TEXCOORD_1", count, surface.triangle_count,
                         lost);
    if (count > 0)
      context_.warning("missing-texcoords",
                       fmt::format("{}: {} slivers ({:.3g} m²) have no area in TEXCOORD_1; they show the nearest texel",
                                   name_of(surface), count, lost));
    const double scale = texels_a_unit(extent);
    std::vector<Triangle2> points;
    for (std::uint32_t t = 0; t < surface.triangle_count; ++t)
      points.push_back(uv1_of(scene_, surface.first_triangle + t, scale));
    const auto found = find_overlap(points, tolerance(extent, scale));
    if (!found) return {};
    return fmt::format("TEXCOORD_1 overlaps itself, triangles {} and {} at uv ({:.5f}, {:.5f}) by {:.3g} texels²",
                       found->a, found->b, found->where.x / scale, found->where.y / scale, found->area);
  }

  bool make_one_page() {
    std::vector<Triangle2> points;
    std::vector<std::uint32_t> owner;
    for (std::size_t i = 0; i < out_.own.size(); ++i) {
      const Surface& surface = scene_.surfaces[out_.own[i]];
      if (!extents_[i].in_page())
        return packed(fmt::format("{}: TEXCOORD_1 spans ({:.3g}, {:.3g}) to ({:.3g}, {:.3g}), more than [0, 1]",
                                  name_of(surface), extents_[i].lower.x, extents_[i].lower.y, extents_[i].upper.x,
                                  extents_[i].upper.y));
      for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
        points.push_back(uv1_of(scene_, surface.first_triangle + t, options_.resolution));
        owner.push_back(out_.own[i]);
      }
    }
    const auto found = find_overlap(points, tolerance(kUnitSquare, options_.resolution));
    if (!found) return true;
    const DVec2 uv = found->where / static_cast<double>(options_.resolution);
    return packed(fmt::format("{}: TEXCOORD_1 overlaps that of {} at uv ({:.5f}, {:.5f})",
                              name_of(scene_.surfaces[owner[found->a]]), name_of(scene_.surfaces[owner[found->b]]),
                              uv.x, uv.y));
  }

  bool packed(const std::string& why) {
    moved_.add(why + ": no page for all as they are; each surface's charts are packed into one");
    return false;
  }

  // Where every mesh owns 0 to 1 they differ in metres a unit, where all share a page in what they fill of it. What is
  // far off by both is a mistake.
  void check_scales() {
    std::vector<double> metres, fill;
    for (const Extent& e : extents_) metres.push_back(e.metres()), fill.push_back(e.side());
    const auto middle = [](std::vector<double> of) {
      if (of.empty()) return 0.0;
      std::ranges::nth_element(of, of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2));
      return of[of.size() / 2];
    };
    const double most_metres = kTooSmall * middle(metres), usual = middle(fill);
    for (std::size_t i = 0; i < extents_.size(); ++i)
      if (metres[i] > most_metres && fill[i] * kTooSmall < usual)
        moved_.add(
            fmt::format("{}: TEXCOORD_1 could be {:.0f} times larger within 0 to 1, as that of other surfaces is; its "
                        "charts get texels as theirs",
                        name_of(scene_.surfaces[out_.own[i]]), 1 / fill[i]));
  }

  // Charts so near together that filters mix them, on the one page that all share; else those that touch on what would
  // be a page of each surface.
  void check_margins() {
    std::vector<std::string> found(out_.one_page ? 1 : out_.own.size());
    // Stopped: the atlas tells.
    (void)parallel_for(context_, "", found.size(), [&](std::size_t i) {
      found[i] = out_.one_page ? margins(out_.own, kUnitSquare) : margins({&out_.own[i], 1}, extents_[i]);
    });
    for (const std::string& text : found)
      if (!text.empty()) moved_.add(text);
  }

  std::string margins(std::span<const std::uint32_t> surfaces, const Extent& extent) const {
    const int side = out_.one_page ? std::min(options_.resolution, options_.max_page) : kMarginPage;
    std::vector<std::string> first;  // of each chart: its surface and first triangle
    std::vector<std::pair<std::uint32_t, int>> charted;
    for (const std::uint32_t s : surfaces) {
      const Surface& surface = scene_.surfaces[s];
      const auto charts = static_cast<std::uint32_t>(first.size());
      const std::vector<std::uint32_t> island = islands_of(scene_, surface);
      for (std::uint32_t t = 0; t < surface.triangle_count; ++t) {
        if (charts + island[t] == first.size())
          first.push_back(surfaces.size() > 1 ? fmt::format("{} of '{}'", t, surface.name) : fmt::format("{}", t));
        charted.emplace_back(surface.first_triangle + t, static_cast<int>(charts + island[t]));
      }
    }
    if (first.size() < 2) return {};
    ChartGrid grid(side / extent.side(), extent);
    for (const auto& [triangle, chart] : charted) grid.draw(uv1_of(scene_, triangle), chart);
    const int wanted = out_.one_page ? std::min(options_.padding, kMostMargin) : 1;
    std::string pairs;
    std::size_t said = 0;
    for (const auto& [charts, gap] : grid.nearer_than(wanted))
      if (++said <= WarningGroup::kLimit)
        pairs +=
            fmt::format("{}{} and {} at uv ({:.3f}, {:.3f}) by {}, mixed from mip {}", pairs.empty() ? "" : "; ",
                        first[static_cast<std::size_t>(charts.first)], first[static_cast<std::size_t>(charts.second)],
                        gap.uv.x, gap.uv.y, gap.texels, std::bit_width(static_cast<unsigned>(gap.texels) / 2));
    if (said == 0) return {};
    if (said > WarningGroup::kLimit) pairs += fmt::format("; {} more pairs", said - WarningGroup::kLimit);
    const std::string near = out_.one_page ? fmt::format("lie nearer together than {} texels", wanted) : "touch";
    return fmt::format("{}: charts {} on a page of {}², by their first triangles: {}{}",
                       surfaces.size() > 1 ? "TEXCOORD_1" : name_of(scene_.surfaces[surfaces[0]]), near, side, pairs,
                       out_.one_page ? "" : fmt::format(". They are packed {} apart", options_.padding));
  }

  const Scene& scene_;
  const AtlasOptions& options_;
  Context& context_;
  WarningGroup faulty_, moved_;
  Uv1Check out_;
  std::vector<Extent> extents_;  // of out_.own
};

}  // namespace

Uv1Check check_uv1(const Scene& scene, const std::vector<std::uint32_t>& surfaces, const AtlasOptions& options,
                   Context& context) {
  return Checker(scene, options, context).run(surfaces);
}

ChartSet own_charts(const Scene& scene, const Surface& surface) {
  const std::vector<std::uint32_t> island = islands_of(scene, surface);
  const Extent extent = extent_of(scene, surface);
  ChartSet set;
  set.one_texel = true;
  set.texel_m = static_cast<double>(surface.texel_m);
  std::vector<std::uint32_t> order(island.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return island[t]; });
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && island[order[end]] == island[order[first]]) ++end;
    DVec2 lower(1e300), upper(-1e300);
    for (std::size_t i = first; i < end; ++i) {
      set.triangles.push_back(surface.first_triangle + order[i]);
      set.points.push_back(uv1_of(scene, set.triangles.back(), extent.metres()));
      for (const DVec2& p : set.points.back()) lower = glm::min(lower, p), upper = glm::max(upper, p);
    }
    const DVec2 size = upper - lower;
    const bool high = size.y > size.x;
    for (std::size_t i = first; i < end; ++i)
      for (DVec2& p : set.points[i]) p = high ? DVec2(p.y - lower.y, upper.x - p.x) : p - lower;
    set.charts.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first),
                          high ? DVec2(size.y, size.x) : size});
  }
  return set;
}

void place_uv1(const Scene& scene, const std::vector<std::uint32_t>& surfaces, Atlas& atlas) {
  StretchSum stretch;
  for (const std::uint32_t s : surfaces) {
    const Surface& surface = scene.surfaces[s];
    const std::vector<std::uint32_t> island = islands_of(scene, surface);
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) {
      const std::uint32_t t = surface.first_triangle + i;
      atlas.page[t] = 0;
      atlas.chart[t] = atlas.chart_count + island[i];
      for (int k = 0; k < 3; ++k)
        atlas.uv[t][static_cast<std::size_t>(k)] = glm::clamp(scene.uv1[scene.triangles[t][k]], Vec2(0), Vec2(1));
      stretch.add(triangle_corners(scene, t), uv1_of(scene, t));
    }
    atlas.chart_count += island.empty() ? 0 : *std::ranges::max_element(island) + 1;
  }
  report_stretch(stretch, atlas.report);
}

}  // namespace oriel
