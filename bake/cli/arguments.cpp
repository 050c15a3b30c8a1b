#include "bake/cli/arguments.h"

#include "bake/cli/lux_arguments.h"
#include "bake/cli/render_arguments.h"
#include "bake/jobs/memory.h"
#include "bake/run/version.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-bake house.glb -o house.oriel                      sensible defaults: 10 cm texels, 2 % error, reflections
  oriel-bake house.glb -o house.oriel --texel 5cm --error 1%         finer, with half the error
  oriel-bake house.gltf -o house.oriel --atlas uv1 --resolution 512  the artist's own lightmap coordinates
  oriel-bake house.glb -o house.oriel --sky noon.exr --sky-scale 1000 --ies "lamp=downlight.ies"  measured light
  oriel-bake house.glb -o house.oriel --only radiosity     no radiance maps: a small pack without mirror images
  oriel-bake plan house.glb                                what that would do and cost, and what looks wrong

Exit codes: 0 done (after one interrupt with what was there), 1 usage, 2 a file cannot be read or written, 3 invalid input,
4 failed at run time, 5 findings with --strict or other bytes with verify, 6 the pack was written without a part that failed its checks,
130 stopped by the user before there was a first estimate, or by a
second interrupt (nothing half-written is left).)";

struct Texts {
  std::string texel = "auto", unit = "auto", memory = "128MiB", memory_limit, views = "planned:8", eyes = "walk",
              pvs = "auto", directional = "auto", atlas = "auto", only, estimator = "cached", error = "2%",
              verify = "10%", time, reuse, transfer = "shadowed", probe = "1m";
  std::uint32_t samples = 0;
  int resolution = 0;
  CLI::Option *texel_option = nullptr, *error_option = nullptr;
};

