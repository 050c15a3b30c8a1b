#include "study/herf1997/occluder_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace oriel::study {
namespace {

// Nearer to its own height than this share, a point is seen no place that matters: as far off as 2^20 times its
// distance from the apex.
constexpr double kLeastHeight = 0x1p-20;

struct Box {
  DVec3 lower, upper;
};

// Interval arithmetic of seen_at along one axis: whether a box between plane and light is seen in [0, size].
bool may_be_seen(const Box& box, const Box& light, int axis, double size) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const double near = std::max(box.lower.z, 0.0), far = box.upper.z;
  const double least = near / (light.upper.z - near);
  const double most = far < light.lower.z ? far / (light.lower.z - far) : kFar;
  const auto times = [](double d, double f) { return d == 0 ? 0 : d * f; };
  const double d0 = box.lower[axis] - light.upper[axis], d1 = box.upper[axis] - light.lower[axis];
  return box.upper[axis] + std::max(times(d1, least), times(d1, most)) >= 0 &&
         box.lower[axis] + std::min(times(d0, least), times(d0, most)) <= size;
}

class OccluderViewer {
 public:
  OccluderViewer(const Occluders& occluders, const ShadowReceiver& receiver, double touching)
      : in_(occluders), receiver_(receiver), space_(receiver), touching_(touching) {}

  OccluderView run(const ShadowLight& light) {
    const double inf = std::numeric_limits<double>::infinity();
    light_ = {DVec3(inf), DVec3(-inf)};
    for (std::uint32_t s = 0; s < light.samples.size(); ++s) {
      const DVec3 apex = space_(light.samples[s].position);
      if (!(apex.z > touching_)) continue;
      out_.apexes.push_back(apex), out_.apex_of.push_back(s);
      light_.lower = min(light_.lower, apex), light_.upper = max(light_.upper, apex);
    }
    if (out_.apexes.empty() || in_.nodes.empty()) return std::move(out_);
    lamp_normal_ = light.normal, lamp_point_ = light.samples.front().position;
    one_side_.resize(in_.parts.size(), -1);
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const OccluderNode& node = in_.nodes[open.back()];
      open.pop_back();
      if (!may_shadow(box_of(node.lower, node.upper))) continue;
      if (node.left == 0)
        for (std::uint32_t f = 0; f < node.count; ++f) add(in_.faces[node.first + f]);
      else
        open.insert(open.end(), {node.left + 1, node.left});
    }
    return std::move(out_);
  }

 private:
  // A box of the world in receiver space, with all of it in it.
  Box box_of(const DVec3& lower, const DVec3& upper) const {
    const DVec3 half = 0.5 * (upper - lower), middle = space_(0.5 * (lower + upper));
    DVec3 reach(0);
    for (int k = 0; k < 3; ++k) reach += abs(space_.linear[k]) * half[k];
    return {middle - reach, middle + reach};
  }

  bool may_shadow(const Box& box) {
    ++out_.tested;
    return box.upper.z > touching_ && box.lower.z < light_.upper.z && may_be_seen(box, light_, 0, receiver_.width) &&
           may_be_seen(box, light_, 1, receiver_.height);
  }

  // Rays from the receiver to the light meet as many fronts as backs where neither is inside.
  bool casts_by_one_side(std::uint32_t p) {
    if (one_side_[p] >= 0) return one_side_[p] == 1;
    const OccluderPart& part = in_.parts[p];
    const Box box = box_of(part.lower, part.upper);
    const bool apart =
        glm::any(glm::lessThan(box.upper, light_.lower)) || glm::any(glm::lessThan(light_.upper, box.lower));
    one_side_[p] = part.closed && box.lower.z > touching_ && apart;
    return one_side_[p] == 1;
  }

  std::uint32_t add_point(const DVec3& p) {
    out_.points.push_back(p);
    return static_cast<std::uint32_t>(out_.points.size() - 1);
  }

  std::uint32_t point(std::uint32_t p) {
    const auto [it, is_new] = point_of_.try_emplace(p, 0);
    if (is_new) {
      DVec3 q = space_(in_.points[p]);
      if (std::abs(q.z) <= touching_) q.z = 0;
      it->second = add_point(q);
    }
    return it->second;
  }

  // Where the edge of two points, one of them behind, meets the plane: the same for both faces of the edge.
  std::uint32_t cut(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [it, is_new] = cut_of_.try_emplace(std::uint64_t{a} << 32 | b, 0);
    if (is_new) {
      const DVec3 p = out_.points[a], q = out_.points[b];
      it->second = add_point(DVec3(DVec2(p) + (DVec2(q) - DVec2(p)) * (p.z / (p.z - q.z)), 0));
    }
    return it->second;
  }

  // No ray to the lamp crosses what lies in its plane, as the lamp itself does.
  bool in_lamp_plane(const OccluderFace& face) const {
    return std::ranges::all_of(face.points, [&](std::uint32_t p) {
      return std::abs(glm::dot(lamp_normal_, in_.points[p] - lamp_point_)) <= touching_;
    });
  }

  void add(const OccluderFace& face) {
    std::array<std::uint32_t, 3> p{};
    std::array<DVec3, 3> at{};
    for (int k = 0; k < 3; ++k) p[k] = point(face.points[k]), at[k] = out_.points[p[k]];
    if (!may_shadow({min(min(at[0], at[1]), at[2]), max(max(at[0], at[1]), at[2])})) return;
    if (at[0].z == 0 && at[1].z == 0 && at[2].z == 0) return;
    if (in_lamp_plane(face)) return;
    std::array<std::uint32_t, 4> corners{};
    std::size_t n = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = p[k], b = p[(k + 1) % 3];
      const double ha = at[k].z, hb = at[(k + 1) % 3].z;
      if (ha >= 0) corners[n++] = a;
      if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) corners[n++] = cut(a, b);
    }
    for (std::size_t k = 2; k < n; ++k) add_triangle({corners[0], corners[k - 1], corners[k]}, face.part);
  }

  void add_triangle(const std::array<std::uint32_t, 3>& p, std::uint32_t part) {
    const std::array<DVec3, 3> at{out_.points[p[0]], out_.points[p[1]], out_.points[p[2]]};
    const double top = std::max({at[0].z, at[1].z, at[2].z});
    if (!(top > 0)) return;
    if (top >= light_.lower.z * (1 - kLeastHeight)) {
      out_.beside_light.push_back(at);
      return;
    }
    ViewFace face{.points = p, .edges = {}, .part = part, .one_side = casts_by_one_side(part)};
    for (int k = 0; k < 3; ++k) face.edges[k] = edge(p[k], p[(k + 1) % 3]);
    out_.faces.push_back(face);
  }

  std::uint32_t edge(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto face = static_cast<std::uint32_t>(out_.faces.size());
    auto [it, is_new] = edge_of_.try_emplace(std::uint64_t{a} << 32 | b, 0);
    if (!is_new && out_.edges[it->second].faces[1] == kNoFace) {
      out_.edges[it->second].faces[1] = face;
    } else {
      it->second = static_cast<std::uint32_t>(out_.edges.size());
      out_.edges.push_back({a, b, {face, kNoFace}});
    }
    return it->second;
  }

  const Occluders& in_;
  const ShadowReceiver& receiver_;
  ReceiverSpace space_;
  double touching_;
  Box light_{};
  DVec3 lamp_normal_{0}, lamp_point_{0};
  std::vector<std::int8_t> one_side_;  // by part; -1: not yet asked
  std::unordered_map<std::uint32_t, std::uint32_t> point_of_;
  std::unordered_map<std::uint64_t, std::uint32_t> cut_of_, edge_of_;
  OccluderView out_;
};

}  // namespace

