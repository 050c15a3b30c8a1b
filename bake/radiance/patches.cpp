#include "bake/radiance/patches.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

namespace oriel {
namespace {

// Triangles whose planes agree almost exactly: what a flat polygon's triangulation gives. The search for patches works
// on these, so that a floor of a million triangles is as cheap as one of two.
struct Bundle {
  std::vector<std::uint32_t> triangles;
  DVec3 normal{0};  // area-weighted sum, then unit
  double offset = 0, area = 0;
  bool taken = false;
};

DVec3 centroid(const Scene& scene, std::uint32_t triangle) {
  const UVec3 t = scene.triangles[triangle];
  return (DVec3(scene.positions[t.x]) + DVec3(scene.positions[t.y]) + DVec3(scene.positions[t.z])) / 3.0;
}

using Cell = std::array<std::int64_t, 4>;

std::vector<Bundle> make_bundles(const Scene& scene, std::span<const std::uint32_t> triangles, double distance) {
  std::map<Cell, std::size_t> bundle_of;
  std::vector<Bundle> bundles;
  for (const std::uint32_t t : triangles) {
    const DVec3 n(geometric_normal(scene, t));
    const double offset = glm::dot(n, centroid(scene, t));
    const Cell cell{std::llround(n.x * 4096), std::llround(n.y * 4096), std::llround(n.z * 4096),
                    std::llround(offset / distance)};
    const auto [it, is_new] = bundle_of.try_emplace(cell, bundles.size());
    if (is_new) bundles.emplace_back();
    Bundle& bundle = bundles[it->second];
    const double area = triangle_area(scene, t);
    bundle.triangles.push_back(t);
    bundle.normal += area * n;
    bundle.offset += area * offset;
    bundle.area += area;
  }
  for (Bundle& bundle : bundles) {
    const double length = glm::length(bundle.normal);
    if (bundle.area > 0 && length > 0) {
      bundle.normal /= length;
      bundle.offset /= bundle.area;
    } else {
      bundle.taken = true;  // no area, no plane
    }
  }
  return bundles;
}

// Bundles by normal cell, sorted by offset inside it.
class BundleIndex {
 public:
  BundleIndex(const std::vector<Bundle>& bundles, double max_angle_rad)
      : bundles_(bundles), size_(std::max(max_angle_rad, 1e-4)) {
    for (std::size_t i = 0; i < bundles.size(); ++i)
      if (!bundles[i].taken) cells_[key(cell(bundles[i].normal))].bundles.push_back(i);
    for (auto& [k, entry] : cells_) {
      for (const std::size_t i : entry.bundles) entry.area += bundles[i].area;
      std::sort(entry.bundles.begin(), entry.bundles.end(), [&](std::size_t a, std::size_t b) {
        return bundles_[a].offset != bundles_[b].offset ? bundles_[a].offset < bundles_[b].offset : a < b;
      });
    }
  }

  // Bundles with a normal within the angle (and somewhat beyond) and an offset within `reach`.
  template <class Visit>
  void near(const DVec3& normal, double offset, double reach, Visit&& visit) const {
    for_neighbours(cell(normal), [&](const Entry& entry) {
      auto at = std::lower_bound(entry.bundles.begin(), entry.bundles.end(), offset - reach,
                                 [&](std::size_t b, double value) { return bundles_[b].offset < value; });
      for (; at != entry.bundles.end() && bundles_[*at].offset <= offset + reach; ++at) visit(*at);
    });
  }

  // Area of everything with a normal near this one, wherever it is: no patch around it is larger. Remembered by cell,
  // so that the many facets of a curved mesh are dismissed at once.
  double area_around(const DVec3& normal) {
    Entry& centre = cells_[key(cell(normal))];
    if (centre.around < 0) {
      double sum = 0;
      for_neighbours(cell(normal), [&](const Entry& entry) { sum += entry.area; });
      centre.around = sum;
    }
    return centre.around;
  }

 private:
  struct Entry {
    std::vector<std::size_t> bundles;
    double area = 0, around = -1;
  };

  template <class Visit>
  void for_neighbours(const Cell& centre, Visit&& visit) const {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz)
          if (const auto it = cells_.find(key({centre[0] + dx, centre[1] + dy, centre[2] + dz, 0})); it != cells_.end())
            visit(it->second);
  }
  Cell cell(const DVec3& n) const {
    return {std::llround(n.x / size_), std::llround(n.y / size_), std::llround(n.z / size_), 0};
  }
  static std::int64_t key(const Cell& c) { return (c[0] * 2097152 + c[1]) * 2097152 + c[2]; }

