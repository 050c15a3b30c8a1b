// Which glass is solid: light refracts at closed surfaces only.
#pragma once

#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

// Materials with a volume (SceneMaterial::solid) stay solid on surfaces that enclose a space and face outwards, each by
// itself or all of a material and a mover together. Corners at the same place are one. Solids have one side, whatever
// the file says. Closed surfaces that face inwards are walls of hollows where a body of the material is around them.
// A body that is air to a half or more, and the walls of its hollow, get a copy of the material that is a thin pane
// seen from both sides, with half of the glass's tint each. Other surfaces do, with a warning and the tint of their
// thickness; so does glass of an alpha mode other than OPAQUE. Glass without a volume is a thin pane, seen from both
// sides whatever the file says: a window that is a box of one-sided panes lets light in and out.
void find_solids(Scene& scene, Context& context);

}  // namespace oriel
