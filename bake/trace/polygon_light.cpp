#include "bake/trace/polygon_light.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "bake/trace/warp.h"
#include "formats/query/clipped_polygon.h"

namespace oriel {
namespace {

// As seen from a point, a polygon this many of its radii away is a point: the closed form then errs by less than 1e-4,
// and floats no longer cancel in the sum over its edges.
constexpr float kFar = 60;
// Triangles that fill less than this of the sphere are sampled by area, sr.
constexpr float kSmallSolidAngle = 0.02f;

// Signed: positive where the receiver is on the front side.
float irradiance_of_triangle(const std::array<Vec3, 3>& corners, const Receiver& r) {
  ClippedPolygon all{{corners[0] - r.position, corners[1] - r.position, corners[2] - r.position}, 3};
  const ClippedPolygon above = clip(all, r.horizon());
  if (above.count < 3) return 0;
  if (r.normal == r.horizon()) return -glm::dot(polygon_vector(above), r.normal);
  float sum = 0;
  for (const Vec3& n : {r.normal, r.mirrored_normal()}) {
    const ClippedPolygon part = clip(above, n);
    if (part.count >= 3) sum -= glm::dot(polygon_vector(part), n);
  }
  return sum;
}

float corner_angle(const Vec3& at, const Vec3& b, const Vec3& c) {
  const Vec3 ab = glm::cross(at, b), ac = glm::cross(at, c);
  return std::atan2(glm::length(glm::cross(ab, ac)), glm::dot(ab, ac));
}

// u in [0,1) with a density that is linear from a to b; returns the density.
float warp_linear(float a, float b, float& u) {
  const float root = std::sqrt(a * a + (b * b - a * a) * u);
  u = std::min(a == b ? u : (root - a) / (b - a), 0x1.fffffep-1f);
  return 2 * (a + (b - a) * u) / (a + b);
}

// Bilinear between the cosines at the corners, where sample_spherical_triangle puts them: the second at u.y = 0, the
// first and third at the ends of u.y = 1. Returns the density.
float warp_by_cosines(const std::array<float, 3>& cosine, Vec2& u) {
  const float pdf_y = warp_linear(cosine[1], 0.5f * (cosine[0] + cosine[2]), u.y);
  const float left = cosine[1] + (cosine[0] - cosine[1]) * u.y, right = cosine[1] + (cosine[2] - cosine[1]) * u.y;
  return pdf_y * warp_linear(left, right, u.x);
}

// Edges as ordered pairs of positions; triangles of one polygon that share an edge run along it in opposite directions.
struct Less {
  bool operator()(const Vec3& a, const Vec3& b) const { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }
  bool operator()(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) const {
    return (*this)(a[0], b[0]) || (a[0] == b[0] && (*this)(a[1], b[1]));
  }
};

void finish(PolygonLight& light) {
  std::map<std::array<Vec3, 2>, int, Less> edges;
  for (const auto& t : light.corners)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<Vec3, 2> edge{t[i], t[(i + 1) % 3]};
      if (const auto twin = edges.find({edge[1], edge[0]}); twin != edges.end() && twin->second > 0)
        --twin->second;
      else
        ++edges[edge];
    }
  for (const auto& [edge, count] : edges)
    for (int i = 0; i < count; ++i) light.boundary.push_back(edge);
  Vec3 lower = light.corners[0][0], upper = lower;
  double area = 0;
  for (const auto& t : light.corners) {
    for (const Vec3& v : t) lower = glm::min(lower, v), upper = glm::max(upper, v);
    area += 0.5 * glm::length(glm::cross(DVec3(t[1]) - DVec3(t[0]), DVec3(t[2]) - DVec3(t[0])));
    light.cumulative_area.push_back(area);
  }
  light.center = 0.5f * (lower + upper);
  light.radius = 0.5f * glm::length(upper - lower);
  light.magnitude = max_component(glm::max(glm::abs(lower), glm::abs(upper)));
}

// Whether a triangle lies in the polygon's plane and looks the same way.
bool coplanar(const PolygonLight& light, const Vec3& normal, const std::array<Vec3, 3>& corners) {
  if (glm::dot(light.normal, normal) < 1 - 1e-6f) return false;
  const float reach = std::sqrt(std::max(glm::dot(corners[1] - corners[0], corners[1] - corners[0]),
                                         glm::dot(corners[2] - corners[0], corners[2] - corners[0])));
  return std::abs(glm::dot(light.normal, corners[0] - light.corners[0][0])) <= 1e-4f * reach;
}

bool shares_edge(const PolygonLight& light, const std::array<Vec3, 3>& corners) {
  const auto& last = light.corners;
  const std::size_t first = last.size() > 64 ? last.size() - 64 : 0;  // neighbours are near in every exporter's order
  for (std::size_t k = first; k < last.size(); ++k) {
    int shared = 0;
    for (const Vec3& a : last[k])
      for (const Vec3& b : corners) shared += a == b;
    if (shared >= 2) return true;
  }
  return false;
}

}  // namespace

