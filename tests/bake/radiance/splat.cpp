#include "tests/bake/radiance/splat.h"

#include <algorithm>
#include <limits>

namespace oriel::test {
namespace {

// What the viewer sees in the mirror is the scene mirrored in it: a mirrored view of points p is the view of mirrored
// p.
Pinhole mirror(const Pinhole& view) {
  Pinhole m = view;
  m.eye = mirrored(view.eye);
  m.right = mirrored(view.right);
  m.up = mirrored(view.up);
  m.forward = mirrored(view.forward);
  return m;
}

float sine_to_axis(const Vec3& direction, int axis) {
  return std::sqrt(std::max(0.0f, 1 - direction[axis] * direction[axis]));
}

// Equation (3) from the distance scale: at infinity the ratio of depths is that of a direction's components.
Vec2 point_size_of(const RadianceMap& map, const Pinhole& mirror_view, float distance_scale) {
  const Vec2 ref_pixels = Vec2(map.width, map.height) * -map.eye.z / (map.upper - map.lower);  // per unit of tangent
  const Vec2 window = ref_pixels / mirror_view.focal_px;
  const Vec2 angular(sine_to_axis(mirror_view.forward, 0), sine_to_axis(mirror_view.forward, 1));
  return distance_scale * angular / window;
}

class Splatter {
 public:
  Splatter(const Reflector& reflector, const Pinhole& view) : view_(view), mirror_view_(mirror(view)) {
    const std::size_t pixels = std::size_t{view.width} * view.height;
    image_.width = view.width;
    image_.height = view.height;
    image_.radiance.assign(pixels, Vec3(0));
    image_.depth.assign(pixels, std::numeric_limits<float>::infinity());
    image_.covered.assign(pixels, 0);
    image_.inside.assign(pixels, 0);
    for (std::uint32_t y = 0; y < view.height; ++y)
      for (std::uint32_t x = 0; x < view.width; ++x)
        image_.inside[y * view.width + x] = sees(reflector, Vec2(x, y) + 0.5f);
  }

  void splat(const RadianceMap& map, std::uint32_t x, std::uint32_t y) {
    const std::size_t at = std::size_t{y} * map.width + x;
    if (map.valid[at] == 0) return;
    const Vec4 p = unproject(map, Vec2(x, y) + 0.5f, map.disparity[at]);
    const Vec3 to_point = Vec3(p) - p.w * mirror_view_.eye;
    const float depth_w = glm::dot(to_point, mirror_view_.forward);  // depth times disparity: finite for the sky too
    if (!(depth_w > 0)) return;
    const Vec2 tangent(glm::dot(to_point, mirror_view_.right) / depth_w, glm::dot(to_point, mirror_view_.up) / depth_w);
    const Vec2 centre = Vec2(tangent.x, -tangent.y) * view_.focal_px + 0.5f * Vec2(view_.width, view_.height);
    const Vec2 size =
        p.w > 0 ? point_size(map, mirror_view_, Vec3(p) / p.w) : point_size_of(map, mirror_view_, to_point.z / depth_w);
    const float depth = p.w > 0 ? depth_w / p.w : std::numeric_limits<float>::infinity();
    fill(centre, glm::max(size, Vec2(1)), depth, map.radiance[at]);
  }

  ReflectionImage take() { return std::move(image_); }

 private:
  bool sees(const Reflector& reflector, const Vec2& pixel) const {
    const Vec2 t = (pixel - 0.5f * Vec2(view_.width, view_.height)) / view_.focal_px;
    const Vec3 direction = view_.right * t.x - view_.up * t.y + view_.forward;
    if (!(view_.eye.z > 0) || !(direction.z < 0)) return false;
    const Vec3 hit = view_.eye - direction * (view_.eye.z / direction.z);
    return hit.x >= reflector.lower.x && hit.x <= reflector.upper.x && hit.y >= reflector.lower.y &&
           hit.y <= reflector.upper.y;
  }

