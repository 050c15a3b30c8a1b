#include "formats/pack/reader.h"

#include <new>
#include <stdexcept>

#include "formats/pack/deferred.h"
#include "formats/pack/fields.h"
#include "formats/pack/rules/issues.h"
#include "formats/pack/sections.h"
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

// A pack, and what waits for the sections that it belongs to.
struct Parts {
  Pack pack;
  std::vector<DirectionPage> directions;
  std::vector<NormalMapping> normal_mapping;
  std::vector<KernelSlices> kernel_slices;
  std::vector<KernelFits> kernel_fits;
  std::vector<FresnelFactor> fresnel_factors;
  std::vector<ResidualMap> residuals;
  std::vector<ReflectorEmitters> reflector_emitters;
};

Status decode_section(std::span<const std::byte> file, const SectionInfo& section, Parts& parts) {
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
      return decode_list(in, section, pack.textures);
    case kLightmapSection:
      return decode_list(in, section, pack.lightmaps);
    case kDirectionSection:
      return decode_list(in, section, parts.directions);
    case kNormalTextureSection:
      return decode_list(in, section, pack.normal_textures);
    case kNormalMappingSection:
      ORIEL_TRY_VOID(one_element_only(section));
      return decode_list(in, section, parts.normal_mapping);
    case kReflectorSection:
      return decode_list(in, section, pack.reflectors);
    case kRadianceMapSection:
      return decode_list(in, section, pack.radiance_maps);
    case kCurvedReflectorSection:
      return decode_list(in, section, pack.curved_reflectors);
    case kSurroundMapSection:
      return decode_list(in, section, pack.surround_maps);
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
      return decode_list(in, section, pack.movers);
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

Status attach(DirectionPage& from, std::uint64_t nth, Pack& pack) {
  const std::string label = section_label(kDirectionSection, nth);
  if (from.page >= pack.lightmaps.size())
    return invalid(label, "found lightmap page {}, expected less than {}", from.page, pack.lightmaps.size());
  LightmapPage& page = pack.lightmaps[from.page];
  if (from.width != page.width || from.height != page.height)
    return invalid(label, "found {} x {} texels, expected page {}'s {} x {}", from.width, from.height, from.page,
                   page.width, page.height);
  if (!page.direction.empty()) return invalid(label, "page {} has directions already, expected one section", from.page);
  page.direction = std::move(from.direction);
  return {};
}

Status attach(NormalMapping& from, Pack& pack) {
  const std::string label = section_label(kNormalMappingSection, 0);
  for (const NormalMapping::Use& use : from.uses) {
    if (use.material >= pack.materials.size())
      return invalid(label, "found material {}, expected less than {}", use.material, pack.materials.size());
    Material& material = pack.materials[use.material];
    if (material.normal_texture >= 0) return invalid(label, "material {} is there twice, expected once", use.material);
    if (use.normal_texture < 0) return invalid(label, "found normal texture {}, expected 0 up", use.normal_texture);
    material.normal_texture = use.normal_texture;
    material.normal_scale = use.normal_scale;
  }
  pack.mesh.normal_uvs = std::move(from.uvs);
  pack.mesh.tangents = std::move(from.tangents);
  return {};
}

Status attach(KernelSlices& from, Pack& pack) {
  const std::string label = section_label(kKernelSliceSection, 0);
  if (from.kernel >= pack.kernels.size())
    return invalid(label, "found kernel {}, expected less than {}", from.kernel, pack.kernels.size());
  BrdfKernel& kernel = pack.kernels[from.kernel];
  if (!kernel.slices.empty()) return invalid(label, "kernel {} is there twice, expected once", from.kernel);
  kernel.slice_size = from.size;
  kernel.slices = std::move(from.slices);
  return {};
}

Status attach(KernelFits& from, Pack& pack) {
  const std::string label = section_label(kKernelFitSection, 0);
  if (from.kernel >= pack.kernels.size())
    return invalid(label, "found kernel {}, expected less than {}", from.kernel, pack.kernels.size());
  BrdfKernel& kernel = pack.kernels[from.kernel];
  if (!kernel.fits.empty()) return invalid(label, "kernel {} is there twice, expected once", from.kernel);
  kernel.fits = std::move(from.fits);
  return {};
}

Status attach(FresnelFactor& from, Pack& pack) {
  const std::string label = section_label(kFresnelFactorSection, 0);
  if (from.map >= pack.fresnel_maps.size())
    return invalid(label, "found Fresnel map {}, expected less than {}", from.map, pack.fresnel_maps.size());
  FresnelMap& map = pack.fresnel_maps[from.map];
  if (!map.factor.empty()) return invalid(label, "Fresnel map {} is there twice, expected once", from.map);
  map.factor = std::move(from.factor);
  return {};
}

Status attach(const ResidualMap& from, Pack& pack) {
  const std::string label = section_label(kResidualSection, 0);
  if (from.map >= pack.radiance_maps.size())
    return invalid(label, "found radiance map {}, expected less than {}", from.map, pack.radiance_maps.size());
  RadianceMap& map = pack.radiance_maps[from.map];
  if (map.residual) return invalid(label, "radiance map {} is there twice, expected once", from.map);
  map.residual = true;
  return {};
}

Status attach(ReflectorEmitters& from, Pack& pack) {
  const std::string label = section_label(kReflectorEmitterSection, 0);
  if (from.reflector >= pack.reflectors.size())
    return invalid(label, "found reflector {}, expected less than {}", from.reflector, pack.reflectors.size());
  Reflector& reflector = pack.reflectors[from.reflector];
  if (!reflector.emitters.empty()) return invalid(label, "reflector {} is there twice, expected once", from.reflector);
  reflector.emitters = std::move(from.emitters);
  reflector.visibility_x = from.width;
  reflector.visibility_y = from.height;
  reflector.visibility = std::move(from.visibility);
  return {};
}

// A radiance map without its pixels.
Status decode_without_pixels(std::span<const std::byte> file, const SectionInfo& section, Pack& pack) {
  ORIEL_TRY_VOID(check_section(file, section));
  ORIEL_TRY(const Bytes head, section_head(file, section, kRadianceMapPlaceBytes));
  ByteReader in(head);
  RadianceMap map;
  RadianceMapScale scale;
  if (auto status = decode_place(in, map, scale); !status && in.ok())
    return invalid(section.label, "element 0: {}", status.error().message);
  const std::uint64_t expected = kRadianceMapPlaceBytes + std::uint64_t{7} * map.width * map.height;
  if (!in.ok() || section.raw_bytes != expected)
    return invalid(section.label, "found {} bytes, expected the {} of its pixels", section.raw_bytes, expected);
  pack.radiance_maps.push_back(std::move(map));
  return {};
}

Result<Pack> decode_all(std::span<const std::byte> file, const PackIndex& index, MapPixels pixels) {
  Parts parts;
  Pack& pack = parts.pack;
  for (const auto& section : index.sections) {
    if (section.kind == kRadianceMapSection && pixels == MapPixels::kDeferred) {
      ORIEL_TRY_VOID(decode_without_pixels(file, section, pack));
      continue;
    }
    if (find_section_kind(section.kind)) {
      ORIEL_TRY_VOID(decode_section(file, section, parts));
      continue;
    }
    ORIEL_TRY_VOID(check_section(file, section));
    const auto stored = stored_bytes(file, section);
    pack.unknown.push_back(
        {section.kind, section.codec, section.raw_bytes, section.count, Bytes(stored.begin(), stored.end())});
  }
  for (std::size_t i = 0; i < parts.directions.size(); ++i) ORIEL_TRY_VOID(attach(parts.directions[i], i, pack));
  for (KernelSlices& slices : parts.kernel_slices) ORIEL_TRY_VOID(attach(slices, pack));
  for (KernelFits& fits : parts.kernel_fits) ORIEL_TRY_VOID(attach(fits, pack));
  for (FresnelFactor& factor : parts.fresnel_factors) ORIEL_TRY_VOID(attach(factor, pack));
  for (const ResidualMap& residual : parts.residuals) ORIEL_TRY_VOID(attach(residual, pack));
  for (ReflectorEmitters& part : parts.reflector_emitters) ORIEL_TRY_VOID(attach(part, pack));
  for (NormalMapping& mapping : parts.normal_mapping) ORIEL_TRY_VOID(attach(mapping, pack));
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

Result<RadianceMap> decode_map(std::span<const std::byte> file, const SectionInfo& section, std::size_t map) {
  Parts parts;
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
