// Lamps that glossy reflectors show in closed form: a kernel that blurs an image of a small bright lamp needs it far
// sharper than all else, and errs most there.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiance/reflectors.h"
#include "formats/assets/emitter.h"
#include "formats/query/reflector_nodes.h"

namespace oriel {

struct EmitterOptions {
  std::span<const float>
      lobe_widths;  // α of each material's lobe, 0 where it is as sharp as a mirror or shows no image
  // Between nodes of the visibility's grid, and how many of them along a side: to choose the lamps, and for those
  // chosen.
  float choice_node_m = 0.5f, node_m = kNodeDistance_m;
  std::uint32_t max_choice_nodes = 17, max_nodes = kMostNodesAlong;
  std::uint32_t samples = 32;     // rays from a node to an emitter, at most
  bool squares_turn = false;      // as LitPlane's
  std::uint32_t max_lights = 64;  // of a reflector whose visibility is computed: those that would light it most
};

// Lamps are the scene's flat ones and, since no map shows them, the sun (sun_emitter.h), points and spots
// (punctual_emitter.h).
// Mirrors list the latter alone: as glints, since their images have all that has a surface.
// For each reflector with a lobe the lamps that light it most are left out of its maps: at most kMaxReflectorEmitters
// polygons. Sets the reflectors' emitters, and in Reflector the emitters with their visibility; appends to `emitters`
// what they refer to.
// Where there are light groups, `emitters` ends with lamps' polygons that no reflector lists: lamps may be moved.
// A lamp is left out whole or not at all; textured ones, those of more triangles and those that are partly hidden and
// not small beside the lobe, so that the share which a point sees is not that which the lobe sees, stay in the maps,
// and so do those beyond that number, with a line in `omitted` each time. Of a reflector that is drawn as geometry,
// whose image is as fine as the screen, any that is partly hidden stays in that. The same for any number of threads.
// Error kStopped.
struct LeftOutEmitters {
  std::vector<FoundReflector>& reflectors;
  std::vector<Emitter>& emitters;
  std::vector<std::string>& omitted;
};
Status leave_out_emitters(const Accel& accel, const EmitterOptions& options, Context& context,
                          const LeftOutEmitters& out);

}  // namespace oriel
