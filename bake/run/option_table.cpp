#include "bake/run/option_table.h"

#include "bake/jobs/memory.h"
#include "bake/run/option_values.h"
#include "bake/trace/virtual_lights.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr const char *kLightmap = "Lightmap", *kLight = "Light", *kReflections = "Reflections", *kMovers = "Movers",
                     *kScene = "Scene";

std::vector<Option> atlas_options(BakeOptions& o) {
  return {
      {"--texel", kLightmap,
       "Finest size of a lightmap texel on a surface. auto: 2.4° from where people see what they see, about 10 cm in "
       "rooms; what is far or unseen gets larger ones. Smaller texels show finer shadows. Time and size grow with the "
       "inverse square",
       or_auto(o.choose_texel, "LENGTH", quantity(o.atlas.texel_m, "", parse_length, length_text)), Use::kEveryday,
       "texel_m", "notes/atlas.md"},
      {"--atlas", kLightmap,
       "Where lightmap coordinates come from: auto (charts of our own) or uv1 (the artist's TEXCOORD_1: its charts, "
       "packed at --texel; what lacks them or overlaps gets charts of ours, with a warning)",
       choice(o.atlas.source, {{"auto", AtlasOptions::Source::kAuto}, {"uv1", AtlasOptions::Source::kUv1}}), Use::kRare,
       "atlas", "notes/atlas.md"},
      {"--resolution", kLightmap,
       "Side of the one lightmap page, in texels, that everything shall fit on. With --atlas uv1 coordinates of all "
       "that share a page without overlap stay as they are",
       number(o.atlas.resolution, 16, 16384), Use::kRare, "resolution"},
      {"--padding", kLightmap,
       "Texels between charts, at least. 2 keep them apart as they are, 5 in the first mip, 11 in the second",
       number(o.atlas.padding, 1, 64), Use::kRare, "padding"},
      {"--memory-limit", kLightmap,
       "Memory that the bake may take. With --texel auto what is seen least gets larger texels to keep it; a length "
       "that does not fit is an error that names one that does. Default: half of what is free",
       memory_limit(o), Use::kRare, "memory_limit"},
  };
}

std::vector<Option> radiosity_options(BakeOptions& o) {
  RadiosityOptions& r = o.radiosity;
  return {
      {"--error", kLightmap,
       "The error asked for, as people see it: root mean square over the pixels that eyes in the scene see, relative, "
       "dark ones to a tenth of the mean. Steps of 1 to 2 % are what one can just see. Work stops there. Where none is "
       "given, it also stops when a scene has had its share of rays (a minute or two), with the error stated then",
       quantity(r.error, "SHARE", parse_share, share_text), Use::kEveryday, "error", "oriel-bake.md#accuracy"},
      {"--time", kLightmap,
       "Wall clock of the whole bake. The lightmap is refined for what its other parts leave, reflections get fewer "
       "pixels where they would take half of it. With --error, whichever comes first. The pack then depends on the "
       "machine",
       quantity(o.time_s, "TIME", parse_duration, time_text), Use::kEveryday, "time_s",
       "pipelines.md#a-bake-within-a-time"},
      {"--samples", kLightmap,
       "Instead of --error: so many rays (cached) or paths (reference) a texel, best a power of two", samples(o),
       Use::kRare, "samples", "", "--error"},
      {"--verify", kLightmap,
       "After the lightmap, measure its error on held-out pixels by unbiased paths: with so many of the bake's rays, "
       "or off",
       quantity(r.verify, "off|SHARE", parse_verify, verify_text), Use::kRare, "verify"},
      {"--estimator", kLightmap,
       "How light is computed: cached (bounces kept in the lightmap, one final gather, filtered: some hundred times "
       "less work) or reference (unbiased paths from every texel, to check the other against)",
       choice(r.estimator, {{"cached", Estimator::kCached}, {"reference", Estimator::kReference}}), Use::kRare,
       "estimator", "notes/radiosity.md"},
      {"--bounces", kLightmap,
       "Count so many reflections only; 0: all of them. Fewer darken the scene; for comparing with bakers that stop "
       "there",
       number(r.bounces, 0, 4096), Use::kRare, "bounces"},
      {"--hidden-black", kLightmap,
       "Count the parts of texels that lie inside other geometry as black, as most bakers do, instead of leaving them "
       "out: dark rims, but comparable",
       hidden_black(o), Use::kRare, "hidden"},
      {"--texel-means", kLightmap,
       "Texels hold the mean of their light, as most bakers have it, instead of values whose interpolation has it when "
       "it is shown: softer penumbrae, but comparable texel by texel",
       texel_means(o), Use::kRare, "texel_values"},
      {"--detail", kLightmap,
       "Where light changes within texels, at contacts and edges of shadows, the cells between them are divided into "
       "up to so many steps a side; 1: never",
       detail_steps(o), Use::kRare, "detail", "notes/radiosity.md"},
      {"--directional", kLightmap,
       "Lightmaps that know where their light comes from, so that normal maps show: auto (where a material has a "
       "normal map), on, off. Costs a tenth more variance and about 4 bytes a texel",
       choice(o.directional, {{"auto", Directional::kAuto}, {"on", Directional::kOn}, {"off", Directional::kOff}}),
       Use::kRare, "directional", "notes/conventions.md"},
  };
}

