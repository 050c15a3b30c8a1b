#include "bake/cli/farm/farm_arguments.h"

namespace oriel {
namespace {

constexpr const char* kWorkerFooter = R"(Example, on as many machines as there are, then on one of them:
  oriel-bake worker house.glb --cache /shared/cache --reproducible
  oriel-bake house.glb -o house.oriel --cache /shared/cache --reproducible

Takes the options of the bake; all must be given the same ones. Workers may join and leave at any time.)";

constexpr const char* kCacheFooter = R"(Examples:
  oriel-bake cache .oriel-cache --list
  oriel-bake cache .oriel-cache --prune 10GiB     what was used longest ago goes first)";

}  // namespace

void add_cache_options(CLI::App& app, CacheArguments& args) {
  auto* folder = app.add_option("--cache", args.folder,
                                "Folder of finished units of work: a bake that was killed, or is repeated after a "
                                "change, computes only what is not there. Default: .oriel-cache beside the pack")
                     ->type_name("DIR");
  app.add_flag("--no-cache", args.off, "Compute everything, and keep nothing but the pack")->excludes(folder);
}

CLI::App* add_worker(CLI::App& app, std::filesystem::path& scene, CacheArguments& args) {
  CLI::App* worker = app.add_subcommand(
      "worker", "Helps with the bake of a scene: computes units of work into a cache that machines share");
  worker->footer(kWorkerFooter);
  worker->add_option("SCENE", scene, "The scene: .glb, or .gltf with its buffers and textures")->required();
  worker->add_option("--cache", args.folder, "The folder that all workers and the bake share")
      ->type_name("DIR")
      ->required();
  return worker;
}

CLI::App* add_cache(CLI::App& app, PruneTexts& texts, PruneArguments& args) {
  CLI::App* cache = app.add_subcommand("cache", "Tells what a cache holds, or makes it smaller");
  cache->footer(kCacheFooter);
  cache->add_option("DIR", args.folder, "The folder of the cache")->required();
  auto* list = cache->add_flag("--list")->description("Print its units and bytes; so without --prune");
  cache->add_option("--prune", texts.size, "Remove units until no more than that is left")
      ->type_name("SIZE")
      ->excludes(list);
  return cache;
}

Status resolve_prune(const PruneTexts& texts, PruneArguments& args) {
  args.prunes = !texts.size.empty();
  if (!args.prunes) return {};
  ORIEL_TRY(args.bytes, parse_bytes(texts.size));
  return {};
}

}  // namespace oriel
