// Which materials' needs are the same to within an error, so that they share a map.
#pragma once

#include <span>

#include "formats/assets/fresnel_map.h"

namespace oriel {

// Groups of a list: of[i] is the group of element i.
struct Groups {
  std::vector<std::uint32_t> of;
  std::vector<float> values;  // by group
};

// Widths of lobes whose kernels differ from that of their group's width by at most `error` (the sum of the absolute
// differences of their weights). A lobe that is wider by a factor 1 + x has moved 1.0 x (GGX) or 4/e x (Beckmann) of
// that sum. As few groups as there can be, numbered by rising width; a group's width is the geometric mean of its
// ends, one alone keeps its own. Widths of 0 and below form one group, 0.
Groups group_widths(std::span<const float> alphas, double error);

// Maps whose tables differ from that of their group's first, for any angle and channel, by at most `error` of the
// reflectance, or by kLeastDifference. of[i] is the index of that first map; values stays empty.
inline constexpr float kLeastDifference = 1e-3f;  // what a table itself may be off by
Groups group_reflectances(std::span<const FresnelMap> maps, double error);

}  // namespace oriel
