#include "bake/cli/farm/farm_arguments.h"

#include <set>

#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr const char* kWorkerFooter = R"(Example, on as many machines as there are, then on one of them:
  oriel-bake worker house.glb --cache /shared/cache --reproducible
  oriel-bake house.glb -o house.oriel --cache /shared/cache --reproducible

Takes the options of the bake; all must be given the same ones. Workers may join and leave at any time.)";

constexpr const char* kSubmitFooter = R"(Example:
  oriel-bake submit --slurm -N 8 house.glb -o house.oriel --cache /shared/cache --reproducible --error 1%

Takes the options of the bake. A worker that is cancelled, requeued or dead is replaced by the others, in the end by the
job that packs.)";

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

CLI::App* add_verify(CLI::App& app, BakeOptions& bake, CacheArguments& args, std::string& sample) {
  CLI::App* verify = app.add_subcommand(
      "verify", "Tells whether a pack is what a bake of the scene gives: bakes again out of the cache, a sample anew");
  verify->footer(
      "Takes the options that the pack was baked with. Exit code 0: the same bytes; 5: others.\n"
      "Without a cache everything is computed.");
  verify->add_option("PACK", bake.output, "The pack")->required();
  verify->add_option("SCENE", bake.scene, "The scene that it was baked of")->required();
  verify->add_option("--cache", args.folder, "Its cache. Default: .oriel-cache beside the pack")->type_name("DIR");
  verify->add_option("--sample", sample, "Share of the units in the cache that are computed again and compared")
      ->check([](const std::string& text) {
        const auto share = parse_fraction(text);
        return share ? std::string() : share.error().message;
      })
      ->capture_default_str();
  return verify;
}

CLI::App* add_submit(CLI::App& app, SubmitArguments& args) {
  CLI::App* submit = app.add_subcommand(
      "submit", "Gives a cluster's scheduler a bake: an array of workers, and a job that packs after them");
  submit->footer(kSubmitFooter);
  submit->add_option("SCENE", args.scene, "The scene, at a path that all machines know")->required();
  submit->add_option("-o,--output", args.output, "The pack to write")->required();
  submit->add_option("--cache", args.cache, "The folder that all machines share")->type_name("DIR")->required();
  submit->add_flag("--slurm")->description("The scheduler: Slurm (sbatch)")->required();
  submit->add_option("-N,--workers", args.workers, "Workers")->check(CLI::Range(1, 10000))->capture_default_str();
  submit->add_flag("--dry-run", args.dry_run, "Print the script that would be run");
  return submit;
}

bool is_of_bake(const CLI::Option& option) {
  static const std::set<std::string> kOwn = {"--help",    "SCENE",     "--output", "--cache",   "--slurm",
                                             "--workers", "--dry-run", "--quiet",  "--json-log"};
  return option.count() > 0 && !kOwn.contains(option.get_name());
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
