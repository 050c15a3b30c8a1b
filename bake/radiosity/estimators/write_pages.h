// What is known of texels goes to the lightmap's pages.
#pragma once

#include <vector>

#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/estimators/reuse.h"

namespace oriel {

// The cached estimator's, by texel.
struct TexelEstimate {
  const Texels& texels;
  const Estimate &direct, &gathered;
  const std::vector<Vec4>&direct_moments, &gathered_moments;  // empty unless pages have directions
  const Reuse* reuse = nullptr;                               // of those that keep their light; may be null
};
// As LightEstimator::write, but for the report.
void write_texels(const TexelEstimate& estimate, Radiosity& light);

// What visible texels have of each group goes to its pages. pages: by group and page.
void write_grouped(const Texels& texels, const GroupedLight& grouped, std::vector<std::vector<LightmapPage>>& pages);

// Makes the groups' light sum to that of the whole page, texel by texel and point by point (rescale_groups).
void rescale_page_groups(const LightmapPage& whole, std::size_t page, std::vector<std::vector<LightmapPage>>& groups);

}  // namespace oriel
