// Letters, names, numbers with units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/core/result.h"

namespace oriel {

// ASCII letters in lower case; other bytes as they are.
inline std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

struct Unit {
  std::string_view name;
  double factor;
};
// A number above 0 and one of the units; a number alone is ambiguous (metres? centimetres?) and refused. Error kUsage
// says what was expected: "a length such as 10cm".
Result<double> parse_quantity(const std::string& text, std::span<const Unit> units, const char* what,
                              const char* example);
// "2%" or "0.02" as a fraction above 0. A number alone that is above a half may be either, and is refused. Error
// kUsage.
Result<double> parse_share(const std::string& text);
std::string share_text(double share);  // "" for 0
// "5cm", "0.05m", "50mm" as metres; a unit is required. Error kUsage.
Result<float> parse_length(const std::string& text);
// "64MiB", "2GB", "500000B" as bytes. Error kUsage.
Result<std::uint64_t> parse_bytes(const std::string& text);

// Whether the text is like the pattern: * any text, ? any character. Time is at most the product of their lengths.
bool fits_pattern(std::string_view pattern, std::string_view text);

// For a message about a name that is none of `names`: the few that are nearest to it, in quotes.
std::string names_like(const std::string& wanted, const std::vector<std::string>& names);

// Text of HTML and of its attributes: & < > " and ' escaped.
std::string escaped(const std::string& text);

// RFC 4648.
std::string base64(std::span<const std::byte> bytes);

}  // namespace oriel
