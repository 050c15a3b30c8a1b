// The cache of finished units of work, as the bake, workers and verification take it.
#pragma once

#include <filesystem>
#include <memory>

#include "bake/cli/session.h"
#include "bake/jobs/unit_cache.h"
#include "bake/run/pipeline.h"

namespace oriel {

inline constexpr const char* kDefaultCache = ".oriel-cache";  // beside the pack

// The folder that finished units go to and come from. `folder` may be empty: that beside the pack.
std::unique_ptr<UnitCache> open_cache(std::filesystem::path folder, const BakeOptions& options, const Context& context);
void print_share(const UnitShare& share, const std::filesystem::path& folder, BakeSession& session);

}  // namespace oriel
