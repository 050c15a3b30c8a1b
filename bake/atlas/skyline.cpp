#include "bake/atlas/skyline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace oriel {
namespace {

struct Step {
  std::uint32_t x = 0, y = 0, width = 0;
};

class Skyline {
 public:
  Skyline(std::uint32_t width, std::uint32_t height) : width_(width), height_(height), steps_{{0, 0, width}} {}

  // False where it does not fit.
  bool insert(std::uint32_t w, std::uint32_t h, std::uint32_t& x, std::uint32_t& y) {
    std::size_t best = steps_.size();
    std::uint32_t best_y = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t i = 0; i < steps_.size() && steps_[i].x + w <= width_; ++i) {
      if (steps_[i].y >= best_y) continue;
      const std::uint32_t top = rest_height(i, w, best_y);
      if (top < best_y && top + h <= height_) best = i, best_y = top;
    }
    if (best == steps_.size()) return false;
    x = steps_[best].x;
    y = best_y;
    raise(best, w, best_y + h);
    return true;
  }

 private:
  // The height at which a rectangle of width w comes to rest with its left side at step i; `enough` or more may be cut
  // short.
  std::uint32_t rest_height(std::size_t i, std::uint32_t w, std::uint32_t enough) const {
    std::uint32_t top = 0, covered = 0;
    for (; covered < w && top < enough; ++i) {
      top = std::max(top, steps_[i].y);
      covered += steps_[i].width;
    }
    return top;
  }

  void raise(std::size_t i, std::uint32_t w, std::uint32_t y) {
    const std::uint32_t x = steps_[i].x, end = x + w;
    std::size_t last = i;
    while (last < steps_.size() && steps_[last].x + steps_[last].width <= end) ++last;
    if (last < steps_.size() && steps_[last].x < end) {
      steps_[last].width -= end - steps_[last].x;
      steps_[last].x = end;
    }
    steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(i), steps_.begin() + static_cast<std::ptrdiff_t>(last));
    steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(i), {x, y, w});
    merge(i + 1);
    merge(i);
  }

  // Joins step i with the one before it where both are level.
  void merge(std::size_t i) {
    if (i == 0 || i >= steps_.size() || steps_[i - 1].y != steps_[i].y) return;
    steps_[i - 1].width += steps_[i].width;
    steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  std::uint32_t width_, height_;
  std::vector<Step> steps_;
};

}  // namespace

std::vector<PackedPage> pack_rects(std::span<PackRect> rects, const PackLimits& limits) {
  std::vector<std::uint32_t> order(rects.size()), left;
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (rects[a].height != rects[b].height) return rects[a].height > rects[b].height;
    if (rects[a].width != rects[b].width) return rects[a].width > rects[b].width;
    return a < b;
  });
  std::vector<PackedPage> pages;
  const std::uint32_t pad = limits.padding;
  while (!order.empty()) {
    if (pages.size() == limits.max_pages) return {};
    Skyline skyline(limits.width + pad, limits.height + pad);
    PackedPage page;
    std::uint32_t failed_width = ~0u, failed_height = ~0u;  // what is as wide and as high does not fit either
    left.clear();
    for (const std::uint32_t i : order) {
      PackRect& r = rects[i];
      const bool hopeless = r.width >= failed_width && r.height >= failed_height;
      if (hopeless || !skyline.insert(r.width + pad, r.height + pad, r.x, r.y)) {
        if (!hopeless) failed_width = r.width, failed_height = r.height;
        left.push_back(i);
        continue;
      }
      r.page = static_cast<std::uint32_t>(pages.size());
      page.width = std::max(page.width, r.x + r.width);
      page.height = std::max(page.height, r.y + r.height);
    }
    if (left.size() == order.size()) return {};  // a rectangle larger than a page
    pages.push_back(page);
    order.swap(left);
  }
  return pages;
}

std::vector<PackedPage> pack_compact(std::span<PackRect> rects, const PackLimits& limits) {
  double padded_area = 0;
  std::uint32_t widest = 0;
  for (const PackRect& r : rects) {
    padded_area += static_cast<double>(r.width + limits.padding) * (r.height + limits.padding);
    widest = std::max(widest, r.width);
  }
  const double side = std::ceil(std::sqrt(padded_area * 1.05));
  if (side < limits.width) {
    PackLimits compact = limits;
    compact.width = std::clamp(static_cast<std::uint32_t>(side), widest, limits.width);
    compact.max_pages = 1;
    auto pages = pack_rects(rects, compact);
    if (!pages.empty()) return pages;
  }
  return pack_rects(rects, limits);
}

}  // namespace oriel
