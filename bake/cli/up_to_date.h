// Whether a pack is what a bake would make, without baking: by what it says it was made of.
#pragma once

#include "bake/run/options.h"
#include "formats/core/json.h"

namespace oriel {

class Context;

// What a pack says of itself. All checksums are checked. Errors kIo, kInvalid.
struct PackRecords {
  Json provenance, plan;
};
Result<PackRecords> read_records(const std::filesystem::path& pack);

// The provenance that a bake would give a pack, of all files that the scene may read.
Result<Json> wanted_provenance(const BakeOptions& options, Context& context);

// "options.error (0.02, not 0.01)": what two provenances differ in but the build, names in order; empty: in nothing.
// Of the second's inputs the first may lack some.
std::string provenance_difference(const Json& found, const Json& wanted);

// Of that build, whole, and with all of `met`.
bool is_up_to_date(const PackRecords& pack, const Json& wanted, const std::vector<std::string>& met);

}  // namespace oriel
