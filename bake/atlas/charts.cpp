#include "bake/atlas/charts.h"

#include <algorithm>
#include <Eigen/Eigenvalues>
#include <numeric>

#include "bake/atlas/chart_ends.h"
#include "bake/atlas/merge.h"
#include "bake/atlas/surface_mesh.h"
#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr double kFlatTexels = 64;     // a flat region of less area (texels²) may join its neighbours
constexpr double kSmoothCos = 0.966;   // 15°: a neighbour within it continues a surface smoothly
constexpr double kNarrowTexels = 4;    // a strip of that width shaded like its neighbours is part of a curve
constexpr float kAlikeCos = 0.9998f;   // of shading normals that are the same
constexpr int kRegrowths = 4;          // of a curved chart, around the mean normal found so far, while it helps
constexpr double kLargestStretch = 2;  // L∞ of a chart
constexpr double kBoxFill = 0.6;       // of a large curved chart
constexpr double kTinyTexels = 16;     // a chart of less area (texels²) may join one beyond a sharp edge
constexpr int kSweeps = 8;             // that straighten outlines
constexpr std::uint32_t kNoRegion = ~0u;
constexpr std::uint32_t kFree = 0, kTried = 1, kDone = 2;  // a face: free; no seed of a flat region; in a region

using Faces = std::vector<std::uint32_t>;

struct Region {
  Faces faces;  // connected
  bool exact = false, conformal = true;
};

constexpr double kSlackRad = 1e-4;  // angles of a model are often those of the limits, but for rounding

// To 12 bits after the leading one. Faces that are alike in the model stay alike wherever it stands: the rounding of
// its corners, some 1e-6 of a place in a room, would decide which comes first, and a chair that is moved by a hand's
// breadth would get other charts.
float rounded(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return static_cast<float>(std::ldexp(std::round(std::ldexp(mantissa, 13)), exponent - 13));
}

// A face's normal (unit or zero) and area (rounded) in the memory of four floats: that is what growth decides by.
struct FaceFrame {
  Vec3 normal{0};
  float area = 0;
};

struct ChartTask {
  const Scene& scene;
  const ChartOptions& options;
  Context& context;
  std::uint32_t first = 0;  // triangle of the surface
};

class Grower {
 public:
  Grower(const ChartTask& task, std::span<const std::uint32_t> across, std::span<const FaceFrame> frames)
      : task_(task),
        scene_(task.scene),
        across_(across),
        frame_(frames),
        curved_cos_(std::cos(task.options.curved_rad)) {
    state_.assign(frames.size(), kFree);
    visit_.assign(frames.size(), 0);
  }

