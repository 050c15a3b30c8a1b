// What options' values are called on the command line, and in what the player writes.
#pragma once

#include <algorithm>
#include <map>
#include <string>

#include "player/passes/display_pass.h"
#include "player/scene/frame_options.h"
#include "player/session/pace.h"

namespace oriel {

inline const std::map<std::string, ToneCurve> kToneCurves{{"aces", ToneCurve::kAces}, {"none", ToneCurve::kNone}};
inline const std::map<std::string, Show> kStages{
    {"all", Show::kAll},           {"M", Show::kM},           {"MK", Show::kMK},
    {"MKR", Show::kMKR},           {"D", Show::kD},           {"lux", Show::kLux},
    {"error", Show::kError},       {"texels", Show::kTexels}, {"charts", Show::kCharts},
    {"overdraw", Show::kOverdraw}, {"zones", Show::kZones}};
inline const std::map<std::string, Reflections> kReflections{
    {"chosen", Reflections::kChosen}, {"march", Reflections::kMarch},       {"mesh", Reflections::kMesh},
    {"points", Reflections::kPoints}, {"geometry", Reflections::kGeometry}, {"off", Reflections::kOff}};
inline const std::map<std::string, Selection> kSelections{{"angle", Selection::kAngle},
                                                          {"distance", Selection::kDistance}};
inline const std::map<std::string, Blur> kBlurs{
    {"distance", Blur::kDistance}, {"constant", Blur::kConstant}, {"off", Blur::kOff}};
inline const std::map<std::string, KernelPlace> kKernelPlaces{{"lobe", KernelPlace::kLobe},
                                                              {"centred", KernelPlace::kCentred}};
inline const std::map<std::string, Reflectance> kReflectances{{"table", Reflectance::kTable},
                                                              {"sphere", Reflectance::kSphereMap}};
inline const std::map<std::string, LightmapFilter> kLightmapFilters{{"bilinear", LightmapFilter::kBilinear},
                                                                    {"bicubic", LightmapFilter::kBicubic}};
inline const std::map<std::string, MoverLights> kMoverLights{{"shadowed", MoverLights::kShadowed},
                                                             {"unshadowed", MoverLights::kUnshadowed},
                                                             {"harmonics", MoverLights::kHarmonics}};
inline const std::map<std::string, MoverShadows> kMoverShadows{{"maps", MoverShadows::kMaps},
                                                               {"textures", MoverShadows::kTextures}};

inline const std::map<std::string, ShadeWork> kShadeWorks{{"each", ShadeWork::kEachLight},
                                                          {"cells", ShadeWork::kCells},
                                                          {"few", ShadeWork::kFewPixels},
                                                          {"merged", ShadeWork::kMerged},
                                                          {"lists", ShadeWork::kLists}};
inline const std::map<std::string, bool> kShadePixels{{"half", false}, {"all", true}};

inline const std::map<std::string, LiveMode> kLiveModes{
    {"fitted", LiveMode::kFitted}, {"differential", LiveMode::kDifferential}, {"only", LiveMode::kOnly}};

inline const std::map<std::string, LiveIndirect> kLiveIndirect{{"texels", LiveIndirect::kTexels},
                                                               {"lights", LiveIndirect::kLights}};

inline const std::map<std::string, Quality> kQualities{
    {"auto", Quality::kAutomatic}, {"full", Quality::kFull}, {"fast", Quality::kFast}};

inline const std::map<std::string, bool> kSwitch{{"on", true}, {"off", false}};

// The name of a value that the map has.
template <class T>
const std::string& name_of(const std::map<std::string, T>& names, T value) {
  return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.second == value; })->first;
}

}  // namespace oriel
