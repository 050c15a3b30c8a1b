#include "player/session/method.h"

#include "formats/core/json.h"
#include "player/session/option_names.h"

namespace oriel {

std::vector<Option> reflection_options(const char* group, PlayArguments& out) {
  return {
      {"--method", group,
       "As published, to compare with, for packs of oriel-bake --method likewise. bastos1999: --reflections points "
       "--blur constant --fill off --fresnel sphere",
       choice(out.method, {{"oriel", ShownMethod::kOriel}, {"bastos1999", ShownMethod::kBastos1999}}), Use::kRare,
       "method"},
      {"--reflections", group,
       "What reflectors show: as the bake chose, rays marched through their radiance maps, the maps' pixels as points "
       "as Bastos et al. published it, the mirrored scene drawn again, or nothing. Reflectors without maps always show "
       "the mirrored scene",
       choice(out.frame.reflections, kReflections), Use::kRare, "reflections"},
      {"--orders", group,
       "Reflectors on the way of a reflection: 1 shows a mirror in a mirror as its diffuse light only. Without it: 2, "
       "and on while all on the way are mirrors that leave half of the light",
       number(out.frame.orders, 1, 16), Use::kRare, "orders"},
      {"--maps", group,
       "Radiance maps blended for each reflector element in view: more fill more gaps and cost more time; 0 shows none",
       number(out.frame.maps_per_element, 0, 64), Use::kRare, "maps"},
      {"--select", group,
       "Which maps: taken from the direction nearest to the mirrored eye's, or from the nearest place",
       choice(out.frame.selection, kSelections), Use::kRare, "select"},
      {"--blur", group,
       "K's width in the image: by the distance of what is reflected, one kernel for all of an image of fewer pixels "
       "as Bastos et al. published it (of the reflector's mean distance), or as sharp as a mirror. Lamps that a "
       "glossy reflector's maps leave out are exact for the first two",
       choice(out.frame.blur, kBlurs), Use::kRare, "blur"},
      {"--fill", group,
       "Whether pixels of a reflected image that no map tells of are filled from beside; off: black, as published. Not "
       "with --blur distance, which reads around each pixel",
       choice(out.frame.fill, kSwitch), Use::kRare, "fill"},
      {"--kernel", group,
       "K as the lobe, which leaves the mirror direction at grazing angles, or centred on the mirror ray as Bastos et "
       "al. published it; not of lamps that a glossy reflector's maps leave out",
       choice(out.frame.kernel, kKernelPlaces), Use::kRare, "kernel"},
      {"--fresnel", group,
       "R from the exact table by angle, or from the sphere map at the reflected vectors of vertices, as Bastos et al. "
       "published it",
       choice(out.frame.reflectance, kReflectances), Use::kRare, "fresnel"},
      {"--sphere-cells", group,
       "Of --fresnel sphere: a reflector is divided into so many cells a side, at whose corners the sphere map is "
       "looked up",
       number(out.frame.sphere_cells, 1, 256), Use::kRare, "sphere_cells"},
  };
}

std::string settle_method(const Given& given, PlayArguments& out) {
  FrameOptions& frame = out.frame;
  if (out.method == ShownMethod::kBastos1999) {
    const auto clash = [&](const char* option, bool differs) { return given.has(option) && differs; };
    for (const auto& [option, differs] : {std::pair{"--reflections", frame.reflections != Reflections::kPoints},
                                          {"--blur", frame.blur == Blur::kDistance},
                                          {"--kernel", frame.kernel == KernelPlace::kLobe}})
      if (clash(option, differs)) return fmt::format("found {} of another method with --method bastos1999", option);
    frame.reflections = Reflections::kPoints;
    if (!given.has("--blur")) frame.blur = Blur::kConstant;
    if (!given.has("--fill")) frame.fill = false;
    if (!given.has("--fresnel")) frame.reflectance = Reflectance::kSphereMap;
    frame.kernel = KernelPlace::kCentred;
  }
  if (!frame.fill && frame.blur == Blur::kDistance)
    return "--fill off needs --blur constant or off: a blur by distance reads around each pixel";
  return {};
}

std::string method_of(const Pack& pack) {
  const Json provenance = Json::parse(pack.provenance).value_or(Json());  // a pack's text may be anything
  const Json& method = provenance["options"]["method"];
  return method.is_string() ? method.get<std::string>() : "";
}

std::string other_method(const Pack& pack, const PlayArguments& arguments) {
  const std::string baked = method_of(pack);
  if (arguments.method != ShownMethod::kBastos1999 || pack.reflectors.empty() || baked == "bastos1999") return {};
  return "the pack is not of oriel-bake --method bastos1999: its maps, kernels and sphere maps are not as published, "
         "and lamps are shown beside its maps";
}

}  // namespace oriel
