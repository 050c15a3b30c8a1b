// Flat lights as samples: fixed patterns of points, each with its share of the area.
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel::study {

inline constexpr int kMaxLightSamples = 1024;

// `count` points of the unit square, one in each of as many cells of equal area, at a place in it that is the same at
// every call: a pattern that changes from frame to frame flickers (Herf 1997, section 4.5.1). Neighbours in the list
// are neighbours in the square. 1 to kMaxLightSamples.
std::vector<DVec2> jittered_pattern(int count);

struct ShadowLightSample {
  DVec3 position{0};  // world, metres
  float power = 0;    // radiance times area: the light's texture may differ from sample to sample, cd
};

// All samples lie in a plane, and are of one colour (Herf 1997, section 5.3).
struct ShadowLight {
  std::vector<ShadowLightSample> samples;
  DVec3 normal{0, 0, 1};  // unit, the side that shines
  bool double_sided = false;
};

struct LightParallelogram {
  DVec3 corner{0}, x{1, 0, 0}, y{0, 1, 0};
  bool double_sided = false;
};
// Shines to the side of x × y.
ShadowLight sample_parallelogram(const LightParallelogram& light, float radiance, int samples);

struct LightTriangle {
  DVec3 a{0}, b{0}, c{0};
};
// A flat polygon as triangles of one winding, with `samples` shared out by area, at least one each.
ShadowLight sample_triangles(const std::vector<LightTriangle>& triangles, float radiance, int samples);

}  // namespace oriel::study
