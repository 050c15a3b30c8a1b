// Which lamps are switched together.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel {

enum class LightGrouping : std::uint8_t {
  kMarked,  // as the file's nodes say: extras.oriel.light_group
  kOff,
  kAuto,   // what hangs on one node, or shows one mesh
  kEach,   // every lamp alone
  kNamed,  // LightGroupOptions::named
};

// Light is kept by texel and group: more than people switch one by one.
inline constexpr std::size_t kMostLightGroups = 32;
// Of them, made because the file animates their lamps.
inline constexpr std::size_t kMostMotions = 8;
// Of the lamps that are in no other.
inline constexpr const char* kOtherLamps = "other lamps";

struct LightGroupOptions {
  LightGrouping by = LightGrouping::kMarked;
  std::string file;  // that `named` comes from
  // Names of groups, and of each names or paths of nodes ("ground floor/desk/lamp"), with * for any letters; "sky" is
  // the sky.
  std::vector<std::pair<std::string, std::vector<std::string>>> named;
};

// "marked", "off", "auto", "each", or a JSON file: {"desk": ["desk lamp", "spot *"], …}, which is read. Errors kUsage,
// kIo, kInvalid.
Result<LightGroupOptions> parse_light_groups(const std::string& text);

// The hours of the scene's day are groups whatever is asked for. Gives every lamp of the scene (a node with an emissive
// mesh, a punctual light, the sky) its group. Lamps in none of those asked for make one more, kOtherLamps. No groups
// where there would be that one alone. Of more than kMostLightGroups the last are left to it, with a warning. A mark on
// nodes without a lamp is a warning. Lamps that the file animates are no group's that has others: each motion gets one,
// named as its node, where none is given, up to kMostMotions; the others stand still, with a warning. Error kUsage: of
// a file, a name that no node has, a group without a lamp, a lamp in two groups.
Status assign_light_groups(const LightGroupOptions& options, Scene& scene, Context& context);

}  // namespace oriel
