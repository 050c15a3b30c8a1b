// Finer light where the lightmap's texels miss too much: contact shadows, edges of shadows.
#pragma once

#include "bake/radiosity/estimators/point_light.h"

namespace oriel {

// Chooses cells by the light as it stands and fills LightmapPage::cell and detail, and the report's numbers of them.
// Error kStopped: the pages are as they were.
Status add_detail(const RadiosityTask& task, const TexelLight& known, Radiosity& light);

}  // namespace oriel
