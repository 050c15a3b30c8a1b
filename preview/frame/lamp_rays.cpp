#include "preview/frame/lamp_rays.h"

#include "bake/jobs/parallel.h"
#include "bake/trace/polygon_light.h"
#include "bake/trace/punctual.h"

namespace oriel {
namespace {

constexpr std::size_t kNone = ~std::size_t{0};

struct Shone {
  Ray ray;
  Vec3 light;  // were nothing between
};

// A point's light on a receiver, and the ray to it from `origin`; none where it cannot shine.
std::optional<Shone> shine(const LampPoint& lamp, const Receiver& at, const Vec3& origin, const Scene& scene) {
  Shone out{{origin, Vec3(lamp.place)}, lamp.power};
  float d2 = 1;
  if (lamp.kind != LampKind::kAfar) {
    const Vec3 to = Vec3(lamp.place) - origin;
    d2 = std::max(length2(to), 1e-30f);
    const float distance = std::sqrt(d2);
    out.ray = {origin, to / distance, distance};
  }
  const Vec3& direction = out.ray.direction;
  float share = incidence(at, direction) / (d2 + lamp.soft);
  if (lamp.kind == LampKind::kFlat) share *= -glm::dot(lamp.normal, direction);
  if (!(share > 0)) return std::nullopt;
  if (lamp.light != ~0u) out.light = lamp.share * punctual_intensity(scene, scene.lights[lamp.light], -direction);
  out.light *= share;
  return out;
}

Ray ray_to(const LampPoint& lamp, const Shone& shone) {
  if (!lamp.seen_at) return shone.ray;
  const Vec3 to = *lamp.seen_at - shone.ray.origin;
  const float distance = std::max(glm::length(to), 1e-15f);
  return {shone.ray.origin, to / distance, distance};
}

class LampTracer {
 public:
  LampTracer(const SeenPoints& seen, std::span<const LampPoint> lamps, const Accel& accel, const SharedPoints& shared)
      : seen_(seen),
        lamps_(lamps),
        accel_(accel),
        shared_(shared),
        step_(static_cast<std::size_t>(shared.side) * shared.side) {}

  // Of the points that pixel takes, every step-th.
  std::size_t first_point(std::size_t x, std::size_t y) const {
    const auto side = static_cast<std::size_t>(shared_.side);
    return (x % side + side * (y % side) + shared_.turn) % step_;
  }
  std::size_t points_of(std::size_t x, std::size_t y) const {
    const std::size_t first = first_point(x, y);
    return first < lamps_.size() ? (lamps_.size() - first + step_ - 1) / step_ : 0;
  }

  // Point after point along the row, so that rays of a packet go the same way. light: sums of what was taken.
  void row(std::size_t y, std::vector<Vec4>& light) const {
    const auto width = static_cast<std::size_t>(seen_.width);
    std::vector<Receiver> receivers(width);
    std::vector<Vec3> origins(width);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      if (seen_.place[i].w == 0) continue;
      receivers[x] = {Vec3(seen_.place[i]), Vec3(seen_.normal[i]), Vec3(seen_.face[i])};
      origins[x] = origin_of(i);
    }
    for (std::size_t p = 0; p < lamps_.size(); ++p) add_point(y, p, receivers, origins, light);
  }

 private:
  // The first pixel of a row that takes a point; pixels `side` further take it too.
  std::size_t first_pixel(std::size_t y, std::size_t point) const {
    const auto side = static_cast<std::size_t>(shared_.side);
    for (std::size_t x = 0; x < side; ++x)
      if (first_point(x, y) == point % step_) return x;
    return kNone;
  }

  void add_point(std::size_t y, std::size_t p, const std::vector<Receiver>& receivers, const std::vector<Vec3>& origins,
                 std::vector<Vec4>& light) const {
    struct Asked {
      std::size_t x;
      Vec3 light;
      ShadowClasses::Class known;
    };
    const std::size_t width = receivers.size();
    std::vector<Ray> rays;
    std::vector<Asked> asked;
    ShadowClasses* classes = shared_.classes;
    for (std::size_t x = first_pixel(y, p); x < width; x += static_cast<std::size_t>(shared_.side)) {
      const std::size_t i = y * width + x;
      if (seen_.place[i].w == 0) continue;
      const auto lit = shine(lamps_[p], receivers[x], origins[x], accel_.scene());
      if (!lit) continue;
      light[i].w += 1;
      auto known = ShadowClasses::kUnknown;
      if (lamps_[p].soft > 0 && !lamps_[p].seen_at)
        known = ShadowClasses::kLit;
      else if (classes != nullptr)
        known = classes->known(p, classes->block_of(x, y));
      if (known == ShadowClasses::kLit) light[i] += Vec4(lit->light, 0);
      if (known == ShadowClasses::kLit || known == ShadowClasses::kUmbra)
        if (classes == nullptr || !classes->asks(p, x, y)) continue;
      rays.push_back(ray_to(lamps_[p], *lit));
      asked.push_back({x, lit->light, known});
    }
    std::vector<Vec3> passed(rays.size());
    accel_.transmittance(rays, passed);
    if (shared_.rays != nullptr) *shared_.rays += rays.size();
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const Asked& a = asked[k];
      if (classes != nullptr) classes->tell(p, classes->block_of(a.x, y), passed[k]);
      const bool lit = a.known == ShadowClasses::kLit, umbra = a.known == ShadowClasses::kUmbra;
      const Vec3 found = passed[k] - (lit ? Vec3(1) : Vec3(0));
      light[y * width + a.x] += Vec4(a.light * found * (lit || umbra ? float{ShadowClasses::kOne} : 1.0f), 0);
    }
  }

  // But for the surface's own thickness of rounding.
  Vec3 origin_of(std::size_t i) const {
    const Scene& scene = accel_.scene();
    const UVec3& t = scene.triangles[static_cast<std::size_t>(seen_.place[i].w) - 1];
    float magnitude = 0;
    for (int k = 0; k < 3; ++k) magnitude = std::max(magnitude, max_component(glm::abs(scene.positions[t[k]])));
    return offset_origin(Vec3(seen_.place[i]), Vec3(seen_.face[i]), magnitude);
  }

  const SeenPoints& seen_;
  const std::span<const LampPoint> lamps_;
  const Accel& accel_;
  const SharedPoints shared_;
  const std::size_t step_;
};

}  // namespace

int sharing_side(std::size_t points) {
  return points >= 18 ? 3 : points >= 8 ? 2 : 1;
}

Result<std::vector<Vec4>> lamps_by_rays(const SeenPoints& seen, std::span<const LampPoint> lamps, const Accel& accel,
                                        const SharedPoints& shared, Context& context) {
  const auto width = static_cast<std::size_t>(seen.width), height = static_cast<std::size_t>(seen.height);
  std::vector<Vec4> taken(seen.place.size(), Vec4(0));
  const LampTracer tracer(seen, lamps, accel, shared);
  const std::size_t side = ShadowClasses::kSide;  // a thread has whole blocks
  ORIEL_TRY_VOID(parallel_for(context, "", (height + side - 1) / side, [&](std::size_t block) {
    for (std::size_t y = block * side; y < std::min(height, (block + 1) * side); ++y) tracer.row(y, taken);
  }));
  if (shared.side == 1) return taken;
  // From here on a counts what was taken: light that cannot come from a point is known to be none.
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) taken[y * width + x].w = static_cast<float>(tracer.points_of(x, y));
  return Neighbours(seen).gathered(taken, static_cast<float>(lamps.size()), shared.side == 3, context);
}

}  // namespace oriel
