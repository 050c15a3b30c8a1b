#include "bake/material/reflectance.h"

#include <algorithm>

namespace oriel {
namespace {

float unit(float x) {
  return x > 0 ? std::min(x, 1.0f) : 0.0f;
}  // NaN: 0

Vec3 unit(const Vec3& v) {
  return {unit(v.r), unit(v.g), unit(v.b)};
}

SpecularLayers sane(const SpecularLayers& in) {
  SpecularLayers out = in;
  out.base.f0 = unit(in.base.f0);
  out.base.f90 = unit(in.base.f90);
  out.base.alpha = unit(in.base.alpha);
  out.coat = unit(in.coat);
  out.coat_alpha = unit(in.coat_alpha);
  return out;
}

// Entry i of n.
Vec3 entry(const ExactLayers& exact, std::size_t i, std::size_t n) {
  const double root = static_cast<double>(i) / static_cast<double>(n - 1);
  return exact(root * root);
}

float distance(const Vec3& a, const Vec3& b) {
  return max_component(glm::abs(a - b));
}

// Entries doubled until those between them are where interpolation puts them.
std::vector<Vec3> make_table(const ExactLayers& exact, const FresnelMapOptions& options) {
  std::vector<Vec3> table;
  const std::size_t least = std::max(options.min_entries, 2u);
  for (std::size_t i = 0; i < least; ++i) table.push_back(entry(exact, i, least));
  while (2 * table.size() - 1 <= options.max_entries) {
    std::vector<Vec3> finer;
    double error = 0;
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      finer.push_back(table[i]);
      finer.push_back(entry(exact, 2 * i + 1, 2 * table.size() - 1));
      error = std::max(error, double{distance(finer.back(), 0.5f * (table[i] + table[i + 1]))});
    }
    if (error <= options.error) break;
    finer.push_back(table.back());
    table = std::move(finer);
  }
  return table;
}

}  // namespace

ExactLayers::ExactLayers(const SpecularLayers& layers) : coat_(layers.coat), base_(layers.base) {
  if (coat_ > 0) coat_lobe_.emplace(layers.coat_lobe());
}

Vec3 ExactLayers::operator()(double cos_theta) const {
  const float coat = coat_lobe_ ? coat_ * (*coat_lobe_)(cos_theta).g : 0.0f;
  return Vec3(coat) + (1 - coat) * base_(cos_theta);
}

FresnelMap make_fresnel_map(const SpecularLayers& layers, const FresnelMapOptions& options) {
  const SpecularLayers checked = sane(layers);
  FresnelMap map;
  map.alpha = checked.base.alpha;
  map.table = make_table(ExactLayers(checked), options);
  if (map.alpha >= kMirrorAlpha)
    for (std::uint32_t i = 0; i < options.factor_entries; ++i) {
      const double root = static_cast<double>(i) / (options.factor_entries - 1.0);
      map.factor.push_back(unit(specular_fresnel(checked.base, root * root)));
    }
  return map;
}

Vec3 fresnel_lookup(const FresnelMap& map, float cos_theta) {
  return lookup_by_cosine(map.table, cos_theta);
}

}  // namespace oriel
