#include "bake/atlas/charts.h"

#include <algorithm>
#include <numeric>

#include "bake/atlas/flatten.h"
#include "bake/atlas/surface_mesh.h"

namespace oriel {
namespace {

constexpr double kFlatTexels = 64;   // a flat region of less area (texels²) may join its neighbours
constexpr double kSmoothFactor = 4;  // a neighbour within so many flat angles continues a surface smoothly
constexpr int kRegrowths = 4;        // of a curved chart, around the mean normal found so far, while it helps
constexpr std::uint32_t kFree = 0, kTried = 1, kDone = 2;  // a face: free; no seed of a flat region; in a chart

class Grower {
 public:
  Grower(const Scene& scene, const Surface& surface, const AtlasOptions& options, double texel_m,
         const Context& context)
      : scene_(scene),
        context_(context),
        first_(surface.first_triangle),
        texel_m_(texel_m),
        mesh_(build_surface_mesh(scene, surface)) {
    flat_rad_ = glm::radians(static_cast<double>(options.flat_angle_deg));
    curved_cos_ = std::cos(glm::radians(static_cast<double>(options.curved_angle_deg)));
    frame_.reserve(surface.triangle_count);
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) frame_.push_back(triangle_frame(scene, first_ + i));
    state_.assign(surface.triangle_count, kFree);
    visit_.assign(surface.triangle_count, 0);
    member_.assign(surface.triangle_count, false);
    edge_index_.resize(mesh_.n_halfedges());
    seeds_.resize(surface.triangle_count);
    std::iota(seeds_.begin(), seeds_.end(), 0u);
    std::stable_sort(seeds_.begin(), seeds_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return frame_[a].area > frame_[b].area; });
  }

  ChartSet run() {
    for (const std::uint32_t seed : seeds_)
      if (!context_.stopped() && state_[seed] == kFree && frame_[seed].area > 0) try_flat(seed);
    for (const std::uint32_t seed : seeds_)
      if (!context_.stopped() && state_[seed] != kDone) grow_curved(seed);
    return std::move(out_);
  }

 private:
  using Faces = std::vector<std::uint32_t>;

  // Calls visit(neighbour or -1, halfedge) for the three edges of a face.
  template <class Visit>
  void for_neighbours(std::uint32_t face, Visit&& visit) const {
    auto halfedge = mesh_.halfedge_handle(SurfaceMesh::FaceHandle(static_cast<int>(face)));
    for (int k = 0; k < 3; ++k, halfedge = mesh_.next_halfedge_handle(halfedge))
      visit(mesh_.opposite_face_handle(halfedge).idx(), halfedge);
  }

