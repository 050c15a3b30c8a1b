#include "bake/cli/commands.h"
#include "bake/jobs/unit_cache.h"
#include "bake/run/option_values.h"
#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr const char* kCacheFooter = R"(Examples:
  oriel-bake cache .oriel-cache --list
  oriel-bake cache .oriel-cache --prune 10GiB     what was used longest ago goes first)";

struct CacheArguments {
  std::filesystem::path folder;
  bool list = false, prunes = false;
  std::uint64_t bytes = 0;  // to leave
};

Status run_cache(const CacheArguments& args) {
  const auto text = [](const CacheContent& content) {
    return fmt::format("{} units, {:.1f} MB", content.units, static_cast<double>(content.bytes) * 1e-6);
  };
  std::string line;
  if (args.prunes) {
    ORIEL_TRY(const CacheContent removed, prune_cache(args.folder, args.bytes));
    line = "removed " + text(removed) + "; left ";
  }
  ORIEL_TRY(const CacheContent left, cache_content(args.folder));
  return print(line + text(left) + "\n");
}

}  // namespace

ToolCommand cache_command(BakeSession&) {
  const auto args = std::make_shared<CacheArguments>();
  ToolCommand out{
      .name = "cache",
      .help = "Tells what a cache holds, or makes it smaller",
      .footer = kCacheFooter,
      .options = {{"DIR", "Arguments", "The folder of the cache", path(args->folder, "DIR"), Use::kRequired},
                  {"--list", "Run", "Print its units and bytes; so without --prune", flag(args->list), Use::kEveryday},
                  {"--prune", "Run", "Remove units until no more than that is left",
                   quantity(args->bytes, "SIZE", parse_bytes, bytes_text), Use::kEveryday, "", "", "--list"}}};
  out.settle = [args](const Given& given) -> Status {
    args->prunes = given.has("--prune");
    return {};
  };
  out.run = [args] { return run_cache(*args); };
  return out;
}

}  // namespace oriel
