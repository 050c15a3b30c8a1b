#include "bake/radiosity/shadow_casters.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "bake/scene/shade.h"

namespace oriel {
namespace {

constexpr std::size_t kLeaf = 4;  // triangles

// An edge by its ends' places, so that vertices with several normals are one.
struct PlacedEdge {
  std::array<Vec3, 2> ends;
  std::uint32_t triangle = 0;
  std::uint8_t edge = 0;
  bool turned = false;  // of the triangle's own direction

  auto key() const {
    std::array<std::uint32_t, 6> bits;
    std::memcpy(bits.data(), ends.data(), sizeof bits);
    return bits;
  }
};

bool comes_before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

ShadowCasters::ShadowCasters(const Scene& scene, std::span<const std::uint32_t> lights) {
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const UVec3& v = scene.triangles[t];
    triangles_.push_back({DVec3(scene.positions[v.x]), DVec3(scene.positions[v.y]), DVec3(scene.positions[v.z])});
    const SceneMaterial& material = scene.material_of(t);
    filters_.push_back(may_transmit(material));
    patterned_.push_back(filters_.back() && (!scene.colors.empty() ||
                                             std::ranges::any_of(texture_slots(material), [](const TextureSlot* slot) {
                                               return slot->image >= 0;
                                             })));
    const bool doubled = !scene.twin.empty() && scene.twin[t] < t;
    if (!material.unlit && !doubled) order_.push_back(t);
  }
  join_edges(scene);
  find_bodies();
  for (const std::uint32_t light : lights) look_from(scene.lights[light], kLevel * double{scene.radius()});
  if (!order_.empty()) add_node(0, order_.size());
}

void ShadowCasters::join_edges(const Scene& scene) {
  std::vector<PlacedEdge> edges;
  for (const std::uint32_t t : order_)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const Vec3 a = scene.positions[scene.triangles[t][k]] + 0.0f,
                 b = scene.positions[scene.triangles[t][(k + 1) % 3]] + 0.0f;
      const bool turned = comes_before(b, a);
      edges.push_back({turned ? std::array{b, a} : std::array{a, b}, t, k, turned});
    }
  std::ranges::sort(edges, [](const PlacedEdge& a, const PlacedEdge& b) {
    return std::tuple(a.key(), a.triangle, a.edge) < std::tuple(b.key(), b.triangle, b.edge);
  });
  beyond_.assign(3 * triangles_.size(), ~0u), alike_.resize(3 * triangles_.size());
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next].key() == edges[i].key()) ++next;
    if (next - i != 2) continue;
    const PlacedEdge &a = edges[i], &b = edges[i + 1];
    beyond_[3 * std::size_t{a.triangle} + a.edge] = b.triangle,
                                          beyond_[3 * std::size_t{b.triangle} + b.edge] = a.triangle;
    alike_[3 * std::size_t{a.triangle} + a.edge] = alike_[3 * std::size_t{b.triangle} + b.edge] = a.turned != b.turned;
  }
}

// Opaque surfaces without an open edge, and wound alike all over.
void ShadowCasters::find_bodies() {
  body_.assign(triangles_.size(), ~0u);
  std::vector<std::uint32_t> of(triangles_.size(), ~0u), open;
  for (const std::uint32_t first : order_) {
    if (of[first] != ~0u) continue;
    const auto number = static_cast<std::uint32_t>(volume_.size());
    bool closed = true;
    double volume = 0;
    std::vector<std::uint32_t> body;
    of[first] = number, open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back(), body.push_back(t);
      const auto& [a, b, c] = triangles_[t];
      volume += glm::dot(a - triangles_[first][0], glm::cross(b - triangles_[first][0], c - triangles_[first][0]));
      closed = closed && !filters_[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = beyond_[3 * std::size_t{t} + k];
        closed = closed && next != ~0u && alike_[3 * std::size_t{t} + k];
        if (next != ~0u && of[next] == ~0u) of[next] = number, open.push_back(next);
      }
    }
    if (closed && volume != 0)
      for (const std::uint32_t t : body) body_[t] = number;
    volume_.push_back(volume);
  }
}