  std::vector<Region> run() {
    Faces seeds(frame_.size());
    std::iota(seeds.begin(), seeds.end(), 0u);
    std::stable_sort(seeds.begin(), seeds.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return frame_[a].area > frame_[b].area; });
    for (const std::uint32_t seed : seeds)
      if (!task_.context.stopped() && state_[seed] == kFree && frame_[seed].area > 0) try_flat(seed);
    for (const std::uint32_t seed : seeds) {
      if (task_.context.stopped()) break;
      if (state_[seed] == kDone) continue;
      if (task_.options.deadline->passed())
        grow_box_side(seed);
      else
        grow_curved(seed);
    }
    return std::move(out_);
  }

 private:
  // Calls visit(neighbour or -1, edge) for the three edges of a face.
  template <class Visit>
  void for_neighbours(std::uint32_t face, Visit&& visit) const {
    for (std::uint32_t edge = 3 * face; edge < 3 * face + 3; ++edge)
      visit(across_[edge] == kNoEdge ? -1 : static_cast<int>(across_[edge] / 3), edge);
  }

  // Faces reached from the seed through accepted ones, in order of distance (in steps).
  template <class Accept>
  Faces grow(std::uint32_t seed, Accept&& accept) {
    ++round_;
    Faces faces{seed};
    visit_[seed] = round_;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const std::uint32_t from = faces[i];
      for_neighbours(from, [&](int neighbour, std::uint32_t) {
        if (neighbour < 0) return;
        const auto to = static_cast<std::uint32_t>(neighbour);
        if (visit_[to] == round_ || !accept(from, to)) return;
        visit_[to] = round_;
        faces.push_back(to);
      });
    }
    return faces;
  }

  DVec3 corner(std::uint32_t face, int k) const {
    return DVec3(scene_.positions[scene_.triangles[task_.first + face][k]]);
  }
  DVec3 normal_of(std::uint32_t face) const { return DVec3(frame_[face].normal); }

  void try_flat(std::uint32_t seed) {
    const DVec3 normal = normal_of(seed);
    const DVec3 origin = (corner(seed, 0) + corner(seed, 1) + corner(seed, 2)) / 3.0;
    const double flat_cos = std::cos(task_.options.flat_rad), flat_tan = std::tan(task_.options.flat_rad);
    const double reach = std::sqrt(static_cast<double>(frame_[seed].area));
    Faces region = grow(seed, [&](std::uint32_t, std::uint32_t to) {
      if (state_[to] == kDone) return false;
      double off = 0, far = 0;
      for (int k = 0; k < 3; ++k) {
        const DVec3 p = corner(to, k) - origin;
        off = std::max(off, std::abs(glm::dot(p, normal)));
        far = std::max(far, glm::length(p));
      }
      if (off > flat_tan * (far + reach)) return false;
      if (glm::dot(normal_of(to), normal) >= flat_cos) return true;
      // The normal of a sliver tells little: rounding of its corners turns it. Its corners lie in the plane all the
      // same.
      return off <= 1e-6 * (far + reach) && glm::dot(normal_of(to), normal) >= curved_cos_;
    });
    double area = 0;
    for (const std::uint32_t face : region) area += static_cast<double>(frame_[face].area);
    if (area < kFlatTexels * task_.options.texel_m * task_.options.texel_m || continues_smoothly(region, normal)) {
      for (const std::uint32_t face : region) state_[face] = kTried;
      return;
    }
    finish(std::move(region), {{}, true, true});
  }

  // True where along most of the outline a neighbour goes on at nearly the same angle. Of strips that are narrower than
  // texels show a gradient on, as the sides of columns, shading tells instead.
  bool continues_smoothly(const Faces& region, const DVec3& normal) const {
    double outline = 0, smooth = 0, shaded = 0, area = 0;
    for (const std::uint32_t face : region) {
      area += static_cast<double>(frame_[face].area);
      for_neighbours(face, [&](int neighbour, std::uint32_t edge) {
        if (neighbour >= 0 && visit_[static_cast<std::size_t>(neighbour)] == round_) return;
        const double length =
            glm::length(corner(face, static_cast<int>((edge + 1) % 3)) - corner(face, static_cast<int>(edge % 3)));
        outline += length;
        if (neighbour < 0) return;
        const auto to = static_cast<std::uint32_t>(neighbour);
        if (glm::dot(normal_of(to), normal) >= kSmoothCos) smooth += length;
        if (glm::dot(normal_of(to), normal) >= curved_cos_ && shaded_alike(face, to, edge)) shaded += length;
      });
    }
    const bool narrow = 2 * area < kNarrowTexels * task_.options.texel_m * outline;
    return smooth > 0.5 * outline || (narrow && shaded > 0.5 * outline);
  }

  // Whether two faces have the same shading normals at both ends of their common edge.
  bool shaded_alike(std::uint32_t face, std::uint32_t to, std::uint32_t edge) const {
    const UVec3 &a = scene_.triangles[task_.first + face], &b = scene_.triangles[task_.first + to];
    for (const std::uint32_t k : {edge % 3, (edge + 1) % 3}) {
      bool alike = false;
      for (int i = 0; i < 3; ++i)
        alike |= scene_.positions[a[static_cast<int>(k)]] == scene_.positions[b[i]] &&
                 glm::dot(scene_.normals[a[static_cast<int>(k)]], scene_.normals[b[i]]) >= kAlikeCos;
      if (!alike) return false;
    }
    return true;
  }

  DVec3 mean_normal_of(const Faces& faces) const {
    DVec3 sum(0);
    for (const std::uint32_t face : faces) sum += normal_of(face) * static_cast<double>(frame_[face].area);
    const double length = glm::length(sum);
    return length > 0 ? sum / length : DVec3(0, 1, 0);
  }

  Faces grow_within(std::uint32_t seed, const DVec3& axis) {
    return grow(seed, [&](std::uint32_t from, std::uint32_t to) {
      return state_[to] != kDone && glm::dot(normal_of(to), axis) >= curved_cos_ &&
             glm::dot(normal_of(to), normal_of(from)) >= curved_cos_;
    });
  }

  void grow_curved(std::uint32_t seed) {
    if (frame_[seed].area == 0) return finish({seed}, {});
    Faces faces = grow_within(seed, normal_of(seed));
    for (int pass = 0; pass < kRegrowths && faces.size() > 1; ++pass) {
      const DVec3 axis = mean_normal_of(faces);
      if (glm::dot(axis, normal_of(seed)) < curved_cos_) break;
      Faces better = grow_within(seed, axis);
      const bool enough = better.size() <= faces.size() + faces.size() / 8;
      if (better.size() >= faces.size()) faces = std::move(better);
      if (enough) break;
    }
    finish(std::move(faces), {});
  }

  // The side of a box that a face lies on: 2 * axis + (1 where it looks towards the negative end).
  int box_side(std::uint32_t face) const {
    const Vec3& n = frame_[face].normal;
    const Vec3 a = glm::abs(n);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    return 2 * axis + (n[axis] < 0);
  }

  void grow_box_side(std::uint32_t seed) {
    const int side = box_side(seed);
    Faces faces = grow(seed, [&](std::uint32_t, std::uint32_t to) {
      return state_[to] != kDone && frame_[to].area > 0 && box_side(to) == side;
    });
    finish(std::move(faces), {{}, false, false});
  }

  void finish(Faces faces, Region region) {
    for (const std::uint32_t face : faces) state_[face] = kDone;
    region.faces = std::move(faces);
    out_.push_back(std::move(region));
  }

  const ChartTask& task_;
  const Scene& scene_;
  std::span<const std::uint32_t> across_;
  std::span<const FaceFrame> frame_;  // by face
  double curved_cos_;
  std::vector<std::uint32_t> state_, visit_;  // by face; visit_: the last growth that took it
  std::uint32_t round_ = 0;
  std::vector<Region> out_;
};

