// Who sees what along a line, as the player draws it: backs of one-sided surfaces are not there, see-through and
// cut-out ones hide nothing.
#pragma once

#include <functional>

#include "bake/trace/accel.h"

namespace oriel {

class SightLines {
 public:
  explicit SightLines(const Accel& accel);

  struct Line {
    Vec3 eye{0};
    Vec3 target{0};
    std::uint32_t triangle = ~0u;  // that the target lies on, if any: drawn for that eye
  };
  // Calls seen(line, triangle) for what is drawn along each line, up to the first surface that hides what is behind it.
  // A target is seen too where that is no nearer than a thousandth before it: of surfaces that lie in each other any
  // may be drawn.
  void trace(std::span<const Line> lines,
             const std::function<void(std::size_t line, std::uint32_t triangle)>& seen) const;

  // False where it is a one-sided surface's back that the eye would see.
  bool is_drawn(std::uint32_t triangle, const Vec3& eye) const;
  bool two_sided(std::uint32_t triangle) const { return material(triangle).double_sided; }

 private:
  const SceneMaterial& material(std::uint32_t triangle) const { return scene_.material_of(triangle); }
  // How far the line goes from its first hit on until something hides what is behind; endless where nothing does.
  float follow(Ray ray, Hit hit, std::size_t line, const std::function<void(std::size_t, std::uint32_t)>& seen) const;
  // Whether the line ends at the hit.
  bool meets(const Hit& hit, std::size_t line, const std::function<void(std::size_t, std::uint32_t)>& seen) const;

  const Accel& accel_;
  const Scene& scene_;
};

}  // namespace oriel
