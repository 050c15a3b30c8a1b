// What `info` tells of reflectors, their maps and what these were planned for.
#pragma once

#include "formats/core/json.h"
#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel::inspect {

Json triple(const Vec3& v);

void add_reflections(const PackIndex& index, const Pack& pack, Json& out);
void print_reflections(const PackIndex& index, const Pack& pack);

}  // namespace oriel::inspect