std::vector<Option> reflection_options(BakeOptions& o) {
  return {
      {"--reflections", kReflections,
       "How planar reflectors show the scene: auto (each by the way whose frames are cheaper), geometry (the player "
       "draws the mirrored scene: nothing is baked for them), maps (radiance maps). --views and --map-resolution mean "
       "maps",
       choice(o.ways, {{"auto", WaysWanted::kAuto}, {"geometry", WaysWanted::kGeometry}, {"maps", WaysWanted::kMaps}}),
       Use::kEveryday, "reflections", "oriel-bake.md#reflections"},
      {"--target", kReflections, "What frames will be drawn on, which decides what is cheaper: cpu, gpu",
       choice(o.target, {{"cpu", DrawnOn::kCpu}, {"gpu", DrawnOn::kGpu}}), Use::kRare, "target",
       "oriel-bake.md#reflections"},
      {"--views", kReflections,
       "Viewpoints of radiance maps: at most so many for each 9 m² of a reflector, and 16 in all of an element, those "
       "that show most of what eyes see in it",
       number(o.planned.choice.max_maps, 1, 4096), Use::kRare, "views_per_element", "notes/reflections.md"},
      {"--memory", kReflections,
       "Limit of all radiance maps together, at 4 bytes a pixel; those that show least are left out to keep it",
       quantity(o.planned.memory_bytes, "SIZE", parse_bytes, bytes_text), Use::kEveryday, "map_memory"},
      {"--only", kReflections,
       "Bake only these, comma-separated: radiosity (always: all else shows its light), radiance (all "
       "reflectors, by geometry or maps), material (kernels), transfer (movers, which stand still without it)",
       parts(o), Use::kEveryday},
      {"--max-reflectors", kReflections, "Reflectors at most, the most visible first; each costs memory and frame time",
       number(o.reflectors.max_reflectors, 0, 4096), Use::kRare, "max_reflectors"},
      {"--eyes", kReflections,
       "Whose views texels and reflections are made for: walk (people on the floors that the cameras can walk to), box "
       "(anywhere in the scene), or a file with lines of x y z",
       eyes(o), Use::kRare, "", "notes/reflections.md"},
      {"--eye-height", kReflections,
       "How high people's eyes are over the floor, with which their steps, width and reach go. auto: 1.6 m, unless the "
       "scene's cameras or a guessed unit tell of larger or smaller people",
       or_auto(o.guess_eye_height, "LENGTH", quantity(o.eye_height_m, "", parse_length, length_text)), Use::kRare,
       "eye_height_m", "oriel-bake.md#eye-height"},
      {"--pvs", kReflections,
       "Find out which triangles can be seen from where people walk, so that the player draws no others: auto (in "
       "scenes of 500 000 triangles and more, where it leaves out a quarter), on, off",
       choice(o.visible_sets,
              {{"auto", VisibleSetsWanted::kAuto}, {"on", VisibleSetsWanted::kOn}, {"off", VisibleSetsWanted::kOff}}),
       Use::kRare, "visible_sets", "notes/visibility.md"},
      {"--orders", kReflections,
       "Mirrors that a reflection goes by: 1 shows a mirror in a mirror as its diffuse light only",
       number(o.sight.orders, 1, 16), Use::kRare, "orders"},
      {"--map-resolution", kReflections, "Longer side of a radiance map in pixels; 0 chooses as few as show it sharp",
       number(o.planned.map_resolution, 0, 4096), Use::kRare, "map_resolution"},
  };
}

