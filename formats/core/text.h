// Letters and names.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

// ASCII letters in lower case; other bytes as they are.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

// For a message about a name that is none of `names`: the few that are nearest to it, in quotes.
std::string names_like(const std::string& wanted, const std::vector<std::string>& names);

// Text of HTML and of its attributes: & < > " and ' escaped.
std::string escaped(const std::string& text);

// RFC 4648.
std::string base64(std::span<const std::byte> bytes);

}  // namespace oriel
