// The paper's light: all samples of a lamp weigh alike (Herf 1997, section 4.3.4).
#pragma once

#include <span>

#include "study/herf1997/blocked_rows.h"
#include "study/herf1997/receiver.h"

namespace oriel::study {

// Without shadows: π times the form factor of a polygon in closed form (Lambert 1760) at every `every`-th texel,
// bilinear between. corners: of the light, counter-clockwise seen from its front.
std::vector<float> form_factor_light(const ShadowReceiver& receiver, std::span<const DVec3> corners, int every);

// By texel, the samples that do not reach it.
std::vector<std::uint16_t> count_blocked(const BlockedRows& rows);

}  // namespace oriel::study
