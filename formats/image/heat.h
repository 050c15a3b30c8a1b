// False colours: numbers as colours of heat.
#pragma once

#include "formats/core/vec.h"

namespace oriel {

// Logarithmic scales: the colours of heat() from the lowest value to the highest.
struct HeatScale {
  float lowest = 1, highest = 1;
  const char* unit = "";
};
inline constexpr HeatScale kLuxScale{10, 10000, "lux"};
inline constexpr HeatScale kErrorScale{0.001f, 0.1f, "of the illuminance"};  // one standard deviation

// Dark blue by green and yellow to white; share is clamped to [0, 1]. sRGB as shown, [0, 1].
Vec3 heat(float share);
// Where a value stands on a scale, [0, 1]; 0 for what is not positive.
float share_of(const HeatScale& scale, float value);

}  // namespace oriel
