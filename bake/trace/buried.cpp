#include "bake/trace/buried.h"

#include "bake/trace/warp.h"

namespace oriel {

bool is_buried(const Transport& t, const SurfacePoint& surface, const SampleId& id, std::uint64_t& rays) {
  const Scene& scene = t.accel.scene();
  Sampler sampler(id.seed + 0x5eed, id.stream, id.sample);
  const Mat3 frame = frame_from_normal(surface.geometric_normal);
  const Vec3 origin = spawn_origin(surface, surface.geometric_normal);
  int missed = 0;
  for (int probe = 0; probe < 6; ++probe) {
    const Vec3 direction = glm::normalize(frame * square_to_cosine_hemisphere(sampler.next2()));
    ++rays;
    const Hit hit = t.accel.intersect({origin, direction});
    const bool back = hit && !geometry_at(scene, hit, direction).reflects;
    if (!back && (probe == 0 || ++missed > 1)) return false;
  }
  return true;
}

}  // namespace oriel