void add_atlas_options(CLI::App& app, Texts& texts, BakeOptions& bake) {
  app.add_option("--atlas", texts.atlas,
                 "Where lightmap coordinates come from: auto (charts of our own) or uv1 (the artist's TEXCOORD_1)")
      ->check(CLI::IsMember({"auto", "uv1"}))
      ->capture_default_str();
  auto* texel =
      app.add_option("--texel", texts.texel,
                     "Finest size of a lightmap texel on a surface: a length, or auto, 2.4° from where people see "
                     "what they see (about 10 cm in rooms). What is far or unseen gets larger ones. Smaller "
                     "shows finer shadows; time and size grow with its inverse square")
          ->check(checked(parse_texel, "auto|LENGTH"))
          ->capture_default_str();
  app.add_option("--resolution", texts.resolution,
                 "Side of the lightmap page in texels: with --atlas uv1 the page the coordinates are meant for, with "
                 "auto the page that everything shall fit on")
      ->check(CLI::Range(16, 16384));
  texts.texel_option = texel;
  app.add_option("--max-page", bake.atlas.max_page,
                 "Largest side of an automatic page; GPUs guarantee 2048, nearly all have 16384")
      ->check(CLI::Range(64, 16384))
      ->capture_default_str();
  app.add_option("--memory-limit", texts.memory_limit,
                 "Memory that the bake may take. With --texel auto what is seen least gets larger texels to keep it; a "
                 "length that does not fit is an error that says which one does. Default: half of what is free")
      ->check(checked(parse_bytes, "SIZE"));
  app.add_option("--unit", texts.unit,
                 "What a unit of the file is: auto (metres, as glTF has it, unless rooms are as high as towers or "
                 "matchboxes), mm, cm, in, ft, m, km. Light on surfaces stays what it is")
      ->check(checked(parse_unit, "UNIT"))
      ->capture_default_str();
  app.add_option("--atlas-time-limit", bake.atlas.time_limit_s,
                 "Seconds after which what is left gets plain charts; the pack then depends on the machine. 0: none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void add_radiosity_options(CLI::App& app, Texts& texts, BakeOptions& bake) {
  app.add_option(
         "--estimator", texts.estimator,
         "How light is computed: cached (bounces kept in the lightmap, one final gather, filtered: some hundred "
         "times less work) or reference (unbiased paths from every texel, to check the other against)")
      ->check(CLI::IsMember({"cached", "reference"}))
      ->capture_default_str();
  auto* error =
      app.add_option(
             "--error", texts.error,
             "The error asked for, as people see it: root mean square over the pixels that eyes in the "
             "scene see, relative, dark ones to a tenth of the mean. Work stops there; where none is given, also when "
             "a scene has had its share of rays (a minute or two), with the error that is stated then")
          ->check(checked(parse_fraction, "SHARE"))
          ->capture_default_str();
  texts.error_option = error;
  app.add_option(
         "--time", texts.time,
         "Wall clock of the whole bake. The lightmap is refined for what its other parts leave, reflections get "
         "fewer pixels where they would take half of it; with --error, whichever comes first. The pack then "
         "depends on the machine")
      ->check(checked(parse_duration, "TIME"));
  app.add_option(
         "--verify", texts.verify,
         "After the lightmap, measure its error on held-out pixels by unbiased paths: with so many of the bake's "
         "rays, or off. What misses --error by a tenth is refined")
      ->check(checked(parse_verify, "SHARE|off"))
      ->capture_default_str();
  app.add_option("--reuse-error", texts.reuse,
                 "After an edit of the scene: keep the light and the radiance maps of the last whole bake in the "
                 "cache, with these options, where the edit changes them by no more than that, relative; the error "
                 "that this brings is measured and stated. The pack then depends on the cache. Default: all is baked")
      ->check(checked(parse_fraction, "SHARE"));
  app.add_option("--samples", texts.samples,
                 "Instead of --error: so many rays (cached) or paths (reference) a texel, best a power of two")
      ->check(CLI::Range(1u, 1u << 24))
      ->excludes(error);
  app.add_option(
         "--bounces", bake.radiosity.bounces,
         "Count so many reflections only; 0: all of them. Fewer darken the scene; for comparing with bakers that "
         "stop there")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_flag_callback(
      "--hidden-black", [&bake] { bake.radiosity.hidden = Hidden::kBlack; },
      "Count the parts of texels that lie inside other geometry as black, as most bakers do, instead of leaving them "
      "out: dark rims, but comparable");
  bake.radiosity.fit_texels = true;
  app.add_flag("!--texel-means", bake.radiosity.fit_texels,
               "Texels hold the mean of their light, as most bakers have it, instead of values whose interpolation has "
               "it when it is shown: softer penumbrae, but comparable texel by texel");
  bake.radiosity.detail = kMostDetail;
  app.add_option("--detail", bake.radiosity.detail,
                 "Where light changes within texels, at contacts and edges of shadows, the cells between them are "
                 "divided into up to so many steps a side; 1: never")
      ->check(CLI::IsMember({1, 2, 4, 8}))
      ->capture_default_str();
  app.add_option("--directional", texts.directional,
                 "Lightmaps that know where their light comes from, so that normal maps show: auto (where a material "
                 "has a normal map), on, off. Costs a tenth more variance and about 4 bytes a texel")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
}

void add_reflection_options(CLI::App& app, Texts& texts, BakeOptions& bake) {
  app.add_option("--only", texts.only,
                 "Bake only these, comma-separated: radiosity (always: all else shows its light), radiance (maps "
                 "behind reflectors), material (kernels), transfer (movers, which stand still without it)")
      ->type_name("LIST");
  app.add_option("--max-reflectors", bake.reflectors.max_reflectors,
                 "Planar reflectors that get radiance maps, the most visible first; each costs memory and frame time")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option(
         "--views", texts.views,
         "Viewpoints of radiance maps: planned:N are at most N for each 9 m² of a reflector, and 15 in all of an "
         "element, those that show most of what eyes see in it; hemisphere:N are spread evenly, as published")
      ->capture_default_str();
  app.add_option(
         "--eyes", texts.eyes,
         "Whose views reflections are planned for: walk (people on the floors that the cameras can walk to), box "
         "(anywhere in the scene), or a file with lines of x y z")
      ->capture_default_str();
  app.add_option(
         "--pvs", texts.pvs,
         "Find out which triangles can be seen from where people walk, so that the player draws no others: auto "
         "(in scenes of 500 000 triangles and more, where it leaves out a quarter), on, off")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
  app.add_option("--orders", bake.sight.orders,
                 "Mirrors that a reflection goes by: 1 shows a mirror in a mirror as its diffuse light only")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  app.add_option("--map-resolution", bake.views.map_resolution,
                 "Longer side of a radiance map in pixels; 0 chooses as few as show it sharp (planned), or by the "
                 "material's lobe")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--map-price", bake.planned.pixel_price,
                 "What a pixel of a radiance map must show to be captured: solid angle, sr on average over eyes, times "
                 "reflectance (planned); less gives more and sharper maps, 0 all that show anything")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option(
         "--memory", texts.memory,
         "Limit of all radiance maps together, at 4 bytes a pixel; those that show least are left out to keep it")
      ->check(checked(parse_bytes, "SIZE"))
      ->capture_default_str();
}

