#include "formats/pack/writer.h"

#include <zstd.h>

#include <memory>

#include "formats/core/check.h"
#include "formats/core/file.h"
#include "formats/core/hash.h"
#include "formats/pack/layout.h"
#include "formats/pack/sections.h"
#include "formats/pack/validate.h"

namespace oriel {
namespace {

// Level 6 saves 1 to 2 % on maps for two to three times the time, level 15 no more than that (measured:
// docs/format.md).
constexpr int kZstdLevel = 3;

struct Section {
  SectionRecord record{};
  Bytes stored;
};

Bytes compress(const Bytes& raw) {
  Bytes stored(ZSTD_compressBound(raw.size()));
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ORIEL_CHECK(context != nullptr);
  const std::size_t n =
      ZSTD_compressCCtx(context.get(), stored.data(), stored.size(), raw.data(), raw.size(), kZstdLevel);
  ORIEL_CHECK(!ZSTD_isError(n));
  stored.resize(n);
  return stored;
}

class SectionList {
 public:
  void add(std::uint32_t kind, std::uint64_t count, Bytes raw) {
    Section section;
    section.record.kind = kind;
    section.record.flags = find_section_kind(kind)->optional ? kSectionOptional : 0;
    section.record.count = count;
    section.record.raw_bytes = raw.size();
    section.stored = compress(raw);
    section.record.codec = static_cast<std::uint32_t>(Codec::kZstd);
    // Bytes that do not shrink are stored as they are. The other bound is the reader's, against decompression bombs.
    if (section.stored.size() >= raw.size() || raw.size() / kMaxExpansion > section.stored.size()) {
      section.stored = std::move(raw);
      section.record.codec = static_cast<std::uint32_t>(Codec::kNone);
    }
    finish(std::move(section));
  }
  void add_text(std::uint32_t kind, const std::string& text) {
    if (text.empty()) return;
    const auto* p = reinterpret_cast<const std::byte*>(text.data());
    add(kind, 1, Bytes(p, p + text.size()));
  }
  template <class T>
  void add_list(std::uint32_t kind, const std::vector<T>& elements) {
    if (elements.empty()) return;
    ByteWriter out;
    for (const T& element : elements) encode(out, element);
    add(kind, elements.size(), out.take());
  }
  template <class T>
  void add_each(std::uint32_t kind, const std::vector<T>& elements) {
    for (const T& element : elements) {
      ByteWriter out;
      encode(out, element);
      add(kind, 1, out.take());
    }
  }
  void add_unknown(const UnknownSection& unknown) {
    Section section;
    section.record.kind = unknown.kind;
    section.record.codec = unknown.codec;
    section.record.flags = kSectionOptional;
    section.record.raw_bytes = unknown.raw_bytes;
    section.record.count = unknown.count;
    section.stored = unknown.stored;
    finish(std::move(section));
  }
  const std::vector<Section>& sections() const { return sections_; }

 private:
  void finish(Section section) {
    section.record.stored_bytes = section.stored.size();
    section.record.checksum = hash64(section.stored);
    sections_.push_back(std::move(section));
  }

