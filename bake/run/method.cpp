#include "bake/run/method.h"

namespace oriel {
namespace {

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
  if (o.vertex_light) return clash(kPasses, "--radiosity vertices", "texture");
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
       "oriel, or to compare with (oriel-play --method). diefenbach1997: lightmaps without the light of lamps, which "
       "the player draws in passes of its own",
       choice(o.method, {{"oriel", Method::kOriel}, {"diefenbach1997", Method::kDiefenbach1997}}), Use::kRare,
       "method"},
  };
}

Status settle_method(const Given& given, BakeOptions& o) {
  return o.method == Method::kDiefenbach1997 ? settle_passes(given, o) : Status();
}

}  // namespace oriel
