#include "bake/radiance/known_reflections.h"

#include <algorithm>

namespace oriel {
namespace {

constexpr std::size_t kMostBoxes = 64;  // every pixel's ray is held against them
constexpr float kEnlarged = 1e-4f;      // of the box's size and distance from the origin: what floats round

// Inlined into a writer of an empty vector, GCC 12 warns of an overflow that is none (-Wstringop-overflow).
[[gnu::noinline]] void fields(Archive& archive, KnownReflections& k) {
  archive(k.parts, k.plans, k.captured, k.inputs, k.around);
}

std::vector<Hash128> looks_of(std::span<const ScenePart> parts) {
  std::vector<Hash128> looks;
  for (const ScenePart& part : parts) looks.push_back(part.look);
  std::sort(looks.begin(), looks.end());
  return looks;
}

Box enlarged(const ScenePart& part) {
  const Vec3 margin = kEnlarged * (glm::max(glm::abs(part.lower), glm::abs(part.upper)) + part.upper - part.lower);
  return {part.lower - margin, part.upper + margin};
}

}  // namespace

std::optional<KnownReflections> recall_reflections(Context& context, const Hash128& name) {
  const auto bytes = context.units ? context.units->recall(name) : std::nullopt;
  if (!bytes) return std::nullopt;
  KnownReflections known;
  Archive archive{std::span<const std::byte>(*bytes)};
  fields(archive, known);
  if (!archive.complete()) return std::nullopt;
  return known;
}

void remember_reflections(Context& context, const Hash128& name, KnownReflections known) {
  if (!context.units) return;
  Bytes bytes;
  Archive archive(bytes);
  fields(archive, known);
  context.units->remember(name, std::move(bytes));
}

std::vector<Box> edited_boxes(std::span<const ScenePart> before, std::span<const ScenePart> now) {
  std::vector<Box> boxes;
  const auto add_unknown = [&](std::span<const ScenePart> parts, const std::vector<Hash128>& looks) {
    for (const ScenePart& part : parts)
      if (part.lower.x <= part.upper.x && !std::binary_search(looks.begin(), looks.end(), part.look))
        boxes.push_back(enlarged(part));
  };
  add_unknown(before, looks_of(now));
  add_unknown(now, looks_of(before));
  if (boxes.size() <= kMostBoxes) return boxes;
  Box all = boxes[0];
  for (const Box& box : boxes) all = {glm::min(all.lower, box.lower), glm::max(all.upper, box.upper)};
  return {all};
}

bool meets(std::span<const Box> boxes, const Vec3& from, const Vec3& direction, float distance) {
  const auto met = [&](const Box& box) {
    float near = 0, far = distance;
    for (int axis = 0; axis < 3; ++axis) {
      if (direction[axis] == 0) {
        if (from[axis] < box.lower[axis] || from[axis] > box.upper[axis]) return false;
        continue;
      }
      const float a = (box.lower[axis] - from[axis]) / direction[axis];
      const float b = (box.upper[axis] - from[axis]) / direction[axis];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near <= far;
  };
  return std::any_of(boxes.begin(), boxes.end(), met);
}

}  // namespace oriel
