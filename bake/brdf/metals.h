// Measured optical constants of metals at the three wavelengths that stand for R, G and B.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace oriel {

// n + i k, relative to the medium that light comes from (air: 1).
struct ComplexIndex {
  double n = 1, k = 0;
};

enum class Metal : std::int8_t { kNone = -1, kGold, kSilver, kCopper, kAluminium, kIron, kChromium };
inline constexpr int kMetalCount = 6;

struct MetalConstants {
  const char* name;                 // as of the key metal (object_keys.h): "gold"
  const char* symbol;               // "Au": accepted too
  std::array<ComplexIndex, 3> rgb;  // at 630, 532 and 465 nm
};

// metal: not kNone.
const MetalConstants& constants_of(Metal metal);
// By name or symbol in any case: "gold", "Au".
std::optional<Metal> metal_by_name(std::string_view name);
// "gold, silver, …": for messages.
std::string metal_names();

}  // namespace oriel
