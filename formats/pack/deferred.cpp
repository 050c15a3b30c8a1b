#include "formats/pack/deferred.h"

#include <algorithm>

#include "formats/core/hash.h"
#include "formats/pack/decode.h"
#include "formats/pack/issues.h"
#include "formats/pack/reading.h"

namespace oriel {
namespace {

constexpr std::uint64_t kPiece = 256 << 10;  // bytes that stay in a core's own cache while they are looked at

bool is_image(std::uint32_t kind) {
  return kind == kTextureSection || kind == kNormalTextureSection || kind == kLightmapSection ||
         kind == kRadianceMapSection || kind == kSurroundMapSection;
}

std::size_t number_of(std::uint32_t kind) {
  return static_cast<std::size_t>(find_section_kind(kind) - std::begin(kSectionKinds));
}

// Bytes of the file that belong to a section.
Status read_of(const OpenFile& file, const SectionInfo& section, std::uint64_t offset, std::span<std::byte> to) {
  Status status = file.read(offset, to);
  if (!status) status.error().where = section.label;
  return status;
}

// So many bytes of a buffer that is used again, so that the system need not find memory each time. Sections are of all
// sizes: a large one's memory is not kept for long.
std::span<std::byte> some_of(RawBytes& buffer, std::uint64_t bytes) {
  if (buffer.size < bytes || buffer.size > 4 * bytes + kPiece)
    buffer = {std::make_unique_for_overwrite<std::byte[]>(bytes), bytes};
  return {buffer.data.get(), bytes};
}

// The stored bytes of a section as the file has them, in memory of this thread until the next call.
Result<std::span<const std::byte>> stored_in(const OpenFile& file, const SectionInfo& section) {
  thread_local RawBytes buffer;
  const std::span<std::byte> to = some_of(buffer, section.padding + section.stored_bytes);
  ORIEL_TRY_VOID(read_of(file, section, section.offset - section.padding, to));
  ORIEL_TRY_VOID(check_padding(to.first(section.padding), section));
  const std::span<const std::byte> stored = to.subspan(section.padding);
  ORIEL_TRY_VOID(check_stored(stored, section));
  return stored;
}

Status check_in(const OpenFile& file, const SectionInfo& section) {
  Hasher64 hasher;
  Bytes piece(std::min(section.padding + section.stored_bytes, kPiece));
  const std::uint64_t end = section.offset + section.stored_bytes;
  for (std::uint64_t at = section.offset - section.padding; at < end;) {
    const std::span<std::byte> to(piece.data(), std::min<std::uint64_t>(end - at, piece.size()));
    ORIEL_TRY_VOID(read_of(file, section, at, to));
    const std::uint64_t padding = at < section.offset ? section.offset - at : 0;  // shorter than a piece
    ORIEL_TRY_VOID(check_padding(to.first(std::min<std::uint64_t>(padding, to.size())), section));
    hasher.add(to.subspan(std::min<std::uint64_t>(padding, to.size())));
    at += to.size();
  }
  if (hasher.result() != section.checksum)
    return invalid(section.label, "checksum {:016x}, expected {:016x}", hasher.result(), section.checksum);
  return {};
}

// The first `bytes` of the raw ones, without the checksum, of which as few stored bytes are read as will do.
Result<Bytes> head_in(const OpenFile& file, const SectionInfo& section, std::size_t bytes) {
  Bytes front;
  // A little, all that one of zstd's blocks takes, all.
  for (std::uint64_t take : {std::uint64_t{512}, kPiece / 2 + 64, section.stored_bytes}) {
    take = std::min(take, section.stored_bytes);
    if (take == front.size() && take > 0) continue;
    front.resize(take);
    ORIEL_TRY_VOID(read_of(file, section, section.offset, front));
    ORIEL_TRY(Bytes head, stored_head(front, section, bytes));
    if (!head.empty() || take == section.stored_bytes) return head;
  }
  return Bytes();
}

// Describes the beginning of a section.
template <class Describe>
Status decode_start(const OpenFile& file, const SectionInfo& section, std::size_t bytes, const Describe& describe_start,
                    std::uint64_t& position) {
  ORIEL_TRY(const Bytes head, head_in(file, section, bytes));
  ByteReader in(head);
  Serial s(in);
  describe_start(s);
  if (!s.status() && in.ok()) return invalid(section.label, "element 0: {}", s.status().error().message);
  if (!in.ok()) return invalid(section.label, "found {} bytes, expected more of its place", section.raw_bytes);
  position = in.position();
  return {};
}

Status expect_bytes(const SectionInfo& section, std::uint64_t expected) {
  if (section.raw_bytes != expected)
    return invalid(section.label, "found {} bytes, expected the {} of its pixels", section.raw_bytes, expected);
  return {};
}

template <class Side>
std::uint64_t area(Side width, Side height) {
  return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

template <class Image>
IVec2 size_of(const Image& image) {
  return {static_cast<int>(image.width), static_cast<int>(image.height)};
}
IVec2 size_of(const SurroundMap& map) {
  return IVec2(static_cast<int>(map.size));
}

// Whether an image is as large as its place said when the pack was opened.
Status expect_size(const IVec2& found, const IVec2& expected, const SectionInfo& section) {
  if (found == expected) return {};
  return invalid(section.label, "found {} x {} texels, expected the {} x {} that it had: the file was changed", found.x,
                 found.y, expected.x, expected.y);
}

Status decode_texture_place(const OpenFile& file, const SectionInfo& section, Texture& texture) {
  std::uint32_t name = 0;
  std::uint64_t at = 0;
  ORIEL_TRY_VOID(decode_start(
      file, section, 4, [&](Serial& s) { s(name); }, at));
  ORIEL_TRY_VOID(decode_start(
      file, section, std::min(4 + std::uint64_t{name} + 12, section.raw_bytes),
      [&](Serial& s) { describe_place(s, texture); }, at));
  return expect_bytes(section, at + 4 * area(texture.width, texture.height));
}

// A pack whose images have their sizes only.
struct Opened {
  Pack pack;
  std::vector<LightmapFlags> flags;  // by lightmap page
};

// An image without its pixels.
Status decode_image_place(const OpenFile& file, const SectionInfo& section, Opened& opened) {
  std::uint64_t at = 0;
  Pack& pack = opened.pack;
  const auto start = [&](std::size_t bytes, const auto& describe_start) {
    return decode_start(file, section, bytes, describe_start, at);
  };
  switch (section.kind) {
    case kTextureSection:
      return decode_texture_place(file, section, pack.textures[section.nth]);
    case kNormalTextureSection:
      return decode_texture_place(file, section, pack.normal_textures[section.nth]);
    case kLightmapSection: {
      LightmapPage& page = pack.lightmaps[section.nth];
      LightmapFlags& flags = opened.flags[section.nth];
      ORIEL_TRY_VOID(start(kLightmapPlaceBytes, [&](Serial& s) { describe_place(s, page, flags); }));
      const std::uint64_t texels = area(page.width, page.height);
      return expect_bytes(section, light_bytes(texels, flags, area(page.detail_width, page.detail_height)) +
                                       (flags.sharp ? 4 + 6 * texels : 0) + 4 + 7 * texels);
    }
    case kSurroundMapSection: {
      SurroundMap& map = pack.surround_maps[section.nth];
      SurroundMapScale scale;
      ORIEL_TRY_VOID(start(kSurroundMapPlaceBytes, [&](Serial& s) { describe_place(s, map, scale); }));
      return expect_bytes(section, at + 7 * area(map.size, map.size));
    }
    default: {
      RadianceMap& map = pack.radiance_maps[section.nth];
      RadianceMapScale scale;
      ORIEL_TRY_VOID(start(kRadianceMapPlaceBytes, [&](Serial& s) { describe_place(s, map, scale); }));
      return expect_bytes(section, at + 7 * area(map.width, map.height));
    }
  }
}

// What was decoded makes no sense where the bytes are not those that were written: then that is told.
Status open_section(const OpenFile& file, const SectionInfo& section, Opened& opened) {
  const bool known = find_section_kind(section.kind) != nullptr;
  if (!known) return {};
  if (is_image(section.kind)) {
    Status place = decode_image_place(file, section, opened);
    if (!place) ORIEL_TRY_VOID(check_in(file, section));
    return place;
  }
  ORIEL_TRY(const auto stored, stored_in(file, section));
  ORIEL_TRY(const RawBytes raw, decompressed(stored, section, section.raw_bytes));
  return decode_section(raw.span(), section, opened.pack);
}

Result<PackIndex> read_index_of(const OpenFile& file) {
  Bytes front;
  for (int step = 0; step < 2; ++step) {  // the header, then the table too
    front.resize(index_bytes(front, file.size()));
    ORIEL_TRY_VOID(file.read(0, front));
  }
  return read_index(front, file.size());
}

Result<DeferredPack> open_sections(OpenFile file) {
  ORIEL_TRY(PackIndex index, read_index_of(file));
  Opened opened{pack_of(index), {}};
  opened.flags.resize(opened.pack.lightmaps.size());
  std::uint64_t bytes = 0;  // that are no images
  for (const SectionInfo& section : index.sections) bytes += is_image(section.kind) ? 0 : section.raw_bytes;
  ORIEL_TRY_VOID(first_failure(index.sections.size(), bytes + 2048 * index.sections.size(),
                               [&](std::size_t i) { return open_section(file, index.sections[i], opened); }));
  ORIEL_TRY_VOID(refuse_errors(validate(opened.pack, ImagePixels::kDeferred)));
  auto images = std::make_shared<DeferredImages>(std::move(file), std::move(index.sections), opened.pack,
                                                 std::move(opened.flags));
  return DeferredPack{std::move(opened.pack), std::move(images)};
}

}  // namespace

DeferredImages::DeferredImages(OpenFile file, std::vector<SectionInfo> sections, const Pack& pack,
                               std::vector<LightmapFlags> flags)
    : file_(std::move(file)),
      sections_(std::move(sections)),
      flags_(std::move(flags)),
      sharp_records_(sharp_records(pack.sharp_light)) {
  by_kind_.resize(std::size(kSectionKinds));
  checked_ = std::make_unique<std::atomic<bool>[]>(sections_.size());
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const SectionInfo& section = sections_[i];
    IVec2 size(0);
    if (section.kind == kTextureSection) size = size_of(pack.textures[section.nth]);
    if (section.kind == kNormalTextureSection) size = size_of(pack.normal_textures[section.nth]);
    if (section.kind == kLightmapSection) {
      const LightmapPage& page = pack.lightmaps[section.nth];
      size = size_of(page);
      details_.emplace_back(page.detail_width, page.detail_height);
    }
    if (section.kind == kRadianceMapSection) size = size_of(pack.radiance_maps[section.nth]);
    if (section.kind == kSurroundMapSection) size = size_of(pack.surround_maps[section.nth]);
    sizes_.push_back(size);
    checked_[i] = find_section_kind(section.kind) != nullptr && !is_image(section.kind);
    if (find_section_kind(section.kind)) by_kind_[number_of(section.kind)].push_back(i);
  }
}

std::size_t DeferredImages::of(std::uint32_t kind, std::size_t nth) const {
  return by_kind_[number_of(kind)][nth];
}

template <class Image>
Result<Image> DeferredImages::load(std::uint32_t kind, std::size_t nth) const {
  const std::size_t at = of(kind, nth);
  const SectionInfo& section = sections_[at];
  checked_[at] = true;
  auto loaded = without_exceptions([&]() -> Result<Image> {
    ORIEL_TRY(const auto stored, stored_in(file_, section));
    ORIEL_TRY(const RawBytes raw, decompressed(stored, section, section.raw_bytes));
    Image image;
    ORIEL_TRY_VOID(decode_element(raw.span(), section, image));
    ORIEL_TRY_VOID(expect_size(size_of(image), sizes_[at], section));
    IssueList list;
    list.in_section(kind, nth);
    validate_pixels(image, list);
    if constexpr (std::is_same_v<Image, LightmapPage>) validate_sharp_places(image.sharp_at, sharp_records_, list);
    ORIEL_TRY_VOID(refuse_errors(list.issues));
    return image;
  });
  if (!loaded) return in_file(file_.path().string(), std::move(loaded).error());
  return loaded;
}

Result<Texture> DeferredImages::texture(std::size_t i) const {
  return load<Texture>(kTextureSection, i);
}

Result<Texture> DeferredImages::normal_texture(std::size_t i) const {
  return load<Texture>(kNormalTextureSection, i);
}

Result<LightmapPage> DeferredImages::lightmap(std::size_t i) const {
  return load<LightmapPage>(kLightmapSection, i);
}

Result<RadianceMap> DeferredImages::radiance_map(std::size_t i) const {
  return load<RadianceMap>(kRadianceMapSection, i);
}

Result<SurroundMap> DeferredImages::surround_map(std::size_t i) const {
  return load<SurroundMap>(kSurroundMapSection, i);
}

Result<HalfPage> DeferredImages::light(std::size_t i) const {
  const std::size_t at = of(kLightmapSection, i);
  const SectionInfo& section = sections_[at];
  checked_[at] = true;
  auto loaded = without_exceptions([&]() -> Result<HalfPage> {
    ORIEL_TRY(const auto stored, stored_in(file_, section));
    thread_local RawBytes buffer;
    const std::span<std::byte> raw =
        some_of(buffer, light_bytes(area(sizes_[at].x, sizes_[at].y), flags_[i], area(details_[i].x, details_[i].y)));
    ORIEL_TRY_VOID(decompress(stored, section, raw));
    ByteReader in(raw);
    HalfPage page;
    if (auto status = decode(in, page); !status && in.ok())
      return invalid(section.label, "element 0: {}", status.error().message);
    ORIEL_TRY_VOID(expect_size(size_of(page), sizes_[at], section));
    if (!in.ok()) return invalid(section.label, "found {} bytes, expected more of light", raw.size());
    ORIEL_TRY_VOID(
        expect_size({static_cast<int>(page.detail_width), static_cast<int>(page.detail_height)}, details_[i], section));
    IssueList list;
    list.in_section(kLightmapSection, i);
    validate_cells(page.cell, {page.width, page.height}, details_[i], list);
    validate_sharp_places(page.sharp_at, sharp_records_, list);
    ORIEL_TRY_VOID(refuse_errors(list.issues));
    return page;
  });
  if (!loaded) return in_file(file_.path().string(), std::move(loaded).error());
  return loaded;
}

Status DeferredImages::check(std::size_t section) const {
  checked_[section] = true;
  const Status status = without_exceptions([&] { return check_in(file_, sections_[section]); });
  if (!status) return in_file(file_.path().string(), status.error());
  return {};
}

Result<DeferredPack> open_pack(const std::filesystem::path& path) {
  ORIEL_TRY(OpenFile file, OpenFile::open(path));
  auto pack = without_exceptions([&] { return open_sections(std::move(file)); });
  if (!pack) return in_file(path.string(), std::move(pack).error());
  return pack;
}

}  // namespace oriel