bool all_emission_is_plain(const Scene& scene) {
  return std::all_of(scene.materials.begin(), scene.materials.end(), [](const SceneMaterial& m) {
    return m.unlit || m.emission_texture.image < 0 || !(max_component(m.emission) > 0);
  });
}

std::vector<PolygonLight> find_polygon_lights(const Scene& scene) {
  std::vector<PolygonLight> lights;
  for (const Surface& surface : scene.surfaces) {
    const SceneMaterial& material = scene.materials[surface.material];
    if (material.unlit || material.emission_texture.image >= 0 || !(max_component(material.emission) > 0)) continue;
    const std::size_t first_of_surface = lights.size();
    for (std::uint32_t k = 0; k < surface.triangle_count; ++k) {
      const std::uint32_t t = surface.first_triangle + k;
      const UVec3& index = scene.triangles[t];
      const std::array<Vec3, 3> corners{scene.positions[index.x], scene.positions[index.y], scene.positions[index.z]};
      const Vec3 normal = geometric_normal(scene, t);
      const bool grows = lights.size() > first_of_surface && coplanar(lights.back(), normal, corners) &&
                         shares_edge(lights.back(), corners);
      if (!grows) {
        lights.emplace_back();
        lights.back().radiance = material.emission;
        lights.back().normal = normal;
        lights.back().double_sided = material.double_sided;
      }
      lights.back().triangles.push_back(t);
      lights.back().corners.push_back(corners);
    }
  }
  for (PolygonLight& light : lights) finish(light);
  return lights;
}

float polygon_irradiance(const PolygonLight& light, const Receiver& r) {
  const Vec3 to = light.center - r.position;
  const float height = -glm::dot(light.normal, to);  // of the receiver over the light's plane
  if (light.double_sided ? height == 0 : height <= 0) return 0;
  const float above = glm::dot(r.horizon(), to);
  if (above <= -light.radius) return 0;
  const float d2 = glm::dot(to, to);
  if (above > light.radius && d2 > kFar * kFar * light.radius * light.radius) {
    const float d = std::sqrt(d2);
    return incidence(r, to / d) * (static_cast<float>(light.area_m2()) * std::abs(height) / (d2 * d));
  }
  float sum = 0;
  if (above > light.radius && r.normal == r.horizon()) {
    Vec3 vector(0);
    for (const auto& edge : light.boundary) vector += edge_vector(edge[0] - r.position, edge[1] - r.position);
    sum = -0.5f * glm::dot(vector, r.normal);
  } else {
    for (const auto& corners : light.corners) sum += irradiance_of_triangle(corners, r);
  }
  return std::clamp(height > 0 ? sum : -sum, 0.0f, kPi);
}

PolygonView::PolygonView(const PolygonLight& light, const Receiver& receiver)
    : light_(light), receiver_(receiver), height_(glm::dot(light.normal, receiver.position - light.center)) {
  if (light.corners.size() > kFew || (light.double_sided ? height_ == 0 : height_ <= 0)) return;
  for (std::size_t k = 0; k < light.corners.size(); ++k) sum_ += (seen_[k] = see(k)).weight();
}

float PolygonView::area_of(std::size_t k) const {
  const auto& cumulative = light_.cumulative_area;
  return static_cast<float>(cumulative[k] - (k > 0 ? cumulative[k - 1] : 0));
}

PolygonView::Triangle PolygonView::see(std::size_t k) const {
  Triangle t;
  t.area = area_of(k);
  float length[3], largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    t.to[i] = light_.corners[k][i] - receiver_.position;
    length[i] = std::sqrt(length2(t.to[i]));
    if (!(length[i] > 0)) return t;
    t.direction[i] = t.to[i] / length[i];
    t.cosine[i] = incidence(receiver_, t.direction[i]);
    largest = std::max(largest, t.cosine[i]);
  }
  for (float& c : t.cosine) c = std::max(c, std::max(0.1f * largest, 0.01f));
  const auto& [a, b, c] = t.direction;
  const float triple = std::abs(glm::dot(a, glm::cross(b, c)));  // Van Oosterom & Strackee 1983
  t.solid_angle = 2 * std::atan2(triple, 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  if (t.solid_angle > kSmallSolidAngle) t.alpha = corner_angle(a, b, c);
  return t;
}

