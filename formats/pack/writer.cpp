#include "formats/pack/writer.h"

#include <algorithm>
#include <functional>

#include "formats/core/file.h"
#include "formats/pack/fields.h"
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
  void add_text(std::uint32_t kind, const std::string& text) {
    if (!text.empty()) add(kind, 1, [&text](ByteWriter& out) { out.put_array(std::span<const char>(text)); });
  }
  // elements: of the pack, or a list made for this (moved in).
  template <class T>
  void add_list(std::uint32_t kind, const std::vector<T>& elements) {
    if (!elements.empty()) add(kind, elements.size(), [&elements](ByteWriter& out) { encode_all(out, elements); });
  }
  template <class T>
  void add_list(std::uint32_t kind, std::vector<T>&& elements) {
    const std::size_t count = elements.size();
    if (count == 0) return;
    add(kind, count, [made = std::move(elements)](ByteWriter& out) { encode_all(out, made); });
  }
  template <class T>
  void add_one(std::uint32_t kind, const T& element) {
    add(kind, 1, [&element](ByteWriter& out) { encode(out, element); });
  }
  template <class T>
  void add_each(std::uint32_t kind, const std::vector<T>& elements) {
    for (const T& element : elements) add_one(kind, element);
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
  template <class T>
  static void encode_all(ByteWriter& out, const std::vector<T>& elements) {
    for (const T& element : elements) encode(out, element);
  }

  std::vector<std::function<Status(PackStream&)>> writers_;
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

// Refers to the pack.
SectionList sections_of(const Pack& pack) {
  SectionList list;
  list.add_text(kProvenanceSection, pack.provenance);
  list.add_text(kPlanSection, pack.plan);
  list.add(kSceneSection, 1, [&pack](ByteWriter& out) { put(out, pack.sky); });
  list.add_one(kMeshSection, pack.mesh);
  list.add_list(kMaterialSection, pack.materials);
  list.add_each(kTextureSection, pack.textures);
  list.add_each(kLightmapSection, pack.lightmaps);
  for (std::size_t i = 0; i < pack.lightmaps.size(); ++i) {
    const LightmapPage& page = pack.lightmaps[i];
    if (page.direction.empty()) continue;
    list.add(kDirectionSection, 1, [&page, i](ByteWriter& out) {
      encode(out, DirectionPage{static_cast<std::uint32_t>(i), page.width, page.height, page.direction});
    });
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
  if (pack.split_reflectance.angles > 0) list.add_one(kSplitSection, pack.split_reflectance);
  list.add_list(kCameraSection, pack.cameras);
  list.add_list(kPathSection, pack.paths);
  list.add_list(kWalkSection, pack.walk_grids);
  if (!pack.visible_sets.empty()) list.add_one(kVisibleSetsSection, pack.visible_sets);
  list.add_each(kMoverSection, pack.movers);
  if (pack.light_field.bands > 0) list.add_one(kLightFieldSection, pack.light_field);
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
