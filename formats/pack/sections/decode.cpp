#include "formats/pack/sections/decode.h"

#include "formats/pack/fields.h"

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

}  // namespace

Status decode_section(std::span<const std::byte> raw, const SectionInfo& section, PackParts& parts) {
  Pack& pack = parts.pack;
  ByteReader in(raw);
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

}  // namespace oriel
