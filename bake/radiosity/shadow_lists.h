// Which triangles stand between texels of flat charts and lamps: the baked half of sharp light
// (formats/assets/sharp_light.h, docs/notes/sharp-light.md).
#pragma once

#include <functional>

#include "bake/jobs/context.h"
#include "bake/radiosity/texels/lightmap_scene.h"
#include "bake/radiosity/texels/sharp_charts.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/sharp_light.h"

namespace oriel {

struct ShadowLists {
  SharpLight light;
  std::vector<std::vector<std::uint32_t>> at;  // by page: LightmapPage::sharp_at; empty: nothing on this page
  std::vector<std::uint32_t> left_out;         // charts
};

// Ends where there is `enough`, which may be empty, or too much to store: charts are left out then, small ones first.
// Error kStopped.
Result<ShadowLists> list_shadows(const LightmapScene& scene, const SharpCharts& sharp,
                                 const std::function<bool()>& enough, const Stage& stage);

}  // namespace oriel
