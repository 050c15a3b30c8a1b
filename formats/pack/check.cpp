#include "formats/pack/check.h"

#include "formats/pack/index.h"
#include "formats/pack/reader.h"

namespace oriel {
namespace {

Issue damage(const Error& error) {
  return {1, Severity::kError, error.where, error.message};
}

std::vector<Issue> find_damage(std::span<const std::byte> file) {
  const auto index = read_index(file);
  if (!index) return {damage(index.error())};
  std::vector<Issue> issues;
  for (const auto& section : index->sections)
    if (const auto status = check_section(file, section); !status) issues.push_back(damage(status.error()));
  return issues;
}

}  // namespace

Result<CheckedPack> check_pack(std::span<const std::byte> file) {
  CheckedPack checked{std::nullopt, find_damage(file)};
  if (!checked.issues.empty()) return checked;
  auto pack = decode_pack(file);
  if (!pack && pack.error().code != ErrorCode::kInvalid) return tl::unexpected<Error>(std::move(pack).error());
  if (!pack) {
    checked.issues.push_back(damage(pack.error()));
    return checked;
  }
  checked.issues = validate(*pack);
  checked.pack = std::move(*pack);
  return checked;
}

}  // namespace oriel