void add_mover_options(CLI::App& app, Texts& texts, BakeOptions& bake) {
  app.add_option("--sh-bands", bake.transfer.bands,
                 "Bands of spherical harmonics of movers' transfer and of the light around them: their square is the "
                 "number of coefficients")
      ->check(CLI::Range(2, 6))
      ->capture_default_str();
  app.add_option("--transfer", texts.transfer,
                 "Whether movers shade themselves: shadowed or unshadowed (as if every one was convex)")
      ->check(CLI::IsMember({"shadowed", "unshadowed"}))
      ->capture_default_str();
  app.add_option("--transfer-bounces", bake.transfer.bounces, "Reflections between the parts of a mover")
      ->check(CLI::Range(0, 16))
      ->capture_default_str();
  app.add_option("--clusters", bake.compress.clusters,
                 "Clusters that a mover's transfer is compressed in: more lose less and cost the player more")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--probe", texts.probe,
                 "Distance between the probes of the light that movers meet; they are a quarter as far apart where "
                 "light changes")
      ->check(checked(parse_length, "LENGTH"))
      ->capture_default_str();
}

Status resolve(const Texts& texts, Arguments& args) {
  BakeOptions& bake = args.bake;
  ORIEL_TRY(bake.probes.spacing_m, parse_length(texts.probe));
  bake.transfer.shadowed = texts.transfer == "shadowed";
  if (!bake.transfer.shadowed) bake.transfer.bounces = 0;
  bake.choose_texel = texts.texel == "auto";
  if (!bake.choose_texel) {
    ORIEL_TRY(bake.atlas.texel_m, parse_length(texts.texel));
  }
  bake.guess_unit = texts.unit == "auto";
  if (!bake.guess_unit) {
    ORIEL_TRY(bake.import.unit_m, parse_unit(texts.unit));
  }
  ORIEL_TRY(bake.views.memory_bytes, parse_bytes(texts.memory));
  bake.planned.memory_bytes = bake.views.memory_bytes;
  bake.planned.map_resolution = bake.views.map_resolution;
  if (const Status views = parse_views(texts.views, bake); !views)
    return fail(ErrorCode::kUsage, "--views", "{}", views.error().message);
  ORIEL_TRY(bake.eyes, parse_eye_source(texts.eyes));
  bake.visible_sets = texts.pvs == "on"    ? VisibleSetsWanted::kOn
                      : texts.pvs == "off" ? VisibleSetsWanted::kOff
                                           : VisibleSetsWanted::kAuto;
  ORIEL_TRY(bake.radiosity.verify, parse_verify(texts.verify));
  if (!texts.reuse.empty()) {
    ORIEL_TRY(bake.radiosity.reuse_error, parse_fraction(texts.reuse));
  }
  bake.radiosity.estimator = texts.estimator == "cached" ? Estimator::kCached : Estimator::kReference;
  if (texts.samples > 0) {
    bake.radiosity.samples = texts.samples;
    bake.radiosity.error = 0;
  } else if (!texts.time.empty()) {
    ORIEL_TRY(bake.time_s, parse_duration(texts.time));
    bake.radiosity.error = kBestError;
    if (texts.error_option->count() > 0) {
      ORIEL_TRY(bake.radiosity.error, parse_fraction(texts.error));
    }
    bake.radiosity.samples = kMostTexelRays;
  } else {
    ORIEL_TRY(bake.radiosity.error, parse_fraction(texts.error));
    bake.radiosity.samples = most_texel_rays(bake.radiosity);
    if (texts.error_option->count() == 0) bake.radiosity.most_rays = kDefaultMostRays;
  }
  bake.memory_given = !texts.memory_limit.empty();
  if (bake.memory_given) {
    ORIEL_TRY(bake.memory_bytes, parse_bytes(texts.memory_limit));
  } else {
    bake.memory_bytes = free_memory() / 2;
  }
  bake.atlas.resolution = texts.resolution;
  bake.directional = texts.directional == "on"    ? Directional::kOn
                     : texts.directional == "off" ? Directional::kOff
                                                  : Directional::kAuto;
  if (texts.atlas == "auto" && texts.resolution > 0 && texts.texel_option->count() > 0)
    return fail(ErrorCode::kUsage, "",
                "found both --texel and --resolution, expected one: with --atlas auto each follows from the other");
  if (texts.atlas == "uv1") {
    bake.atlas.source = AtlasOptions::Source::kUv1;
    if (texts.resolution == 0)
      return fail(ErrorCode::kUsage, "--atlas uv1",
                  "needs --resolution N, the side of the page its coordinates are meant for");
  }
  if (!texts.only.empty()) {
    bake.with_radiance = bake.with_material = bake.with_transfer = false;
    for (const std::string& part : CLI::detail::split(texts.only, ',')) {
      if (part == "radiance")
        bake.with_radiance = true;
      else if (part == "material")
        bake.with_material = true;
      else if (part == "transfer")
        bake.with_transfer = true;
      else if (part != "radiosity")
        return fail(ErrorCode::kUsage, "--only", "found '{}', expected radiosity, radiance, material or transfer",
                    part);
    }
  }
  return {};
}

