#include "preview/frame/eye_points.h"

#include "bake/trace/rounded.h"
#include "bake/trace/sampler.h"
#include "preview/frame/streams.h"

namespace oriel {

EyePoint eye_point(const SeenPoints& seen, std::size_t pixel, const Accel& accel) {
  SurfacePoint s = point_on_side(accel.scene(), static_cast<std::uint32_t>(seen.place[pixel].w) - 1, Vec2(0));
  s.position = Vec3(seen.place[pixel]), s.normal = Vec3(seen.normal[pixel]);
  s.geometric_normal = Vec3(seen.face[pixel]);
  s.rounded = height_of_rounded(accel, s);
  // But for the surface's own thickness of rounding.
  return {{s.position, s.normal, s.geometric_normal, s.rounded}, spawn_origin(s, s.geometric_normal)};
}

std::vector<EyePoint> eye_points(const SeenPoints& seen, const Accel& accel, std::uint32_t count, std::uint64_t seed,
                                 std::uint32_t pass) {
  std::vector<EyePoint> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler sampler(seed, kEyeStream, pass * count + i);
    const Vec2 at = sampler.next2() * Vec2(IVec2(seen.width, seen.height));
    const std::size_t pixel =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(seen.width) + static_cast<std::size_t>(at.x);
    if (pixel < seen.place.size() && seen.place[pixel].w != 0) points.push_back(eye_point(seen, pixel, accel));
  }
  return points;
}

}  // namespace oriel
