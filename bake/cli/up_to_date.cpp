#include "bake/cli/up_to_date.h"

#include <algorithm>

#include "bake/jobs/context.h"
#include "bake/run/report.h"
#include "formats/core/file.h"
#include "formats/pack/index.h"

namespace oriel {
namespace {

bool holds(const Json& list, const Json& value) {
  return std::any_of(list.begin(), list.end(), [&](const Json& one) { return one == value; });
}

}  // namespace

Result<PackRecords> read_records(const std::filesystem::path& path) {
  ORIEL_TRY(const MappedFile file, MappedFile::open(path));
  ORIEL_TRY(const PackIndex index, read_index(file.bytes()));
  PackRecords records;
  for (const SectionInfo& section : index.sections) {
    ORIEL_TRY_VOID(check_section(file.bytes(), section));
    if (section.kind != kProvenanceSection && section.kind != kPlanSection) continue;
    ORIEL_TRY(const RawBytes text, section_bytes(file.bytes(), section));
    ORIEL_TRY((section.kind == kPlanSection ? records.plan : records.provenance),
              Json::parse(text.span(), path.string()));
  }
  return records;
}

Result<Json> wanted_provenance(const BakeOptions& options, Context& context) {
  ORIEL_TRY(const auto inputs, hash_inputs(options.scene, options.import, context));
  return Json::parse(provenance_json(options, context.seed, inputs));
}

std::string provenance_difference(const Json& found, const Json& wanted) {
  std::string text;
  const auto tell = [&](const std::string& name, const Json& was, const Json& is) {
    add_word(text, fmt::format("{} ({}, not {})", name, was.dump(), is.dump()), ", ");
  };
  for (const auto& [name, value] : wanted["options"].items())
    if (const Json& was = found["options"][name]; was != value) tell("options." + name, was, value);
  for (const Json& input : found["inputs"])
    if (!holds(wanted["inputs"], input)) add_word(text, "the file " + input.value("name", ""), ", ");
  if (found["version"] != wanted["version"]) tell("version", found["version"], wanted["version"]);
  return text;
}

bool is_up_to_date(const PackRecords& pack, const Json& wanted, const std::vector<std::string>& met) {
  return pack.provenance["build"] == wanted["build"] && provenance_difference(pack.provenance, wanted).empty() &&
         pack.plan["shortfalls"].empty() &&
         std::ranges::all_of(met, [&](const std::string& one) { return holds(pack.plan["met"], one); });
}

}  // namespace oriel
