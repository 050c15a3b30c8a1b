// Where eyes can be: what radiance maps are planned for.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bake/visibility/floor_plan.h"
#include "formats/assets/walk_grid.h"

namespace oriel {

enum class EyeSource : std::uint8_t { kWalk, kBox, kFile };

struct EyeOptions {
  EyeSource source = EyeSource::kWalk;
  std::vector<DVec3> points;  // kFile: world space, metres
  WalkOptions walk;
};

struct EyeRegion {
  std::vector<WalkGrid> grids;  // by storey; empty unless people walk
  std::vector<Vec3> points;     // eyes that are given: of the scene's cameras and paths, or of a file; scene space
  Vec3 lower{0}, upper{0};      // where neither grids nor points are: any place in this box
  float left_out_m2 = 0;        // of open floor beside it, where neither a roof nor a camera leads to
  std::string note;             // why it is not what was asked for; empty where it is
};

// The floors that can be reached on foot from the scene's cameras and paths, or, where none stands on a floor, the
// largest connected ones (those under a roof if there are any). Of open ground only what lies near a roof, a camera or
// a path (WalkOptions): nobody looks at a house from the far end of its lawn. A storey's grid spans less than the head
// room in height. Without a floor: the scene's box, with a note. Error kStopped.
Result<EyeRegion> find_eye_region(const Accel& accel, const EyeOptions& options, Context& context);

// `count` eyes, scene space: three quarters anywhere over the grids' cells, between 0.2 m under and over eye height,
// the others at the given points, in turn. The same for the same seed; another seed gives others.
std::vector<Vec3> sample_eyes(const EyeRegion& region, std::uint32_t count, std::uint64_t seed);

// The like, but none of sample_eyes': other places, and instead of given points some up to 20 cm away along each axis.
std::vector<Vec3> held_out_eyes(const EyeRegion& region, std::uint32_t count, std::uint64_t seed);

// A box around eyes: of one storey, or of one eye that is given; the scene's where eyes can be anywhere.
struct EyeBox {
  Vec3 lower{0}, upper{0};
};
std::vector<EyeBox> eye_boxes(const EyeRegion& region);

// Metres from a point to the nearest box (not empty): never more than to the nearest eye.
float distance_to(std::span<const EyeBox> boxes, const Vec3& point);

// Lines of "x y z" in world space, metres; empty ones and those that start with # are skipped. Error kInvalid with
// name:line.
Result<std::vector<DVec3>> parse_eyes(std::string_view text, const std::string& name);

}  // namespace oriel
