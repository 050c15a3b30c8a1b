#include "formats/image/heat.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel {
namespace {

constexpr std::array<Vec3, 7> kHeat{Vec3(0.05f, 0.03f, 0.25f), Vec3(0.15f, 0.25f, 0.8f), Vec3(0.1f, 0.6f, 0.75f),
                                    Vec3(0.25f, 0.7f, 0.3f),   Vec3(0.9f, 0.85f, 0.2f),  Vec3(0.95f, 0.4f, 0.15f),
                                    Vec3(1, 0.95f, 0.9f)};

}  // namespace

Vec3 heat(float share) {
  const float at = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(kHeat.size() - 1);
  const std::size_t low = std::min(static_cast<std::size_t>(at), kHeat.size() - 2);
  return glm::mix(kHeat[low], kHeat[low + 1], at - static_cast<float>(low));
}

float share_of(const HeatScale& scale, float value) {
  if (!(value > 0)) return 0;
  return std::clamp(std::log(value / scale.lowest) / std::log(scale.highest / scale.lowest), 0.0f, 1.0f);
}

}  // namespace oriel
