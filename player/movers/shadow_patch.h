// What movers take of the light of a flat lamp on a plane of the scene, as a soft-shadow texture (Herf 1997, by
// formats/shadow). No OpenGL.
#pragma once

#include <memory>

#include "formats/assets/light_field.h"
#include "formats/assets/mover.h"
#include "formats/shadow/silhouettes.h"
#include "formats/shadow/soft_shadow.h"
#include "player/movers/flat_surfaces.h"

namespace oriel {

// A rectangle of a plane: along its axes, metres.
struct PlaneRect {
  DVec2 lower{0}, upper{0};
  bool empty() const { return !(lower.x < upper.x && lower.y < upper.y); }
};
PlaneRect common(const PlaneRect& a, const PlaneRect& b);
PlaneRect around(const PlaneRect& a, const PlaneRect& b);

// What casts: triangles of the scene or of a mover, which must be opaque.
Occluders still_occluders(const Pack& pack, std::span<const Vec3> positions);
struct MoverShape {
  explicit MoverShape(const Mover& mover);
  Occluders occluders;
  ShadowBody body;
};

// Whether a light's shadows can be textures: a polygon whose triangles lie in one plane.
bool is_flat(const BrightLight& light);
// `samples` points of it, of radiance 1.
ShadowLight shadow_light(const BrightLight& light, int samples);

// Where on the plane a box can shade some of a flat light, nothing where it lies behind the plane or the light does.
// shaft: that holds the box and all of its shadow.
PlaneRect shadow_rect(const FlatPlane& plane, const BrightLight& light, std::span<const Vec3> box,
                      std::span<const Vec3> shaft);

struct PatchCaster {
  const MoverShape* shape = nullptr;  // the mover's own space
  DMat4 pack_from_object{1};          // rigid
  PlaneRect rect;                     // where its shadow may be
};

// Of a light's samples, those that the scene itself blocks, in a tile of 32 x 32 texels: words by sample and row. Empty
// where it blocks none.
using StillTile = std::vector<std::uint32_t>;
inline constexpr int kTile = 32;

struct ShadowPatch {
  std::uint32_t light = 0;
  std::size_t plane = 0;
  std::vector<PatchCaster> casters{};
  PlaneRect rect{};
  int samples = 0;                                  // of the light
  int level = 0;                                    // texels are 2^level metres
  IVec2 tile{0};                                    // of its first corner on the plane's grid
  ShadowReceiver receiver{};                        // whole tiles around rect
  std::vector<std::shared_ptr<StillTile>> still{};  // by tile, row by row; null: not yet known
  std::vector<float> lux{};  // by texel, for radiance 1: what movers block and the scene does not
};
inline IVec2 tiles_of(const ShadowPatch& patch) {
  return {patch.receiver.width / kTile, patch.receiver.height / kTile};
}

// Texels of 2^level metres, which lie on the same grid wherever the patch is.
void lay_texels(const FlatPlane& plane, int level, ShadowPatch& patch);

// Keeps its memory. Not for two threads at once.
class PatchPainter {
 public:
  // Fills patch.lux, and the tiles of patch.still that are needed and not known. still: the scene's triangles.
  void paint(const Occluders& still, const ShadowLight& light, double touching, ShadowPatch& patch);

 private:
  void block(const PatchCaster& caster, const ShadowLight& light, const ShadowPatch& patch);
  void find_still(const Occluders& still, const ShadowLight& light, ShadowPatch& patch);
  bool takes_in(const IVec2& tile) const;
  void leave(const StillTile& tile, const IVec2& at);

  SoftShadows shadows_;
  SilhouetteShadows silhouettes_;
  double touching_ = 0;
  OccluderView lamp_;  // as the receiver has it, without occluders
  BlockedRows taken_;
};

}  // namespace oriel
