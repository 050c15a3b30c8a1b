#include "bake/radiosity/texels/neighbours.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "bake/scene/box_tree.h"

namespace oriel {
namespace {

constexpr float kSameNormal = 0.9f;  // cosine
constexpr float kSamePlane = 0.25f;  // of the distance
constexpr float kReach = 1.6f;       // sides of a square texel: a diagonal and a little
constexpr float kLift = 0.1f;        // texels above the surface at which neighbours must see each other

struct Candidate {
  std::uint32_t a, b;  // a < b
};

class NeighbourFinder {
 public:
  NeighbourFinder(const Transport& t, const Texels& texels) : t_(t), texels_(texels) {
    position_.resize(texels.count());
    size_.resize(texels.count());
    for (std::size_t i = 0; i < texels.count(); ++i) {
      Vec3 sum(0);
      for (const SamplePoint& point : texels.sample_points[i]) sum += point.origin;
      position_[i] = sum / static_cast<float>(kSamplePoints);
      size_[i] = std::sqrt(texels.area_m2[i]);
    }
    // Partly covered texels are smaller than the grid: neighbours stand a whole texel apart.
    std::vector<float> of_chart(texels.chart.empty() ? 0 : *std::ranges::max_element(texels.chart) + 1, 0.0f);
    for (std::size_t i = 0; i < texels.count(); ++i)
      of_chart[texels.chart[i]] = std::max(of_chart[texels.chart[i]], size_[i]);
    for (std::size_t i = 0; i < texels.count(); ++i) size_[i] = of_chart[texels.chart[i]];
    find_reach(of_chart);
    fill_rims();
  }

  // Pairs that begin at texel a, nearest first.
  std::vector<Candidate> candidates(std::uint32_t a) const {
    std::vector<std::pair<float, std::uint32_t>> found;
    if (texels_.visible[a] == 0) return {};
    int on_page = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::uint32_t b =
            texels_.at(texels_.page[a], static_cast<int>(texels_.x[a]) + dx, static_cast<int>(texels_.y[a]) + dy);
        if (b == kNoTexel || texels_.chart[b] != texels_.chart[a] || !continues(a, b)) continue;
        ++on_page;
        found.emplace_back(distance2(a, b), b);
      }
    if (on_page < kMaxNeighbours) add_from_world(a, found);
    std::sort(found.begin(), found.end());
    if (found.size() > kMaxNeighbours) found.resize(kMaxNeighbours);
    std::vector<Candidate> pairs;
    for (const auto& [d, b] : found) pairs.push_back({a, b});
    return pairs;
  }

  // A segment just above the surface, to be found free. Between charts it stays below what is closer over either: the
  // inside of a flat lamp's body faces as the ceiling over it does, but is no part of the room.
  Ray bridge(const Candidate& c) const {
    const bool across = texels_.chart[c.a] != texels_.chart[c.b];
    const Vec3 from = lifted(c.a, across), to = lifted(c.b, across);
    const float length = std::sqrt(length2(to - from));
    return {from, length > 0 ? (to - from) / length : Vec3(0, 0, 1), length};
  }

 private:
  const Vec3& normal(std::uint32_t i) const { return texels_.sample_points[i][0].geometric_normal; }
  Vec3 lifted(std::uint32_t i, bool below_others) const {
    float lift = kLift * size_[i];
    if (below_others)
      if (const Hit hit = t_.accel.intersect({texels_.sample_points[i][0].origin, normal(i), lift}))
        lift = 0.5f * hit.distance;
    return position_[i] + normal(i) * lift;
  }
  float distance2(std::uint32_t a, std::uint32_t b) const { return length2(position_[b] - position_[a]); }

  bool continues(std::uint32_t a, std::uint32_t b) const {
    if (texels_.visible[b] == 0 || glm::dot(normal(a), normal(b)) < kSameNormal) return false;
    const Vec3 between = position_[b] - position_[a];
    const float reach = std::max(reach_[texels_.chart[a]], reach_[texels_.chart[b]]), d2 = length2(between);
    if (d2 > reach * reach) return false;
    const float off = std::max(std::abs(glm::dot(between, normal(a))), std::abs(glm::dot(between, normal(b))));
    return off <= kSamePlane * std::max(std::sqrt(d2), 0.2f * reach);
  }

  void add_from_world(std::uint32_t a, std::vector<std::pair<float, std::uint32_t>>& found) const {
    std::vector<std::uint32_t> near;
    rims_->near(reach_of(a), near);
    for (const std::uint32_t i : near)
      if (const std::uint32_t b = rim_texels_[i]; b != a && texels_.chart[b] != texels_.chart[a] && continues(a, b))
        found.emplace_back(distance2(a, b), b);
  }

