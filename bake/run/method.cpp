#include "bake/run/method.h"

namespace oriel {
namespace {

constexpr std::uint32_t kViews = 64, kResolution = 128;  // of an element, as published
constexpr const char* kMethod = "--method bastos1999";

}  // namespace

std::vector<Option> method_options(const char* group, BakeOptions& o) {
  return {
      {"--method", group,
       "How reflections are baked: oriel, or bastos1999, as published, to compare with (oriel-play --method): 64 "
       "uniform viewpoints to the rim, maps of 128 pixels that hold the lamps and no mirrors in mirrors, K of D·G, R "
       "by equation (4); planar reflectors only",
       choice(o.method, Names<Method>{{"oriel", Method::kOriel}, {"bastos1999", Method::kBastos1999}}), Use::kRare,
       "method", "reflections.md#as-published"},
      {"--facets", group,
       "Distribution of K's facets: ggx, or with --method bastos1999 beckmann, its default, or gaussian",
       choice(o.material.model, Names<KernelModel>{{"ggx", KernelModel::kGgx},
                                                   {"beckmann", KernelModel::kBeckmann},
                                                   {"gaussian", KernelModel::kGaussian}}),
       Use::kRare, "facets", "materials.md#kernels-and-fresnel-maps"},
      {"--sphere-map", group, "Side of the sphere maps of R in texels; 0: none",
       number(o.material.fresnel.sphere_size, 0, 1024), Use::kRare, "sphere_map",
       "materials.md#kernels-and-fresnel-maps"},
  };
}

Status settle_method(const Given& given, BakeOptions& o) {
  if (o.method == Method::kOriel) {
    if (o.material.model == KernelModel::kGgx) return {};
    return fail(ErrorCode::kUsage, "--facets", "found another than ggx without {}, expected both: paths follow GGX",
                kMethod);
  }
  const auto clash = [](const char* found, const char* expected) {
    return fail(ErrorCode::kUsage, kMethod, "found {} with it, expected {}", found, expected);
  };
  if (given.has("--reflections") && o.ways != WaysWanted::kMaps) return clash("--reflections without maps", "maps");
  if (given.has("--views") && o.view_scheme != ViewScheme::kHemisphere) return clash("planned --views", "hemisphere:N");
  if (given.has("--map-price"))
    return clash("--map-price", "none: uniform viewpoints are not chosen by what they show");
  if (given.has("--facets") && o.material.model == KernelModel::kGgx)
    return clash("--facets ggx", "beckmann or gaussian");
  o.ways = WaysWanted::kMaps;
  o.view_scheme = ViewScheme::kHemisphere;
  if (!given.has("--views")) o.views.views_per_element = kViews;
  if (!given.has("--map-resolution")) o.views.map_resolution = kResolution;
  if (!given.has("--orders")) o.sight.orders = 1;
  if (!given.has("--facets")) o.material.model = KernelModel::kBeckmann;
  o.material.kernel.form = LobeForm::kDg;
  o.material.by_incidence = false;
  o.material.fresnel.equation_4 = true;
  return {};
}

}  // namespace oriel
