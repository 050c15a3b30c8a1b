#include "bake/radiosity/texels/frame_pixels.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/trace/shading.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr std::uint32_t kChordsAView = 8;  // of which one is chosen for each view

// Fills in what bilinear filtering reads at the pixel's point.
void read_texels(const Atlas& atlas, FramePixel& pixel) {
  const AtlasPage& page = atlas.pages[pixel.page];
  const auto& uv = atlas.uv[pixel.triangle];
  const Vec2& b = pixel.barycentric;
  const Vec2 at = ((1 - b.x - b.y) * uv[0] + b.x * uv[1] + b.y * uv[2]) * Vec2(page.width, page.height) - 0.5f;
  const Vec2 last(page.width - 1, page.height - 1);
  const Vec2 inside = glm::clamp(at, Vec2(0), last), low = glm::floor(inside), in = inside - low;
  const auto number = [&](float x, float y) {
    const Vec2 texel = glm::min(low + Vec2(x, y), last);
    return static_cast<std::uint32_t>(texel.y) * page.width + static_cast<std::uint32_t>(texel.x);
  };
  pixel.texel = {number(0, 0), number(1, 0), number(0, 1), number(1, 1)};
  pixel.share = {(1 - in.x) * (1 - in.y), in.x * (1 - in.y), (1 - in.x) * in.y, in.x * in.y};
}

class Follower {
 public:
  Follower(const Transport& transport, const Atlas& atlas) : t_(transport), atlas_(atlas) {}

  std::optional<FramePixel> follow(Ray ray, std::uint32_t view, Sampler& sampler) const {
    const Scene& scene = t_.accel.scene();
    Vec3 through(1);
    bool mirrored = false;
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const Hit hit = t_.accel.intersect(ray);
      if (!hit || !hit.front) return std::nullopt;  // lit backs have triangles of their own
      const SurfacePoint surface = surface_at(scene, hit, ray.direction);
      const Shading shading(surface, -ray.direction);
      const float which = sampler.next1(), lobe = sampler.next1();
      const Vec2 where = sampler.next2();
      if (which >= surface.shade.coverage) {
        ray.origin = spawn_origin(surface, ray.direction);
        continue;
      }
      const auto sample = shading.sample(lobe, where);
      if (sample && sample->lobe == Lobe::kTransmission) {
        through *= sample->weight;
        ray.origin = spawn_origin(surface, ray.direction);
        continue;
      }
      const float specular = max_component(reflectance(surface.shade, glm::dot(surface.normal, -ray.direction)));
      const Vec3 diffuse = surface.shade.diffuse * (1 - specular);
      if (max_component(diffuse) > 0 && (mirrored || specular <= max_component(diffuse))) {
        if (atlas_.page[hit.triangle] < 0) return std::nullopt;
        FramePixel pixel{view, hit.triangle, hit.barycentric, through * diffuse / kPi, {}};
        if (surface.emits) pixel.emitted = through * surface.shade.emission;
        pixel.page = static_cast<std::uint32_t>(atlas_.page[hit.triangle]);
        read_texels(atlas_, pixel);
        return pixel;
      }
      if (mirrored || !sample || sample->lobe != Lobe::kSpecular) return std::nullopt;
      mirrored = true;
      through *= sample->weight;
      const Vec3 direction = shading.above(sample->wi);
      ray = {spawn_origin(surface, direction), direction};
    }
    return std::nullopt;
  }

 private:
  const Transport& t_;
  const Atlas& atlas_;
};

// The scene's bounding box; a flat scene gets air on both sides.
class Box {
 public:
  explicit Box(const Scene& scene) : lower_(scene.lower), upper_(scene.upper) {
    const float size = glm::length(upper_ - lower_);
    for (int i = 0; i < 3; ++i)
      if (upper_[i] - lower_[i] < kFlat * size) lower_[i] -= size / 2, upper_[i] += size / 2;
  }
  // The length of the part of a ray inside the box.
  float length_of(const Ray& ray) const {
    float length = std::numeric_limits<float>::max();
    for (int i = 0; i < 3; ++i) {
      const float to = (ray.direction[i] > 0 ? upper_[i] : lower_[i]) - ray.origin[i];
      if (ray.direction[i] != 0) length = std::min(length, std::max(0.0f, to / ray.direction[i]));
    }
    return length;
  }

 private:
  static constexpr float kFlat = 1e-3f;  // of the box's diagonal
  Vec3 lower_, upper_;
};

}  // namespace

Result<std::vector<FramePixel>> find_frame_pixels(const Transport& transport, const Atlas& atlas,
                                                  const FrameViews& from, std::uint64_t seed, Context& context) {
  const auto& [views, directions_per_view] = from;
  const Follower follower(transport, atlas);
  std::vector<std::optional<FramePixel>> found(views.size() * directions_per_view);
  ORIEL_TRY_VOID(parallel_for(context, "", views.size(), [&](std::size_t e) {
    for (std::uint32_t k = 0; k < directions_per_view; ++k) {
      Sampler sampler(seed, e, k);
      const Vec3 direction = square_to_sphere(sampler.next2());
      found[k * views.size() + e] = follower.follow({views[e], direction}, static_cast<std::uint32_t>(e), sampler);
    }
  }));
  std::vector<FramePixel> pixels;
  for (const auto& pixel : found)
    if (pixel) pixels.push_back(*pixel);
  return pixels;
}

std::vector<Vec3> sample_view_positions(const Transport& transport, std::uint32_t count, std::uint64_t seed) {
  const Scene& scene = transport.accel.scene();
  std::vector<double> area(scene.triangles.size());
  double all = 0;
  for (std::uint32_t t = 0; t < area.size(); ++t) area[t] = all += triangle_area(scene, t);
  if (!(all > 0)) return {};
  const Box air(scene);
  struct Chord {
    Vec3 from, direction;
    float length;
    double sum;  // of the lengths so far
  };
  std::vector<Chord> chords;
  double sum = 0;
  for (std::uint32_t i = 0; i < kChordsAView * count; ++i) {
    Sampler sampler(seed, 0, i);
    const auto found = std::upper_bound(area.begin(), area.end(), sampler.next1() * all);
    const auto triangle = static_cast<std::uint32_t>(
        std::min<std::ptrdiff_t>(found - area.begin(), static_cast<std::ptrdiff_t>(area.size()) - 1));
    const SurfacePoint surface = point_on_side(scene, triangle, square_to_triangle(sampler.next2()));
    const Vec3 direction = frame_from_normal(surface.geometric_normal) * square_to_cosine_hemisphere(sampler.next2());
    const Ray ray{spawn_origin(surface, direction), direction};
    const Hit hit = transport.accel.intersect(ray);
    if (hit && !hit.front) continue;  // inside a body, or behind everything
    const float length = hit ? hit.distance : air.length_of(ray);
    chords.push_back({ray.origin, direction, length, sum += length});
  }
  std::vector<Vec3> views;
  for (std::uint32_t i = 0; i < count && sum > 0; ++i) {
    Sampler sampler(seed, 1, i);
    const double at = (i + sampler.next1()) / count * sum;
    const auto chord = std::min(
        std::upper_bound(chords.begin(), chords.end(), at, [](double value, const Chord& c) { return value < c.sum; }),
        chords.end() - 1);
    views.push_back(chord->from + sampler.next1() * chord->length * chord->direction);
  }
  return views;
}

}  // namespace oriel
