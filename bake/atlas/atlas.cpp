#include "bake/atlas/atlas.h"

#include <cmath>

#include "bake/atlas/congruent.h"
#include "bake/atlas/layout.h"
#include "bake/atlas/texel_map.h"
#include "bake/atlas/uv1.h"
#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr int kMaxSide = 16384;
constexpr double kLargeShare = 1.0 / 256;  // of all charts' area in one whose shape matters for packing
constexpr double kMergedShare = 1.0 / 24;  // of all charts' area in a merged one: a few large round charts would leave
                                           // much of a page empty between them

Status measure_coverage(Context& context, Atlas& atlas) {
  std::vector<std::vector<std::uint32_t>> triangles(atlas.pages.size());
  for (std::size_t t = 0; t < atlas.page.size(); ++t)
    if (atlas.page[t] >= 0) triangles[static_cast<std::size_t>(atlas.page[t])].push_back(static_cast<std::uint32_t>(t));
  struct Count {
    std::uint64_t covered = 0, shared = 0;
  };
  std::vector<Count> counts(atlas.pages.size());
  ORIEL_TRY_VOID(parallel_for(context, "", atlas.pages.size(), [&](std::size_t p) {
    const AtlasPage& page = atlas.pages[p];
    constexpr std::uint32_t kNobody = ~0u, kShared = ~0u - 1;
    std::vector<std::uint32_t> owner(std::size_t{page.width} * page.height, kNobody);
    for (const std::uint32_t t : triangles[p]) {
      for_each_row(texel_triangle(atlas, t), static_cast<int>(page.height), [&](int row, const ConvexPolygon& part) {
        const Interval x = extent(part, 0);
        const CellRange columns = touched_cells(x.lo, x.hi, static_cast<int>(page.width));
        for (int column = columns.first; column <= columns.last; ++column) {
          std::uint32_t& texel = owner[static_cast<std::size_t>(row) * page.width + static_cast<std::size_t>(column)];
          texel = texel == kNobody || texel == atlas.chart[t] ? atlas.chart[t] : kShared;
        }
      });
    }
    for (const std::uint32_t o : owner) counts[p].covered += o != kNobody, counts[p].shared += o == kShared;
  }));
  AtlasReport& report = atlas.report;
  for (std::size_t p = 0; p < atlas.pages.size(); ++p) {
    report.covered_texels += counts[p].covered;
    report.overlapping_texels += counts[p].shared;
    report.page_texels += std::uint64_t{atlas.pages[p].width} * atlas.pages[p].height;
  }
  if (report.page_texels > 0)
    atlas.covered_share = static_cast<double>(report.covered_texels) / static_cast<double>(report.page_texels);
  return {};
}

Status check_options(const AtlasOptions& o) {
  const auto usage = [](const char* what, double found, const char* expected) -> Status {
    return fail(ErrorCode::kUsage, "atlas", "{} is {}; expected {}", what, found, expected);
  };
  if (!(o.texel_m > 0) || !std::isfinite(o.texel_m)) return usage("the texel size", o.texel_m, "metres, more than 0");
  if (o.resolution < 0 || o.resolution > kMaxSide) return usage("the resolution", o.resolution, "0 to 16384 texels");
  if (o.max_page < 16 || o.max_page > kMaxSide) return usage("the largest page", o.max_page, "16 to 16384 texels");
  if (o.padding < 1 || o.padding > 64) return usage("the padding", o.padding, "1 to 64 texels");
  if (!(o.flat_angle_deg >= 0 && o.flat_angle_deg <= 10))
    return usage("the flat angle", o.flat_angle_deg, "0 to 10 degrees");
  if (!(o.curved_angle_deg >= 0 && o.curved_angle_deg <= 75))
    return usage("the curved angle", o.curved_angle_deg, "0 to 75 degrees");
  if (!(o.max_stretch >= 1 && o.max_stretch <= 10)) return usage("the largest stretch", o.max_stretch, "1 to 10");
  if (!(o.time_limit_s >= 0)) return usage("the time limit", o.time_limit_s, "seconds, 0 for none");
  return {};
}

// Surfaces of a scene whose charts are packed: grown ones, and those of the artist's coordinates.
struct ChartedSurfaces {
  const Scene& scene;
  std::vector<std::uint32_t> grown, own;
  bool one_page = false;
};

// The charts of a surface for a congruent one.
ChartSet moved(ChartSet charts, const Surface& from, const Surface& to) {
  for (std::uint32_t& t : charts.triangles) t += to.first_triangle - from.first_triangle;
  return charts;
}

double area_of(const Scene& scene, const std::vector<std::uint32_t>& surfaces) {
  double area = 0;
  for (const std::uint32_t s : surfaces)
    for (std::uint32_t t = 0; t < scene.surfaces[s].triangle_count; ++t)
      area += triangle_area(scene, scene.surfaces[s].first_triangle + t);
  return area;
}

