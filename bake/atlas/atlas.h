// Lightmap texture coordinates for every triangle: charts, packed into pages.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bake/atlas/texel_demand.h"
#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

struct AtlasOptions {
  enum class Source { kAuto, kUv1 };
  Source source = Source::kAuto;
  float texel_m = 0.1f;            // automatic charts: metres a texel; with a TexelDemand the finest
  int resolution = 0;              // > 0: charts get the texel size that fills one page of this side; with kUv1 it is
                                   // that of page 0, where coordinates can be taken as they are
  int max_page = 2048;             // largest side of a page, texels
  int padding = 2;                 // texels between charts, at least
  float flat_angle_deg = 1.0f;     // faces within it of a chart's plane are projected exactly
  float curved_angle_deg = 40.0f;  // a curved chart has no sharper edge, and is first grown to normals within it
  float max_stretch = 1.1f;        // L2 stretch of a curved chart, at most
  double time_limit_s = 0;         // then what is left gets quick, plain charts (a warning says so); 0: none. Where it
                                   // strikes, the atlas depends on the speed of the machine
  std::uint64_t memory_bytes = 0;  // of baking the lightmap: an error where the texels need more; 0: no limit
  bool coarsen = false;            // with a TexelDemand: where the texels need more, those of what is seen least become
                                   // larger until they do not
  std::uint64_t texels_in_time = 0;  // with coarsen: likewise where there are more than so many; 0: no limit
};

struct AtlasPage {
  std::uint32_t width = 0, height = 0;
  bool from_uv1 = false;  // the artist's coordinates
};

// How well packed charts (where there are none: the artist's page) show their surfaces, and how full pages are. Stretch
// and distortion are 1 for an isometry at the mean density of texels (StretchSum in stretch.h); charts drawn coarser
// count as they are.
struct AtlasReport {
  double l2_stretch = 1, linf_stretch = 1;
  double angle_distortion = 1, area_distortion = 1;
  std::uint64_t page_texels = 0, covered_texels = 0;
  std::uint64_t overlapping_texels = 0;  // touched by triangles of two charts
  bool time_limit_struck = false;
  double unseen_m2 = 0;  // with a TexelDemand: of charts that no eye sees
};

struct Atlas {
  std::vector<AtlasPage> pages;
  std::vector<std::int32_t>
      page;  // by triangle; -1: none (unlit material; with a demand also one that reflects nothing)
  std::vector<std::array<Vec2, 3>> uv;  // by triangle and corner, [0,1] over its page
  std::vector<std::uint32_t> chart;     // by triangle; ~0u: none
  std::uint32_t chart_count = 0;
  double covered_share = 0;  // covered texels over all texels
  float texel_m = 0;         // the (finest) texel size used by automatic charts, metres
  AtlasReport report;
};

// Whether light that falls on a material can be seen: it is not unlit, and reflects some. A material that shines and
// is black but for the gloss of all plastics, the dome that stands for a sky say, counts as one that does not.
bool takes_light(const SceneMaterial& material);

// With kUv1 and a resolution artist coordinates are page 0 as they are, where all lie in [0, 1] and no two overlap.
// Else charts of each surface are packed (own_charts). Where coordinates are faulty charts are made (check_uv1).
// Errors: kInvalid when kUv1 is asked for and no surface has coordinates of use; kRuntime when it would need more than
// 4096 pages or more memory than the limit (says the texel size that fits).
Result<Atlas> build_atlas(const Scene& scene, const AtlasOptions& options, Context& context,
                          const TexelDemand& demand = {});

}  // namespace oriel
