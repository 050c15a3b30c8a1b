// Lightmap texture coordinates for every triangle: charts, packed into pages.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

struct AtlasOptions {
  enum class Source { kAuto, kUv1 };
  Source source = Source::kAuto;
  float texel_m = 0.1f;            // automatic charts: metres a texel
  int resolution = 0;              // > 0: automatic charts choose the texel size that fills one page of this side; with
                                   // kUv1 the side of page 0 (required there)
  int max_page = 2048;             // largest side of a page, texels
  int padding = 2;                 // texels between charts, at least
  float flat_angle_deg = 1.0f;     // faces within it of a chart's plane are projected exactly
  float curved_angle_deg = 40.0f;  // a curved chart's normals stay within it
};

struct AtlasPage {
  std::uint32_t width = 0, height = 0;
  bool from_uv1 = false;  // the artist's coordinates
};

struct Atlas {
  std::vector<AtlasPage> pages;
  std::vector<std::int32_t> page;       // by triangle; -1: none (unlit material, or emission only)
  std::vector<std::array<Vec2, 3>> uv;  // by triangle and corner, [0,1] over its page
  std::vector<std::uint32_t> chart;     // by triangle; ~0u: none
  std::uint32_t chart_count = 0;
  double covered_share = 0;  // covered texels over all texels, automatic pages
  float texel_m = 0;         // the texel size used by automatic charts, metres
};

// Errors: kInvalid when artist coordinates overlap (names both meshes), leave [0,1], have no area, or when kUv1 is
// asked for and no mesh has TEXCOORD_1; kRuntime when it would need more than 4096 pages (says the texel size that
// fits).
Result<Atlas> build_atlas(const Scene& scene, const AtlasOptions& options, Context& context);

}  // namespace oriel