Status resolve_verify(const Texts& texts, const std::string& sample, Arguments& args) {
  ORIEL_TRY_VOID(resolve(texts, args));
  ORIEL_TRY(args.verify.sample, parse_fraction(sample));
  return {};
}

// Words of all options that the workers and the bake take.
Status resolve_submit(const CLI::App& submit, Arguments& args) {
  for (const CLI::Option* option : submit.get_options())
    if (is_of_bake(*option))
      for (std::string& word : as_typed(*option)) args.submit.forwarded.push_back(std::move(word));
  return {};
}

// The bake's options as its subcommands take them.
void add_bake_options(CLI::App& app, Texts& texts, SharedTexts& shared, Arguments& args) {
  add_atlas_options(app, texts, args.bake);
  add_radiosity_options(app, texts, args.bake);
  add_light_options(app, shared, args);
  add_reflection_options(app, texts, args.bake);
  add_mover_option(app, args);
  add_mover_options(app, texts, args.bake);
}

// With a subcommand no option of the bake means anything; without one SCENE and -o must be there.
void require_bake_arguments(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  if (commands.empty())
    for (const char* name : {"SCENE", "--output"})
      if (app.get_option(name)->count() == 0) throw CLI::RequiredError(name);
  if (!commands.empty())
    for (const CLI::Option* option : app.get_options())
      if (option->count() > 0) throw CLI::ExcludesError(commands[0]->get_name(), option->get_name());
}

}  // namespace

