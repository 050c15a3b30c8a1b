#include <algorithm>

#include "bake/plan/doctor.h"
#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr int kKinds = static_cast<int>(FindingKind::kImport);

std::string trimmed(const std::string& text) {
  const std::size_t from = text.find_first_not_of(" \t\r");
  if (from == std::string::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r") + 1 - from);
}

bool is_kind(const std::string& name, FindingKind kind) {
  return lower_case(name) == name_of(kind) || lower_case(name) == fmt::format("d{}", static_cast<int>(kind));
}

Status add_allowed(const std::string& entry, std::vector<AllowedFinding>& out) {
  const std::string text = trimmed(entry);
  if (text.empty() || text[0] == '#') return {};
  const std::size_t colon = text.find(':');
  AllowedFinding allowed{trimmed(text.substr(0, colon))};
  if (colon != std::string::npos) allowed.object = trimmed(text.substr(colon + 1));
  std::vector<std::string> names;
  for (int k = 1; k <= kKinds; ++k) {
    if (is_kind(allowed.kind, static_cast<FindingKind>(k))) {
      out.push_back(std::move(allowed));
      return {};
    }
    names.emplace_back(name_of(static_cast<FindingKind>(k)));
  }
  return fail(ErrorCode::kUsage, "",
              "found '{}', expected the kind of a finding, as D4 or \"one-sided wall:Curtain*\"; the "
              "nearest are {}",
              allowed.kind, names_like(allowed.kind, names));
}

}  // namespace

Result<std::vector<AllowedFinding>> parse_allowed(const std::string& text) {
  std::string list = text;
  char between = ',';
  if (text.starts_with("@")) {
    ORIEL_TRY(const Bytes file, read_file(text.substr(1)));
    list.assign(reinterpret_cast<const char*>(file.data()), file.size());
    between = '\n';
  }
  std::vector<AllowedFinding> out;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(between, at), list.size());
    ORIEL_TRY_VOID(add_allowed(list.substr(at, end - at), out));
    at = end + 1;
  }
  return out;
}

bool is_allowed(const Finding& finding, std::span<const AllowedFinding> allowed) {
  return std::any_of(allowed.begin(), allowed.end(), [&](const AllowedFinding& a) {
    return is_kind(a.kind, finding.kind) && fits_pattern(a.object, finding.object);
  });
}

FindingSeverity severity_of(FindingKind kind) {
  switch (kind) {
    case FindingKind::kOneSidedWall:
    case FindingKind::kLightmapUv:
    case FindingKind::kNoLight:
      return FindingSeverity::kError;
    case FindingKind::kFlippedNormals:
    case FindingKind::kAlbedo:
    case FindingKind::kLightUnits:
    case FindingKind::kFarFromOrigin:
    case FindingKind::kTexelDensity:
      return FindingSeverity::kWarning;
    case FindingKind::kDegenerate:
    case FindingKind::kImport:
      break;
  }
  return FindingSeverity::kNote;
}

const char* name_of(FindingSeverity severity) {
  return severity == FindingSeverity::kError ? "error" : severity == FindingSeverity::kWarning ? "warning" : "note";
}

}  // namespace oriel
