// R: directional reflectance as the tables that modulate a reflected image (Bastos et al. 1999, section 8.2.2).
#pragma once

#include "bake/brdf/specular.h"
#include "formats/assets/fresnel_map.h"
#include "formats/core/archive.h"

namespace oriel {

struct FresnelMapOptions {
  double error = 7e-4;             // of the 1-D table between its entries, absolute, where max_entries allow
  std::uint32_t min_entries = 65;  // at least 2; doubled (2 n - 1) until the error is kept
  std::uint32_t max_entries = 1025;
  std::uint32_t factor_entries = 65;  // at least 2; a mirror has none
};
inline void fields(Archive& archive, FresnelMapOptions& o) {
  archive(o.error, o.min_entries, o.max_entries, o.factor_entries);
}

// Numbers outside their ranges are clamped, NaN counts as 0. alpha below kMirrorAlpha is a mirror: R is Fresnel's
// factor itself.
FresnelMap make_fresnel_map(const SpecularLayers& layers, const FresnelMapOptions& options = {});

// R at a direction, from the table: linear between entries; cos_theta is clamped to [0,1], NaN counts as 0. 0 for an
// empty table.
Vec3 fresnel_lookup(const FresnelMap& map, float cos_theta);

// R per channel of the layers, exact: what the maps approximate.
class ExactLayers {
 public:
  explicit ExactLayers(const SpecularLayers& layers);
  Vec3 operator()(double cos_theta) const;

 private:
  float coat_;
  ExactReflectance base_;
  std::optional<ExactReflectance> coat_lobe_;
};

}  // namespace oriel
