// The members of assets in order, for Archive: to keep them to the last bit while a pack is baked. A pack itself has
// its own sections (formats/pack), which round.
#pragma once

#include "formats/assets/brdf_kernel.h"
#include "formats/assets/emitter.h"
#include "formats/assets/fresnel_map.h"
#include "formats/assets/light_field.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/radiance_map.h"
#include "formats/assets/transfer.h"
#include "formats/core/archive.h"

namespace oriel {

inline void fields(Archive& archive, KernelSlice& s) {
  archive(s.cos_theta, s.albedo, s.energy_kept, s.tilt_rad, s.shift, s.width, s.lower, s.upper, s.radial_extent,
          s.radial, s.weights);
}
inline void fields(Archive& archive, LobeFit& f) {
  archive(f.m11, f.m13, f.m22, f.m31, f.amplitude);
}
inline void fields(Archive& archive, BrdfKernel& k) {
  archive(k.alpha, k.cos_theta, k.half_extent, k.energy_kept, k.size, k.weights, k.slice_size, k.slices, k.fits);
}
inline void fields(Archive& archive, FresnelMap& m) {
  archive(m.alpha, m.table, m.factor);
}
inline void fields(Archive& archive, Emitter& e) {
  archive(e.corners, e.radiance, e.two_sided);
}
inline void fields(Archive& archive, LightmapPage& p) {
  archive(p.width, p.height, p.irradiance, p.standard_error, p.state, p.direction, p.cell, p.detail_width,
          p.detail_height, p.detail, p.sharp, p.sharp_at);
}
inline void fields(Archive& archive, LightProbe& p) {
  archive(p.position, p.valid, p.bright, p.kept, p.sh, p.depth);
}
inline void fields(Archive& archive, CompressedTransfer& t) {
  archive(t.bands, t.channels, t.clusters, t.components, t.basis, t.weight_scale, t.cluster, t.weight, t.error);
}
inline void fields(Archive& archive, Reflector& r) {
  archive(r.name, r.material, r.pack_from_reflector, r.lower, r.upper, r.area_m2, r.flatness_m, r.indices, r.elements_x,
          r.elements_y, r.first_map, r.map_count, r.emitters, r.visibility_x, r.visibility_y, r.visibility);
}
inline void fields(Archive& archive, RadianceMap& m) {
  archive(m.reflector, m.element, m.eye, m.lower, m.upper, m.width, m.height, m.has_emission, m.radiance, m.disparity,
          m.valid);
}
// Where a map looks, without what it sees.
inline Hash128 frame_of(const RadianceMap& m) {
  return hash_of(m.reflector, m.element, m.eye, m.lower, m.upper, m.width, m.height, m.has_emission);
}

}  // namespace oriel
