// What a bake must be, or it fails: --require.
#pragma once

#include "bake/cli/session.h"
#include "bake/run/pipeline.h"

namespace oriel {

struct Requirements {
  bool whole = true;  // nothing that was asked for is missing
  bool sound = false, reflections = false;
  double error = 0;                     // of the light, relative, at most; 0: any
  std::vector<std::string> given = {};  // as they were typed
};

// Light and textures are warnings that become errors of the session: they end the bake at once.
OptionValue requirements(Requirements& out, BakeSession& session);

// "9.6 % (0 to 14 %)": a measurement that cannot be told from its own noise is a bound.
std::string measured_text(const HeldOutError& error);

// Errors kIncomplete and kUnmet, whose text follows "the pack …"; what is met is a note with its figure.
Status judge(const Requirements& requirements, const BakeResult& result, BakeSession& session);

}  // namespace oriel
