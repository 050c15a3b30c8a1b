// The emitters that a glossy reflector's maps leave out, as shaders/passes/reflector_emitters.glsl reads them.
#pragma once

#include <span>

#include "formats/pack/pack.h"
#include "player/gpu/texture.h"

namespace oriel {

// Polygons of what of the emitters lies before the reflector's plane. A polygon is a row of four texels: the x, y, z of
// four corners, a triangle's last one twice, in reflector space in units of the reflector's size; then its light in
// cd/m² and the number from 1 of its emitter in Reflector::emitters, negative where both sides shine.
struct GpuEmitters {
  int cells_x = 0, cells_y = 0;  // between the nodes of Reflector::visibility
  gpu::Texture2d polygons;       // none where there is nothing to show
  gpu::Texture2d visibility;     // the shares at a cell's nodes (x, y), (x+1, y), (x, y+1), (x+1, y+1); by emitter
  gpu::Texture2d seen;           // bit k of a cell's 128: polygon k is seen from any of its nodes
};
// Which of the pack's emitters a reflector shows in closed form, and what its nodes see of them, as Reflector has both.
struct ListedEmitters {
  std::span<const std::uint32_t> emitters;
  std::uint32_t visibility_x = 0, visibility_y = 0;
  std::span<const std::uint8_t> visibility;
};
inline ListedEmitters listed_by(const Reflector& r) {
  return {r.emitters, r.visibility_x, r.visibility_y, r.visibility};
}
// size: metres.
GpuEmitters upload_emitters(const Pack& pack, const ListedEmitters& listed, const Mat4& reflector_from_pack,
                            float size);

}  // namespace oriel