  void fill(const Vec2& centre, const Vec2& size, float depth, const Vec3& radiance) {
    const Vec2 limit(view_.width, view_.height);
    // Pixels whose centre is in the box; NaN falls out of the clamps' order and gives an empty range.
    const Vec2 low = glm::clamp(glm::ceil(centre - 0.5f * size - 0.5f), Vec2(0), limit);
    const Vec2 high = glm::clamp(glm::ceil(centre + 0.5f * size - 0.5f), Vec2(0), limit);
    if (!(high.x > low.x) || !(high.y > low.y)) return;
    for (auto y = static_cast<std::uint32_t>(low.y); y < static_cast<std::uint32_t>(high.y); ++y)
      for (auto x = static_cast<std::uint32_t>(low.x); x < static_cast<std::uint32_t>(high.x); ++x) {
        const std::size_t at = std::size_t{y} * view_.width + x;
        if (!image_.inside[at] || (image_.covered[at] && depth >= image_.depth[at])) continue;
        image_.covered[at] = 1;
        image_.depth[at] = depth;
        image_.radiance[at] = radiance;
      }
  }

  Pinhole view_, mirror_view_;
  ReflectionImage image_;
};

}  // namespace

float height_of(const RadianceMap& map, float disparity) {
  return -map.eye.z * (1 - disparity) / disparity;
}

Pinhole pinhole_from_camera(const Reflector& reflector, const Camera& camera, std::uint32_t width,
                            std::uint32_t height) {
  const Vec3 forward = normalize_or(camera.forward, Vec3(0, 0, -1));
  const Vec3 right = normalize_or(glm::cross(forward, camera.up), Vec3(frame_from_normal(forward)[0]));
  const Mat3 to_reflector = glm::transpose(Mat3(reflector.pack_from_reflector));
  Pinhole view{.eye = reflector_from_pack(reflector, camera.eye)};
  view.right = to_reflector * right;
  view.up = to_reflector * glm::cross(right, forward);
  view.forward = to_reflector * forward;
  view.focal_px = 0.5f * static_cast<float>(height) / std::tan(0.5f * camera.vertical_fov_rad);
  view.width = width;
  view.height = height;
  return view;
}

Vec2 point_size(const RadianceMap& map, const Pinhole& mirror_view, const Vec3& p) {
  const float depth = glm::dot(p - mirror_view.eye, mirror_view.forward);
  return point_size_of(map, mirror_view, (p.z - map.eye.z) / std::max(depth, 1e-30f));
}

std::vector<std::uint32_t> select_maps(const Reflector& reflector, std::span<const RadianceMap> maps,
                                       const Vec3& mirrored_eye, std::uint32_t n, SelectBy by) {
  std::vector<std::uint32_t> selected;
  struct Candidate {
    float cost;
    std::uint32_t map;
  };
  std::vector<Candidate> candidates;
  const std::uint32_t end = reflector.first_map + reflector.map_count;
  for (std::uint32_t i = reflector.first_map; i < end; ++i) {
    const RadianceMap& map = maps[i];
    const Vec3 centre(0.5f * (map.lower + map.upper), 0);
    const Vec3 a = normalize_or(mirrored_eye - centre, Vec3(0, 0, -1)),
               b = normalize_or(map.eye - centre, Vec3(0, 0, -1));
    // The chord grows with the angle, and tells small ones apart where a cosine cannot.
    candidates.push_back({by == SelectBy::kAngle ? length2(a - b) : length2(mirrored_eye - map.eye), i});
    if (i + 1 < end && maps[i + 1].lower == map.lower && maps[i + 1].upper == map.upper) continue;
    const std::size_t count = std::min<std::size_t>(n, candidates.size());
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& x, const Candidate& y) { return x.cost < y.cost; });
    for (std::size_t k = 0; k < count; ++k) selected.push_back(candidates[k].map);
    candidates.clear();
  }
  return selected;
}

ReflectionImage render_reflection(const Reflector& reflector, std::span<const RadianceMap> maps,
                                  std::span<const std::uint32_t> selection, const Pinhole& view) {
  Splatter splatter(reflector, view);
  for (const std::uint32_t i : selection)
    for (std::uint32_t y = 0; y < maps[i].height; ++y)
      for (std::uint32_t x = 0; x < maps[i].width; ++x) splatter.splat(maps[i], x, y);
  return splatter.take();
}

}  // namespace oriel::test
