#include "bake/atlas/merge.h"

#include <algorithm>
#include <set>

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr std::size_t kWork = 16;  // triangles laid flat, over those of the surface
constexpr int kRounds = 48;
constexpr double kTinyCos = 0.26;        // 75°: the corners of a box stay
constexpr std::size_t kMostLeaves = 64;  // of a group
constexpr std::size_t kLeaf = 8;         // the centre of a group of several has so many times a leaf's triangles
constexpr double kLeastCommon = 0.1;     // of the shorter outline; charts that hardly touch make a worse shape
constexpr std::uint32_t kNoChart = ~0u;

struct Pair {
  std::uint32_t a = 0, b = 0;
  double common = 0;  // length of the outline that they share, then its share
};

// A chart and smaller ones beside it.
struct Group {
  std::uint32_t centre = 0;
  std::vector<std::uint32_t> leaves;
};

class Merger {
 public:
  Merger(const MergeSurface& surface, const FlattenLimits& limits, Context& context, std::vector<GrownChart>& charts)
      : surface_(surface), limits_(limits), context_(context), charts_(charts) {
    const std::size_t faces = surface.across.size() / 3;
    owner_.assign(faces, kNoChart);
    slot_.assign(faces, 0);
    work_left_ = kWork * faces;
    reach_.assign(charts.size(), kMostLeaves);
    for (std::uint32_t c = 0; c < charts.size(); ++c) {
      own(c);
      double area = 0;
      for (const Triangle2& t : charts[c].flat.points) area += std::abs(signed_area(t));
      area_.push_back(area);
    }
  }

  void run() {
    for (int round = 0; round < kRounds && !context_.stopped() && !surface_.expired(); ++round) {
      const std::vector<Group> groups = match();
      if (groups.empty()) return;
      std::vector<std::optional<FlatChart>> merged(groups.size());
      const Status done =
          parallel_for(context_, "", groups.size(), [&](std::size_t i) { merged[i] = try_group(groups[i]); });
      if (!done) return;
      for (std::size_t i = 0; i < groups.size(); ++i) {
        if (merged[i])
          replace(groups[i], std::move(*merged[i]));
        else
          remember_failure(groups[i]);
      }
    }
  }

  // The charts that are left, in order.
  void collect() {
    std::erase_if(charts_, [](const GrownChart& chart) { return chart.flat.faces.empty(); });
  }

 private:
  void own(std::uint32_t c) {
    for (const std::uint32_t face : charts_[c].flat.faces) owner_[face] = c;
  }

  double edge_length(std::uint32_t edge) const {
    const Triangle3 t = surface_.corners(edge / 3);
    return glm::length(t[(edge + 1) % 3] - t[edge % 3]);
  }

  bool joins(std::uint32_t a, std::uint32_t b, double cosine) const {
    return cosine >= (std::min(area_[a], area_[b]) < surface_.tiny_area ? kTinyCos : surface_.smooth_cos);
  }

