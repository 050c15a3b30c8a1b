#include "bake/import/patches.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

constexpr int kMostLayers = 8;                // then they share a place again
constexpr double kOverlap = 1e-3;             // of the smaller triangle: less is a common edge
constexpr std::size_t kFew = 8;               // triangles of a plane: their pairs take less than finding patches
constexpr std::size_t kMostPairs = 1u << 26;  // of triangles of one plane that are compared

using Polygon = std::vector<DVec2>;

double area_of(std::span<const DVec2> p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const DVec2 &a = p[i], &b = p[(i + 1) % p.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

// The area that two counter-clockwise triangles share (Sutherland and Hodgman 1974).
double shared_area(const std::array<DVec2, 3>& subject, const std::array<DVec2, 3>& clip) {
  Polygon rest(subject.begin(), subject.end()), next;
  for (std::size_t k = 0; k < 3 && !rest.empty(); ++k) {
    const DVec2 from = clip[k], along = clip[(k + 1) % 3] - from;
    const auto inside = [&](const DVec2& p) { return along.x * (p.y - from.y) - along.y * (p.x - from.x); };
    next.clear();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const DVec2 &a = rest[i], &b = rest[(i + 1) % rest.size()];
      const double at_a = inside(a), at_b = inside(b);
      if (at_a >= 0) next.push_back(a);
      if ((at_a >= 0) != (at_b >= 0)) next.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    rest.swap(next);
  }
  return area_of(rest);
}

}  // namespace

bool lets_through(const SceneMaterial& material) {
  return material.alpha_mode != AlphaMode::kOpaque || material.transmission > 0;
}

// Whether a few triangles cannot lie in one place: each two hang together or are further apart than a lift.
bool PlanePatches::all_apart(std::span<const Planar> triangles) const {
  if (triangles.size() > kFew) return false;
  const auto corner = [&](std::size_t i, int k) {
    return scene_.positions[scene_.triangles[triangles[i].triangle][k]];
  };
  const auto of = [&](std::size_t i) { return scene_.triangle_surface[triangles[i].triangle]; };
  const Vec3 lift(static_cast<float>(2 * lift_));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (oriel::lets_through(scene_.materials[scene_.surfaces[of(i)].material])) return false;
    const Vec3 lower = glm::min(glm::min(corner(i, 0), corner(i, 1)), corner(i, 2)) - lift,
               upper = glm::max(glm::max(corner(i, 0), corner(i, 1)), corner(i, 2)) + lift;
    for (std::size_t k = 0; k < i; ++k) {
      bool joined = false;
      for (int c = 0; c < 9 && of(i) == of(k); ++c) joined |= corner(i, c / 3) == corner(k, c % 3);
      const Vec3 from = glm::min(glm::min(corner(k, 0), corner(k, 1)), corner(k, 2)),
                 to = glm::max(glm::max(corner(k, 0), corner(k, 1)), corner(k, 2));
      if (!joined && glm::all(glm::lessThanEqual(from, upper)) && glm::all(glm::lessThanEqual(lower, to))) return false;
    }
  }
  return true;
}

std::vector<Layer> PlanePatches::layers(std::span<const Planar> triangles) {
  if (all_apart(triangles)) return {};
  triangles_.assign(triangles.begin(), triangles.end());
  find_patches();
  if (patches_.size() < 2 && !patches_.front().lets_through) return {};
  project();
  find_overlaps();
  return stack();
}

std::uint32_t PlanePatches::met(const Layer& layer, std::span<const Planar> others) const {
  std::vector<Flat> patch;
  for (const std::uint32_t t : layer.triangles) patch.push_back(flattened(t));
  for (const Planar& other : others) {
    const std::uint32_t s = scene_.triangle_surface[other.triangle];
    if (lets_through(scene_.materials[scene_.surfaces[s].material])) continue;
    const Flat f = flattened(other.triangle);
    if (std::ranges::any_of(patch, [&](const Flat& p) { return overlap(p, f); })) return s;
  }
  return ~0u;
}

bool PlanePatches::has_elsewhere(std::uint32_t vertex, std::uint32_t patch) const {
  const auto found = patch_of_vertex_.find(vertex);
  return found != patch_of_vertex_.end() && found->second != patch;
}

