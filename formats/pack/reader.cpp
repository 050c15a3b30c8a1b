#include "formats/pack/reader.h"

#include "formats/core/file.h"
#include "formats/pack/decode.h"
#include "formats/pack/issues.h"
#include "formats/pack/reading.h"

namespace oriel {
namespace {

// A section that may be decoded beside others.
Status decode_known(std::span<const std::byte> file, const SectionInfo& section, Pack& pack) {
  if (!find_section_kind(section.kind)) return check_section(file, section);
  ORIEL_TRY(const RawBytes raw, section_bytes(file, section));
  return decode_section(raw.span(), section, pack);
}

// The error of the first section in the file that has one, whatever was decoded first.
Status decode_known(std::span<const std::byte> file, const PackIndex& index, Pack& pack) {
  return first_failure(index.sections.size(), file.size(),
                       [&](std::size_t i) { return decode_known(file, index.sections[i], pack); });
}

Result<Pack> decode_all(std::span<const std::byte> file, const PackIndex& index) {
  Pack pack = pack_of(index);
  ORIEL_TRY_VOID(decode_known(file, index, pack));
  for (const auto& section : index.sections) {
    if (find_section_kind(section.kind)) continue;
    const auto stored = stored_bytes(file, section);
    pack.unknown.push_back(
        {section.kind, section.codec, section.raw_bytes, section.count, Bytes(stored.begin(), stored.end())});
  }
  return pack;
}

Result<Pack> decode_valid(std::span<const std::byte> file, const PackIndex& index) {
  ORIEL_TRY(Pack pack, decode_all(file, index));
  ORIEL_TRY_VOID(refuse_errors(validate(pack)));
  return pack;
}

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

Result<Pack> decode_pack(std::span<const std::byte> file) {
  return without_exceptions([&]() -> Result<Pack> {
    ORIEL_TRY(const PackIndex index, read_index(file));
    return decode_all(file, index);
  });
}

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

Result<Pack> read_pack(const std::filesystem::path& path) {
  ORIEL_TRY(const MappedFile file, MappedFile::open(path));
  auto pack = without_exceptions([&]() -> Result<Pack> {
    ORIEL_TRY(const PackIndex index, read_index(file.bytes()));
    return decode_valid(file.bytes(), index);
  });
  if (!pack) return in_file(path.string(), std::move(pack).error());
  return pack;
}

}  // namespace oriel