Status place_charts(const ChartedSurfaces& charted, const AtlasOptions& options, const TexelDemand& demand,
                    Context& context, Atlas& atlas) {
  const Scene& scene = charted.scene;
  const std::vector<std::uint32_t>& surfaces = charted.grown;
  const bool one_page = charted.one_page;
  const double area = area_of(scene, surfaces) + area_of(scene, charted.own);
  double texel_m = options.texel_m;
  // Charts depend on the texel a little (which flat regions are worth one); three quarters full is a fair guess.
  if (one_page && area > 0) texel_m = std::sqrt(area / 0.75) / options.resolution;
  const AtlasTimeLimit deadline(options.time_limit_s);
  const ChartOptions chart_options{texel_m,
                                   glm::radians(static_cast<double>(options.flat_angle_deg)),
                                   glm::radians(static_cast<double>(options.curved_angle_deg)),
                                   static_cast<double>(options.max_stretch),
                                   kMergedShare * area,
                                   kLargeShare * area,
                                   &deadline,
                                   demand.empty() ? nullptr : &demand};
  std::vector<ChartSet> sets(surfaces.size());
  const std::vector<std::uint32_t> first = first_congruent(scene, surfaces, chart_options.demand);
  ORIEL_TRY_VOID(parallel_for(context, "atlas", surfaces.size(), [&](std::size_t i) {
    if (first[i] != i) return;
    const Surface& surface = scene.surfaces[surfaces[i]];
    ChartOptions own = chart_options;
    if (surface.texel_m > 0) own.texel_m = static_cast<double>(surface.texel_m);
    sets[i] = grow_charts(scene, surface, own, context);
    sets[i].texel_m = static_cast<double>(surface.texel_m);
  }));
  for (std::size_t i = 0; i < sets.size(); ++i)
    if (first[i] != i) sets[i] = moved(sets[first[i]], scene.surfaces[surfaces[first[i]]], scene.surfaces[surfaces[i]]);
  for (const std::uint32_t s : charted.own) sets.push_back(own_charts(scene, scene.surfaces[s]));
  if (context.stopped()) return fail(ErrorCode::kStopped, "atlas", "stopped");
  atlas.report.time_limit_struck = deadline.struck();
  if (deadline.struck())
    context.warning("plain-charts",
                    fmt::format("atlas: the limit of {} s was reached; the charts left then are plain projections, and "
                                "another run may give others",
                                options.time_limit_s));
  LayoutOptions layout;
  layout.side = static_cast<std::uint32_t>(one_page ? options.resolution : options.max_page / 4 * 4);
  layout.padding = static_cast<std::uint32_t>(options.padding);
  layout.one_page = one_page;
  layout.texel_m = texel_m;
  layout.memory_bytes = options.memory_bytes;
  layout.coarsen = options.coarsen;
  layout.texels_in_time = options.texels_in_time;
  if (!one_page && !demand.empty()) layout.demand = &demand;
  return lay_out(scene, sets, layout, context, atlas);
}

}  // namespace

bool takes_light(const SceneMaterial& material) {
  if (material.unlit) return false;
  const bool black = max_component(material.base_color) == 0 && material.metal == Metal::kNone && material.coat == 0;
  const bool shines = max_component(material.emission) > 0 && material.emission_texture.image < 0;
  return !(black && (shines || material.specular == 0 || max_component(material.specular_color) == 0));
}

Result<Atlas> build_atlas(const Scene& scene, const AtlasOptions& options, Context& context,
                          const TexelDemand& demand) {
  ORIEL_TRY_VOID(check_options(options));
  Atlas atlas;
  atlas.texel_m = options.texel_m;
  atlas.page.assign(scene.triangles.size(), -1);
  atlas.chart.assign(scene.triangles.size(), ~0u);
  atlas.uv.assign(scene.triangles.size(), {Vec2(0), Vec2(0), Vec2(0)});
  ChartedSurfaces charted{scene, {}, {}, options.resolution > 0};
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const SceneMaterial& material = scene.materials[surface.material];
    if (surface.triangle_count == 0 || material.unlit || (!demand.empty() && !takes_light(material))) continue;
    charted.grown.push_back(s);
  }
  if (options.source == AtlasOptions::Source::kUv1) {
    Uv1Check check = check_uv1(scene, charted.grown, options, context);
    if (check.own.empty())
      return invalid("atlas", "no mesh has TEXCOORD_1 of use; expected lightmap coordinates on one that takes light");
    charted.grown = std::move(check.faulty);
    if (check.one_page) {
      const auto side = static_cast<std::uint32_t>(options.resolution);
      atlas.pages.push_back({side, side, true});
      place_uv1(scene, check.own, atlas);
      charted.one_page = false;
    } else {
      charted.own = std::move(check.own);
    }
  }
  if (!charted.grown.empty() || !charted.own.empty())
    ORIEL_TRY_VOID(place_charts(charted, options, demand, context, atlas));
  ORIEL_TRY_VOID(measure_coverage(context, atlas));
  return atlas;
}

}  // namespace oriel
