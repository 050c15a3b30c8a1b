// What `oriel-inspect info` tells of lightmaps, of the light beside them that is computed by pixel, of reflectors and
// their maps, and of what these were planned for.
#pragma once

#include "formats/core/json.h"
#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel::inspect {

Json triple(const Vec3& v);

void add_lightmaps(const PackIndex& index, const Pack& pack, Json& out);
void print_lightmaps(const PackIndex& index, const Pack& pack);

void add_reflections(const PackIndex& index, const Pack& pack, Json& out);
void print_reflections(const PackIndex& index, const Pack& pack);

}  // namespace oriel::inspect
