// The part of the panel that changes lamps and materials, saves them and bakes.
#pragma once

#include "preview/frame/background_bake.h"
#include "preview/frame/scene_edits.h"

namespace oriel {

// What the user did in this frame.
struct PanelWishes {
  bool edited = false, saves = false, undoes = false, bakes = false, stops = false;
};

// Which lamp and material are shown.
struct EditSelection {
  int light = 0, material = 0;
};

// In the panel that is open.
PanelWishes draw_edit_panel(const Scene& scene, const BackgroundBake& bake, SceneEdits& edits,
                            EditSelection& selection);

}  // namespace oriel
