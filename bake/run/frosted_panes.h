// Frosted panes and what shines on them, into the pack.
#pragma once

#include <functional>

#include "bake/run/assemble.h"
#include "bake/run/task.h"

namespace oriel {

// Pack::frosted_panes, where reflections are baked. Appends to `emitters` those that they list, and to `omissions` what
// is left out. Error kStopped.
Result<std::vector<Reflector>> list_frosted_panes(const BakeTask& bake, const AssembledMesh& mesh,
                                                  const std::function<bool()>& late, std::vector<Emitter>& emitters,
                                                  std::vector<Warning>& omissions);

}  // namespace oriel
