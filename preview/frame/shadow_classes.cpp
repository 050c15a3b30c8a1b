#include "preview/frame/shadow_classes.h"

#include <utility>

#include "bake/trace/sampler.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

constexpr std::size_t kMostLamps = 64;      // that are remembered: of more of them each gets few points
constexpr std::uint32_t kFewestPoints = 8;  // of a lamp, before a block is believed

}  // namespace

ShadowClasses::ShadowClasses(const IVec2& size)
    : across_((static_cast<std::size_t>(size.x) + kSide - 1) / kSide),
      blocks_(across_ * ((static_cast<std::size_t>(size.y) + kSide - 1) / kSide)) {}

void ShadowClasses::begin(std::span<const LampPoint> points, std::uint64_t seed, std::uint32_t pass) {
  for (auto& [id, lamp] : lamps_) {
    lamp.before = lamp.seen;
    lamp.asked += std::exchange(lamp.now, 0u);
  }
  of_points_.clear(), turns_.clear();
  Sampler sampler(seed, kClassStream, pass);
  for (const LampPoint& point : points) {
    const bool known = lamps_.contains(point.lamp) || lamps_.size() < kMostLamps;
    Lamp* lamp = known && point.lamp != ~0u ? &lamps_[point.lamp] : nullptr;
    if (lamp != nullptr && lamp->seen.empty()) lamp->before.assign(blocks_, 0), lamp->seen.assign(blocks_, 0);
    if (lamp != nullptr) ++lamp->now;
    of_points_.push_back(lamp);
    turns_.push_back(static_cast<std::uint32_t>(sampler.next1() * kOne));
  }
}

ShadowClasses::Class ShadowClasses::known(std::size_t point, std::size_t block) const {
  const Lamp* lamp = of_points_[point];
  if (lamp == nullptr || lamp->asked < kFewestPoints) return kUnknown;
  return static_cast<Class>(lamp->before[block]);
}

void ShadowClasses::tell(std::size_t point, std::size_t block, const Vec3& passed) {
  if (Lamp* lamp = of_points_[point])
    lamp->seen[block] |= passed == Vec3(1) ? kLit : passed == Vec3(0) ? kUmbra : kPenumbra;
}

}  // namespace oriel
