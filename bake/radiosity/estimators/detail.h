// Finer light between texels where their interpolation is not accurate enough: contact shadows, edges of shadows.
#pragma once

#include "bake/radiosity/estimators/point_light.h"

namespace oriel {

// Chooses cells by the light as it stands. Fills LightmapPage::cell and detail, Radiosity::groups and the report's
// DetailReport. Error kStopped: the pages are unchanged.
Status add_detail(const RadiosityTask& task, const TexelLight& texel_light, Radiosity& light);

}  // namespace oriel
