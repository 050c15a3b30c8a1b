#include "bake/cli/outcome.h"

#include <unistd.h>
#include <array>

#include <ctime>

#include "bake/plan/doctor.h"
#include "bake/run/version.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr int kSchema = 1;  // grows when a field changes its meaning or goes; new fields leave it as it is

// What stands between the first quotes: messages name their surface, material or light so.
std::string object_of(const std::string& text) {
  const std::size_t open = text.find_first_of("'\"");
  if (open == std::string::npos) return {};
  const std::size_t close = text.find(text[open], open + 1);
  return close == std::string::npos ? std::string() : text.substr(open + 1, close - open - 1);
}

// Our messages end with what to do, behind a semicolon.
std::string fix_of(const std::string& text) {
  const std::size_t at = text.rfind("; ");
  return at == std::string::npos ? std::string() : text.substr(at + 2);
}

using NodePaths = std::map<std::string, std::string>;

Json records(const std::vector<Warning>& warnings, const char* kind, const char* severity, const NodePaths& paths) {
  Json out = Json::array();
  for (const Warning& warning : warnings) {
    const std::string& text = warning.text;
    // The importer's have their own fixes.
    const Finding known = findings_of_import(std::span(&warning, 1)).front();
    const std::string object = object_of(text);
    const auto node = paths.find(object);
    const bool of_import = known.kind != FindingKind::kImport;
    out.push_back({{"id", warning.code.name()},
                   {"kind", of_import ? name_of(known.kind) : kind},
                   {"severity", severity},
                   {"object", object},
                   {"node", node == paths.end() ? std::string() : node->second},
                   {"text", text},
                   {"fix", of_import ? known.fix : fix_of(text)}});
  }
  return out;
}

Json error_json(const Outcome& o) {
  if (o.kind != Outcome::Kind::kFailed && o.kind != Outcome::Kind::kStopped) return Json();
  return {{"code", static_cast<int>(o.error.code)}, {"where", o.error.where}, {"text", o.error.message}};
}

// What tells a bake that runs from one that was killed.
Json running_json() {
  char host[256] = "";
  ::gethostname(host, sizeof(host) - 1);
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char started[32] = "";
  std::strftime(started, sizeof(started), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return {
      {"host", host},
      {"pid", ::getpid()},
      {"started", started},
      {"text",
       fmt::format("this bake has not ended: where process {} of {} is gone, it was killed, and the same command goes "
                   "on from what its cache holds",
                   ::getpid(), host)}};
}

}  // namespace

const char* name_of(Outcome::Kind kind) {
  static const std::array names{"running", "complete", "partial", "findings", "failed", "stopped"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string outcome_json(const Outcome& o, const std::filesystem::path& scene, const std::filesystem::path& pack) {
  const NodePaths paths = o.result != nullptr ? o.result->node_paths : NodePaths();
  Json json = {{"schema", kSchema},         {"tool", std::string("oriel-bake ") + kVersion},
               {"status", name_of(o.kind)}, {"exit_code", o.exit_code < 0 ? Json() : Json(o.exit_code)},
               {"error", error_json(o)},    {"scene", scene.string()},
               {"pack", pack.string()},     {"warnings", records(o.warnings, "warning", "warning", paths)},
               {"findings", Json::array()}, {"shortfalls", Json::array()}};
  if (o.kind == Outcome::Kind::kRunning) json["running"] = running_json();
  if (o.result != nullptr) {
    std::vector<Warning> missing = o.result->shortfalls;
    for (const std::string& text : o.result->left_out) missing.push_back({text, "failed-checks"});
    json["findings"] = records(o.result->findings, "light", "error", paths);
    json["shortfalls"] = records(missing, "shortfall", "error", paths);
    json.update(Json::parse(report_json(*o.result)).value());
  }
  return json.dump(2) + "\n";
}

}  // namespace oriel
