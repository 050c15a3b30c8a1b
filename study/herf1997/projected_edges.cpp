#include "study/herf1997/projected_edges.h"

namespace oriel::study {
namespace {

struct Apexes {
  std::array<double, kLanes> x{}, y{}, z{};
};

[[gnu::always_inline]] inline void project_all(const OccluderView& view, const Apexes& apex, int height,
                                               ProjectedEdges& out) {
  for (std::size_t p = 0; p < view.points.size(); ++p) {
    const double px = view.points[p].x, py = view.points[p].y, pz = view.points[p].z;
    for (int i = 0; i < kLanes; ++i) {
      const double w = apex.z[i] - pz;
      out.x[p][i] = (px * apex.z[i] - apex.x[i] * pz) / w;
      out.y[p][i] = (py * apex.z[i] - apex.y[i] * pz) / w;
    }
  }
  for (std::size_t e = 0; e < view.edges.size(); ++e) {
    const auto &ax = out.x[view.edges[e].a], &ay = out.y[view.edges[e].a];
    const auto &bx = out.x[view.edges[e].b], &by = out.y[view.edges[e].b];
    EdgeLanes& edge = out.edges[e];
    for (int i = 0; i < kLanes; ++i) {
      const FixedEdge fixed = fixed_edge(ax[i], ay[i], bx[i], by[i], height);
      edge.x[i] = fixed.x, edge.step[i] = fixed.step;
      edge.first[i] = fixed.first, edge.last[i] = fixed.last;
    }
  }
  for (std::size_t f = 0; f < view.faces.size(); ++f) {
    const auto& p = view.faces[f].points;
    const auto &ax = out.x[p[0]], &ay = out.y[p[0]], &bx = out.x[p[1]], &by = out.y[p[1]];
    const auto &cx = out.x[p[2]], &cy = out.y[p[2]];
    for (int i = 0; i < kLanes; ++i) {
      const double area = (bx[i] - ax[i]) * (cy[i] - ay[i]) - (cx[i] - ax[i]) * (by[i] - ay[i]);
      out.sides[f][i] = static_cast<std::int8_t>((area > 0) - (area < 0));
    }
  }
}

void project_baseline(const OccluderView& view, const Apexes& apex, int height, ProjectedEdges& out) {
  project_all(view, apex, height, out);
}
[[gnu::target("avx2")]] void project_avx2(const OccluderView& view, const Apexes& apex, int height,
                                          ProjectedEdges& out) {
  project_all(view, apex, height, out);
}
[[gnu::target("avx2,avx512f,avx512dq,avx512bw,avx512vl")]] void project_avx512(const OccluderView& view,
                                                                               const Apexes& apex, int height,
                                                                               ProjectedEdges& out) {
  project_all(view, apex, height, out);
}

}  // namespace

void ProjectedEdges::project(const OccluderView& view, int first, int height, Simd simd) {
  x.resize(view.points.size()), y.resize(view.points.size());
  edges.resize(view.edges.size()), sides.resize(view.faces.size());
  Apexes apex;
  for (int i = 0; i < kLanes; ++i) {
    const DVec3& a = view.apexes[std::min<std::size_t>(static_cast<std::size_t>(first + i), view.apexes.size() - 1)];
    apex.x[i] = a.x, apex.y[i] = a.y, apex.z[i] = a.z;
  }
  if (simd == Simd::kAvx512) return project_avx512(view, apex, height, *this);
  if (simd == Simd::kAvx2) return project_avx2(view, apex, height, *this);
  project_baseline(view, apex, height, *this);
}

std::vector<FaceEdges> edges_beside_light(const OccluderView& view, const DVec3& apex, int height) {
  std::vector<FaceEdges> out;
  for (const auto& triangle : view.beside_light)
    for (const auto& t : cut_at_light(apex, triangle))
      out.push_back({fixed_edge(t[0].x, t[0].y, t[1].x, t[1].y, height),
                     fixed_edge(t[1].x, t[1].y, t[2].x, t[2].y, height),
                     fixed_edge(t[2].x, t[2].y, t[0].x, t[0].y, height)});
  return out;
}

}  // namespace oriel::study
