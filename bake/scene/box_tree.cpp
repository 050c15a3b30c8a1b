#include "bake/scene/box_tree.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

namespace oriel {
namespace {

using RTreeBox = boost::geometry::model::box<boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>>;
using TreeEntry = std::pair<RTreeBox, std::uint32_t>;

RTreeBox tree_box(const TreeBox& b) {
  return {{b.lower.x, b.lower.y, b.lower.z}, {b.upper.x, b.upper.y, b.upper.z}};
}

std::vector<TreeEntry> entries_of(std::span<const TreeBox> boxes) {
  std::vector<TreeEntry> entries;
  for (const TreeBox& box : boxes) entries.emplace_back(tree_box(box), static_cast<std::uint32_t>(entries.size()));
  return entries;
}

}  // namespace

struct BoxTree::Impl {
  boost::geometry::index::rtree<TreeEntry, boost::geometry::index::quadratic<16>> tree;
};

BoxTree::BoxTree(std::span<const TreeBox> boxes) : impl_(new Impl{decltype(Impl::tree)(entries_of(boxes))}) {}
BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree::~BoxTree() = default;

void BoxTree::near(const TreeBox& box, std::vector<std::uint32_t>& found) const {
  found.clear();
  const auto query = boost::geometry::index::intersects(tree_box(box));
  for (auto it = impl_->tree.qbegin(query); it != impl_->tree.qend(); ++it) found.push_back(it->second);
  std::ranges::sort(found);
}

BoxTree tree_of(std::span<const ChartCut> cuts) {
  std::vector<TreeBox> boxes(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    boxes[i].add(DVec3(cuts[i].from)), boxes[i].add(DVec3(cuts[i].to));
    boxes[i].widen(cuts[i].tolerance_m());
  }
  return BoxTree(boxes);
}

}  // namespace oriel