// One triangle, few of them by what they contribute, many by area; u.x is stretched to be used again.
const PolygonView::Triangle& PolygonView::choose(Vec2& u, float& probability, Triangle& other) const {
  const std::size_t count = light_.corners.size();
  if (count == 1) return seen_[0];
  std::size_t chosen = 0;
  if (count <= kFew && sum_ > 0) {
    const float target = u.x * sum_;
    float before = 0;
    while (chosen + 1 < count && target >= before + seen_[chosen].weight()) before += seen_[chosen++].weight();
    const float weight = std::max(seen_[chosen].weight(), 1e-30f);
    u.x = std::clamp((target - before) / weight, 0.0f, 0x1.fffffep-1f);
    probability = weight / sum_;
    return seen_[chosen];
  }
  const auto& cumulative = light_.cumulative_area;
  const double target = double{u.x} * light_.area_m2();
  chosen = std::min<std::size_t>(std::upper_bound(cumulative.begin(), cumulative.end(), target) - cumulative.begin(),
                                 count - 1);
  u.x = std::clamp(static_cast<float>((target - (chosen > 0 ? cumulative[chosen - 1] : 0)) / area_of(chosen)), 0.0f,
                   0x1.fffffep-1f);
  probability = static_cast<float>(area_of(chosen) / light_.area_m2());
  return count <= kFew ? seen_[chosen] : other = see(chosen);
}

// Arvo 1995, "Stratified Sampling of Spherical Triangles".
Vec3 PolygonView::on_sphere(const Triangle& triangle, const Vec2& u) {
  const auto& [a, b, c] = triangle.direction;
  const float alpha = triangle.alpha;
  const float phi = triangle.solid_angle * u.x - alpha;
  const float s = std::sin(phi), t = std::cos(phi);
  const float cos_alpha = std::cos(alpha), sin_alpha = std::sin(alpha);
  const float cos_c = glm::dot(a, b);
  const float k1 = t - cos_alpha, k2 = s + sin_alpha * cos_c;
  const float numerator = (k2 * t - k1 * s) * cos_alpha - k2;
  const float denominator = (k2 * s + k1 * t) * sin_alpha;
  const float q = std::clamp(denominator != 0 ? numerator / denominator : 1.0f, -1.0f, 1.0f);
  const Vec3 towards_c = normalize_or(c - glm::dot(c, a) * a, a);
  const Vec3 on_edge = q * a + std::sqrt(1 - q * q) * towards_c;
  const float z = 1 - u.y * (1 - glm::dot(on_edge, b));
  const Vec3 from_b = normalize_or(on_edge - glm::dot(on_edge, b) * b, b);
  return glm::normalize(z * b + std::sqrt(std::max(0.0f, 1 - z * z)) * from_b);
}

std::optional<PolygonSample> PolygonView::sample(const Vec2& u) const {
  if (light_.double_sided ? height_ == 0 : height_ <= 0) return std::nullopt;
  Vec2 rest = u;
  float probability = 1;
  Triangle other;
  const Triangle& triangle = choose(rest, probability, other);
  PolygonSample s;
  if (triangle.solid_angle > kSmallSolidAngle) {
    const float pdf = warp_by_cosines(triangle.cosine, rest);
    s.direction = on_sphere(triangle, rest);
    const float cosine = std::abs(glm::dot(light_.normal, s.direction));
    if (!(cosine > 0)) return std::nullopt;
    s.distance = std::abs(height_) / cosine;
    s.solid_angle = triangle.solid_angle / (probability * pdf);
  } else {
    const Vec2 w = square_to_triangle(rest);
    const Vec3 on = triangle.to[0] + w.x * (triangle.to[1] - triangle.to[0]) + w.y * (triangle.to[2] - triangle.to[0]);
    s.distance = std::sqrt(length2(on));
    if (!(s.distance > 0)) return std::nullopt;
    s.direction = on / s.distance;
    s.solid_angle =
        triangle.area / probability * std::abs(glm::dot(light_.normal, s.direction)) / (s.distance * s.distance);
  }
  if (!(s.solid_angle > 0) || !is_finite(s.direction)) return std::nullopt;
  // Stop short of the emitter itself, as far as rounding may put its points off its plane.
  const float cosine = std::abs(glm::dot(light_.normal, s.direction));
  s.distance -= s.distance * 0x1p-14f + light_.magnitude * (32 * 0x1p-24f) / std::max(cosine, 1e-6f);
  return s;
}

}  // namespace oriel
