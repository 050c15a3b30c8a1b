// How much longer a bake takes: one estimate over all that it does, from what its parts are foretold and what they
// took.
#pragma once

#include <optional>
#include <string_view>

namespace oriel {

class Forecast {
 public:
  // What a bake does, in this order. Time is seconds since it began.
  static constexpr std::string_view kParts[] = {"visibility",  "views",        "mips",   "transfer",     "timing",
                                                "first light", "refinement",   "detail", "verification", "ledger",
                                                "radiance",    "surroundings", "probes", "writing"};

  // What a part is likely to take that has not begun.
  void expect(std::string_view part, double seconds);
  // A part is under way, or so much of its time is over, [0,1]: all before it are done. Others than kParts are left
  // alone.
  void at(std::string_view part, double done, double now_s);
  // Seconds; nothing before the lightmap's first light is foretold, or the part under way says how far it is.
  std::optional<double> left(double now_s) const;

  // Of the first light, a texel and thread: a first guess, until it is over. Measured 0.13 to 0.34 ms.
  static constexpr double kTexel_s = 0.35e-3;

 private:
  static constexpr std::size_t kCount = std::size(kParts);
  static constexpr std::size_t kNone = kCount;
  double expected(std::size_t part) const;
  double of_current(double now_s) const;

  double expected_s_[kCount] = {};
  double took_s_[kCount] = {};
  std::size_t current_ = kNone;
  double begun_s_ = 0, told_s_ = 0, done_ = 0;  // of the current part
};

}  // namespace oriel
