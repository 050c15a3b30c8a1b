#include "player/images/residency.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "formats/core/check.h"

namespace oriel {

std::vector<int> plan_residency(std::span<const Wish> wishes, std::uint64_t limit) {
  std::vector<std::size_t> order(wishes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return wishes[a].rank < wishes[b].rank; });
  std::vector<int> levels(wishes.size());
  std::uint64_t left = limit;
  for (const std::size_t i : order) {
    const Wish& wish = wishes[i];
    const bool fits = !wish.bytes.empty() && wish.bytes.back() <= left;
    levels[i] = fits ? wish.out() - 1 : wish.out();
    if (fits) left -= wish.bytes.back();
  }
  for (const std::size_t i : order) {
    const Wish& wish = wishes[i];
    if (levels[i] == wish.out()) continue;
    const std::uint64_t has = wish.bytes.back();
    int level = 0;
    while (wish.bytes[static_cast<std::size_t>(level)] - has > left) ++level;
    left -= wish.bytes[static_cast<std::size_t>(level)] - has;
    levels[i] = level;
  }
  return levels;
}

bool MemoryAccount::take(std::uint64_t bytes) {
  if (!has_room(bytes)) return false;
  used_ += bytes;
  most_ = std::max(most_, used_);
  return true;
}

void MemoryAccount::give_back(std::uint64_t bytes) {
  ORIEL_CHECK(bytes <= used_);
  used_ -= bytes;
}

float rank_of(const Bounds& bounds, const Vec3& eye, bool in_view, bool may_be_seen) {
  constexpr float kNear = 0.5f;  // metres: all that is nearer is here
  const float distance = glm::length(glm::max(glm::max(bounds.lower - eye, eye - bounds.upper), Vec3(0)));
  const float steps = std::floor(2 * std::log2(std::max(distance, kNear) / kNear));
  return steps + (in_view ? 0.0f : 6.0f) + (may_be_seen ? 0.0f : 8.0f);
}

}  // namespace oriel
