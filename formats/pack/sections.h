// What lies inside each section: one pair of functions a kind. Used by the writer and the reader only.
#pragma once

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/pack/encoding/half_page.h"
#include "formats/pack/pack.h"

namespace oriel {

// What a section adds to elements of other kinds: read apart, because sections come in any order.
struct DirectionPage {
  std::uint32_t page = 0;  // into Pack::lightmaps
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> direction;
};
// Of one kernel.
struct KernelSlices {
  std::uint32_t kernel = 0;  // into Pack::kernels
  std::uint32_t size = 0;
  std::vector<KernelSlice> slices;
};
// A radiance map that is a residual.
struct ResidualMap {
  std::uint32_t map = 0;  // into Pack::radiance_maps
};
// What a reflector's maps leave out.
struct ReflectorEmitters {
  std::uint32_t reflector = 0;  // into Pack::reflectors
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> emitters;
  std::vector<std::uint8_t> visibility;
};
struct KernelFits {
  std::uint32_t kernel = 0;  // into Pack::kernels
  std::vector<LobeFit> fits;
};
struct FresnelFactor {
  std::uint32_t map = 0;  // into Pack::fresnel_maps
  std::vector<Vec3> factor;
};
struct NormalMapping {
  struct Use {
    std::uint32_t material = 0;       // into Pack::materials
    std::int32_t normal_texture = 0;  // into Pack::normal_textures
    float normal_scale = 1;
  };
  std::vector<Use> uses;
  std::vector<Vec2> uvs;
  std::vector<Vec4> tangents;
};

// Append one element. They rely on a pack that validate() finds nothing wrong with.
void encode(ByteWriter& out, const Mesh& mesh);
void encode(ByteWriter& out, const Material& material);
void encode(ByteWriter& out, const Reflector& reflector);
void encode(ByteWriter& out, const Camera& camera);
void encode(ByteWriter& out, const CameraPath& path);
void encode(ByteWriter& out, const Texture& texture);
void encode(ByteWriter& out, const LightmapPage& page);
void encode(ByteWriter& out, const DirectionPage& page);
void encode(ByteWriter& out, const NormalMapping& mapping);
void encode(ByteWriter& out, const RadianceMap& map);
void encode(ByteWriter& out, const CurvedReflector& reflector);
void encode(ByteWriter& out, const SurroundMap& map);
void encode(ByteWriter& out, const BrdfKernel& kernel);
void encode(ByteWriter& out, const KernelSlices& slices);
void encode(ByteWriter& out, const FresnelMap& map);
void encode(ByteWriter& out, const FresnelFactor& factor);
void encode(ByteWriter& out, const SplitReflectance& split);
void encode(ByteWriter& out, const WalkGrid& grid);
void encode(ByteWriter& out, const Emitter& emitter);
void encode(ByteWriter& out, const ReflectorEmitters& part);
void encode(ByteWriter& out, const ResidualMap& residual);
void encode(ByteWriter& out, const KernelFits& fits);
void encode(ByteWriter& out, const VisibleSets& sets);
void encode(ByteWriter& out, const Mover& mover);
void encode(ByteWriter& out, const LightField& field);

// Read one element from hostile bytes. Codes that mean nothing give an error without a place; where the bytes end early
// the element is incomplete and in is not ok(), which the caller asks. Allocations stay in proportion to the bytes
// left.
Status decode(ByteReader& in, Mesh& mesh);
Status decode(ByteReader& in, Material& material);
Status decode(ByteReader& in, Reflector& reflector);
Status decode(ByteReader& in, Camera& camera);
Status decode(ByteReader& in, CameraPath& path);
Status decode(ByteReader& in, Texture& texture);
Status decode(ByteReader& in, LightmapPage& page);
Status decode(ByteReader& in, DirectionPage& page);
Status decode(ByteReader& in, NormalMapping& mapping);
Status decode(ByteReader& in, RadianceMap& map);
// The same without what is there by texel: the beginning of the section.
struct RadianceMapScale {
  int exponent = 0;  // of 2: what radiance was divided by
  int shift = 0;     // disparity_from_code's
};
inline constexpr std::size_t kRadianceMapPlaceBytes = 52;
Status decode_place(ByteReader& in, RadianceMap& map, RadianceMapScale& scale);
Status decode_place(ByteReader& in, Texture& texture);
Status decode_place(ByteReader& in, LightmapPage& page);
Status decode_place(ByteReader& in, DirectionPage& page);
struct SurroundMapScale {
  int exponent = 0;   // of 2: what radiance was divided by
  float nearest = 0;  // what codes of inverse distance are shares of
};
Status decode_place(ByteReader& in, SurroundMap& map, SurroundMapScale& scale);
// Of a lightmap page all that lights surfaces, which is its beginning, light_bytes() of the section.
inline std::uint64_t light_bytes(std::uint64_t texels, std::uint64_t details) {
  return 20 + 6 * texels + (details > 0 ? 4 * texels + 6 * details : 0);
}
Status decode(ByteReader& in, HalfPage& page);
Status decode(ByteReader& in, CurvedReflector& reflector);
Status decode(ByteReader& in, SurroundMap& map);
Status decode(ByteReader& in, BrdfKernel& kernel);
Status decode(ByteReader& in, KernelSlices& slices);
Status decode(ByteReader& in, FresnelMap& map);
Status decode(ByteReader& in, FresnelFactor& factor);
Status decode(ByteReader& in, SplitReflectance& split);
Status decode(ByteReader& in, WalkGrid& grid);
Status decode(ByteReader& in, Emitter& emitter);
Status decode(ByteReader& in, ReflectorEmitters& part);
Status decode(ByteReader& in, ResidualMap& residual);
Status decode(ByteReader& in, KernelFits& fits);
Status decode(ByteReader& in, VisibleSets& sets);
Status decode(ByteReader& in, Mover& mover);
Status decode(ByteReader& in, LightField& field);

}  // namespace oriel
