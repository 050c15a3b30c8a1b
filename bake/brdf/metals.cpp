#include "bake/brdf/metals.h"

#include "formats/core/check.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

// Linear between the tabulated wavelengths on both sides, from the refractiveindex.info database (CC0):
// Au, Ag, Cu: P. B. Johnson and R. W. Christy, "Optical constants of the noble metals", Phys. Rev. B 6, 4370 (1972).
// Al: A. D. Rakić, "Algorithm for the determination of intrinsic optical constants of metal films: application to
//     aluminum", Appl. Opt. 34, 4755 (1995).
// Fe, Cr: P. B. Johnson and R. W. Christy, "Optical constants of transition metals", Phys. Rev. B 9, 5056 (1974).
constexpr MetalConstants kConstants[kMetalCount] = {
    {"gold", "Au", {{{0.188361, 3.403382}, {0.543863, 2.230870}, {1.331854, 1.869293}}}},
    {"silver", "Ag", {{{0.056909, 4.254323}, {0.054007, 3.428989}, {0.046878, 2.802815}}}},
    {"copper", "Cu", {{{0.275269, 3.372550}, {1.115884, 2.595578}, {1.246878, 2.456151}}}},
    {"aluminium", "Al", {{{1.430308, 7.508081}, {0.938777, 6.419538}, {0.686027, 5.635082}}}},
    {"iron", "Fe", {{{2.892381, 3.065476}, {2.895357, 2.917857}, {2.646000, 2.805000}}}},
    {"chromium", "Cr", {{{3.145238, 3.312381}, {3.034286, 3.330000}, {2.456000, 3.210000}}}},
};

}  // namespace

const MetalConstants& constants_of(Metal metal) {
  const auto i = static_cast<int>(metal);
  ORIEL_CHECK(i >= 0 && i < kMetalCount);
  return kConstants[i];
}

std::optional<Metal> metal_by_name(std::string_view name) {
  for (int i = 0; i < kMetalCount; ++i)
    if (lower_case(name) == kConstants[i].name || lower_case(name) == lower_case(kConstants[i].symbol))
      return static_cast<Metal>(i);
  return std::nullopt;
}

std::string metal_names() {
  std::string names;
  for (const MetalConstants& metal : kConstants) names += (names.empty() ? "" : ", ") + std::string(metal.name);
  return names;
}

}  // namespace oriel
