#include "formats/pack/reader.h"

#include <mutex>
#include <new>
#include <stdexcept>

#include "formats/core/threads/parallel.h"
#include "formats/pack/deferred.h"
#include "formats/pack/fields.h"
#include "formats/pack/rules/issues.h"
#include "formats/pack/sections/parts.h"
#include "formats/pack/validate.h"

namespace oriel {
namespace {

// The end of a section: neither bytes missing nor bytes left over.
Status check_end(const ByteReader& in, const SectionInfo& section) {
  if (!in.ok())
    return invalid(section.label, "its counts need more than the {} bytes that it holds", section.raw_bytes);
  if (in.remaining() > 0)
    return invalid(section.label, "holds {} bytes more than its {} elements need", in.remaining(), section.count);
  return {};
}

Status one_element_only(const SectionInfo& section) {
  if (section.count != 1) return invalid(section.label, "found {} elements, expected 1", section.count);
  return {};
}

template <class T>
Status decode_list(ByteReader& in, const SectionInfo& section, std::vector<T>& elements) {
  for (std::uint64_t i = 0; i < section.count && in.ok(); ++i) {
    T element;
    if (auto status = decode(in, element); !status && in.ok())
      return invalid(section.label, "element {}: {}", i, status.error().message);
    if (in.ok()) elements.push_back(std::move(element));
  }
  return check_end(in, section);
}

Status decode_text(ByteReader& in, const SectionInfo& section, std::string& text) {
  ORIEL_TRY_VOID(one_element_only(section));
  const auto chars = in.get_array<char>(section.raw_bytes);
  text.assign(chars.begin(), chars.end());
  return check_end(in, section);
}

// The element of a section that holds one, at its place among those of its kind.
template <class T>
Status decode_one(ByteReader& in, const SectionInfo& section, std::vector<T>& elements) {
  T& element = elements[section.nth];
  if (auto status = decode(in, element); !status && in.ok())
    return invalid(section.label, "element 0: {}", status.error().message);
  return check_end(in, section);
}

Status decode_section(std::span<const std::byte> file, const SectionInfo& section, PackParts& parts) {
  Pack& pack = parts.pack;
  ORIEL_TRY(const RawBytes raw, section_bytes(file, section));
  ByteReader in(raw.span());
  switch (section.kind) {
    case kProvenanceSection:
      return decode_text(in, section, pack.provenance);
    case kPlanSection:
      return decode_text(in, section, pack.plan);
    case kSceneSection:
      ORIEL_TRY_VOID(one_element_only(section));
      pack.sky = get_vec3(in);
      return check_end(in, section);
    case kMeshSection: {
      ORIEL_TRY_VOID(one_element_only(section));
      if (auto status = decode(in, pack.mesh); !status && in.ok())
        return invalid(section.label, "{}", status.error().message);
      return check_end(in, section);
    }
    case kMaterialSection:
      return decode_list(in, section, pack.materials);
    case kTextureSection:
      return decode_one(in, section, pack.textures);
    case kLightmapSection:
      return decode_one(in, section, pack.lightmaps);
    case kDirectionSection:
      return decode_one(in, section, parts.directions);
    case kNormalTextureSection:
      return decode_one(in, section, pack.normal_textures);
    case kNormalMappingSection:
      ORIEL_TRY_VOID(one_element_only(section));
      return decode_list(in, section, parts.normal_mapping);
    case kReflectorSection:
      return decode_list(in, section, pack.reflectors);
    case kRadianceMapSection:
      return decode_one(in, section, pack.radiance_maps);
    case kCurvedReflectorSection:
      return decode_list(in, section, pack.curved_reflectors);
    case kSurroundMapSection:
      return decode_one(in, section, pack.surround_maps);
    case kKernelSection:
      return decode_list(in, section, pack.kernels);
    case kKernelSliceSection:
      return decode_list(in, section, parts.kernel_slices);
    case kKernelFitSection:
      return decode_list(in, section, parts.kernel_fits);
    case kResidualSection:
      return decode_list(in, section, parts.residuals);
    case kEmitterSection:
      return decode_list(in, section, pack.emitters);
    case kReflectorEmitterSection:
      return decode_list(in, section, parts.reflector_emitters);
    case kWalkSection:
      return decode_list(in, section, pack.walk_grids);
    case kVisibleSetsSection:
      ORIEL_TRY_VOID(one_element_only(section));
      if (auto status = decode(in, pack.visible_sets); !status && in.ok())
        return invalid(section.label, "{}", status.error().message);
      return check_end(in, section);
    case kMoverSection:
      return decode_one(in, section, pack.movers);
    case kLightFieldSection:
      ORIEL_TRY_VOID(one_element_only(section));
      if (auto status = decode(in, pack.light_field); !status && in.ok())
        return invalid(section.label, "{}", status.error().message);
      return check_end(in, section);
    case kSplitSection:
      ORIEL_TRY_VOID(one_element_only(section));
      if (auto status = decode(in, pack.split_reflectance); !status && in.ok())
        return invalid(section.label, "{}", status.error().message);
      return check_end(in, section);
    case kFresnelSection:
      return decode_list(in, section, pack.fresnel_maps);
    case kFresnelFactorSection:
      return decode_list(in, section, parts.fresnel_factors);
    case kCameraSection:
      return decode_list(in, section, pack.cameras);
    case kPathSection:
      return decode_list(in, section, pack.paths);
    default:
      return invalid(section.label, "is of a kind that cannot be decoded");
  }
}

// A radiance map without its pixels.
Status decode_without_pixels(std::span<const std::byte> file, const SectionInfo& section, Pack& pack) {
  ORIEL_TRY_VOID(check_section(file, section));
  ORIEL_TRY(const Bytes head, section_head(file, section, kRadianceMapPlaceBytes));
  ByteReader in(head);
  RadianceMap& map = pack.radiance_maps[section.nth];
  RadianceMapScale scale;
  if (auto status = decode_place(in, map, scale); !status && in.ok())
    return invalid(section.label, "element 0: {}", status.error().message);
  const std::uint64_t expected = kRadianceMapPlaceBytes + std::uint64_t{7} * map.width * map.height;
  if (!in.ok() || section.raw_bytes != expected)
    return invalid(section.label, "found {} bytes, expected the {} of its pixels", section.raw_bytes, expected);
  return {};
}

// A section that may be decoded beside others.
Status decode_known(std::span<const std::byte> file, const SectionInfo& section, MapPixels pixels, PackParts& parts) {
  if (section.kind == kRadianceMapSection && pixels == MapPixels::kDeferred)
    return decode_without_pixels(file, section, parts.pack);
  return find_section_kind(section.kind) ? decode_section(file, section, parts) : check_section(file, section);
}

// The error of the first section in the file that has one, whatever was decoded first.
Status decode_known(std::span<const std::byte> file, const PackIndex& index, MapPixels pixels, PackParts& parts) {
  constexpr std::size_t kSmall = 1 << 20;  // bytes that take less time than starting a thread
  std::mutex of_first;
  std::size_t first = index.sections.size();
  Status error;
  for_each_parallel(index.sections.size(), file.size() < kSmall ? 1 : core_count(), [&](std::size_t i) {
    if (const std::lock_guard lock(of_first); i > first) return;
    Status status = decode_known(file, index.sections[i], pixels, parts);
    if (status) return;
    const std::lock_guard lock(of_first);
    if (i < first) first = i, error = std::move(status);
  });
  return error;
}

Result<Pack> decode_all(std::span<const std::byte> file, const PackIndex& index, MapPixels pixels) {
  PackParts parts(index);
  Pack& pack = parts.pack;
  ORIEL_TRY_VOID(decode_known(file, index, pixels, parts));
  for (const auto& section : index.sections) {
    if (find_section_kind(section.kind)) continue;
    const auto stored = stored_bytes(file, section);
    pack.unknown.push_back(
        {section.kind, section.codec, section.raw_bytes, section.count, Bytes(stored.begin(), stored.end())});
  }
  ORIEL_TRY_VOID(attach(parts));
  return std::move(parts.pack);
}

// What lacks memory gives an error.
template <class Decode>
auto without_exceptions(const Decode& decode) -> decltype(decode()) {
  try {
    return decode();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, "pack", "there is not enough memory to decode it");
  } catch (const std::length_error&) {
    return fail(ErrorCode::kRuntime, "pack", "there is not enough memory to decode it");
  }
}

tl::unexpected<Error> in_file(const std::string& path, Error error) {
  error.where = error.where.empty() ? path : path + ": " + error.where;
  return tl::unexpected<Error>(std::move(error));
}

// The first issue of severity kError.
Status refuse_errors(const std::vector<Issue>& issues) {
  for (const auto& issue : issues)
    if (issue.severity == Severity::kError) return invalid(issue.section, "issue {}: {}", issue.number, issue.message);
  return {};
}

Result<Pack> decode_valid(std::span<const std::byte> file, const PackIndex& index, MapPixels pixels) {
  ORIEL_TRY(Pack pack, decode_all(file, index, pixels));
  ORIEL_TRY_VOID(refuse_errors(validate(pack, pixels)));
  return pack;
}

Result<RadianceMap> decode_map(std::span<const std::byte> file, SectionInfo section, std::size_t map) {
  section.nth = 0;
  PackParts parts({0, 0, {section}});
  ORIEL_TRY_VOID(decode_section(file, section, parts));
  IssueList list;
  list.in_section(kRadianceMapSection, map);
  validate_pixels(parts.pack.radiance_maps[0], list);
  ORIEL_TRY_VOID(refuse_errors(list.issues));
  return std::move(parts.pack.radiance_maps[0]);
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
    return decode_all(file, index, MapPixels::kHere);
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
    return decode_valid(file.bytes(), index, MapPixels::kHere);
  });
  if (!pack) return in_file(path.string(), std::move(pack).error());
  return pack;
}

Result<DeferredPack> read_pack_deferred(const std::filesystem::path& path) {
  ORIEL_TRY(MappedFile file, MappedFile::open(path));
  auto pack = without_exceptions([&]() -> Result<DeferredPack> {
    ORIEL_TRY(PackIndex index, read_index(file.bytes()));
    ORIEL_TRY(Pack decoded, decode_valid(file.bytes(), index, MapPixels::kDeferred));
    std::erase_if(index.sections, [](const SectionInfo& s) { return s.kind != kRadianceMapSection; });
    return DeferredPack{std::move(decoded), std::make_shared<const DeferredMaps>(std::move(file), path.string(),
                                                                                 std::move(index.sections))};
  });
  if (!pack) return in_file(path.string(), std::move(pack).error());
  return pack;
}

Result<RadianceMap> DeferredMaps::load(std::size_t map) const {
  auto loaded = without_exceptions([&] { return decode_map(file_.bytes(), sections_[map], map); });
  if (!loaded) return in_file(path_, std::move(loaded).error());
  return loaded;
}

}  // namespace oriel
