#include "formats/pack/sections/parts.h"

#include <map>

namespace oriel {
namespace {

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

}  // namespace

PackParts::PackParts(const PackIndex& index) {
  std::map<std::uint32_t, std::size_t> numbers;
  for (const auto& section : index.sections) ++numbers[section.kind];
  pack.textures.resize(numbers[kTextureSection]);
  pack.lightmaps.resize(numbers[kLightmapSection]);
  directions.resize(numbers[kDirectionSection]);
  pack.normal_textures.resize(numbers[kNormalTextureSection]);
  pack.radiance_maps.resize(numbers[kRadianceMapSection]);
  pack.surround_maps.resize(numbers[kSurroundMapSection]);
  pack.movers.resize(numbers[kMoverSection]);
}

Status attach(PackParts& parts) {
  Pack& pack = parts.pack;
  for (std::size_t i = 0; i < parts.directions.size(); ++i) ORIEL_TRY_VOID(attach(parts.directions[i], i, pack));
  for (KernelSlices& slices : parts.kernel_slices) ORIEL_TRY_VOID(attach(slices, pack));
  for (KernelFits& fits : parts.kernel_fits) ORIEL_TRY_VOID(attach(fits, pack));
  for (FresnelFactor& factor : parts.fresnel_factors) ORIEL_TRY_VOID(attach(factor, pack));
  for (const ResidualMap& residual : parts.residuals) ORIEL_TRY_VOID(attach(residual, pack));
  for (ReflectorEmitters& part : parts.reflector_emitters) ORIEL_TRY_VOID(attach(part, pack));
  for (NormalMapping& mapping : parts.normal_mapping) ORIEL_TRY_VOID(attach(mapping, pack));
  return {};
}

}  // namespace oriel
