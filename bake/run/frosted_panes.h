// Frosted panes and what shines on them, into the pack.
#pragma once

#include "bake/run/assemble.h"
#include "bake/run/task.h"

namespace oriel {

// Pack::frosted_panes and the emitters that they list. Appends to `omissions` what is left out. Error kStopped.
Status list_frosted_panes(const BakeTask& bake, const AssembledMesh& mesh, std::vector<Warning>& omissions);

}  // namespace oriel
