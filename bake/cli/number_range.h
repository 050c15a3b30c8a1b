// A range that an option's numbers must lie in.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

namespace oriel {

// Numbers from low to high, both included. NaN, which is neither less nor more than any bound, is refused too, unlike
// by CLI::Range.
inline CLI::Validator number_range(double low, double high) {
  const std::string expected = fmt::format("[{:g} - {:g}]", low, high);
  const auto check = [=](std::string& text) -> std::string {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
    return fmt::format("found {}, expected a number in {}", text, expected);
  };
  return {check, "FLOAT in " + expected, ""};
}

}  // namespace oriel
