// Which sides of double-sided surfaces receive light or are seen: found before the atlas, which needs texels for those.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiosity/split_sides.h"
#include "bake/trace/path.h"

namespace oriel {

struct SidesReport {
  std::size_t turned = 0;   // connected parts of double-sided surfaces that are lit from behind only
  std::size_t doubled = 0;  // lit from both sides
  std::uint64_t rays = 0;
};

struct FoundSides {
  std::vector<LitSides> sides;  // by triangle, as split_sides() takes them
  SidesReport report;
  bool change_scene() const { return report.turned + report.doubled > 0; }
};

// Follows paths from points on both sides of every connected part (by vertex indices) of the double-sided surfaces,
// unlit ones excepted; of thousands of parts the small ones are looked at in patches, which count as one. A side counts
// where one of its points gets more than 1 % of the other side's mean, or has a line of sight to one of the eyes (scene
// space) nearest to it: few paths may miss the light of small parts that people see. A part without either is kFront,
// so is a closed body whose inside is dark. Where an Interruptible ends it, parts that nobody looked at are kBoth.
// Stage name "sides"; error kStopped.
Result<FoundSides> find_lit_sides(const Transport& transport, std::span<const Vec3> eyes, Context& context);

}  // namespace oriel