// Label of each triangle of a patch: 0 or 1, on which side it lies of the plane across the patch's longest direction.
std::vector<std::uint32_t> cut_across(std::span<const Triangle3> corners) {
  DVec3 middle(0);
  std::vector<DVec3> centre;
  for (const Triangle3& t : corners) {
    centre.push_back((t[0] + t[1] + t[2]) / 3.0);
    middle += centre.back() / static_cast<double>(corners.size());
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const DVec3& c : centre) {
    const Eigen::Vector3d d(c.x - middle.x, c.y - middle.y, c.z - middle.z);
    spread += d * d.transpose();
  }
  const Eigen::Vector3d e = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
  const DVec3 direction(e[0], e[1], e[2]);
  std::vector<std::uint32_t> label;
  for (const DVec3& c : centre) label.push_back(glm::dot(c - middle, direction) > 0);
  const auto ones = static_cast<std::size_t>(std::count(label.begin(), label.end(), 1u));
  if (ones == 0 || ones == label.size())  // all in one place
    for (std::size_t i = 0; i < label.size(); ++i) label[i] = i < label.size() / 2;
  return label;
}

// Charts of a connected patch: one where it can be laid flat, else those of its parts.
std::vector<FlatChart> flatten_parts(const ChartTask& task, Patch patch, const FlattenLimits& limits) {
  std::vector<FlatChart> out;
  std::vector<Patch> work;
  work.push_back(std::move(patch));
  while (!work.empty() && !task.context.stopped()) {
    const Patch part = std::move(work.back());
    work.pop_back();
    std::vector<Triangle3> corners;
    corners.reserve(part.size());
    for (const std::uint32_t face : part.faces) corners.push_back(triangle_corners(task.scene, task.first + face));
    FlattenLimits now = limits;
    now.conformal = limits.conformal && !task.options.deadline->passed();
    if (part.size() <= kMaxChartFaces || !now.conformal) {
      if (auto chart = flatten(part, corners, now)) {
        out.push_back(std::move(*chart));
        continue;
      }
    }
    for (Patch& piece : pieces_by_label(part, cut_across(corners))) work.push_back(std::move(piece));
  }
  return out;
}

// Moves charts into a set, their triangles in ascending order.
ChartSet make_set(std::uint32_t first, std::vector<GrownChart>&& charts) {
  ChartSet out;
  std::size_t count = 0;
  for (const GrownChart& chart : charts) count += chart.flat.faces.size();
  out.triangles.reserve(count);
  out.points.reserve(count);
  for (GrownChart& chart : charts) {
    const FlatChart flat = std::move(chart.flat);
    out.charts.push_back(
        {static_cast<std::uint32_t>(out.triangles.size()), static_cast<std::uint32_t>(flat.faces.size()), flat.size});
    std::vector<std::uint32_t> order(flat.faces.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return flat.faces[a] < flat.faces[b]; });
    for (const std::uint32_t i : order) {
      out.triangles.push_back(first + flat.faces[i]);
      out.points.push_back(flat.points[i]);
    }
  }
  return out;
}

