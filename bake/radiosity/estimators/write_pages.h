// Writing of texel estimates to the lightmap's pages.
#pragma once

#include <vector>

#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/estimators/radiosity_options.h"

namespace oriel {

// The cached estimator's results by texel.
struct TexelEstimate {
  const Texels& texels;
  const Estimate &direct, &gathered;                          // without what is computed by pixel
  const std::vector<Vec3>& sharp;                             // that
  const std::vector<Vec4>&direct_moments, &gathered_moments;  // empty unless pages have directions
};
// Does LightEstimator::write(), except for the report.
void write_texels(const TexelEstimate& estimate, Radiosity& light);

// Writes the light of visible texels by light group. pages: by group and page.
void write_grouped(const Texels& texels, const GroupedLight& grouped, std::vector<std::vector<LightmapPage>>& pages);

// Scales the groups' light to sum to that of the whole page, texel by texel and point by point (rescale_groups).
void rescale_page_groups(const LightmapPage& whole, std::size_t page, std::vector<std::vector<LightmapPage>>& groups);

}  // namespace oriel
