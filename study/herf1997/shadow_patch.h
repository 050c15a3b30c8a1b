// What movers take of the light of a flat lamp on a plane of the scene, as a soft-shadow texture. No OpenGL.
#pragma once

#include "formats/assets/light_field.h"
#include "formats/assets/mover.h"
#include "study/herf1997/flat_surfaces.h"
#include "study/herf1997/soft_shadow.h"

namespace oriel::study {

// A rectangle of a plane: along its axes, metres.
struct PlaneRect {
  DVec2 lower{0}, upper{0};
  bool empty() const { return !(lower.x < upper.x && lower.y < upper.y); }
};
PlaneRect common(const PlaneRect& a, const PlaneRect& b);
PlaneRect around(const PlaneRect& a, const PlaneRect& b);

// Triangles that cast: those of the opaque scene, and of a mover in its own space.
Occluders still_occluders(const Pack& pack);
Occluders mover_occluders(const Mover& mover);

// Whether a light's shadows can be textures: a polygon whose triangles lie in one plane.
bool is_flat(const BrightLight& light);
// `samples` points of it, of radiance 1.
ShadowLight shadow_light(const BrightLight& light, int samples);

// Where on the plane a box can shade some of a flat light, nothing where it lies behind the plane or the light does.
// shaft: that holds the box and all of its shadow.
PlaneRect shadow_rect(const FlatPlane& plane, const BrightLight& light, std::span<const Vec3> box,
                      std::span<const Vec3> shaft);

struct PatchCaster {
  const Occluders* shape = nullptr;  // in the mover's own space
  DMat4 pack_from_object{1};         // rigid
};

struct ShadowPatch {
  std::uint32_t light = 0;
  std::size_t plane = 0;
  std::vector<PatchCaster> casters{};
  PlaneRect rect{};
  ShadowReceiver receiver{};  // a texel more than rect at each side
  std::vector<float> lux{};   // by texel, for radiance 1: what movers block and the scene does not
};

// Texels as wide as `wanted` metres where no more than 256 of them go along a side.
void lay_texels(const FlatPlane& plane, double wanted, ShadowPatch& patch);

// Keeps its memory. Not for two threads at once.
class PatchPainter {
 public:
  // Fills patch.lux. still: the scene's triangles. touching: as SoftShadowOptions.
  void paint(const Occluders& still, const ShadowLight& light, double touching, ShadowPatch& patch);

 private:
  SoftShadows shadows_;
  BlockedRows taken_;
};

}  // namespace oriel::study