// Straightens ragged outlines: a triangle with one neighbour or none in its own region, but two in another, goes there.
// (Nothing is cut off so.) Flat regions stay.
void straighten(const MergeSurface& surface, std::vector<Region>& regions, std::vector<std::uint32_t>& owner) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool changed = false;
    for (std::uint32_t face = 0; face < owner.size(); ++face) {
      const std::uint32_t own = owner[face];
      if (own == kNoRegion || regions[own].exact) continue;
      std::array<std::uint32_t, 3> beside{kNoRegion, kNoRegion, kNoRegion};
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t edge = surface.across[3 * std::size_t{face} + k];
        if (edge != kNoEdge && surface.cosine(face, edge / 3) >= surface.smooth_cos) beside[k] = owner[edge / 3];
      }
      const std::uint32_t most = beside[0] == beside[1] || beside[0] == beside[2] ? beside[0] : beside[1];
      const bool twice = std::count(beside.begin(), beside.end(), most) > 1;
      if (!twice || most == own || most == kNoRegion || regions[most].exact) continue;
      owner[face] = most;
      changed = true;
    }
    if (!changed) break;
  }
  for (Region& region : regions) region.faces.clear();
  for (std::uint32_t face = 0; face < owner.size(); ++face)
    if (owner[face] != kNoRegion) regions[owner[face]].faces.push_back(face);
}

std::vector<GrownChart> flatten_regions(const ChartTask& task, const MergeSurface& surface,
                                        std::vector<Region>& regions, const FlattenLimits& limits) {
  const std::span<const std::uint32_t> across = surface.across;
  std::vector<std::uint32_t> owner(across.size() / 3, kNoRegion), slot(across.size() / 3);
  for (std::uint32_t r = 0; r < regions.size(); ++r)
    for (const std::uint32_t face : regions[r].faces) owner[face] = r;
  straighten(surface, regions, owner);
  std::vector<std::vector<FlatChart>> parts(regions.size());
  // Stopped: what is missing is the caller's to notice.
  (void)parallel_for(task.context, "", regions.size(), [&](std::size_t r) {
    if (regions[r].faces.empty()) return;
    Patch patch = make_patch(std::move(regions[r].faces), across, slot,
                             [&](std::uint32_t face) { return owner[face] == static_cast<std::uint32_t>(r); });
    FlattenLimits own = limits;
    own.conformal = regions[r].conformal;
    if (regions[r].exact) own.box_fill = 0;
    parts[r] = flatten_parts(task, std::move(patch), own);
  });
  std::vector<GrownChart> charts;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (FlatChart& chart : parts[r]) charts.push_back({std::move(chart), regions[r].exact});
  return charts;
}

}  // namespace

ChartSet grow_charts(const Scene& scene, const Surface& surface, const ChartOptions& options, Context& context) {
  if (surface.triangle_count == 0) return {};
  const std::uint32_t first = surface.first_triangle;
  std::vector<std::uint32_t> across = edges_across(build_surface_mesh(scene, surface));
  end_charts(scene, surface, options.demand, across);
  std::vector<FaceFrame> frames(surface.triangle_count);
  for (std::uint32_t i = 0; i < surface.triangle_count; ++i) {
    const TriangleFrame frame = triangle_frame(scene, first + i);
    frames[i] = {Vec3(frame.normal), rounded(frame.area)};
  }
  const ChartTask task{scene, options, context, first};
  std::vector<Region> regions = Grower(task, across, frames).run();
  const FlattenLimits limits{options.texel_m, options.stretch, kLargestStretch, options.large_m2, kBoxFill, true};
  MergeSurface whole;
  whole.across = across;
  whole.corners = [&](std::uint32_t face) { return triangle_corners(scene, first + face); };
  whole.cosine = [&](std::uint32_t a, std::uint32_t b) {
    if (frames[a].area == 0 || frames[b].area == 0) return 1.0;
    return static_cast<double>(glm::dot(frames[a].normal, frames[b].normal));
  };
  whole.smooth_cos = std::cos(options.curved_rad + kSlackRad);
  whole.tiny_area = kTinyTexels * options.texel_m * options.texel_m;
  whole.expired = [&] { return options.deadline->passed(); };
  whole.largest_area = options.merged_area_m2;
  std::vector<GrownChart> charts = flatten_regions(task, whole, regions, limits);
  merge_charts(whole, limits, context, charts);
  return make_set(first, std::move(charts));
}

}  // namespace oriel
