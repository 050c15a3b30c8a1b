#include <fmt/format.h>

#include <optional>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {
namespace {

void print_text(const std::vector<Issue>& issues, std::size_t errors) {
  for (const auto& issue : issues)
    fmt::print("{} {}: {}: {}\n", issue.severity == Severity::kError ? "error" : "warning", issue.number, issue.section,
               issue.message);
  if (errors == 0)
    fmt::print("valid{}\n", issues.empty() ? "" : fmt::format(" ({} warnings)", issues.size()));
  else
    fmt::print("invalid ({} errors, {} warnings)\n", errors, issues.size() - errors);
}

void print_json(const std::filesystem::path& path, const std::vector<Issue>& issues,
                const std::optional<std::vector<std::string>>& changed, std::size_t errors) {
  Json out;
  out["schema"] = kJsonSchema;
  out["file"] = path.string();
  out["valid"] = errors == 0;
  out["issues"] = Json::array();
  for (const auto& issue : issues)
    out["issues"].push_back({{"number", issue.number},
                             {"severity", issue.severity == Severity::kError ? "error" : "warning"},
                             {"section", issue.section},
                             {"message", issue.message}});
  if (changed) out["changed_inputs"] = *changed;
  fmt::print("{}\n", out.dump(2));
}

}  // namespace

int validate(const std::filesystem::path& path, const std::filesystem::path& scene, bool json) {
  const auto file = read_file(path);
  if (!file) return report(file.error());
  const auto checked = check_pack(*file);
  if (!checked) return report(checked.error());
  const auto& issues = checked->issues;
  std::optional<std::vector<std::string>> changed;
  if (checked->pack && !scene.empty()) {
    auto found = changed_inputs(*checked->pack, scene);
    if (!found) return report(found.error());
    changed = std::move(*found);
  }
  std::size_t errors = 0;
  for (const auto& issue : issues) errors += issue.severity == Severity::kError ? 1 : 0;
  if (json)
    print_json(path, issues, changed, errors);
  else
    print_text(issues, errors);
  if (changed && !json) {
    for (const std::string& line : *changed) fmt::print("changed: {}\n", line);
    if (changed->empty()) fmt::print("belongs to {}\n", scene.string());
  }
  if (errors > 0) return static_cast<int>(ErrorCode::kInvalid);
  return changed && !changed->empty() ? static_cast<int>(ErrorCode::kDifferent) : 0;
}

}  // namespace oriel::inspect