Arguments parse_arguments(int argc, char** argv) {
  Arguments args;
  Texts texts;
  SharedTexts shared;
  LuxTexts lux_texts;
  RenderTexts render_texts;
  MaterialTexts material_texts;
  TradeTexts trade_texts;
  CLI::App app(
      "Bakes the light of a glTF 2.0 scene into one .oriel pack: radiosity textures with their error, radiance maps\n"
      "with depth behind planar reflectors, BRDF kernels and Fresnel maps. Play it with oriel-play, look into it with "
      "oriel-inspect.",
      "oriel-bake");
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("oriel-bake ") + kVersion);
  // CLI11's required() would be asked for with the subcommand too: require_bake_arguments() stands in for it.
  app.add_option("SCENE", args.bake.scene, "The scene: .glb, or .gltf with its buffers and textures");
  app.add_option("-o,--output", args.bake.output, "The pack to write. It appears whole or not at all");
  add_bake_options(app, texts, shared, args);
  add_cache_options(app, args.cache);
  app.add_option("--report", args.report, "Write what was done, omitted, measured and how long it took, as JSON");
  app.add_flag("--strict", args.strict,
               "Exit code 5 where something is found to be likely wrong with the light, such as an energy ledger that "
               "does not close. The pack is written all the same");
  add_run_options(app, shared, args);
  const CLI::App* lux = add_lux(app, lux_texts, shared, args);
  const CLI::App* render = add_render(app, render_texts, shared, args);
  add_material(app, material_texts, args.material);
  CLI::App* plan = add_plan(app, args.bake.scene, args.plan);
  Texts plan_texts;
  add_bake_options(*plan, plan_texts, shared, args);
  add_run_options(*plan, shared, args);
  struct {
    Texts bake;
    std::string sample = "1%";
  } texts_of_verify;
  CLI::App* worker = add_worker(app, args.bake.scene, args.cache);
  Texts worker_texts;
  add_bake_options(*worker, worker_texts, shared, args);
  add_run_options(*worker, shared, args);
  CLI::App* verify = add_verify(app, args.bake, args.cache, texts_of_verify.sample);
  add_bake_options(*verify, texts_of_verify.bake, shared, args);
  add_run_options(*verify, shared, args);
  CLI::App* submit = add_submit(app, args.submit);
  Texts submit_texts;
  add_bake_options(*submit, submit_texts, shared, args);
  add_run_options(*submit, shared, args);
  PruneTexts prune_texts;
  const CLI::App* cache = add_cache(app, prune_texts, args.prune);
  CLI::App* trade = add_trade(app, trade_texts, args.trade);
  add_light_options(*trade, shared, args);
  add_mover_option(*trade, args);
  add_run_options(*trade, shared, args);
  app.require_subcommand(0, 1);
  try {
    app.parse(argc, argv);
    args.wants_lux = lux->parsed();
    args.render.wanted = render->parsed();
    args.plan.wanted = plan->parsed();
    args.trade.wanted = trade->parsed();
    args.works = worker->parsed();
    args.prune.wanted = cache->parsed();
    args.verify.wanted = verify->parsed();
    args.submit.wanted = submit->parsed();
    require_bake_arguments(app);
  } catch (const CLI::ParseError& error) {
    args.exit_code = app.exit(error) == 0 ? 0 : 1;
    return args;
  }
  Status resolved = resolve_shared(shared, args);
  if (resolved) resolved = resolve_material(material_texts, args.material);
  if (resolved && !args.material.wanted)
    resolved = args.wants_lux       ? resolve_lux(lux_texts, args)
               : args.prune.wanted  ? resolve_prune(prune_texts, args.prune)
               : args.works         ? resolve(worker_texts, args)
               : args.submit.wanted ? resolve_submit(*submit, args)
               : args.verify.wanted ? resolve_verify(texts_of_verify.bake, texts_of_verify.sample, args)
               : args.render.wanted ? resolve_render(render_texts, args)
               : args.trade.wanted  ? resolve_trade(trade_texts, args.seed, args.trade)
                                    : resolve(args.plan.wanted ? plan_texts : texts, args);
  if (!resolved) {
    std::fprintf(stderr, "oriel-bake: %s\n", resolved.error().text().c_str());
    args.exit_code = 1;
  }
  return args;
}

}  // namespace oriel