  std::vector<Section> sections_;
};

// One or none.
std::vector<NormalMapping> normal_mapping(const Pack& pack) {
  NormalMapping mapping;
  for (std::uint32_t i = 0; i < pack.materials.size(); ++i)
    if (const Material& m = pack.materials[i]; m.normal_texture >= 0)
      mapping.uses.push_back({i, m.normal_texture, m.normal_scale});
  if (mapping.uses.empty() && pack.mesh.normal_uvs.empty()) return {};
  mapping.uvs = pack.mesh.normal_uvs;
  mapping.tangents = pack.mesh.tangents;
  return {std::move(mapping)};
}

std::vector<KernelSlices> kernel_slices(const Pack& pack) {
  std::vector<KernelSlices> all;
  for (std::uint32_t i = 0; i < pack.kernels.size(); ++i)
    if (const BrdfKernel& k = pack.kernels[i]; !k.slices.empty()) all.push_back({i, k.slice_size, k.slices});
  return all;
}

std::vector<KernelFits> kernel_fits(const Pack& pack) {
  std::vector<KernelFits> all;
  for (std::uint32_t i = 0; i < pack.kernels.size(); ++i)
    if (const BrdfKernel& k = pack.kernels[i]; !k.fits.empty()) all.push_back({i, k.fits});
  return all;
}

std::vector<FresnelFactor> fresnel_factors(const Pack& pack) {
  std::vector<FresnelFactor> all;
  for (std::uint32_t i = 0; i < pack.fresnel_maps.size(); ++i)
    if (const FresnelMap& map = pack.fresnel_maps[i]; !map.factor.empty()) all.push_back({i, map.factor});
  return all;
}

std::vector<ResidualMap> residual_maps(const Pack& pack) {
  std::vector<ResidualMap> all;
  for (std::uint32_t i = 0; i < pack.radiance_maps.size(); ++i)
    if (pack.radiance_maps[i].residual) all.push_back({i});
  return all;
}

std::vector<ReflectorEmitters> reflector_emitters(const Pack& pack) {
  std::vector<ReflectorEmitters> all;
  for (std::uint32_t i = 0; i < pack.reflectors.size(); ++i)
    if (const Reflector& r = pack.reflectors[i]; !r.emitters.empty())
      all.push_back({i, r.visibility_x, r.visibility_y, r.emitters, r.visibility});
  return all;
}

SectionList encode_sections(const Pack& pack) {
  SectionList list;
  list.add_text(kProvenanceSection, pack.provenance);
  list.add_text(kPlanSection, pack.plan);
  ByteWriter scene;
  for (int c = 0; c < 3; ++c) scene.put(pack.sky[c]);
  list.add(kSceneSection, 1, scene.take());
  ByteWriter mesh;
  encode(mesh, pack.mesh);
  list.add(kMeshSection, 1, mesh.take());
  list.add_list(kMaterialSection, pack.materials);
  list.add_each(kTextureSection, pack.textures);
  list.add_each(kLightmapSection, pack.lightmaps);
  for (std::size_t i = 0; i < pack.lightmaps.size(); ++i) {
    const LightmapPage& page = pack.lightmaps[i];
    if (page.direction.empty()) continue;
    ByteWriter out;
    encode(out, DirectionPage{static_cast<std::uint32_t>(i), page.width, page.height, page.direction});
    list.add(kDirectionSection, 1, out.take());
  }
  list.add_each(kNormalTextureSection, pack.normal_textures);
  list.add_list(kNormalMappingSection, normal_mapping(pack));
  list.add_list(kReflectorSection, pack.reflectors);
  list.add_each(kRadianceMapSection, pack.radiance_maps);
  list.add_list(kResidualSection, residual_maps(pack));
  list.add_list(kEmitterSection, pack.emitters);
  list.add_list(kReflectorEmitterSection, reflector_emitters(pack));
  list.add_list(kCurvedReflectorSection, pack.curved_reflectors);
  list.add_each(kSurroundMapSection, pack.surround_maps);
  list.add_list(kKernelSection, pack.kernels);
  list.add_list(kKernelSliceSection, kernel_slices(pack));
  list.add_list(kKernelFitSection, kernel_fits(pack));
  list.add_list(kFresnelSection, pack.fresnel_maps);
  list.add_list(kFresnelFactorSection, fresnel_factors(pack));
  if (pack.split_reflectance.angles > 0) {
    ByteWriter split;
    encode(split, pack.split_reflectance);
    list.add(kSplitSection, 1, split.take());
  }
  list.add_list(kCameraSection, pack.cameras);
  list.add_list(kPathSection, pack.paths);
  list.add_list(kWalkSection, pack.walk_grids);
  list.add_each(kMoverSection, pack.movers);
  if (pack.light_field.bands > 0) {
    ByteWriter field;
    encode(field, pack.light_field);
    list.add(kLightFieldSection, 1, field.take());
  }
  for (const auto& unknown : pack.unknown) list.add_unknown(unknown);
  return list;
}

void append(Bytes& bytes, const void* data, std::size_t size) {
  const auto* p = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), p, p + size);
}

std::uint64_t align(std::uint64_t offset) {
  return (offset + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
}

}  // namespace

Result<Bytes> encode_pack(const Pack& pack) {
  for (const auto& issue : validate(pack))
    if (issue.severity == Severity::kError) return invalid(issue.section, "issue {}: {}", issue.number, issue.message);
  const SectionList list = encode_sections(pack);
  if (list.sections().size() > kMaxSections)
    return invalid("section table", "found {} sections, at most {} are accepted", list.sections().size(), kMaxSections);
  FileHeader header{};
  header.magic = kPackMagic;
  header.version = kPackVersion;
  header.section_count = static_cast<std::uint32_t>(list.sections().size());
  header.record_bytes = sizeof(SectionRecord);
  header.table_offset = sizeof(FileHeader);
  std::uint64_t end = sizeof(FileHeader) + list.sections().size() * sizeof(SectionRecord);
  Bytes table;
  for (const auto& section : list.sections()) {
    SectionRecord record = section.record;
    record.offset = align(end);
    end = record.offset + record.stored_bytes;
    append(table, &record, sizeof(record));
  }
  header.file_bytes = end;
  Bytes file;
  file.reserve(end);
  append(file, &header, offsetof(FileHeader, checksum));
  Bytes covered = file;
  append(covered, table.data(), table.size());
  const std::uint64_t checksum = hash64(covered);
  append(file, &checksum, sizeof(checksum));
  append(file, table.data(), table.size());
  for (const auto& section : list.sections()) {
    file.resize(align(file.size()));
    append(file, section.stored.data(), section.stored.size());
  }
  return file;
}

Status write_pack(const std::filesystem::path& path, const Pack& pack) {
  auto bytes = encode_pack(pack);
  // The data is ours, not the user's: a pack that cannot be written is a failure of the run.
  if (!bytes) return fail(ErrorCode::kRuntime, path.string(), "{}", bytes.error().text());
  return write_file_atomically(path, *bytes);
}

}  // namespace oriel
