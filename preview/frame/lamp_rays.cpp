#include "preview/frame/lamp_rays.h"

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr std::size_t kNone = ~std::size_t{0};

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
    std::vector<EyePoint> points(width);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      if (seen_.place[i].w == 0) continue;
      points[x] = eye_point(seen_, i, accel_);
    }
    for (std::size_t p = 0; p < lamps_.size(); ++p) add_point(y, p, points, light);
  }

 private:
  // The first pixel of a row that takes a point; pixels `side` further take it too.
  std::size_t first_pixel(std::size_t y, std::size_t point) const {
    const auto side = static_cast<std::size_t>(shared_.side);
    for (std::size_t x = 0; x < side; ++x)
      if (first_point(x, y) == point % step_) return x;
    return kNone;
  }

  void add_point(std::size_t y, std::size_t p, const std::vector<EyePoint>& points, std::vector<Vec4>& light) const {
    struct Asked {
      std::size_t x;
      Vec3 light;
      ShadowClasses::Class known;
    };
    const std::size_t width = points.size();
    std::vector<Ray> rays;
    std::vector<Asked> asked;
    ShadowClasses* classes = shared_.classes;
    for (std::size_t x = first_pixel(y, p); x < width; x += static_cast<std::size_t>(shared_.side)) {
      const std::size_t i = y * width + x;
      if (seen_.place[i].w == 0) continue;
      const auto lit = shine(lamps_[p], points[x], accel_.scene());
      if (!lit) continue;
      light[i].w += 1;
      const auto known = classes != nullptr ? classes->known(p, classes->block_of(x, y)) : ShadowClasses::kUnknown;
      if (known == ShadowClasses::kLit) light[i] += Vec4(lit->light, 0);
      if (known == ShadowClasses::kLit || known == ShadowClasses::kUmbra)
        if (classes == nullptr || !classes->asks(p, x, y)) continue;
      rays.push_back(lit->ray);
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
