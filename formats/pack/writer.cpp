#include "formats/pack/writer.h"

#include <algorithm>
#include <functional>

#include "formats/core/file.h"
#include "formats/pack/layout.h"
#include "formats/pack/sections.h"
#include "formats/pack/stream.h"
#include "formats/pack/validate.h"

namespace oriel {
namespace {

// What a pack's sections are, before any is encoded: one at a time is in memory.
class SectionList {
 public:
  void add(std::uint32_t kind, std::uint64_t count, std::function<void(ByteWriter&)> encode_raw) {
    // Players read the places of all radiance maps, and the pixels of few.
    const std::size_t head = kind == kRadianceMapSection ? kRadianceMapPlaceBytes : 0;
    writers_.push_back([kind, count, head, encode_raw = std::move(encode_raw)](PackStream& stream) {
      ByteWriter out;
      encode_raw(out);
      return stream.add(kind, count, out.bytes(), head);
    });
  }
  // For visit_sections().
  void text(std::uint32_t kind, const std::string& text) {
    if (!text.empty()) add(kind, 1, [&text](ByteWriter& out) { out.put_array(std::span<const char>(text)); });
  }
  template <class T>
  void one(std::uint32_t kind, const T& element, bool present) {
    if (present) add(kind, 1, [&element](ByteWriter& out) { encode(out, element); });
  }
  template <class T>
  void list(std::uint32_t kind, const std::vector<T>& elements) {
    if (elements.empty()) return;
    add(kind, elements.size(), [&elements](ByteWriter& out) {
      for (const T& element : elements) encode(out, element);
    });
  }
  template <class T>
  void each(std::uint32_t kind, const std::vector<T>& elements) {
    for (const T& element : elements) one(kind, element, true);
  }
  void add_unknown(const UnknownSection& unknown) {
    writers_.push_back([&unknown](PackStream& stream) { return stream.add(unknown); });
  }

  Status write(const PutBytes& put) const {
    PackStream stream(writers_.size(), put);
    for (const auto& writer : writers_) ORIEL_TRY_VOID(writer(stream));
    return stream.finish();
  }

 private:
  std::vector<std::function<Status(PackStream&)>> writers_;
};

// Refers to the pack.
SectionList sections_of(const Pack& pack) {
  SectionList list;
  visit_sections(pack, list);
  for (const auto& unknown : pack.unknown) list.add_unknown(unknown);
  return list;
}

// Refuses a pack with an issue of severity kError.
Status check_writable(const Pack& pack) {
  for (const auto& issue : validate(pack))
    if (issue.severity == Severity::kError) return invalid(issue.section, "issue {}: {}", issue.number, issue.message);
  return {};
}

Status write_file(const std::filesystem::path& path, const Pack& pack) {
  ORIEL_TRY_VOID(check_writable(pack));
  ORIEL_TRY(AtomicFile file, AtomicFile::create(path));
  ORIEL_TRY_VOID(sections_of(pack).write(
      [&](std::uint64_t offset, std::span<const std::byte> bytes) { return file.write(offset, bytes); }));
  return file.commit();
}

}  // namespace

Result<Bytes> encode_pack(const Pack& pack) {
  ORIEL_TRY_VOID(check_writable(pack));
  Bytes file;
  ORIEL_TRY_VOID(sections_of(pack).write([&](std::uint64_t offset, std::span<const std::byte> bytes) -> Status {
    if (file.size() < offset + bytes.size()) file.resize(offset + bytes.size());
    std::copy(bytes.begin(), bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(offset));
    return {};
  }));
  return file;
}

Status write_pack(const std::filesystem::path& path, const Pack& pack) {
  auto status = write_file(path, pack);
  // The data is ours, not the user's: a pack that cannot be written is a failure of the run.
  if (!status && status.error().code == ErrorCode::kInvalid)
    return fail(ErrorCode::kRuntime, path.string(), "{}", status.error().text());
  return status;
}

}  // namespace oriel
