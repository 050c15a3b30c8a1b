// What `info` tells of reflectors, their maps and what these were planned for.
#pragma once

#include <nlohmann/json.hpp>

#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel::inspect {

nlohmann::ordered_json triple(const Vec3& v);

void add_reflections(const PackIndex& index, const Pack& pack, nlohmann::ordered_json& out);
void print_reflections(const PackIndex& index, const Pack& pack);

}  // namespace oriel::inspect
