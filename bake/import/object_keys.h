// What a file, or who bakes it, says of a node and all below it: extras.oriel.KEY or oriel_KEY, --object.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bake/brdf/metals.h"
#include "formats/core/json.h"
#include "formats/core/result.h"

namespace oriel {

struct ObjectKeys {
  std::optional<bool> mover;        // of this node alone: what is below it goes along
  std::optional<bool> exclude;      // not there: neither seen nor in the light
  std::optional<bool> two_sided;    // whatever its materials say
  std::optional<bool> reflections;  // false: it shows no image of its surroundings
  std::optional<float> texel_m;     // of its lightmap, instead of what eyes want
  std::optional<std::string> light_group;
  Metal metal = Metal::kNone;

  // Takes from the node above what this one leaves open; light_group's empty name is one that is left open.
  void inherit(const ObjectKeys& above);
};

// Sets one key; booleans are true, false, 1 or 0, texel is a length or metres, density texels a metre. Error kUsage for
// a key that is none, naming those most alike, and for a value: what was expected.
Status set_object_key(std::string_view key, const std::string& value, ObjectKeys& keys);

// Nodes, by name or path with * for any text and ? for any character, and their keys.
struct ObjectRule {
  std::string nodes;
  std::vector<std::pair<std::string, std::string>> keys;
};
// "NODE:KEY=VALUE,…", where a key alone is true, or a file name.json of {"NODE": {"KEY": VALUE, …}, …}. Errors kUsage,
// kIo, kInvalid.
Result<std::vector<ObjectRule>> parse_object_rules(const std::string& text);
std::string text_of(const ObjectRule& rule);

}  // namespace oriel
