#include "formats/query/light_at.h"

#include "formats/core/octahedral.h"

namespace oriel {
namespace {

constexpr float kLeastTrust = 1e-3f;  // below it depth is not asked
constexpr float kFaint = 0.2f;        // weights below it fade faster, so that probes behind walls vanish

// Bilinear.
Vec2 depth_towards(const LightField& field, const LightProbe& probe, const Vec3& direction) {
  const int side = static_cast<int>(field.depth_side);
  const Vec2 at = square_from_sphere(direction) * static_cast<float>(side) - 0.5f;
  const IVec2 first(glm::floor(at));
  const Vec2 f = at - Vec2(first);
  const auto texel = [&](int x, int y) {
    const IVec2 t = wrap_octahedral(first + IVec2(x, y), side);
    return probe.depth[static_cast<std::size_t>(t.y) * field.depth_side + static_cast<std::size_t>(t.x)];
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

// How likely a probe sees p, [0,1].
float sight(const LightField& field, const LightProbe& probe, const Vec3& p) {
  const Vec3 to = p - probe.position;
  const float distance = glm::length(to);
  if (!(distance > 0)) return 1;
  const Vec2 moments = depth_towards(field, probe, to / distance);
  const float behind = distance / field.depth_cap_m - moments.x;
  if (behind <= 0) return 1;
  const float variance = std::max(moments.y - moments.x * moments.x, 1e-6f);
  const float chebyshev = variance / (variance + behind * behind);
  return chebyshev * chebyshev * chebyshev;
}

// The part without parts that holds p, and where in it p is, [0,1]³.
const FieldCell& cell_at(const LightField& field, const Vec3& p, Vec3& in_cell) {
  std::size_t index = 0, stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cells = field.size[static_cast<std::size_t>(axis)];
    const float at = std::clamp((p[axis] - field.lower[axis]) / field.cell_m[axis], 0.0f, static_cast<float>(cells));
    const auto cell = std::min(static_cast<std::uint32_t>(at), cells - 1);
    in_cell[axis] = at - static_cast<float>(cell);
    index += cell * stride;
    stride *= cells;
  }
  while (field.cells[index].children != 0) {
    index = field.cells[index].children;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = in_cell[axis] >= 0.5f;
      in_cell[axis] = 2 * in_cell[axis] - (upper ? 1.0f : 0.0f);
      if (upper) index += std::size_t{1} << axis;
    }
  }
  return field.cells[index];
}

using Weights = std::array<float, 8>;

float sum(const Weights& weights) {
  float total = 0;
  for (const float w : weights) total += w;
  return total;
}

void blend(const LightField& field, const FieldCell& cell, const Weights& weights, LocalLight& out) {
  const float total = sum(weights);
  std::uint64_t bright = 0;
  std::array<float, kMaxBrightLights> kept{};
  for (std::size_t i = 0; i < 8; ++i) {
    const float w = weights[i] / total;
    if (!(w > 0)) continue;
    const LightProbe& probe = field.probes[cell.probes[i]];
    for (std::size_t k = 0; k < out.sh.size(); ++k) out.sh[k] += w * probe.sh[k];
    bright |= probe.bright;
    for (std::size_t l = 0; l < field.lights.size(); ++l)
      if ((probe.kept >> l & 1) != 0) kept[l] += w;
  }
  for (std::size_t l = 0; l < field.lights.size(); ++l)
    if ((bright >> l & 1) != 0) out.bright.push_back({static_cast<std::uint32_t>(l), std::max(0.0f, 1 - kept[l])});
}

}  // namespace

LocalLight light_at(const LightField& field, const Vec3& p, const Vec3& normal) {
  LocalLight out;
  out.sh.assign(static_cast<std::size_t>(3 * field.bands * field.bands), 0.0f);
  Vec3 in_cell;
  const FieldCell& cell = cell_at(field, p, in_cell);
  Weights trilinear, valid, seen;
  for (std::size_t i = 0; i < 8; ++i) {
    const LightProbe& probe = field.probes[cell.probes[i]];
    const Vec3 upper((i & 1) != 0 ? 1 : 0, (i & 2) != 0 ? 1 : 0, (i & 4) != 0 ? 1 : 0);
    const Vec3 share = glm::mix(1.0f - in_cell, in_cell, upper);
    trilinear[i] = share.x * share.y * share.z;
    valid[i] = probe.valid ? trilinear[i] : 0;
    float w = probe.valid ? sight(field, probe, p) : 0;
    if (w < kFaint) w *= w * w / (kFaint * kFaint);
    if (normal != Vec3(0)) {
      const float facing = 0.5f + 0.5f * glm::dot(normalize_or(probe.position - p, normal), normal);
      w *= facing * facing + 0.2f;
    }
    seen[i] = w * trilinear[i];
  }
  out.trust = std::min(1.0f, sum(seen));
  blend(field, cell, out.trust > kLeastTrust ? seen : sum(valid) > 0 ? valid : trilinear, out);
  return out;
}

}  // namespace oriel