std::vector<Option> transfer_options(BakeOptions& o) {
  return {
      {"--sh-bands", kMovers,
       "Bands of spherical harmonics of movers' transfer and of the light around them: their square is the number of "
       "coefficients",
       number(o.transfer.bands, 2, 6), Use::kRare, "sh_bands"},
      {"--probe", kMovers,
       "Distance between the probes of the light that movers meet; they are a quarter as far apart where light changes",
       quantity(o.probes.spacing_m, "LENGTH", parse_length, length_text), Use::kRare, "probe_m"},
  };
}

}  // namespace

BakeOptions command_line_defaults() {
  BakeOptions o;
  o.choose_texel = o.import.clear_sky = true;
  o.radiosity.estimator = Estimator::kCached;
  o.radiosity.samples = 0;
  o.radiosity.error = 0.02;
  o.radiosity.fit_texels = true;
  o.radiosity.detail = kMostCellSide;
  o.radiosity.sharp = true;
  return o;
}

std::vector<Option> light_options(ImportOptions& import) {
  return {
      {"--sky", kLight,
       "The sky: auto (a clear one to the file's sun, where it has one), none, radiance in cd/m² all around (one "
       "value, or R,G,B), or an HDRI: a latitude-longitude .hdr or .exr whose centre is +X and whose right is +Z, as "
       "in Blender",
       sky(import), Use::kEveryday},
      {"--day", kLight,
       "Sun and sky of a day and place, instead of a sky: date, degrees north and east, and where north is, degrees "
       "clockwise from -Z as seen from above. Each of --hours is a light group, which oriel-play --hour shows",
       day(import), Use::kEveryday, "day", "oriel-bake.md#sun-and-sky-by-the-hour", "--sky"},
      {"--hours", kLight,
       "Of --day: from, to and step in hours of solar time (12: the sun is in the meridian), or of a clock that is so "
       "far ahead of UTC, as 8-18/1+02:00; one hour alone as 14.5",
       hours(import), Use::kRare, "hours", "oriel-bake.md#sun-and-sky-by-the-hour", "", "--day"},
      {"--sky-type", kLight,
       "Of --day: 1 to 15 of ISO 15469 (CIE S 011), 1 to 5 being overcast, 6 to 10 partly cloudy, 11 to 15 clear; 16: "
       "the traditional overcast sky",
       number(import.day.sky_type, 1, 16), Use::kRare, "sky_type", "oriel-bake.md#sun-and-sky-by-the-hour", "",
       "--day"},
      {"--sky-scale", kLight, "Radiance in cd/m² of a 1 in the sky's file", number(import.sky_scale, 0, 1e30),
       Use::kRare, "sky_scale"},
      {"--sky-rotation", kLight, "Turns the sky's file, counter-clockwise seen from above, degrees",
       number(import.sky_rotation_deg, -360, 360), Use::kRare, "sky_rotation_deg"},
      {"--sun-angle", kLight,
       "How large directional lights appear, degrees across; 0: points. Otherwise as the file says "
       "(extras.oriel.angular_diameter_deg), or 0.53 as the sun",
       number(import.sun_angle_deg, 0, 180), Use::kRare, "sun_angle_deg"},
      {"--ies", kLight,
       "A measured luminaire (IES LM-63 of type C, or EULUMDAT) for the point or spot light of a node: it replaces "
       "intensity and "
       "cone, the colour stays. Nadir is the node's -Z, horizontal 0 its +X. May be repeated",
       profiles(import), Use::kRare, "ies"},
      {"--lamp-scale", kLight,
       "Multiplies the light of point and spot lights, or of the lights of that name (with * for any letters): 0.0015 "
       "takes back an exporter's 683 lm/W, 0.8 is a maintenance factor. May be repeated",
       light_scales(import.lamp_scales), Use::kRare, "lamp_scale", "oriel-bake.md#light"},
      {"--emission-scale", kLight,
       "Multiplies the emission of all materials, or of those of that name (with * for any letters). May be repeated",
       light_scales(import.emission_scales), Use::kRare, "emission_scale", "oriel-bake.md#light"},
  };
}

std::vector<Option> mover_options(ImportOptions& import) {
  return {
      {"--move", kMovers,
       "Puts a mover, or the middle of what shines of a node, there (world metres) and turns it about up by degrees, "
       "before anything is computed. May be repeated",
       moves(import.moves), Use::kRare, "moves", "oriel-play.md#moving-lamps-and-movers"}};
}

