// What lies inside each section: one description an asset, which writes it and reads it.
#pragma once

#include "formats/pack/half_page.h"
#include "formats/pack/pack.h"
#include "formats/pack/serial.h"

namespace oriel {

// The members of one element. Writing relies on a pack that validate() finds nothing wrong with.
void describe(Serial& s, Mesh& mesh);
void describe(Serial& s, Material& material);
void describe(Serial& s, SolidGlass& solid);
void describe(Serial& s, EmissionTexture& emission);
void describe(Serial& s, Metalness& metalness);
void describe(Serial& s, Texture& texture);
void describe(Serial& s, LightmapPage& page);
void describe(Serial& s, Reflector& reflector);
void describe(Serial& s, RadianceMap& map);
void describe(Serial& s, MapMesh& mesh);
void describe(Serial& s, SkyMap& sky);
void describe(Serial& s, Emitter& emitter);
void describe(Serial& s, CurvedReflector& reflector);
void describe(Serial& s, SurroundMap& map);
void describe(Serial& s, BrdfKernel& kernel);
void describe(Serial& s, FresnelMap& map);
void describe(Serial& s, Camera& camera);
void describe(Serial& s, CameraPath& path);
void describe(Serial& s, WalkGrid& grid);
void describe(Serial& s, VisibleSets& sets);
void describe(Serial& s, ReflectedSets& sets);
void describe(Serial& s, Mover& mover);
void describe(Serial& s, LightField& field);
void describe(Serial& s, LightGroup& group);
// Of movers and of lamps.
void describe_motion(Serial& s, MoverPose& rest, std::vector<MoverKey>& keys);
void describe(Serial& s, PageGroups& page);
void describe(Serial& s, Day& day);
void describe(Serial& s, SharpLight& light);

// The beginning of an image's section: all but what is there by texel.
struct RadianceMapScale {
  std::int32_t exponent = 0;  // of 2: what radiance was divided by
  std::int32_t shift = 0;     // disparity_from_code's
};
struct SurroundMapScale {
  std::int32_t exponent = 0;  // of 2: what radiance was divided by
  float nearest = 0;          // what codes of inverse distance are shares of
};
inline constexpr std::size_t kRadianceMapPlaceBytes = 56, kSurroundMapPlaceBytes = 24, kLightmapPlaceBytes = 20;
void describe_place(Serial& s, Texture& texture);
void describe_place(Serial& s, LightmapPage& page, LightmapFlags& flags);
void describe_place(Serial& s, RadianceMap& map, RadianceMapScale& scale);
void describe_place(Serial& s, SurroundMap& map, SurroundMapScale& scale);

// Of a lightmap page all that lights surfaces, which is the beginning of its section: so many bytes.
inline std::uint64_t light_bytes(std::uint64_t texels, const LightmapFlags& flags, std::uint64_t details) {
  return kLightmapPlaceBytes + 4 + (flags.directional ? 12 : 6) * texels +
         (details > 0 ? 4 * texels + 6 * details : 0) + (flags.sharp ? 4 * texels : 0);
}
Status decode(ByteReader& in, HalfPage& page);

template <class T>
void encode(ByteWriter& out, const T& element) {
  Serial s(out);
  describe(s, const_cast<T&>(element));  // it is only looked at
}

// An error has no place. Where the bytes end early the element is incomplete and in is not ok(), which the caller asks.
template <class T>
Status decode(ByteReader& in, T& element) {
  Serial s(in);
  describe(s, element);
  return s.status();
}

// All sections of a pack in the order of kSectionKinds, for whoever writes or reads one:
//   text(kind, string)   JSON              one(kind, value, present)   exactly one element, where present
//   list(kind, vector)   all in one        each(kind, vector)          a section an element
template <class P, class Visitor>
void visit_sections(P& pack, Visitor& v) {
  v.text(kProvenanceSection, pack.provenance);
  v.text(kPlanSection, pack.plan);
  v.one(kSceneSection, pack.sky, true);
  v.one(kMeshSection, pack.mesh, true);
  v.list(kMaterialSection, pack.materials);
  v.list(kSolidSection, pack.solids);
  v.list(kEmissionTextureSection, pack.emission_textures);
  v.each(kTextureSection, pack.textures);
  v.each(kLightmapSection, pack.lightmaps);
  v.one(kSharpLightSection, pack.sharp_light, !pack.sharp_light.empty());
  v.each(kNormalTextureSection, pack.normal_textures);
  v.list(kReflectorSection, pack.reflectors);
  v.each(kRadianceMapSection, pack.radiance_maps);
  v.each(kMapMeshSection, pack.map_meshes);
  v.list(kEmitterSection, pack.emitters);
  v.list(kFrostedPaneSection, pack.frosted_panes);
  v.list(kCurvedReflectorSection, pack.curved_reflectors);
  v.each(kSurroundMapSection, pack.surround_maps);
  v.list(kKernelSection, pack.kernels);
  v.list(kFresnelSection, pack.fresnel_maps);
  v.list(kCameraSection, pack.cameras);
  v.list(kPathSection, pack.paths);
  v.list(kWalkSection, pack.walk_grids);
  v.one(kVisibleSetsSection, pack.visible_sets, !pack.visible_sets.empty());
  v.one(kReflectedSetsSection, pack.reflected_sets, !pack.reflected_sets.empty());
  v.each(kMoverSection, pack.movers);
  v.one(kLightFieldSection, pack.light_field, pack.light_field.bands > 0);
  v.list(kLightGroupSection, pack.light_groups);
  v.each(kPageGroupsSection, pack.page_groups);
  v.one(kDaySection, pack.day, !pack.day.empty());
  v.one(kSkyMapSection, pack.sky_map, pack.sky_map.width > 0);
  v.list(kMetalnessSection, pack.metalness);
}
inline void describe(Serial& s, Vec3& sky) {
  s(sky);
}

}  // namespace oriel