  // Only texels at the rim of their chart can have neighbours elsewhere.
  bool at_rim(std::uint32_t i) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const std::uint32_t b =
            texels_.at(texels_.page[i], static_cast<int>(texels_.x[i]) + dx, static_cast<int>(texels_.y[i]) + dy);
        if (b == kNoTexel || texels_.chart[b] != texels_.chart[i]) return true;
      }
    return false;
  }

  // A file's own charts may be stretched or sheared: a texel's diagonals are then longer than its area tells.
  void find_reach(const std::vector<float>& side) {
    struct Diagonal {
      float length_m = 0, count = 0;
      float mean() const { return count > 0 ? length_m / count : 0; }
    };
    std::vector<std::array<Diagonal, 2>> diagonals(side.size());
    for (std::uint32_t i = 0; i < texels_.count(); ++i)
      for (const int up : {0, 1}) {
        const std::uint32_t next = texels_.at(texels_.page[i], static_cast<int>(texels_.x[i]) + 1,
                                              static_cast<int>(texels_.y[i]) + 2 * up - 1);
        if (next == kNoTexel || texels_.chart[next] != texels_.chart[i]) continue;
        if (texels_.visible[i] == 0 || texels_.visible[next] == 0) continue;
        Diagonal& to = diagonals[texels_.chart[i]][up];
        to.length_m += std::sqrt(distance2(i, next)), ++to.count;
      }
    reach_.resize(side.size());
    for (std::size_t c = 0; c < side.size(); ++c) {
      const float longer = std::max(diagonals[c][0].mean(), diagonals[c][1].mean());
      reach_[c] = kReach * std::max(side[c], longer / std::sqrt(2.0f));
    }
  }

  TreeBox reach_of(std::uint32_t i) const {
    const Vec3 reach(reach_[texels_.chart[i]]);
    return {DVec3(position_[i] - reach), DVec3(position_[i] + reach)};
  }

  void fill_rims() {
    std::vector<TreeBox> boxes;
    for (std::uint32_t i = 0; i < texels_.count(); ++i)
      if (texels_.visible[i] > 0 && at_rim(i)) rim_texels_.push_back(i), boxes.push_back(reach_of(i));
    rims_.emplace(boxes);
  }

  const Transport& t_;
  const Texels& texels_;
  std::vector<Vec3> position_;
  std::vector<float> size_;                // side of a texel of its chart, metres
  std::vector<float> reach_;               // by chart, metres
  std::vector<std::uint32_t> rim_texels_;  // those at the rims of charts
  std::optional<BoxTree> rims_;            // what is within their reach
};

void link(TexelGraph& graph, std::uint32_t a, std::uint32_t b) {
  const auto own = graph.of(a);
  if (std::find(own.begin(), own.end(), b) != own.end()) return;
  if (graph.count[a] == kMaxNeighbours || graph.count[b] == kMaxNeighbours) return;
  graph.neighbour[a][graph.count[a]++] = b;
  graph.neighbour[b][graph.count[b]++] = a;
}

}  // namespace

Result<TexelGraph> find_neighbours(const Transport& transport, const Texels& texels, const Stage& stage) {
  constexpr std::size_t kRun = 256;
  const NeighbourFinder finder(transport, texels);
  const std::size_t runs = (texels.count() + kRun - 1) / kRun;
  std::vector<std::vector<Candidate>> free(runs);
  ORIEL_TRY_VOID(parallel_for(stage, "neighbours", runs, [&](std::size_t run) {
    std::vector<Candidate> pairs;
    for (std::size_t i = run * kRun; i < std::min(texels.count(), (run + 1) * kRun); ++i)
      for (const Candidate& c : finder.candidates(static_cast<std::uint32_t>(i)))
        if (c.a < c.b || texels.chart[c.a] != texels.chart[c.b]) pairs.push_back(c);
    std::vector<Ray> bridges;
    for (const Candidate& c : pairs) bridges.push_back(finder.bridge(c));
    std::vector<Vec3> transmittance(pairs.size());
    transport.accel.transmittance(bridges, transmittance);
    stage.count(bridges.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (max_component(transmittance[i]) > 0) free[run].push_back(pairs[i]);
  }));
  TexelGraph graph;
  graph.neighbour.resize(texels.count());
  graph.count.assign(texels.count(), 0);
  // Pairs within a chart come first; pairs across charts take the remaining places.
  for (const bool across : {false, true})
    for (const auto& pairs : free)
      for (const Candidate& c : pairs)
        if ((texels.chart[c.a] != texels.chart[c.b]) == across) link(graph, c.a, c.b);
  return graph;
}

TexelGraph with_chart_neighbours(TexelGraph graph, const Texels& texels) {
  constexpr std::array<std::array<int, 2>, 4> kAhead{{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};  // the others look back
  for (std::uint32_t a = 0; a < texels.count(); ++a)
    for (const auto& [dx, dy] : kAhead) {
      const std::uint32_t b =
          texels.at(texels.page[a], static_cast<int>(texels.x[a]) + dx, static_cast<int>(texels.y[a]) + dy);
      if (b != kNoTexel && texels.chart[b] == texels.chart[a] && texels.visible[a] > 0 && texels.visible[b] > 0)
        link(graph, a, b);
    }
  return graph;
}

}  // namespace oriel