OccluderView view_occluders(const Occluders& occluders, const ShadowReceiver& receiver, const ShadowLight& light,
                            double touching) {
  return OccluderViewer(occluders, receiver, touching).run(light);
}

std::vector<std::array<DVec2, 3>> cut_at_light(const DVec3& apex, const std::array<DVec3, 3>& triangle) {
  const double most = apex.z * (1 - kLeastHeight);
  std::array<DVec2, 4> corners{};
  std::size_t n = 0;
  for (int k = 0; k < 3; ++k) {
    const DVec3 &a = triangle[k], &b = triangle[(k + 1) % 3];
    if (a.z <= most) corners[n++] = seen_at(apex, a);
    if ((a.z < most && b.z > most) || (a.z > most && b.z < most)) {
      // The lower end first, so that both faces of an edge are cut at the same place.
      const DVec3 &p = a.z < b.z ? a : b, &q = a.z < b.z ? b : a;
      const DVec2 at = DVec2(p) + (DVec2(q) - DVec2(p)) * ((most - p.z) / (q.z - p.z));
      corners[n++] = seen_at(apex, DVec3(at, most));
    }
  }
  std::vector<std::array<DVec2, 3>> fan;
  for (std::size_t k = 2; k < n; ++k) fan.push_back({corners[0], corners[k - 1], corners[k]});
  return fan;
}

}  // namespace oriel::study
