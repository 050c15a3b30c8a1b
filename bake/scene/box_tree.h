// Boxes by where they are: their sizes span orders of magnitude, so no grid of one size fits them.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "bake/scene/scene.h"

namespace oriel {

struct TreeBox {
  DVec3 lower{std::numeric_limits<double>::max()}, upper{-std::numeric_limits<double>::max()};

  void add(const DVec3& p) { lower = glm::min(lower, p), upper = glm::max(upper, p); }
  void widen(double by) { lower -= by, upper += by; }
};

class BoxTree {
 public:
  explicit BoxTree(std::span<const TreeBox> boxes);
  BoxTree(BoxTree&&) noexcept;
  ~BoxTree();

  // Those that touch the box, ascending; what `found` held is gone.
  void near(const TreeBox& box, std::vector<std::uint32_t>& found) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Of cuts with their tolerance around them.
BoxTree tree_of(std::span<const ChartCut> cuts);

}  // namespace oriel
