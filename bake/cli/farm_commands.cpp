// Commands for bakes that machines share: worker, verify and key.
#include <random>

#include "bake/cli/cache_options.h"
#include "bake/cli/commands.h"
#include "bake/cli/up_to_date.h"
#include "bake/jobs/checking_store.h"
#include "bake/run/option_table.h"
#include "bake/run/option_values.h"
#include "formats/core/file.h"
#include "formats/pack/reader.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

constexpr const char* kWorkerFooter = R"(Example, on as many machines as there are, then on one of them:
  oriel-bake worker house.glb --cache /shared/cache --reproducible
  oriel-bake house.glb -o house.oriel --cache /shared/cache --reproducible

Takes the options of the bake; all must be given the same ones. Workers may join and leave at any time.)";

struct FarmArguments {
  BakeOptions bake = command_line_defaults();
  std::filesystem::path cache;
  double sample = 0.01;  // verify: of the units in the cache that are computed again
};

// Computes what a bake would, for those who share the cache.
Status run_worker(const FarmArguments& args, BakeSession& session) {
  const auto cache = open_cache(args.cache, args.bake, session.context);
  session.context.units = cache.get();
  ORIEL_TRY_VOID(bake(args.bake, session.context));
  print_share(cache->share(), args.cache, session);
  return {};
}

// Bakes again, mostly from the cache, and compares.
Status run_verify(const FarmArguments& args, BakeSession& session) {
  const std::filesystem::path& pack = args.bake.output;
  ORIEL_TRY(const Bytes written, read_file(pack));
  ORIEL_TRY(const Pack before, decode_pack(written));
  const auto cache = open_cache(args.cache, args.bake, session.context);
  CheckingStore checking(*cache, args.sample, std::random_device()());
  session.context.units = &checking;
  ORIEL_TRY(BakeResult again, bake(args.bake, session.context));
  session.note(fmt::format("{} of {} units were found in {}; {} that are there were computed again: {} differ",
                           again.units.reused - checking.checked(), again.units.units(), cache->folder().string(),
                           checking.checked(), checking.differing()));
  const std::string difference = provenance_difference(Json::parse(before.provenance).value_or(Json()),
                                                       Json::parse(again.pack.provenance).value());
  if (!difference.empty())
    return fail(ErrorCode::kDifferent, pack.string(), "differs from that bake in {}", difference);
  again.pack.provenance = before.provenance;
  Json plan = Json::parse(before.plan).value(), plan_now = Json::parse(again.pack.plan).value();
  // What was asked of the bake is none of its result, nor is what was told of options, by who gave them.
  for (const char* told : {"met", "shortfalls", "warnings"}) plan.erase(told), plan_now.erase(told);
  again.pack.plan = before.plan;
  ORIEL_TRY(const Bytes bytes, encode_pack(again.pack));
  if (checking.differing() > 0 || plan != plan_now || bytes != written)
    return fail(ErrorCode::kDifferent, pack.string(),
                "found other bytes than a bake of {} gives now, expected the same", args.bake.scene.string());
  return print("the same\n");
}

// Sets the options that the pack was baked with, but those that are given.
Status take_options(const PackRecords& pack, FarmArguments& args, BakeSession& session, Given& given) {
  const Json& words = pack.provenance["given"];
  std::map<std::string, Given::Texts> found;
  const auto options = bake_options(args.bake);
  const auto word = [&](std::size_t i) {
    return words.is_array() && i < words.size() && words[i].is_string() ? words[i].get<std::string>() : "";
  };
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string name = word(i);
    const auto option = std::ranges::find(options, name, long_name);
    if (option == options.end()) return fail(ErrorCode::kInvalid, name, "is no option of this version");
    const std::string text = option->value.type.empty() ? "" : word(++i);
    if (given.has(name)) continue;
    ORIEL_TRY_VOID(option->value.set(text));
    found[name].texts.push_back(text);
  }
  for (auto& [name, texts] : found) given.add(name, {Source::kPreset, std::move(texts.texts)});
  if (!given.has("--seed")) session.seed = pack.provenance["options"].value("seed", session.seed);
  return {};
}

// The hash of all that a bake's result follows from.
Status print_key(const FarmArguments& args, BakeSession& session) {
  ORIEL_TRY(Json wanted, wanted_provenance(args.bake, session.context));
  wanted.erase("given");  // other words for the same options
  wanted["instruction_sets"] = instruction_sets(args.bake.reproducible);
  const std::string text = wanted.dump();
  return print(hash128_hex(std::as_bytes(std::span(text))) + "\n");
}

}  // namespace

std::unique_ptr<UnitCache> open_cache(std::filesystem::path folder, const BakeOptions& options,
                                      const Context& context) {
  if (folder.empty()) folder = options.output.parent_path() / kDefaultCache;
  return std::make_unique<UnitCache>(folder, program_identity() + instruction_sets(options.reproducible), context.warn);
}

void print_share(const UnitShare& share, const std::filesystem::path& folder, BakeSession& session) {
  session.note(fmt::format("reused {} of {} units ({:.0f} % of the work) in {}", share.reused, share.units(),
                           100 * share.work(), folder.string()));
}

ToolCommand worker_command(BakeSession& session) {
  const auto args = std::make_shared<FarmArguments>();
  ToolCommand out{.name = "worker",
                  .help = "Helps with the bake of a scene: computes units of work into a cache that machines share",
                  .footer = kWorkerFooter,
                  .options = {scene_argument(args->bake.scene),
                              {"--cache", "Run", "The folder that all workers and the bake share",
                               path(args->cache, "DIR"), Use::kRequired}}};
  append(out.options, bake_options(args->bake));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return run_worker(*args, session); };
  return out;
}

ToolCommand verify_command(BakeSession& session) {
  const auto args = std::make_shared<FarmArguments>();
  ToolCommand out{
      .name = "verify",
      .help = "Tells whether a pack is what a bake of the scene gives: bakes again out of the cache, a sample anew",
      .footer =
          "Bakes with the pack's own options, and those that are given. Exit code 0: the same bytes; 5: others.\n"
          "Without a cache everything is computed.",
      .options = {
          {"PACK", "Arguments", "The pack", path(args->bake.output, "PACK"), Use::kRequired},
          {"SCENE", "Arguments", "The scene that it was baked of", path(args->bake.scene, "SCENE"), Use::kRequired},
          {"--cache", "Run", "Its cache. Default: .oriel-cache beside the pack", path(args->cache, "DIR"),
           Use::kEveryday},
          {"--sample", "Run", "Share of the units in the cache that are computed again and compared",
           quantity(args->sample, "SHARE", parse_share, share_text), Use::kEveryday}}};
  append(out.options, bake_options(args->bake));
  append(out.options, run_options(session));
  out.settle = [args, &session](Given given) -> Status {
    if (const auto pack = read_records(args->bake.output)) ORIEL_TRY_VOID(take_options(*pack, *args, session, given));
    return settle(args->bake, given);
  };
  out.run = [args, &session] { return run_verify(*args, session); };
  return out;
}

ToolCommand key_command(BakeSession& session) {
  const auto args = std::make_shared<FarmArguments>();
  ToolCommand out{.name = "key",
                  .help = "Prints the hash of all that a bake would follow from: files, options, seed, program",
                  .footer = "The same key, the same pack (but for --time): a build system need not bake again.",
                  .options = {scene_argument(args->bake.scene)}};
  append(out.options, bake_options(args->bake));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle(args->bake, given); };
  out.run = [args, &session] { return print_key(*args, session); };
  return out;
}

}  // namespace oriel