  const std::vector<Bundle>& bundles_;
  double size_;
  std::unordered_map<std::int64_t, Entry> cells_;
};

double largest_distance(const Scene& scene, std::uint32_t triangle, const DVec3& normal, double offset) {
  double largest = 0;
  for (int corner = 0; corner < 3; ++corner) {
    const DVec3 p(scene.positions[scene.triangles[triangle][corner]]);
    largest = std::max(largest, std::abs(glm::dot(normal, p) - offset));
  }
  return largest;
}

// The area-weighted plane of the patch's triangles; they are not all degenerate.
void fit_plane(const Scene& scene, PlanarPatch& patch) {
  DVec3 normal(0), moment(0);
  patch.area_m2 = 0;
  for (const std::uint32_t t : patch.triangles) {
    const double area = triangle_area(scene, t);
    normal += area * DVec3(geometric_normal(scene, t));
    moment += area * centroid(scene, t);
    patch.area_m2 += area;
  }
  patch.normal = glm::normalize(normal);
  patch.offset = glm::dot(patch.normal, moment) / patch.area_m2;
}

// Grows patches out of bundles.
class PatchGrower {
 public:
  PatchGrower(const Scene& scene, std::span<const std::uint32_t> triangles, const PatchOptions& options)
      : scene_(scene), options_(options) {
    for (const std::uint32_t t : triangles)
      extent_ = std::max(extent_, double{glm::length(scene.positions[scene.triangles[t].x])});
  }

  // The patch that grows from a bundle: its plane is fitted anew as triangles join, so that the noise of small
  // triangles does not tilt it.
  PlanarPatch grow(std::size_t seed, const BundleIndex& index, std::vector<Bundle>& bundles) const {
    const Bundle& bundle = bundles[seed];
    std::uint32_t largest = bundle.triangles.front();
    for (const std::uint32_t t : bundle.triangles)
      if (triangle_area(scene_, t) > triangle_area(scene_, largest)) largest = t;
    PlanarPatch patch{.triangles = {}, .normal = bundle.normal, .area_m2 = bundle.area};
    patch.offset = glm::dot(bundle.normal, centroid(scene_, largest));
    for (int round = 0; round < 3; ++round) {
      collect(index, false, bundles, patch);
      if (patch.triangles.empty()) return patch;
      fit_plane(scene_, patch);
    }
    collect(index, true, bundles, patch);
    if (patch.triangles.empty()) return patch;
    fit_plane(scene_, patch);
    for (const std::uint32_t t : patch.triangles)
      patch.flatness_m = std::max(patch.flatness_m, largest_distance(scene_, t, patch.normal, patch.offset));
    return patch;
  }

 private:
  // Free triangles in the patch's plane replace its list; with `take` they are removed from their bundles.
  void collect(const BundleIndex& index, bool take, std::vector<Bundle>& bundles, PlanarPatch& patch) const {
    const double distance =
        std::max(options_.min_distance_m,
                 std::min(options_.max_distance_m, options_.relative_distance * std::sqrt(patch.area_m2)));
    const double min_cos = std::cos(options_.max_angle_rad);
    // Bundles further than this in offset cannot hold a triangle of the plane: one tilted by the angle about a point at
    // `extent_` from the origin shifts its offset by as much.
    const double reach =
        2 * std::max(options_.max_distance_m, options_.min_distance_m) + options_.max_angle_rad * 2 * extent_;
    patch.triangles.clear();
    index.near(patch.normal, patch.offset, reach, [&](std::size_t i) {
      Bundle& bundle = bundles[i];
      if (bundle.taken || glm::dot(bundle.normal, patch.normal) < min_cos) return;
      std::vector<std::uint32_t> rest;
      for (const std::uint32_t t : bundle.triangles)
        (largest_distance(scene_, t, patch.normal, patch.offset) <= distance ? patch.triangles : rest).push_back(t);
      if (!take) return;
      bundle.triangles = std::move(rest);
      bundle.taken = bundle.triangles.empty();
    });
    // Sums below run in the triangles' order, not in that of the index.
    std::sort(patch.triangles.begin(), patch.triangles.end());
  }

  const Scene& scene_;
  const PatchOptions& options_;
  double extent_ = 0;
};

}  // namespace

std::vector<PlanarPatch> find_planar_patches(const Scene& scene, std::span<const std::uint32_t> triangles,
                                             const PatchOptions& options) {
  std::vector<std::uint32_t> sorted(triangles.begin(), triangles.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<Bundle> bundles = make_bundles(scene, sorted, std::max(options.max_distance_m, options.min_distance_m));
  BundleIndex index(bundles, options.max_angle_rad);
  const PatchGrower grower(scene, sorted, options);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < bundles.size(); ++i)
    if (!bundles[i].taken) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return bundles[a].area != bundles[b].area ? bundles[a].area > bundles[b].area : a < b;
  });
  std::vector<PlanarPatch> patches;
  for (const std::size_t seed : order) {
    if (bundles[seed].taken || index.area_around(bundles[seed].normal) < options.min_area_m2) continue;
    // More than once where a bundle holds planes closer to each other than its cell.
    for (int repeat = 0; repeat < 4 && !bundles[seed].taken; ++repeat) {
      PlanarPatch patch = grower.grow(seed, index, bundles);
      if (patch.triangles.empty()) break;
      if (patch.area_m2 >= options.min_area_m2) patches.push_back(std::move(patch));
    }
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const PlanarPatch& a, const PlanarPatch& b) { return a.area_m2 > b.area_m2; });
  return patches;
}

}  // namespace oriel
