#include "player/images/cutout_mips.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "formats/core/color.h"

namespace oriel {
namespace {

// color: sum of weight * linear light.
struct Texel {
  Vec3 color{0};
  float weight = 0, alpha = 0;
};

struct CutoutLevel {
  int width = 0, height = 0;
  std::vector<Texel> texels;
  Texel& at(int x, int y) { return texels[static_cast<std::size_t>(y) * width + x]; }
};

Texel texel_of(const Texture& texture, int x, int y, float cutoff) {
  const std::uint8_t* t = &texture.texels[4 * (static_cast<std::size_t>(y) * texture.width + x)];
  const float alpha = static_cast<float>(t[3]) / 255;
  const float weight = cutoff > 0 ? (alpha >= cutoff ? 1.0f : 0.0f) : alpha;
  return {Vec3(linear_from_srgb8(t[0]), linear_from_srgb8(t[1]), linear_from_srgb8(t[2])) * weight, weight, alpha};
}

// The texels of a line of `from` that texel i of `to` covers: a whole number of them, or parts where sizes are odd.
template <class F>
void for_covered(int i, int from, int to, F visit) {
  const double scale = static_cast<double>(from) / to, lower = i * scale, upper = (i + 1) * scale;
  for (int x = static_cast<int>(lower); x < from && x < upper; ++x) {
    const double part = std::min(upper, x + 1.0) - std::max(lower, static_cast<double>(x));
    visit(x, static_cast<float>(part / scale));
  }
}

// at(x, y): the texel of the level before.
template <class At>
CutoutLevel next_level(int width, int height, At at) {
  CutoutLevel out{std::max(1, width / 2), std::max(1, height / 2), {}};
  out.texels.resize(static_cast<std::size_t>(out.width) * out.height);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      Texel& mean = out.at(x, y);
      for_covered(y, height, out.height, [&](int v, float part_v) {
        for_covered(x, width, out.width, [&](int u, float part_u) {
          const Texel t = at(u, v);
          mean.color += t.color * (part_u * part_v);
          mean.weight += t.weight * (part_u * part_v);
          mean.alpha += t.alpha * (part_u * part_v);
        });
      });
    }
  }
  return out;
}

std::uint8_t encoded(float value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

// What alpha is multiplied by, so that the share of the level's texels that reach the cutoff is `coverage`.
float alpha_scale(const CutoutLevel& level, float coverage, float cutoff) {
  const auto size = static_cast<long>(level.texels.size());
  const long wanted = std::min(std::lround(coverage * static_cast<float>(size)), size);
  const auto passing = std::ranges::count_if(level.texels, [&](const Texel& t) { return t.alpha >= cutoff; });
  if (wanted == 0 || wanted == passing) return 1;
  std::vector<float> alphas;
  for (const Texel& t : level.texels) alphas.push_back(t.alpha);
  std::ranges::sort(alphas, std::greater());
  // Texels of one alpha pass together or not at all: where that is nearer to what is wanted, not.
  const float last = alphas[static_cast<std::size_t>(wanted - 1)];
  const auto range = std::ranges::equal_range(alphas, last, std::greater());
  const long without = range.begin() - alphas.begin(), with = range.end() - alphas.begin();
  const bool pass = without == 0 || with - wanted <= wanted - without;
  const float least = pass ? last : alphas[static_cast<std::size_t>(without - 1)];
  // Alpha has 8 bits: one code more makes sure that rounding does not take it below the cutoff.
  return least > 0 ? (cutoff + 1.0f / 255) / least : 1;
}

std::vector<std::uint8_t> encoded(const CutoutLevel& level, float scale) {
  std::vector<std::uint8_t> out;
  out.reserve(4 * level.texels.size());
  for (const Texel& t : level.texels) {
    const Vec3 c = srgb_from_linear(t.weight > 0 ? t.color / t.weight : Vec3(0));
    for (const float value : {c.r, c.g, c.b, scale * t.alpha}) out.push_back(encoded(value));
  }
  return out;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> cutout_mips(const Texture& texture, float cutoff) {
  std::vector<std::vector<std::uint8_t>> out{texture.texels};
  const int width = static_cast<int>(texture.width), height = static_cast<int>(texture.height);
  if (width <= 1 && height <= 1) return out;
  std::vector<CutoutLevel> levels{
      next_level(width, height, [&](int x, int y) { return texel_of(texture, x, y, cutoff); })};
  while (levels.back().texels.size() > 1) {
    CutoutLevel& fine = levels.back();
    levels.push_back(next_level(fine.width, fine.height, [&](int x, int y) { return fine.at(x, y); }));
  }
  const float coverage = levels.back().texels.front().weight;
  // Coarse to fine: who has no colour takes that of the texel above.
  for (std::size_t i = levels.size() - 1; i-- > 0;) {
    CutoutLevel &coarse = levels[i + 1], &fine = levels[i];
    for (int y = 0; y < fine.height; ++y) {
      for (int x = 0; x < fine.width; ++x) {
        Texel& t = fine.at(x, y);
        if (t.weight > 0) continue;
        const Texel& above = coarse.at(std::min(x / 2, coarse.width - 1), std::min(y / 2, coarse.height - 1));
        t.color = above.color;
        t.weight = above.weight;
      }
    }
  }
  for (const CutoutLevel& level : levels)
    out.push_back(encoded(level, cutoff > 0 ? alpha_scale(level, coverage, cutoff) : 1.0f));
  return out;
}

}  // namespace oriel
