#include "bake/cache/unit_cache.h"
#include "bake/cli/farm/farm_arguments.h"
#include "formats/core/file.h"

namespace oriel {

Status run_cache(const PruneArguments& args) {
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

}  // namespace oriel