// Triangles of a surface that have a corner in common.
DisjointSets PlanePatches::connected() const {
  DisjointSets sets(triangles_.size());
  std::vector<std::tuple<std::size_t, Vec3, std::uint32_t>> corners;  // by the hash of the position
  const auto surface_of = [&](std::uint32_t i) { return scene_.triangle_surface[triangles_[i].triangle]; };
  for (std::uint32_t first = 0, last = 0; first < triangles_.size(); first = last) {
    corners.clear();
    for (; last < triangles_.size() && surface_of(last) == surface_of(first); ++last)
      for (int k = 0; k < 3; ++k) {
        const Vec3& p = scene_.positions[scene_.triangles[triangles_[last].triangle][k]];
        corners.emplace_back(PositionHash()(p), p, last);
      }
    if (last - first == 1) continue;
    std::ranges::sort(corners, {}, [](const auto& corner) { return std::get<0>(corner); });
    for (std::size_t a = 0; a < corners.size(); ++a)
      for (std::size_t b = a + 1; b < corners.size() && std::get<0>(corners[b]) == std::get<0>(corners[a]); ++b)
        if (std::get<1>(corners[b]) == std::get<1>(corners[a])) {
          sets.join(std::get<2>(corners[a]), std::get<2>(corners[b]));
          break;
        }
  }
  return sets;
}

void PlanePatches::find_patches() {
  DisjointSets sets = connected();
  patches_.clear();
  patch_of_.assign(triangles_.size(), ~0u);
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const std::size_t r = sets.root(i);
    if (patch_of_[r] == ~0u) {
      patch_of_[r] = static_cast<std::uint32_t>(patches_.size());
      patches_.emplace_back().lets_through = oriel::lets_through(scene_.materials[surface(i).material]);
    }
    patch_of_[i] = patch_of_[r];
    patches_[patch_of_[i]].members.push_back(i);
    patches_[patch_of_[i]].area += triangle_area(scene_, triangles_[i].triangle);
  }
}

void PlanePatches::project() {
  const Vec3 n = glm::abs(geometric_normal(scene_, triangles_.front().triangle));
  drop_ = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  flat_.clear();
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    flat_.push_back(flattened(triangles_[i].triangle));
    flat_.back().patch = patch_of_[i];
  }
}

PlanePatches::Flat PlanePatches::flattened(std::uint32_t triangle) const {
  Flat f;
  for (int k = 0; k < 3; ++k) {
    const Vec3& p = scene_.positions[scene_.triangles[triangle][k]];
    f.corners[static_cast<std::size_t>(k)] = DVec2(p[(drop_ + 1) % 3], p[(drop_ + 2) % 3]);
  }
  f.area = area_of(f.corners);
  if (f.area < 0) std::swap(f.corners[1], f.corners[2]), f.area = -f.area;
  f.lower = glm::min(glm::min(f.corners[0], f.corners[1]), f.corners[2]);
  f.upper = glm::max(glm::max(f.corners[0], f.corners[1]), f.corners[2]);
  return f;
}

bool PlanePatches::boxes_meet(const Flat& a, const Flat& b) {
  return a.lower.x < b.upper.x && b.lower.x < a.upper.x && a.lower.y < b.upper.y && b.lower.y < a.upper.y;
}

bool PlanePatches::overlap(const Flat& a, const Flat& b) {
  return boxes_meet(a, b) && shared_area(a.corners, b.corners) >= kOverlap * std::min(a.area, b.area);
}

// How far k lies before i, m, if they are parallel and no further apart than a layer is moved: by the corners of the
// smaller one.
std::optional<double> PlanePatches::rise(std::uint32_t i, std::uint32_t k) const {
  const bool first_is_large = flat_[i].area >= flat_[k].area;
  const std::uint32_t large = first_is_large ? i : k, small = i + k - large;
  const std::uint32_t t = triangles_[large].triangle, other = triangles_[small].triangle;
  const DVec3 n(geometric_normal(scene_, t)), from(scene_.positions[scene_.triangles[t].x]);
  double least = lift_, most = -lift_;
  for (int c = 0; c < 3; ++c) {
    const double d = glm::dot(n, DVec3(scene_.positions[scene_.triangles[other][c]]) - from);
    least = std::min(least, d), most = std::max(most, d);
  }
  if (most >= lift_ || least <= -lift_ || most - least > 2 * one_place_) return std::nullopt;
  const double mean = 0.5 * (least + most);
  return first_is_large ? mean : -mean;
}

