// What shines on frosted panes, for who sees them from behind: their facets spread it (docs/notes/materials.md,
// "Frosted panes").
#pragma once

#include "bake/radiance/emitters.h"

namespace oriel {

inline constexpr std::size_t kMostBentPanes = 512;

// The sides of frosted panes on which points, spots or suns shine, by plane and material, as reflectors that face these
// lights: each lists at most 16 of them, with what its nodes see of them. Panes that are bent are cut into parts that
// are nearly flat. Appends what they are to `emitters`. None without such lights; of flat ones at most
// PlanarMirrors::kMost, of others kMostBentPanes, the largest. What is left out goes to `omitted`, a line each. Error
// kStopped.
Result<std::vector<FoundReflector>> find_lit_panes(const Accel& accel, Context& context, std::vector<Emitter>& emitters,
                                                   std::vector<std::string>& omitted);

}  // namespace oriel
