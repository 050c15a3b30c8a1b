#include "bake/trace/light_volumes.h"

#include <algorithm>
#include <queue>

#include "bake/trace/punctual.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kThickness = 1e-6;  // of the scene's size

// A light's image: where it seems to be, and through what it is seen.
struct Image {
  VirtualLight light;
  DVec3 position{0};        // of a point or spot
  DVec3 direction{0};       // unit, the way a directional light's light travels
  DVec3 reflected{1};       // share, by all mirrors so far
  std::vector<DVec3> hull;  // of the last mirror that the light reaches; empty: of the light itself
};

struct Fainter {
  bool operator()(const Image& a, const Image& b) const { return a.light.flux_lm < b.light.flux_lm; }
};

// The part of a convex polygon on the side n · p >= d.
std::vector<DVec3> cut(const std::vector<DVec3>& polygon, const DVec3& n, double d) {
  std::vector<DVec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = glm::dot(n, a) - d, at_b = glm::dot(n, b) - d;
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept.size() < 3 ? std::vector<DVec3>() : kept;
}

DVec3 centre_of(const std::vector<DVec3>& polygon) {
  DVec3 sum(0);
  for (const DVec3& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

// Its area seen along a unit direction, signed by the side that is seen; or the solid angle seen from p.
double seen_area(const std::vector<DVec3>& polygon, const DVec3& along) {
  DVec3 area(0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area += 0.5 * glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return std::abs(glm::dot(area, along));
}
double solid_angle(const std::vector<DVec3>& polygon, const DVec3& p) {
  double sum = 0;  // van Oosterom & Strackee 1983
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const DVec3 a = glm::normalize(polygon[0] - p), b = glm::normalize(polygon[i - 1] - p),
                c = glm::normalize(polygon[i] - p);
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  }
  return std::abs(sum);
}

class Finder {
 public:
  Finder(const Scene& scene, const PlanarMirrors& mirrors, double least)
      : scene_(scene), mirrors_(mirrors), least_(least) {}

  FoundLights run(int most_mirrors, std::size_t most) {
    FoundLights found;
    for (std::uint32_t l = 0; l < scene_.lights.size(); ++l) {
      Image image;
      image.light.light = l;
      image.position = DVec3(scene_.lights[l].position), image.direction = DVec3(scene_.lights[l].direction);
      if (own_flux(l) > 0) expand(image);
    }
    double kept = 0;
    while (!waiting_.empty() && found.lights.size() < most) {
      const Image image = waiting_.top();
      waiting_.pop();
      found.lights.push_back(image.light);
      kept += image.light.flux_lm;
      if (image.light.order < most_mirrors) expand(image);
    }
    double left = 0;
    for (; !waiting_.empty(); waiting_.pop()) left += waiting_.top().light.flux_lm;
    found.left_out = left > 0 ? left / (left + kept) : 0;
    return found;
  }

 private:
  bool is_afar(std::uint32_t l) const { return scene_.lights[l].type == LightType::kDirectional; }

  double own_flux(std::uint32_t l) const {
    const double r = scene_.radius();
    return is_afar(l) ? luminance(scene_.lights[l].intensity) * kPiD * r * r
                      : luminance(Vec3(punctual_power(scene_, scene_.lights[l])));
  }

  void expand(const Image& image) {
    for (std::uint16_t m = 0; m < mirrors_.size(); ++m)
      if (image.light.order == 0 || image.light.mirror[image.light.order - 1] != m) reflect(image, m);
  }

  // What of a mirror lies where the image's light goes.
  std::vector<DVec3> reached(const Image& image, const PlanarMirror& mirror) const {
    std::vector<DVec3> hull = mirror.hull;
    if (!image.hull.empty()) {
      const PlanarMirror& last = mirrors_[image.light.mirror[image.light.order - 1]];
      // What lies behind the last mirror, or in its plane, is not reached.
      hull = cut(hull, last.normal, last.offset + kThickness * double{scene_.radius()});
    }
    const double wide = 2 * double{scene_.radius()} * image.light.spread;
    for (const VirtualLight::Side& side : image.light.sides)
      if (!hull.empty()) hull = cut(hull, side.normal, side.offset - wide);
    return hull;
  }

  // By the edges of what of the last mirror the light reaches.
  void bound(Image& image) const {
    image.light.sides.clear();
    image.light.spread = kThickness + std::sin(double{scene_.lights[image.light.light].angular_radius_rad});
    const DVec3 middle = image.light.middle = centre_of(image.hull);
    image.light.extent_m = 0;
    for (std::size_t i = 0; i < image.hull.size(); ++i) {
      const DVec3 &a = image.hull[i], &b = image.hull[(i + 1) % image.hull.size()];
      image.light.extent_m = std::max(image.light.extent_m, glm::distance(a, middle));
      DVec3 n = is_afar(image.light.light) ? glm::cross(b - a, image.direction)
                                           : glm::cross(a - image.position, b - image.position);
      const double size = glm::length(n);
      // What cutting left of an edge does not tell where it runs; without it the volume is only wider.
      if (!(size > 0) || glm::distance(a, b) < kThickness * double{scene_.radius()}) continue;
      n *= (glm::dot(n, middle - a) < 0 ? -1 : 1) / size;
      image.light.sides.push_back({n, glm::dot(n, a)});
    }
  }

  void reflect(const Image& from, std::uint16_t m) {
    const PlanarMirror& mirror = mirrors_[m];
    const std::uint32_t l = from.light.light;
    const bool afar = is_afar(l);
    // Of a sun's disk a part may be before the mirror where its centre is not.
    const double low = std::sin(double{scene_.lights[l].angular_radius_rad});
    if (afar ? glm::dot(mirror.normal, from.direction) >= low : mirror.height(from.position) <= 0) return;
    std::vector<DVec3> hull = reached(from, mirror);
    if (hull.empty()) return;
    const DVec3 centre = centre_of(hull);
    const DVec3 arrives = afar ? from.direction : glm::normalize(centre - from.position);
    const double cosine = std::max(std::abs(glm::dot(arrives, mirror.normal)), low);
    const DVec3 reflected = from.reflected * DVec3(mirror_reflectance(mirror.shade, static_cast<float>(cosine)));
    Image image = from;
    image.reflected = reflected;
    image.light.mirror[static_cast<std::size_t>(image.light.order++)] = m;
    image.position = mirror.mirrored(from.position), image.direction = mirror.turned(from.direction);
    const DMat3 turn = DMat3(1) - 2.0 * glm::outerProduct(mirror.normal, mirror.normal);
    // A receiver is mirrored by the last mirror first: what was before is applied to what that gives.
    image.light.unfolded = from.light.unfolded * turn;
    image.light.shift = from.light.unfolded * (2 * mirror.offset * mirror.normal) + from.light.shift;
    image.light.flux_lm =
        std::min(flux(l, from, hull, arrives, reflected), from.light.order > 0 ? from.light.flux_lm : 1e300);
    image.hull = std::move(hull);
    bound(image);
    if (image.light.flux_lm >= least_ * own_flux(l)) waiting_.push(std::move(image));
  }

  double flux(std::uint32_t l, const Image& from, const std::vector<DVec3>& hull, const DVec3& arrives,
              const DVec3& reflected) const {
    if (is_afar(l)) return luminance(Vec3(DVec3(scene_.lights[l].intensity) * reflected)) * seen_area(hull, arrives);
    // Mean intensity of all directions: what a spot or a profile sends this way is asked at each point.
    const DVec3 mean = punctual_power(scene_, scene_.lights[l]) / (4 * kPiD);
    return luminance(Vec3(mean * reflected)) * solid_angle(hull, from.position);
  }

  const Scene& scene_;
  const PlanarMirrors& mirrors_;
  double least_;
  std::priority_queue<Image, std::vector<Image>, Fainter> waiting_;
};

}  // namespace

FoundLights find_virtual_lights(const Scene& scene, const PlanarMirrors& mirrors, int most_mirrors, std::size_t most,
                                double least) {
  return Finder(scene, mirrors, least).run(most_mirrors, most);
}

}  // namespace oriel
