// What `oriel-inspect info` tells of lightmaps and of the light beside them that is computed by pixel.
#pragma once

#include "formats/core/json.h"
#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel::inspect {

void add_lightmaps(const PackIndex& index, const Pack& pack, Json& out);
void print_lightmaps(const PackIndex& index, const Pack& pack);

}  // namespace oriel::inspect
