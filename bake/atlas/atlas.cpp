#include "bake/atlas/atlas.h"

#include <algorithm>
#include <cmath>

#include "bake/atlas/charts.h"
#include "bake/atlas/skyline.h"
#include "bake/atlas/surface_mesh.h"
#include "bake/atlas/texel_map.h"
#include "bake/atlas/uv1.h"
#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr std::uint32_t kMaxPages = 4096;
constexpr int kMaxSide = 16384;
constexpr double kSnapTexels = 1e-3;  // a chart so little longer than whole texels is fitted into them
constexpr double kLeastTexels =
    0.25;  // a chart is drawn at least so long: thinner, float coordinates would lose its shape

// How a chart's axis is drawn: texel = metres * scale + offset, within a row of `size` texels.
struct Axis {
  std::uint32_t size = 1;
  double scale = 0, offset = 0;
};

// A chart lies in the middle of the whole texels that hold it, so that a border texel is covered for more than half of
// its width, and a wall whose sides are whole texels covers exactly these. `inset` keeps float rounding of page
// coordinates from reaching into the next texel.
Axis fit_axis(double metres, double texel_m, double inset) {
  Axis axis;
  const double texels = metres / texel_m;
  axis.size = static_cast<std::uint32_t>(std::max(1.0, std::ceil(texels - kSnapTexels)));
  const double drawn = std::min(std::max(texels, kLeastTexels), axis.size - 2 * inset);
  axis.scale = metres > 0 ? drawn / metres : 0;
  axis.offset = 0.5 * (axis.size - (metres > 0 ? drawn : 0));
  return axis;
}

// Charts of many surfaces and how large they are drawn.
struct Layout {
  std::vector<ChartSet> sets;
  std::vector<DVec2> sizes;  // metres, of all charts in order of set and chart
  int side = 0;              // of a page
  double inset = 0;

  // The texel of a chart: the asked one, or as much coarser as the page needs.
  double chart_texel(std::size_t chart, double texel_m) const {
    return std::max(texel_m, sizes[chart].x / (side - 2 * inset));  // x is the longer side
  }
  std::vector<PackRect> rects(double texel_m) const {
    std::vector<PackRect> out(sizes.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double texel = chart_texel(i, texel_m);
      out[i].width = fit_axis(sizes[i].x, texel, inset).size;
      out[i].height = fit_axis(sizes[i].y, texel, inset).size;
    }
    return out;
  }
};

double padded_area(const std::vector<PackRect>& rects, std::uint32_t padding) {
  double sum = 0;
  for (const PackRect& r : rects) sum += static_cast<double>(r.width + padding) * (r.height + padding);
  return sum;
}

struct Packing {
  double texel_m = 0;
  std::vector<PackRect> rects;
  std::vector<PackedPage> pages;
};

std::uint32_t round_up_4(std::uint32_t n) {
  return (n + 3) / 4 * 4;
}

Result<Packing> pack_at_texel(const Layout& layout, double texel_m, std::uint32_t padding) {
  Packing out{texel_m, layout.rects(texel_m), {}};
  const auto side = static_cast<std::uint32_t>(layout.side);
  const double room = static_cast<double>(kMaxPages) * (side + padding) * (side + padding);
  if (padded_area(out.rects, padding) <= room) out.pages = pack_compact(out.rects, {side, side, padding, kMaxPages});
  if (out.pages.empty() && !out.rects.empty()) {
    double fits = texel_m * 1.1;
    for (int i = 0; i < 400 && padded_area(layout.rects(fits), padding) > 0.8 * room; ++i) fits *= 1.1;
    return fail(ErrorCode::kRuntime, "atlas",
                "a texel of {:.4g} m needs more than {} pages of {}x{} texels; a texel of {:.3g} m fits", texel_m,
                kMaxPages, side, side, fits);
  }
  for (PackedPage& page : out.pages) page = {round_up_4(page.width), round_up_4(page.height)};
  return out;
}

