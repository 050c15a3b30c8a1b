// Ways of light from lamps to what they light, straight or by planar mirrors (Diefenbach & Badler 1997, section 4.2): a
// mirror on the way makes a virtual lamp behind it, whose light passes through the mirror's outline. No OpenGL.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/assets/light_field.h"
#include "formats/core/vec.h"

namespace oriel::study {

// A point of a lamp, which stands for one `count`-th of it.
struct LightSource {
  std::uint32_t lamp = 0;  // into the lamps given
  Vec4 place{0, 0, 0, 1};  // pack space; w = 0: the unit direction to it, from afar
  Vec3 intensity{0};       // LightSamples::intensity over the number of points
  Vec3 axis{0, -1, 0};
  Vec2 cones{-2, -3};
  bool cosine = false;
};
// points: of lamps that have a size (sample_light). Lamps that shine on nothing have none.
std::vector<LightSource> sources_of(std::span<const BrightLight> lamps, int points, std::uint32_t look);

// A planar reflector that throws light on as a mirror does.
struct LightMirror {
  std::uint32_t reflector = 0;  // into Pack::reflectors
  Vec4 plane{0, 0, 1, 0};       // unit normal; dot(plane, (p, 1)) is p's height before it, metres
  float margin = 0;             // metres before the plane that belong to the mirror itself
  std::array<Vec3, 4> corners{};
};
// Homogeneous points, w = 0 directions.
Mat4 reflection_of(const LightMirror& mirror);

struct LightPath {
  std::uint32_t source = 0;            // into the sources
  std::vector<std::uint32_t> mirrors;  // into the mirrors, in the order in which light meets them
};

// One stretch of a path, between two mirrors, or before the first or after the last.
struct PathLeg {
  Vec4 light{0, 0, 0, 1};            // where it comes from: the source, mirrored by all mirrors before this stretch
  Mat4 last_from_leg{1};             // mirrors what stands on it by all mirrors that follow
  std::vector<std::uint32_t> walls;  // mirrors at its ends: what lies behind one of them is not on it
};
// As many as the path has mirrors, and one.
std::vector<PathLeg> legs_of(const LightPath& path, std::span<const LightSource> sources,
                             std::span<const LightMirror> mirrors);

inline constexpr std::size_t kMostLightPaths = 1024;  // in a frame
inline constexpr int kMostLightMirrors = 3;           // on a path

struct LightPaths {
  std::vector<LightPath> paths;  // those by fewer mirrors first
  std::size_t left_out = 0;      // beyond kMostLightPaths
};
// All ways by up to `most` mirrors (0 to kMostLightMirrors) on which each mirror has the light before it, and the one
// before it too.
LightPaths find_light_paths(std::span<const LightSource> sources, std::span<const LightMirror> mirrors, int most);

}  // namespace oriel::study