void PlanePatches::find_overlaps() {
  std::vector<std::uint32_t> order(flat_.size()), open;
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(flat_[i].lower.x, i); });
  std::size_t pairs = 0;
  for (const std::uint32_t i : order) {
    std::erase_if(open, [&](std::uint32_t k) { return flat_[k].upper.x <= flat_[i].lower.x; });
    if ((pairs += open.size()) > kMostPairs) return;
    for (const std::uint32_t k : open) compare(i, k);
    open.push_back(i);
  }
}

void PlanePatches::compare(std::uint32_t i, std::uint32_t k) {
  const Flat &a = flat_[i], &b = flat_[k];
  if (a.patch == b.patch || !boxes_meet(a, b) || patches_[a.patch].overlaps.contains(b.patch)) return;
  if (surface(i).mover != surface(k).mover || !overlap(a, b)) return;
  const std::optional<double> d = rise(i, k);
  if (!d) return;
  if (*d > one_place_) patches_[b.patch].behind.try_emplace(a.patch, *d);
  if (*d < -one_place_) patches_[a.patch].behind.try_emplace(b.patch, -*d);
  if (std::abs(*d) > one_place_) return;
  patches_[a.patch].overlaps.insert(b.patch);
  patches_[b.patch].overlaps.insert(a.patch);
}

// By patch how many layers lie below it, none or a patch of which is told too: those of its place that are before it in
// the order, and what would be moved to it or past it.
std::vector<int> PlanePatches::levels(std::span<const std::uint32_t> order, std::vector<std::uint32_t>& below) const {
  std::vector<std::uint32_t> rank(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
  std::vector<int> level(order.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::uint32_t p : order) {
      const auto lies_on = [&](std::uint32_t other, double at_least) {
        const int needed = std::min(static_cast<int>(std::ceil(at_least)), kMostLayers);
        if (needed > level[p]) level[p] = needed, below[p] = other, changed = true;
      };
      for (const std::uint32_t other : patches_[p].overlaps)
        if (rank[other] < rank[p]) lies_on(other, level[other] + 1);
      for (const auto& [other, distance] : patches_[p].behind)
        if (level[other] > 0) lies_on(other, level[other] + 1 - distance / lift_);
    }
  }
  return level;
}

std::vector<Layer> PlanePatches::stack() {
  constexpr double kThrough = 0.9;  // of copies that one lies on top which lets light through
  std::vector<std::uint32_t> order(patches_.size()), below(patches_.size(), ~0u);
  for (std::uint32_t p = 0; p < order.size(); ++p) order[p] = p;
  std::ranges::stable_sort(order, {}, [&](std::uint32_t p) {
    return -static_cast<float>(patches_[p].area * (patches_[p].lets_through ? kThrough : 1));
  });
  const std::vector<int> level = levels(order, below);
  std::vector<Layer> layers;
  for (const std::uint32_t p : order) {
    if (level[p] == 0 && !patches_[p].lets_through) continue;
    Layer layer{.triangles = {}, .patch = p, .level = level[p]};
    if (below[p] != ~0u) layer.below = scene_.triangle_surface[triangles_[patches_[below[p]].members.front()].triangle];
    for (const std::uint32_t i : patches_[p].members) layer.triangles.push_back(triangles_[i].triangle);
    layers.push_back(std::move(layer));
  }
  patch_of_vertex_.clear();
  for (std::uint32_t i = 0; i < triangles_.size() && !layers.empty(); ++i)
    for (int k = 0; k < 3; ++k) patch_of_vertex_[scene_.triangles[triangles_[i].triangle][k]] = patch_of_[i];
  return layers;
}

}  // namespace oriel