// The smallest texel (to half a percent) with which all charts fit into one page.
Result<Packing> pack_one_page(const Layout& layout, std::uint32_t padding, const Context& context) {
  const auto side = static_cast<std::uint32_t>(layout.side);
  const PackLimits limits{side, side, padding, 1};
  const double room = static_cast<double>(side + padding) * (side + padding);
  const auto attempt = [&](double texel_m) {
    Packing p{texel_m, layout.rects(texel_m), {}};
    if (padded_area(p.rects, padding) <= room) p.pages = pack_rects(p.rects, limits);
    return p;
  };
  double chart_area = 0, longest = 0;
  for (const DVec2& size : layout.sizes) chart_area += size.x * size.y, longest = std::max(longest, size.x);
  double too_fine = std::max(std::sqrt(chart_area), longest) / side * 0.999;
  Packing best = attempt(std::max(longest, too_fine));
  if (best.pages.empty()) {
    const double least = std::sqrt(static_cast<double>(layout.sizes.size())) * (1 + padding);
    return fail(ErrorCode::kRuntime, "atlas",
                "{} charts do not fit into one page of {}x{} texels; about {:.0f}x{:.0f} are needed",
                layout.sizes.size(), side, side, std::ceil(least * 1.05), std::ceil(least * 1.05));
  }
  while (best.texel_m > too_fine * 1.005 && !context.stopped()) {
    const double middle = std::sqrt(best.texel_m * too_fine);
    Packing p = attempt(middle);
    if (p.pages.empty()) {
      too_fine = middle;
    } else {
      best = std::move(p);
    }
  }
  best.pages[0] = {side, side};
  return best;
}

void warn_coarsened(const Layout& layout, double texel_m, Context& context) {
  std::size_t count = 0;
  double worst = texel_m;
  for (std::size_t i = 0; i < layout.sizes.size(); ++i) {
    const double texel = layout.chart_texel(i, texel_m);
    if (texel <= texel_m * (1 + 1e-3)) continue;
    ++count;
    worst = std::max(worst, texel);
  }
  if (count > 0)
    context.warning(fmt::format(
        "atlas: {} of {} charts are longer than a page of {} texels at {:.4g} m a texel; theirs are up to {:.4g} m",
        count, layout.sizes.size(), layout.side, texel_m, worst));
}

// Writes page, chart and uv of the layout's triangles; pages are appended to the atlas.
void place(const Layout& layout, const Packing& packing, Atlas& atlas) {
  const auto first_page = static_cast<std::uint32_t>(atlas.pages.size());
  for (const PackedPage& page : packing.pages) atlas.pages.push_back({page.width, page.height, false});
  std::size_t index = 0;
  for (const ChartSet& set : layout.sets) {
    for (const Chart& chart : set.charts) {
      const PackRect& rect = packing.rects[index];
      const double texel = layout.chart_texel(index++, packing.texel_m);
      const Axis x = fit_axis(chart.size.x, texel, layout.inset), y = fit_axis(chart.size.y, texel, layout.inset);
      const DVec2 scale(x.scale, y.scale), offset(rect.x + x.offset, rect.y + y.offset);
      const DVec2 page_size(packing.pages[rect.page].width, packing.pages[rect.page].height);
      for (std::uint32_t i = chart.first; i < chart.first + chart.count; ++i) {
        const std::uint32_t t = set.triangles[i];
        atlas.page[t] = static_cast<std::int32_t>(first_page + rect.page);
        atlas.chart[t] = atlas.chart_count;
        for (std::size_t k = 0; k < 3; ++k) atlas.uv[t][k] = Vec2((set.points[i][k] * scale + offset) / page_size);
      }
      ++atlas.chart_count;
    }
  }
}

Status measure_coverage(Context& context, Atlas& atlas) {
  std::vector<std::vector<std::uint32_t>> triangles(atlas.pages.size());
  for (std::size_t t = 0; t < atlas.page.size(); ++t)
    if (atlas.page[t] >= 0) triangles[static_cast<std::size_t>(atlas.page[t])].push_back(static_cast<std::uint32_t>(t));
  std::vector<std::uint64_t> covered(atlas.pages.size(), 0);
  ORIEL_TRY_VOID(parallel_for(context, "", atlas.pages.size(), [&](std::size_t p) {
    const AtlasPage& page = atlas.pages[p];
    if (page.from_uv1) return;
    std::vector<std::uint8_t> mask(std::size_t{page.width} * page.height, 0);
    for (const std::uint32_t t : triangles[p]) {
      for_each_row(texel_triangle(atlas, t), static_cast<int>(page.height), [&](int row, const ConvexPolygon& part) {
        const Interval x = extent(part, 0);
        const CellRange columns = touched_cells(x.lo, x.hi, static_cast<int>(page.width));
        const auto begin = mask.begin() + static_cast<std::ptrdiff_t>(row) * page.width;
        std::fill(begin + columns.first, begin + columns.last + 1, std::uint8_t{1});
      });
    }
    covered[p] = static_cast<std::uint64_t>(std::count(mask.begin(), mask.end(), 1));
  }));
  double used = 0, all = 0;
  for (std::size_t p = 0; p < atlas.pages.size(); ++p) {
    if (atlas.pages[p].from_uv1) continue;
    used += static_cast<double>(covered[p]);
    all += static_cast<double>(atlas.pages[p].width) * atlas.pages[p].height;
  }
  atlas.covered_share = all > 0 ? used / all : 0;
  return {};
}

