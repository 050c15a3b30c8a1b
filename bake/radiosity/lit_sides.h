// Detection of the sides of double-sided surfaces that are lit or visible, before the atlas gives texels to those.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiosity/split_sides.h"
#include "bake/trace/path.h"

namespace oriel {

struct SidesReport {
  std::size_t turned = 0;   // connected parts lit on the back only
  std::size_t doubled = 0;  // lit from both sides
  std::uint64_t rays = 0;
};

struct FoundSides {
  std::vector<LitSides> sides;  // by triangle, for split_sides()
  SidesReport report;
  bool change_scene() const { return report.turned + report.doubled > 0; }
};

// Classifies every connected part (by vertex indices) of double-sided surfaces, except unlit ones, by paths from points
// on both sides. Of thousands of parts, the small ones are grouped in patches, which count as one part. A side counts
// as lit if one of its points gets more than 1 % of the other side's mean, or if a line of sight from an eye (scene
// space, m) meets it, since few paths may miss the light of small visible parts. A part with no lit side is kFront, and
// so is a closed body with a dark inside. Parts not classified before an Interruptible ends are kBoth. Stage name
// "sides"; error kStopped.
Result<FoundSides> find_lit_sides(const Transport& transport, std::span<const Vec3> eyes, Context& context);

}  // namespace oriel