std::vector<Option> scene_options(ImportOptions& import, bool& reproducible) {
  return {
      {"--object", kScene,
       "What nodes of that name or path (with * for any letters), and all below them, are: mover, exclude, texel=2cm … "
       "Over what the file says. May be repeated",
       objects(import.objects), Use::kEveryday, "objects", "scenes.md#control-by-object"},
      {"--scene", kScene, "Which scene of the file; -1: its default", number(import.scene, -1, 1e9), Use::kRare,
       "scene_index"},
      {"--double-sided", kScene,
       "Every material reflects and emits on both sides, as renderers that know no single-sided ones have it: for "
       "models with walls turned the wrong way",
       flag(import.double_sided), Use::kRare, "double_sided"},
      {"--reproducible", kScene,
       "Pin Embree's instruction set, about 15 % slower: with one C library the same bytes on CPUs that differ in AVX "
       "only",
       flag(reproducible), Use::kRare, "reproducible"},
  };
}

Option unit_option(ImportOptions& import, bool& guess) {
  return {
      "--unit",
      kScene,
      "What a unit of the file is: auto (metres, as glTF has it, unless rooms are as high as towers or matchboxes), "
      "mm, cm, in, ft, m, km. Light on surfaces stays what it is",
      unit(import.unit_m, guess),
      Use::kRare,
      "unit_m",
      "scenes.md#units"};
}

std::vector<Option> bake_options(BakeOptions& o) {
  std::vector<Option> options = atlas_options(o);
  append(options, radiosity_options(o));
  append(options, light_options(o.import));
  options.push_back({"--light-groups", kLight,
                     "Lamps whose light is kept apart, so that the player switches, dims and colours them: marked (as "
                     "the file's nodes say, extras.oriel.light_group), off, auto (what hangs on one node), each (every "
                     "lamp), or a JSON file of groups and their nodes",
                     light_groups(o), Use::kEveryday, "light_groups", "oriel-bake.md#light-groups"});
  append(options, reflection_options(o));
  append(options, mover_options(o.import));
  append(options, transfer_options(o));
  options.push_back(unit_option(o.import, o.guess_unit));
  append(options, scene_options(o.import, o.reproducible));
  return options;
}

Status settle(BakeOptions& o, const Given& given) {
  RadiosityOptions& r = o.radiosity;
  o.given = given.typed();
  o.words = given.words(bake_options(o));
  o.error_named = given.has("--error");
  // Who says what maps are to be like wants maps.
  const bool maps_named = given.has("--views") || given.has("--map-resolution");
  if (maps_named && !given.has("--reflections")) o.ways = WaysWanted::kMaps;
  if (r.samples > 0) {
    r.error = 0;
  } else {
    r.samples = kMostTexelRays;
    if (!given.has("--error") && o.time_s > 0) r.error = kBestError;
    if (!given.has("--error") && o.time_s <= 0) r.most_rays = kDefaultMostRays;
  }
  if (!o.memory_given) o.memory_bytes = free_memory() / 2;
  const DayOptions& day = o.import.day;
  if (day.wanted && day.from_h < day.to_h && (r.estimator != Estimator::kCached || r.hidden == Hidden::kBlack))
    return fail(
        ErrorCode::kUsage, "--hours " + hours_text(day),
        "found several hours with {}, expected --estimator cached, which tells whose light it is; one hour goes "
        "with any",
        r.estimator != Estimator::kCached ? "another estimator" : "--hidden-black");
  const bool artist = o.atlas.source == AtlasOptions::Source::kUv1;
  if (!artist && o.atlas.resolution > 0 && given.has("--texel"))
    return fail(ErrorCode::kUsage, "",
                "found both --texel and --resolution, expected one: with --atlas auto each follows from the other");
  o.radiosity.dilation = std::max(o.radiosity.dilation, (o.atlas.padding + 1) / 2);
  return {};
}

std::string options_json(const BakeOptions& options, std::uint64_t seed) {
  BakeOptions o = options;
  Json json = {{"seed", seed}};
  for (const Option& option : bake_options(o)) record(option, json);
  json.update({{"most_rays", o.radiosity.most_rays},
               {"filter_scales", o.radiosity.filter.scales},
               {"filter_strength", o.radiosity.filter.strength},
               {"dilation", o.radiosity.dilation},
               {"max_reflector_roughness", o.reflectors.max_roughness},
               {"min_reflector_area_m2", o.reflectors.min_area_m2},
               {"element_m", o.planned.element_m},
               {"transfer_samples", o.transfer.samples}});
  return json.dump();  // names may hold any bytes
}

}  // namespace oriel