Status check_options(const AtlasOptions& o) {
  const auto usage = [](const char* what, double found, const char* expected) -> Status {
    return fail(ErrorCode::kUsage, "atlas", "{} is {}; expected {}", what, found, expected);
  };
  if (!(o.texel_m > 0) || !std::isfinite(o.texel_m)) return usage("the texel size", o.texel_m, "metres, more than 0");
  if (o.resolution < 0 || o.resolution > kMaxSide) return usage("the resolution", o.resolution, "0 to 16384 texels");
  if (o.source == AtlasOptions::Source::kUv1 && o.resolution == 0)
    return usage("the resolution", 0, "the side of the page that TEXCOORD_1 covers, 1 to 16384 texels");
  if (o.max_page < 16 || o.max_page > kMaxSide) return usage("the largest page", o.max_page, "16 to 16384 texels");
  if (o.padding < 1 || o.padding > 64) return usage("the padding", o.padding, "1 to 64 texels");
  if (!(o.flat_angle_deg >= 0 && o.flat_angle_deg <= 10))
    return usage("the flat angle", o.flat_angle_deg, "0 to 10 degrees");
  if (!(o.curved_angle_deg >= 0 && o.curved_angle_deg <= 75))
    return usage("the curved angle", o.curved_angle_deg, "0 to 75 degrees");
  return {};
}

Status place_automatic(const Scene& scene, const std::vector<std::uint32_t>& surfaces, const AtlasOptions& options,
                       Context& context, Atlas& atlas) {
  const bool one_page = options.resolution > 0 && options.source == AtlasOptions::Source::kAuto;
  double texel_m = options.texel_m;
  if (one_page) {
    // Charts depend on the texel a little (which flat regions are worth one); two thirds full is a fair guess.
    double area = 0;
    for (const std::uint32_t s : surfaces)
      for (std::uint32_t t = 0; t < scene.surfaces[s].triangle_count; ++t)
        area += triangle_frame(scene, scene.surfaces[s].first_triangle + t).area;
    if (area > 0) texel_m = std::sqrt(area / 0.66) / options.resolution;
  }
  Layout layout;
  layout.side = one_page ? options.resolution : options.max_page / 4 * 4;
  layout.inset = layout.side * 0x1p-24;  // twice what rounding to float moves a coordinate
  layout.sets.resize(surfaces.size());
  ORIEL_TRY_VOID(parallel_for(context, "atlas", surfaces.size(), [&](std::size_t i) {
    layout.sets[i] = grow_charts(scene, scene.surfaces[surfaces[i]], options, texel_m, context);
  }));
  for (const ChartSet& set : layout.sets)
    for (const Chart& chart : set.charts) layout.sizes.push_back(chart.size);
  if (context.stopped()) return fail(ErrorCode::kStopped, "atlas", "stopped");
  const auto padding = static_cast<std::uint32_t>(options.padding);
  ORIEL_TRY(const Packing packing,
            one_page ? pack_one_page(layout, padding, context) : pack_at_texel(layout, texel_m, padding));
  if (context.stopped()) return fail(ErrorCode::kStopped, "atlas", "stopped");
  warn_coarsened(layout, packing.texel_m, context);
  atlas.texel_m = static_cast<float>(packing.texel_m);
  place(layout, packing, atlas);
  return {};
}

}  // namespace

Result<Atlas> build_atlas(const Scene& scene, const AtlasOptions& options, Context& context) {
  ORIEL_TRY_VOID(check_options(options));
  Atlas atlas;
  atlas.texel_m = options.texel_m;
  atlas.page.assign(scene.triangles.size(), -1);
  atlas.chart.assign(scene.triangles.size(), ~0u);
  atlas.uv.assign(scene.triangles.size(), {Vec2(0), Vec2(0), Vec2(0)});
  std::vector<std::uint32_t> artist, automatic;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    if (surface.triangle_count == 0 || scene.materials[surface.material].unlit) continue;
    const bool own = options.source == AtlasOptions::Source::kUv1 && surface.has_uv1;
    (own ? artist : automatic).push_back(s);
  }
  if (options.source == AtlasOptions::Source::kUv1) {
    if (artist.empty())
      return invalid("atlas", "no mesh has TEXCOORD_1; expected lightmap coordinates on at least one that takes light");
    const auto side = static_cast<std::uint32_t>(options.resolution);
    atlas.pages.push_back({side, side, true});
    ORIEL_TRY_VOID(place_uv1(scene, artist, context, atlas));
  }
  if (!automatic.empty()) ORIEL_TRY_VOID(place_automatic(scene, automatic, options, context, atlas));
  ORIEL_TRY_VOID(measure_coverage(context, atlas));
  return atlas;
}

}  // namespace oriel
