// What the frames show of one lamp's edges, and the table of all lamps.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace oriel {

constexpr float kOff = 1.5f;  // pixels

struct LampSum {
  std::size_t eyes = 0, lit_by_pixel = 0, lit_in_texels = 0, soft = 0, lit_in_shadow = 0, dark_in_light = 0;
  std::vector<float> off;  // by edge, pixels
  double squares = 0;      // of soft pixels
  std::string worst;
  std::size_t worst_count = 0;
};

inline void print_table(std::map<std::uint32_t, LampSum>& sums) {
  std::printf(
      "| lamp | eyes | edges, pixels of them | median, px | within 1.5 px | lit in shadow | dark in light | penumbrae, "
      "rms | lit by pixel | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  for (auto& [lamp, sum] : sums) {
    std::ranges::sort(sum.off);
    const std::size_t n = sum.off.size();
    const auto close = std::ranges::upper_bound(sum.off, kOff) - sum.off.begin();
    const std::string median = n > 0 ? fmt::format("{:.2f}", sum.off[n / 2]) : "",
                      within =
                          n > 0 ? fmt::format("{:.2f} %", 100.0 * static_cast<double>(close) / static_cast<double>(n))
                                : "";
    std::printf("| %u | %zu | %zu | %s | %s | %zu | %zu | %.3f | %.1f %% | %s |\n", lamp, sum.eyes, n, median.c_str(),
                within.c_str(), sum.lit_in_shadow, sum.dark_in_light,
                std::sqrt(sum.squares / static_cast<double>(std::max<std::size_t>(sum.soft, 1))),
                100.0 * static_cast<double>(sum.lit_by_pixel) /
                    static_cast<double>(std::max<std::size_t>(sum.lit_by_pixel + sum.lit_in_texels, 1)),
                sum.worst.c_str());
  }
}

}  // namespace oriel