  // Pairs of charts that adjoin smoothly, with the share of common outline, in order of (a, b).
  std::vector<Pair> adjoining() const {
    std::vector<double> outline(charts_.size(), 0);
    std::vector<Pair> pairs;
    for (std::uint32_t e = 0; e < surface_.across.size(); ++e) {
      const std::uint32_t a = owner_[e / 3], other = surface_.across[e];
      if (a == kNoChart || charts_[a].exact) continue;
      const std::uint32_t b = other == kNoEdge ? kNoChart : owner_[other / 3];
      if (a == b) continue;
      const double length = edge_length(e);
      outline[a] += length;
      if (b != kNoChart && a < b && !charts_[b].exact && joins(a, b, surface_.cosine(e / 3, other / 3)))
        pairs.push_back({a, b, length});
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& x, const Pair& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    std::vector<Pair> out;
    for (const Pair& p : pairs) {
      if (out.empty() || out.back().a != p.a || out.back().b != p.b) out.push_back({p.a, p.b, 0});
      out.back().common += p.common;
    }
    // Rounded: pairs that are alike in the model stay so wherever it stands.
    for (Pair& p : out)
      p.common = std::round(0x1p13 * p.common / std::max(std::min(outline[p.a], outline[p.b]), 1e-300)) * 0x1p-13;
    return out;
  }

  std::size_t size_of(std::uint32_t chart) const { return charts_[chart].flat.faces.size(); }

  // Whether b, the smaller, may join the group of a.
  bool may_join(const Group& group, std::uint32_t a, std::uint32_t b) const {
    if (failed_.contains({std::min(a, b), std::max(a, b)}) || group.leaves.size() >= reach_[a]) return false;
    return group.leaves.empty() || kLeaf * size_of(b) <= size_of(a);
  }

  // The groups of the next round, disjoint.
  std::vector<Group> match() {
    std::vector<Pair> pairs = adjoining();
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.common > y.common; });
    std::vector<Group> groups(charts_.size());
    std::vector<std::size_t> faces(charts_.size());
    std::vector<double> area = area_;
    std::vector<bool> leaf(charts_.size());
    for (const Pair& p : pairs) {
      if (p.common < kLeastCommon) break;
      const bool turn = size_of(p.a) < size_of(p.b);
      const std::uint32_t a = turn ? p.b : p.a, b = turn ? p.a : p.b;
      if (leaf[a] || leaf[b] || !groups[b].leaves.empty() || !may_join(groups[a], a, b)) continue;
      const std::size_t added = size_of(b) + (groups[a].leaves.empty() ? size_of(a) : 0);
      if (faces[a] + added > kMaxChartFaces || added > work_left_ || area[a] + area_[b] > surface_.largest_area)
        continue;
      leaf[b] = true;
      faces[a] += added;
      area[a] += area_[b];
      work_left_ -= added;
      groups[a].centre = a;
      groups[a].leaves.push_back(b);
    }
    std::erase_if(groups, [](const Group& group) { return group.leaves.empty(); });
    return groups;
  }

  std::optional<FlatChart> try_group(const Group& group) {
    std::vector<std::uint32_t> faces = charts_[group.centre].flat.faces;
    for (const std::uint32_t leaf : group.leaves)
      faces.insert(faces.end(), charts_[leaf].flat.faces.begin(), charts_[leaf].flat.faces.end());
    std::vector<Triangle3> corners;
    corners.reserve(faces.size());
    for (const std::uint32_t face : faces) corners.push_back(surface_.corners(face));
    const Patch patch = make_patch(std::move(faces), surface_.across, slot_, [&](std::uint32_t face) {
      const std::uint32_t chart = owner_[face];
      return chart == group.centre || std::find(group.leaves.begin(), group.leaves.end(), chart) != group.leaves.end();
    });
    return flatten(patch, corners, limits_);
  }

  // The union gets a number of its own, so that charts that failed with its parts are tried with it.
  void replace(const Group& group, FlatChart&& merged) {
    double area = area_[group.centre];
    charts_[group.centre].flat = {};
    for (const std::uint32_t leaf : group.leaves) {
      area += area_[leaf];
      charts_[leaf].flat = {};
    }
    charts_.push_back({std::move(merged), false});
    area_.push_back(area);
    reach_.push_back(kMostLeaves);
    own(static_cast<std::uint32_t>(charts_.size() - 1));
  }

  // One of many leaves may be at fault: half of them next time, the better half.
  void remember_failure(const Group& group) {
    const std::uint32_t a = group.centre, b = group.leaves[0];
    reach_[a] = std::max<std::size_t>(1, group.leaves.size() / 2);
    if (group.leaves.size() == 1) failed_.insert({std::min(a, b), std::max(a, b)});
  }

  const MergeSurface& surface_;
  const FlattenLimits& limits_;
  Context& context_;
  std::vector<GrownChart>& charts_;
  std::vector<std::uint32_t> owner_, slot_;  // by face
  std::vector<double> area_;                 // by chart, m²
  std::vector<std::size_t> reach_;           // by chart: leaves that its group may have
  std::size_t work_left_ = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> failed_;
};

}  // namespace

void merge_charts(const MergeSurface& surface, const FlattenLimits& limits, Context& context,
                  std::vector<GrownChart>& charts) {
  Merger merger(surface, limits, context, charts);
  merger.run();
  merger.collect();
}

}  // namespace oriel
