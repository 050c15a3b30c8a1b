#include "bake/radiosity/screen_fit.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

constexpr std::size_t kMostAreas = 4;        // that stand for all that is in the way
constexpr std::size_t kMostCandidates = 64;  // sides to choose from: with more, smaller squares have fewer each
constexpr double kSoft = 4;                  // penumbrae that a square may be wide: of 16 rays across several meet each

struct ScreenCorner {
  DVec2 at{0};
  bool ends = false;  // the shadow does, between here and the next
};

std::vector<ScreenCorner> clipped(std::span<const ScreenCorner> polygon, const DVec2& inwards, double off) {
  std::vector<ScreenCorner> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ScreenCorner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double in_a = glm::dot(a.at, inwards) - off, in_b = glm::dot(b.at, inwards) - off;
    if (in_a >= 0) out.push_back(a);
    if ((in_a >= 0) != (in_b >= 0)) out.push_back({a.at + (b.at - a.at) * (in_a / (in_a - in_b)), in_a >= 0 || a.ends});
  }
  return out;
}

}  // namespace

ScreenFit::ScreenFit(const Light& sun, const DVec3& middle, double reach)
    : middle_(middle),
      towards_(-glm::normalize(DVec3(sun.direction))),
      u_(glm::normalize(std::abs(towards_.x) < 0.7 ? DVec3(0, towards_.z, -towards_.y)
                                                   : DVec3(-towards_.z, 0, towards_.x))),
      v_(glm::cross(towards_, u_)),
      reach_(reach),
      tangent_(std::tan(double{sun.angular_radius_rad})) {}

void ScreenFit::add_edge(const DVec3& a, const DVec3& b, const DVec3& third) {
  const DVec2 from = across(a - middle_), along = across(b - a), inside = across(third - a);
  const DVec2 normal(-along.y, along.x);
  const double length = glm::length(along), width = glm::dot(normal, inside);
  if (!(std::abs(width) > 1e-6 * length * glm::length(third - a))) return;  // edge-on: its neighbour has the edge
  const DVec2 inwards = normal * ((width > 0 ? 1 : -1) / length);
  const double nearest = std::clamp(-glm::dot(from, along) / (length * length), 0.0, 1.0);
  edges_.push_back({inwards, glm::dot(inwards, from), glm::dot(a + nearest * (b - a) - middle_, towards_)});
}

bool ScreenFit::is_soft() const {
  return std::ranges::all_of(edges_, [&](const HalfPlane& e) { return kSoft * e.depth * tangent_ > reach_; });
}

ScreenFit::Rays ScreenFit::within(std::span<const HalfPlane> area, double depth, std::span<const SeenRay> rays) {
  Rays out;
  for (std::size_t i = 0; i < rays.size(); ++i)
    out[i] = std::ranges::all_of(area, [&](const HalfPlane& side) {
      return glm::dot(side.inwards, rays[i].at + depth * rays[i].slope) >= side.off;
    });
  return out;
}

std::optional<std::vector<Screen>> ScreenFit::fit(std::span<const Ray> rays, const Rays& lit) const {
  std::vector<SeenRay> seen;
  for (const Ray& ray : rays) {
    const DVec3 from = DVec3(ray.origin) - middle_, way(ray.direction);
    const DVec2 slope = across(way) / glm::dot(way, towards_);
    seen.push_back({across(from) - glm::dot(from, towards_) * slope, slope});
  }
  std::vector<HalfPlane> sides;
  std::vector<Rays> in;
  for (const HalfPlane& edge : edges_) {
    const Rays covered = within(std::span(&edge, 1), edge.depth, seen);
    if (covered.all() || covered.none() || std::ranges::find(in, covered) != in.end()) continue;
    sides.push_back(edge), in.push_back(covered);
  }
  std::vector<Screen> out;
  if (sides.size() > kMostCandidates) return std::nullopt;
  Rays left = ~lit;
  for (std::size_t areas = 0; left.any(); ++areas) {
    Area best;
    double best_depth = 0;
    Rays best_covered;
    // From each side an area grows by the sides that take away most of what is lit and least of what is dark.
    for (std::size_t first = 0; first < sides.size(); ++first) {
      Area area{sides[first]};
      Rays covered = in[first];
      double depth = sides[first].depth;
      while ((covered & lit).any()) {
        const auto off = [&](const Rays& c) { return (c & lit).count() + (left & ~c).count(); };
        const auto next = std::ranges::min_element(in, {}, [&](const Rays& side) { return off(covered & side); });
        if (off(covered & *next) >= off(covered)) break;
        area.push_back(sides[static_cast<std::size_t>(next - in.begin())]), covered &= *next;
        depth += area.back().depth;
      }
      depth /= static_cast<double>(area.size());
      covered = within(area, depth, seen);
      if ((covered & lit).none() && (covered & left).count() > (best_covered & left).count())
        best = std::move(area), best_depth = depth, best_covered = covered;
    }
    if (best.empty() || areas == kMostAreas) return std::nullopt;
    left &= ~best_covered;
    add_screens(best, best_depth, out);
  }
  return out.size() > kMostListed ? std::nullopt : std::optional(std::move(out));
}

void ScreenFit::add_screens(const Area& area, double depth, std::vector<Screen>& out) const {
  const DVec2 inwards = area[0].inwards, along(inwards.y, -inwards.x), edge = area[0].off * inwards;
  const double half = kScreen * (reach_ + tangent_ * depth);
  std::vector<ScreenCorner> polygon{{edge - half * along, true}, {edge + half * along}, {edge + 2 * half * inwards}};
  for (std::size_t k = 1; k < area.size(); ++k) polygon = clipped(polygon, area[k].inwards, area[k].off);
  const auto place = [&](const ScreenCorner& c) { return middle_ + depth * towards_ + c.at.x * u_ + c.at.y * v_; };
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const bool ends[] = {k == 1 && polygon[0].ends, polygon[k].ends, k + 2 == polygon.size() && polygon[k + 1].ends};
    out.push_back({{place(polygon[0]), place(polygon[k]), place(polygon[k + 1])},
                   static_cast<std::uint8_t>(ends[0] | ends[1] << 1 | ends[2] << 2)});
  }
}

}  // namespace oriel
