#include "player/output/exposed.h"

#include <algorithm>

namespace oriel {
namespace {

float radical_inverse(std::uint32_t base, std::uint32_t i) {
  double digit = 1, value = 0;
  for (; i > 0; i /= base) value += (digit /= base) * (i % base);
  return static_cast<float>(value);
}

// Of the square [0,1)², with even area.
Vec2 in_disk(const Vec2& u) {
  const float angle = 2 * kPi * u.y;
  return std::sqrt(u.x) * Vec2(std::cos(angle), std::sin(angle));
}

}  // namespace

ExposurePoint exposure_point(std::uint32_t i, std::uint32_t n) {
  if (n <= 1) return {};
  const auto at = [&](std::uint32_t base) { return radical_inverse(base, i + 1); };
  return {Vec2(at(5), at(7)) - 0.5f, in_disk({at(2), at(3)}),
          (static_cast<float>(i) + 0.5f) / static_cast<float>(n) - 0.5f};
}

View lens_view(const Camera& camera, const IVec2& size, const Bounds& bounds, const LensPlace& from) {
  View view = make_view(camera, size.x, size.y, bounds);
  const Vec2 picture(size);
  Vec2 moved = from.pixel;
  if (!view.orthographic && from.aside_m != Vec2(0)) {
    const Mat4 pack_from_view = glm::inverse(view.view_from_pack);
    Camera aside = camera;
    aside.eye += Vec3(pack_from_view * Vec4(from.aside_m, 0, 0));
    view = make_view(aside, size.x, size.y, bounds);
    moved -= 0.5f * picture * from.aside_m / (from.focus_m * view.tangents);
  }
  return part_of(view, moved, size.x, size.y);
}

void FrameMean::add(const FloatImage& frame) {
  if (count_++ == 0) sum_ = frame, light_.assign(frame.pixels.size(), 0);
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) light_[i] += double{frame.pixels[i]};
  // Kinds: light, where it is in one of them.
  for (std::size_t i = 3; i < frame.pixels.size(); i += 4)
    if (sum_.pixels[i] != frame.pixels[i]) sum_.pixels[i] = 1;
}

FloatImage FrameMean::mean() const {
  FloatImage out = sum_;
  for (std::size_t i = 0; i < light_.size(); ++i)
    if (i % 4 != 3) out.pixels[i] = static_cast<float>(light_[i] / std::max(count_, 1u));
  return out;
}

}  // namespace oriel
