#include "bake/import/extensions.h"

#include <map>

namespace oriel::gltf {
namespace {

constexpr const char* kConvertImages = "convert its images to PNG, JPEG or WebP";

const std::map<std::string, Extension>& extensions() {
  static const std::map<std::string, Extension> all{
      {"EXT_mesh_gpu_instancing", {Support::kFull}},
      {"EXT_meshopt_compression", {Support::kFull}},
      {"EXT_texture_webp", {Support::kFull}},
      {"KHR_draco_mesh_compression", {Support::kFull}},
      {"KHR_lights_punctual", {Support::kFull}},
      {"KHR_materials_anisotropy", {Support::kFull}},
      {"KHR_materials_clearcoat", {Support::kFull}},
      {"KHR_materials_emissive_strength", {Support::kFull}},
      {"KHR_materials_ior", {Support::kFull}},
      {"KHR_materials_pbrSpecularGlossiness", {Support::kFull}},
      {"KHR_materials_specular", {Support::kFull}},
      {"KHR_materials_transmission", {Support::kFull}},
      {"KHR_materials_unlit", {Support::kFull}},
      {"KHR_materials_volume", {Support::kFull}},
      {"KHR_mesh_quantization", {Support::kFull}},
      {"KHR_node_visibility", {Support::kFull}},
      {"KHR_texture_transform", {Support::kFull}},
      {"KHR_materials_diffuse_transmission", {Support::kByMaterial, "no light comes through its surfaces"}},
      {"KHR_materials_dispersion", {Support::kByMaterial, "glass bends all colours alike"}},
      {"KHR_materials_iridescence", {Support::kByMaterial, "it shines in its base colour"}},
      {"KHR_materials_sheen", {Support::kByMaterial, "cloth has no soft rim of light"}},
      {"KHR_animation_pointer", {Support::kWithout, "what it animates stands still"}},
      {"KHR_materials_variants", {Support::kWithout, "meshes have their own materials, those of no variant"}},
      {"KHR_xmp", {Support::kWithout}},
      {"KHR_xmp_json_ld", {Support::kWithout}},
      {"EXT_lights_image_based", {Support::kNone, "its light does not shine; --sky takes an image of the sky"}},
      {"KHR_texture_basisu", {Support::kOtherImages, kConvertImages}},
      {"MSFT_texture_dds", {Support::kOtherImages, kConvertImages}},
      {"EXT_texture_avif", {Support::kOtherImages, kConvertImages}},
  };
  return all;
}

}  // namespace

Extension extension_named(const std::string& name) {
  const auto found = extensions().find(name);
  return found == extensions().end() ? Extension{} : found->second;
}

}  // namespace oriel::gltf
