// What a bake leaves of its reflections for the next one, after an edit that may hardly change them
// (docs/notes/cache.md). Pixels are not among it: they are the store's units, under the inputs that capture had.
#pragma once

#include <optional>

#include "bake/jobs/units.h"
#include "bake/radiance/reflector_plan.h"

namespace oriel {

// A surface of the scene: its bounds, and a hash of its place, shape, material and light.
struct ScenePart {
  Hash128 look;
  Vec3 lower{0}, upper{0};
};
inline void fields(Archive& archive, ScenePart& p) {
  archive(p.look, p.lower, p.upper);
}

struct KnownReflections {
  std::vector<ScenePart> parts;
  std::vector<KnownPlan> plans;
  std::vector<Hash128> captured;  // by the number that maps had it under: which reflector (identity_of)
  Hash128 inputs;                 // of the stage that captured the maps
  Hash128 around;  // the scene's bounds and the sky: where it is another, all that sees the sky is edited
};

// Nothing where the store holds none, or one that is not whole.
std::optional<KnownReflections> recall_reflections(Context& context, const Hash128& name);
void remember_reflections(Context& context, const Hash128& name, KnownReflections known);

// An axis-aligned box, scene space.
struct Box {
  Vec3 lower{0}, upper{0};
};

// Where the scene is not what it was: the bounds of parts that are new or gone, a little enlarged. Many edits are one
// box.
std::vector<Box> edited_boxes(std::span<const ScenePart> before, std::span<const ScenePart> now);

// Whether the ray meets one of them within that distance.
bool meets(std::span<const Box> boxes, const Vec3& from, const Vec3& direction, float distance);

}  // namespace oriel
