#include "bake/run/method.h"

namespace oriel {
namespace {

constexpr std::uint32_t kViews = 64, kResolution = 128;  // of an element, as published
constexpr const char* kMethod = "--method bastos1999";
constexpr const char* kPasses = "--method diefenbach1997";

Status clash(const char* method, const char* found, const char* expected) {
  return fail(ErrorCode::kUsage, method, "found {} with it, expected {}", found, expected);
}

// Lamps are drawn by the player, mirrors as the scene drawn again.
Status settle_passes(const Given& given, BakeOptions& o) {
  if (o.radiosity.estimator != Estimator::kCached)
    return clash(kPasses, "--estimator reference", "cached: it tells reflected light from that of lamps");
  if (o.radiosity.bounces != 0)
    return clash(kPasses, "--bounces", "all: light by way of mirrors is followed there alone");
  if (o.radiosity.hidden == Hidden::kBlack) return clash(kPasses, "--hidden-black", "none");
  if (o.import.day.wanted) return clash(kPasses, "--day", "lamps: light of hours is switched, not drawn");
  if (given.has("--light-groups") && o.light_groups.by != LightGrouping::kOff)
    return clash(kPasses, "--light-groups", "off: what is baked is not by group");
  if (given.has("--reflections") && o.ways == WaysWanted::kMaps)
    return clash(kPasses, "--reflections maps", "geometry");
  o.light_groups.by = LightGrouping::kOff;
  o.ways = WaysWanted::kGeometry;
  o.radiosity.indirect = true;
  return {};
}

}  // namespace

std::vector<Option> method_options(const char* group, BakeOptions& o) {
  return {
      {"--method", group,
       "oriel, or as published, to compare with (oriel-play --method). bastos1999: reflections of 64 uniform "
       "viewpoints to the rim, maps of 128 pixels that hold the lamps and no mirrors in mirrors, K of D·G, R by "
       "equation (4); planar reflectors only. diefenbach1997: lightmaps without the light of lamps, which the player "
       "draws in passes of its own",
       choice(o.method, {{"oriel", Method::kOriel},
                         {"bastos1999", Method::kBastos1999},
                         {"diefenbach1997", Method::kDiefenbach1997}}),
       Use::kRare, "method", "reflections.md#as-published"},
      {"--facets", group,
       "Distribution of K's facets: ggx, or with --method bastos1999 beckmann, its default, or gaussian",
       choice(o.material.model,
              {{"ggx", KernelModel::kGgx}, {"beckmann", KernelModel::kBeckmann}, {"gaussian", KernelModel::kGaussian}}),
       Use::kRare, "facets", "materials.md#kernels-and-fresnel-maps"},
      {"--sphere-map", group, "Side of the sphere maps of R in texels; 0: none",
       number(o.material.fresnel.sphere_size, 0, 1024), Use::kRare, "sphere_map",
       "materials.md#kernels-and-fresnel-maps"},
  };
}

Status settle_method(const Given& given, BakeOptions& o) {
  if (o.method != Method::kBastos1999) {
    if (o.method == Method::kDiefenbach1997) ORIEL_TRY_VOID(settle_passes(given, o));
    if (o.material.model == KernelModel::kGgx) return {};
    return fail(ErrorCode::kUsage, "--facets", "found another than ggx without {}, expected both: paths follow GGX",
                kMethod);
  }
  if (given.has("--reflections") && o.ways != WaysWanted::kMaps)
    return clash(kMethod, "--reflections without maps", "maps");
  if (given.has("--views") && o.view_scheme != ViewScheme::kHemisphere)
    return clash(kMethod, "planned --views", "hemisphere:N");
  if (given.has("--map-price"))
    return clash(kMethod, "--map-price", "none: uniform viewpoints are not chosen by what they show");
  if (given.has("--facets") && o.material.model == KernelModel::kGgx)
    return clash(kMethod, "--facets ggx", "beckmann or gaussian");
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
