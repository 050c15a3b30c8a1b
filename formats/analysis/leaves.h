// A JSON object as a list: what a provenance or a plan says, by name.
#pragma once

#include <map>
#include <string>

namespace oriel {

// The leaves of a JSON object by their path, joined by dots; arrays are leaves. Values are JSON. Empty for what is not
// JSON.
std::map<std::string, std::string> leaves_of(const std::string& text);

}  // namespace oriel
