// What options' values are called on the command line, and in what the player writes.
#pragma once

#include "formats/cli/option.h"
#include "player/passes/display_pass.h"
#include "player/scene/frame_options.h"
#include "player/session/pace.h"

namespace oriel {

inline constexpr Named<ToneCurve> kToneCurves[] = {{"aces", ToneCurve::kAces}, {"none", ToneCurve::kNone}};
inline constexpr Named<Show> kStages[] = {{"D", Show::kD},         {"M", Show::kM},     {"MK", Show::kMK},
                                          {"MKR", Show::kMKR},     {"all", Show::kAll}, {"charts", Show::kCharts},
                                          {"error", Show::kError}, {"lux", Show::kLux}, {"texels", Show::kTexels}};
inline constexpr Named<Reflections> kReflections[] = {
    {"chosen", Reflections::kChosen}, {"geometry", Reflections::kGeometry}, {"off", Reflections::kOff}};
inline constexpr Named<Blur> kBlurs[] = {{"distance", Blur::kDistance}, {"off", Blur::kOff}};
inline constexpr Named<MoverLights> kMoverLights[] = {{"harmonics", MoverLights::kHarmonics},
                                                      {"shadowed", MoverLights::kShadowed},
                                                      {"unshadowed", MoverLights::kUnshadowed}};

inline constexpr Named<Quality> kQualities[] = {
    {"auto", Quality::kAutomatic}, {"fast", Quality::kFast}, {"full", Quality::kFull}};

inline constexpr Named<bool> kSwitch[] = {{"off", false}, {"on", true}};

// The name of a value that the table has.
template <class T, std::size_t N>
const char* name_of(const Named<T> (&names)[N], T value) {
  std::size_t i = 0;
  while (i + 1 < N && names[i].value != value) ++i;
  return names[i].name;
}

}  // namespace oriel
