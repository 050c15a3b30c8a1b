#include "player/session/method.h"

#include "formats/core/json.h"
#include "player/movers/light_samples.h"
#include "player/session/option_names.h"

namespace oriel {

std::vector<Option> reflection_options(const char* group, PlayArguments& out) {
  return {
      {"--method", group,
       "To compare with, for packs of oriel-bake --method likewise. diefenbach1997: lamps by passes with shadow "
       "volumes, "
       "in mirrors and by way of mirrors too, over a lightmap without their light",
       choice(out.method, {{"oriel", ShownMethod::kOriel}, {"diefenbach1997", ShownMethod::kDiefenbach1997}}),
       Use::kRare, "method"},
      {"--shadow-points", group, "Of --method diefenbach1997: points of a lamp that has a size, each with its passes",
       number(out.frame.multi_pass.points, 1, kMaxLightPoints), Use::kRare, "shadow_points"},
      {"--light-mirrors", group, "Likewise: mirrors on the way of light from a lamp to what it lights, at most",
       number(out.frame.multi_pass.mirrors, 0, kMostLightMirrors), Use::kRare, "light_mirrors"},
      {"--shadow-mirrors", group,
       "Likewise: light by way of more mirrors than this throws no shadows; -1: no light does",
       number(out.frame.multi_pass.shadow_mirrors, -1, kMostLightMirrors), Use::kRare, "shadow_mirrors"},
      {"--bent-shadows", group,
       "Likewise: whether what light meets before a mirror throws shadows by way of it; off: what stands behind the "
       "last mirror alone does",
       choice(out.frame.multi_pass.bent_shadows, kSwitch), Use::kRare, "bent_shadows"},
      {"--reflections", group,
       "What reflectors show: as the bake chose, rays marched through their radiance maps, the maps' meshes, the "
       "mirrored scene drawn again, or nothing. Reflectors without maps always show the mirrored scene",
       choice(out.frame.reflections, kReflections), Use::kEveryday, "reflections"},
      {"--orders", group,
       "Reflectors on the way of a reflection: 1 shows a mirror in a mirror as its diffuse light only. Without it: 2, "
       "and on while all on the way are mirrors that leave half of the light",
       number(out.frame.orders, 1, 16), Use::kRare, "orders"},
      {"--maps", group,
       "Radiance maps blended for each reflector element in view: more fill more gaps and cost more time; 0 shows none",
       number(out.frame.maps_per_element, 0, 64), Use::kRare, "maps"},
      {"--blur", group, "K's width in the image: by the distance of what is reflected, or as sharp as a mirror",
       choice(out.frame.blur, kBlurs), Use::kRare, "blur"},
  };
}

std::string settle_method(const Given& given, PlayArguments& out) {
  FrameOptions& frame = out.frame;
  if (out.method == ShownMethod::kDiefenbach1997) {
    if (given.has("--reflections") && frame.reflections != Reflections::kGeometry &&
        frame.reflections != Reflections::kOff)
      return "found --reflections of another method with --method diefenbach1997";
    if (!given.has("--reflections")) frame.reflections = Reflections::kGeometry;
    frame.multi_pass.on = true;
    frame.mover_lights = MoverLights::kHarmonics;  // the lightmap has no light for movers' shadows to take
  }
  return {};
}

std::string method_of(const Pack& pack) {
  const Json provenance = Json::parse(pack.provenance).value_or(Json());  // a pack's text may be anything
  const Json& method = provenance["options"]["method"];
  return method.is_string() ? method.get<std::string>() : "";
}

std::string other_method(const Pack& pack, const PlayArguments& arguments) {
  const std::string baked = method_of(pack);
  if (arguments.method == ShownMethod::kDiefenbach1997 && baked != "diefenbach1997")
    return "the pack is not of oriel-bake --method diefenbach1997: its lightmap has the light of lamps already, and "
           "what passes add of lamps that it names is there twice";
  if (arguments.method != ShownMethod::kDiefenbach1997 && baked == "diefenbach1997")
    return "the pack is of oriel-bake --method diefenbach1997: its lightmap is without the light of lamps, which "
           "--method diefenbach1997 adds";
  return {};
}

}  // namespace oriel