  // Faces reached from the seed through accepted ones, in order of distance (in steps).
  template <class Accept>
  Faces grow(std::uint32_t seed, Accept&& accept) {
    ++round_;
    Faces faces{seed};
    visit_[seed] = round_;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const std::uint32_t from = faces[i];
      for_neighbours(from, [&](int neighbour, SurfaceMesh::HalfedgeHandle) {
        if (neighbour < 0) return;
        const auto to = static_cast<std::uint32_t>(neighbour);
        if (visit_[to] == round_ || !accept(from, to)) return;
        visit_[to] = round_;
        faces.push_back(to);
      });
    }
    return faces;
  }

  bool is_member(int face) const { return face >= 0 && member_[static_cast<std::size_t>(face)]; }

  DVec3 corner(std::uint32_t face, int k) const { return DVec3(scene_.positions[scene_.triangles[first_ + face][k]]); }

  void try_flat(std::uint32_t seed) {
    const DVec3 normal = frame_[seed].normal;
    const DVec3 origin = (corner(seed, 0) + corner(seed, 1) + corner(seed, 2)) / 3.0;
    const double flat_cos = std::cos(flat_rad_), flat_tan = std::tan(flat_rad_);
    const double reach = std::sqrt(frame_[seed].area);
    const Faces region = grow(seed, [&](std::uint32_t, std::uint32_t to) {
      if (state_[to] == kDone) return false;
      double off = 0, far = 0;
      for (int k = 0; k < 3; ++k) {
        const DVec3 p = corner(to, k) - origin;
        off = std::max(off, std::abs(glm::dot(p, normal)));
        far = std::max(far, glm::length(p));
      }
      if (off > flat_tan * (far + reach)) return false;
      if (glm::dot(frame_[to].normal, normal) >= flat_cos) return true;
      // The normal of a sliver tells little: rounding of its corners turns it. Its corners lie in the plane all the
      // same.
      return off <= 1e-6 * (far + reach) && glm::dot(frame_[to].normal, normal) >= curved_cos_;
    });
    double area = 0;
    for (const std::uint32_t face : region) area += frame_[face].area;
    if (area < kFlatTexels * texel_m_ * texel_m_ || continues_smoothly(region, normal)) {
      for (const std::uint32_t face : region) state_[face] = kTried;
      return;
    }
    finish(region);
  }

  // True where along most of the outline a neighbour goes on at nearly the same angle.
  bool continues_smoothly(const Faces& region, const DVec3& normal) const {
    const double smooth_cos = std::cos(std::min(kSmoothFactor * flat_rad_, kPiD / 4));
    double outline = 0, smooth = 0;
    for (const std::uint32_t face : region) {
      for_neighbours(face, [&](int neighbour, SurfaceMesh::HalfedgeHandle edge) {
        if (neighbour >= 0 && visit_[static_cast<std::size_t>(neighbour)] == round_) return;
        const double length = mesh_.calc_edge_length(edge);
        outline += length;
        if (neighbour >= 0 && glm::dot(frame_[static_cast<std::size_t>(neighbour)].normal, normal) >= smooth_cos)
          smooth += length;
      });
    }
    return smooth > 0.5 * outline;
  }

  DVec3 mean_normal(const Faces& faces) const {
    DVec3 sum(0);
    for (const std::uint32_t face : faces) sum += frame_[face].normal * frame_[face].area;
    const double length = glm::length(sum);
    return length > 0 ? sum / length : DVec3(0, 1, 0);
  }

  Faces grow_within(std::uint32_t seed, const DVec3& axis) {
    return grow(seed, [&](std::uint32_t from, std::uint32_t to) {
      return state_[to] != kDone && glm::dot(frame_[to].normal, axis) >= curved_cos_ &&
             glm::dot(frame_[to].normal, frame_[from].normal) >= curved_cos_;
    });
  }

  void grow_curved(std::uint32_t seed) {
    if (frame_[seed].area == 0) return finish({seed});
    Faces faces = grow_within(seed, frame_[seed].normal);
    for (int pass = 0; pass < kRegrowths && faces.size() > 1; ++pass) {
      const DVec3 axis = mean_normal(faces);
      if (glm::dot(axis, frame_[seed].normal) < curved_cos_) break;
      Faces better = grow_within(seed, axis);
      const bool enough = better.size() <= faces.size() + faces.size() / 8;
      if (better.size() >= faces.size()) faces = std::move(better);
      if (enough) break;
    }
    finish(faces);
  }

  // Makes charts of connected faces: one where it does not overlap itself, else of its halves.
  void finish(const Faces& faces) {
    for (const std::uint32_t face : faces) state_[face] = kDone;
    std::vector<Faces> work{faces};
    while (!work.empty() && !context_.stopped()) {
      const Faces part = std::move(work.back());
      work.pop_back();
      if (emit(part)) continue;
      const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
      Faces tail(middle, part.end());
      work.emplace_back(part.begin(), middle);  // connected: it is where the growth began
      for (Faces& piece : connected_pieces(tail)) work.push_back(std::move(piece));
    }
  }

  std::vector<Faces> connected_pieces(const Faces& faces) {
    std::vector<Faces> pieces;
    for (const std::uint32_t face : faces) member_[face] = true;
    for (const std::uint32_t face : faces) {
      if (!member_[face]) continue;
      pieces.push_back(grow(face, [&](std::uint32_t, std::uint32_t to) { return static_cast<bool>(member_[to]); }));
      for (const std::uint32_t done : pieces.back()) member_[done] = false;
    }
    return pieces;
  }

  // The quick way to know that a chart does not overlap itself: from its outline alone. `sorted`: scene triangles.
  bool has_simple_outline(const Faces& sorted, const std::vector<Triangle2>& points) {
    for (const Triangle2& t : points)
      if (signed_area(t) < 0) return false;
    for (const std::uint32_t t : sorted) member_[t - first_] = true;
    std::vector<SurfaceMesh::HalfedgeHandle> outline;
    std::vector<OutlineEdge> edges;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      for_neighbours(sorted[i] - first_, [&](int neighbour, SurfaceMesh::HalfedgeHandle edge) {
        if (is_member(neighbour)) return;
        const SurfaceMesh::Point& start = mesh_.point(mesh_.from_vertex_handle(edge));
        std::size_t k = 0;
        while (k < 2 && corner(sorted[i] - first_, static_cast<int>(k)) != DVec3(start[0], start[1], start[2])) ++k;
        edge_index_[static_cast<std::size_t>(edge.idx())] = static_cast<std::uint32_t>(edges.size());
        outline.push_back(edge);
        edges.push_back({points[i][k], points[i][(k + 1) % 3], 0});
      });
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      auto next = mesh_.next_halfedge_handle(outline[i]);  // turn around its end until the outline goes on
      while (is_member(mesh_.opposite_face_handle(next).idx()))
        next = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(next));
      edges[i].next = edge_index_[static_cast<std::size_t>(next.idx())];
    }
    for (const std::uint32_t t : sorted) member_[t - first_] = false;
    return is_simple_outline(edges);
  }

  // Appends a chart; false (and nothing appended) where it would fold or overlap itself.
  bool emit(const Faces& faces) {
    const DVec3 axis = mean_normal(faces);
    if (faces.size() > 1)
      for (const std::uint32_t face : faces)
        if (frame_[face].area > 0 && !(glm::dot(frame_[face].normal, axis) > 0.2)) return false;
    Faces sorted = faces;
    std::sort(sorted.begin(), sorted.end());
    for (std::uint32_t& face : sorted) face += first_;
    std::vector<Triangle2> points(sorted.size());
    const DVec2 size = flatten(scene_, sorted, axis, points);
    if (faces.size() > 2 && !has_simple_outline(sorted, points)) {  // two triangles that share an edge cannot overlap
      const double length = std::max(size.x, size.y);
      const OverlapTolerance tolerance{1e-4 * texel_m_ * texel_m_, std::max(1e-6 * length, 1e-3 * texel_m_)};
      if (find_overlap(points, tolerance)) return false;
    }
    Chart chart;
    chart.first = static_cast<std::uint32_t>(out_.triangles.size());
    chart.count = static_cast<std::uint32_t>(sorted.size());
    chart.size = size;
    out_.charts.push_back(chart);
    out_.triangles.insert(out_.triangles.end(), sorted.begin(), sorted.end());
    out_.points.insert(out_.points.end(), points.begin(), points.end());
    return true;
  }

  const Scene& scene_;
  const Context& context_;
  std::uint32_t first_;
  double texel_m_, flat_rad_ = 0, curved_cos_ = 0;
  SurfaceMesh mesh_;
  std::vector<TriangleFrame> frame_;          // by face
  std::vector<std::uint32_t> seeds_, state_;  // state_: by face
  std::vector<std::uint32_t> visit_;          // by face: the last growth that took it
  std::uint32_t round_ = 0;
  std::vector<bool> member_;               // by face: of the set at hand (all false between uses)
  std::vector<std::uint32_t> edge_index_;  // by halfedge, of the outline at hand
  ChartSet out_;
};

}  // namespace

ChartSet grow_charts(const Scene& scene, const Surface& surface, const AtlasOptions& options, double texel_m,
                     const Context& context) {
  if (surface.triangle_count == 0) return {};
  return Grower(scene, surface, options, texel_m, context).run();
}

}  // namespace oriel
