// A scene baked without the light of its lamps, which passes add: radiosity without its first bounce takes the place of
// ambient light (Diefenbach & Badler 1997, section 2).
#pragma once

#include "bake/radiosity/radiosity.h"
#include "bake/run/pipeline.h"

namespace oriel::study {

// By page: the light that surfaces reflect, by Estimator::kCached, without what comes from lamps at once or by way of
// specular reflections alone, finer light and directions. Errors as bake_radiosity().
Result<std::vector<LightmapPage>> bake_reflected(const LightmapScene& scene, const RadiosityOptions& options,
                                                 Context& context);

// A pack that has this light as its lightmap, and all lamps that a bright light can be in its light field, which
// without movers is one cell without light. Its reflectors are mirrors of geometry. Tells on stderr what shines and is
// in no pass. Error kUsage where there are more than kMaxBrightLights lamps; errors as bake().
Result<Pack> bake_without_lamps(const std::string& scene, BakeOptions options);
// Likewise; or reads a pack that it made. Error kInvalid for another pack, whose lightmap has the light of lamps.
Result<Pack> open_without_lamps(const std::string& input, const BakeOptions& options);

}  // namespace oriel::study