void ShadowCasters::look_from(const Light& light, double level) {
  const bool sun = light.type == LightType::kDirectional;
  const DVec3 place(sun ? -light.direction : light.position);
  // How often each body winds about a lamp, times 2π, by solid angles (Van Oosterom and Strackee 1983).
  std::vector<double> about(volume_.size());
  for (std::uint32_t t = 0; !sun && t < triangles_.size(); ++t) {
    if (body_[t] == ~0u) continue;
    const DVec3 a = triangles_[t][0] - place, b = triangles_[t][1] - place, c = triangles_[t][2] - place;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    about[body_[t]] += std::atan2(glm::dot(a, glm::cross(b, c)),
                                  la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  std::vector<bool>&spared = spared_.emplace_back(triangles_.size()), &front = fronts_.emplace_back(triangles_.size());
  for (const std::uint32_t t : order_) {
    const auto& [a, b, c] = triangles_[t];
    const DVec3 normal = glm::cross(b - a, c - a), way = sun ? place : place - a;
    const double faces = glm::dot(normal, way), size = glm::length(normal),
                 longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}),
                 width = 0x1p-22 * (longest + std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}));
    // What is edge-on, by a few roundings of float, shows nothing of itself: a shadow ends with its neighbour, which
    // faces the lamp.
    const bool outwards = body_[t] == ~0u || volume_[body_[t]] > 0;
    front[t] = faces > (outwards ? width : -width) * longest * glm::length(way);
    // A lamp on a wall is in its plane, by rounding before or behind it: neither casts a shadow.
    spared[t] = !sun && std::abs(faces) <= level * size;
    if (body_[t] != ~0u && std::abs(about[body_[t]]) <= 1) spared[t] = spared[t] || front[t] != outwards;
  }
}

// Halves by the longest side of the boxes' middles.
void ShadowCasters::add_node(std::size_t first, std::size_t count) {
  const std::size_t at = nodes_.size();
  nodes_.push_back({{}, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)});
  TreeBox middles;
  const auto middle = [&](std::uint32_t t) { return triangles_[t][0] + triangles_[t][1] + triangles_[t][2]; };
  const auto own = std::span(order_).subspan(first, count);
  for (const std::uint32_t t : own) {
    for (const DVec3& corner : triangles_[t]) nodes_[at].box.add(corner);
    middles.add(middle(t));
  }
  if (count <= kLeaf) return;
  const DVec3 size = middles.upper - middles.lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::ranges::nth_element(
      own, own.begin() + static_cast<std::ptrdiff_t>(count / 2),
      [&](std::uint32_t a, std::uint32_t b) { return std::pair(middle(a)[axis], a) < std::pair(middle(b)[axis], b); });
  nodes_[at].count = 0;
  add_node(first, count / 2);
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  add_node(first + count / 2, count - count / 2);
}

std::vector<std::uint32_t> ShadowCasters::in(const ShadowBeam& beam, std::size_t lamp) const {
  std::vector<std::uint32_t> found, open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    const Node& node = nodes_[at];
    if (!beam.may_meet(node.box)) continue;
    if (node.count == 0) {
      open.push_back(node.first), open.push_back(at + 1);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      if (!spared_[lamp][order_[i]] && beam.may_meet(triangles_[order_[i]])) found.push_back(order_[i]);
  }
  std::ranges::sort(found);
  return found;
}

bool ShadowCasters::ends_shadow(std::uint32_t t, std::size_t k, std::size_t lamp) const {
  const std::uint32_t other = beyond_[3 * std::size_t{t} + k];
  if (other == ~0u || filters_[t] != filters_[other]) return true;
  return (fronts_[lamp][t] == fronts_[lamp][other]) != alike_[3 * std::size_t{t} + k];
}

bool ShadowCasters::stop_all(const ShadowBeam& beam, std::span<const std::uint32_t> triangles, std::size_t lamp) const {
  std::vector<bool> seen(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!seen[i] && beam.is_met_midway(triangles_[triangles[i]]) && is_sheet(beam, triangles, triangles[i], lamp, seen))
      return true;
  return false;
}

bool ShadowCasters::is_sheet(const ShadowBeam& beam, std::span<const std::uint32_t> all, std::uint32_t first,
                             std::size_t lamp, std::vector<bool>& seen) const {
  std::vector<std::uint32_t> open;
  const auto add = [&](std::uint32_t t) {
    const auto at = std::ranges::lower_bound(all, t);
    if (at == all.end() || *at != t) return false;
    if (!seen[static_cast<std::size_t>(at - all.begin())]) open.push_back(t);
    seen[static_cast<std::size_t>(at - all.begin())] = true;
    return true;
  };
  add(first);
  while (!open.empty()) {
    const std::uint32_t t = open.back();
    open.pop_back();
    if (filters_[t] || beam.is_cut_by(triangles_[t])) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const DVec3 &a = triangles_[t][k], &b = triangles_[t][(k + 1) % 3];
      if (!beam.may_meet(a, b)) continue;
      if (ends_shadow(t, k, lamp) || beam.in_plane(a, b) || !add(beyond_[3 * std::size_t{t} + k])) return false;
    }
  }
  return true;
}

}  // namespace oriel
