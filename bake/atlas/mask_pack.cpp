#include "bake/atlas/mask_pack.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace oriel {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kManyCharts = 20000;  // beyond which one width is tried, not several
constexpr double kSizeSteps = 6;            // classes of size an octave
constexpr std::uint32_t kFillSteps = 4;     // classes of a mask's share of its box

struct Span {
  std::uint32_t row, first, length;
};

// A mask as runs of texels, the longest first: these refuse a place soonest.
struct Shape {
  std::uint32_t width = 0, height = 0, turns = 0, cursor = 0;  // cursor: index of its class
  double centre = 0;                                           // mean row of its texels
  std::vector<Span> spans;
};

std::uint32_t size_class(std::uint32_t n) {
  return static_cast<std::uint32_t>(kSizeSteps * std::log2(static_cast<double>(n)));
}
constexpr std::uint32_t kSizeClasses = 15 * static_cast<std::uint32_t>(kSizeSteps);  // sides up to 2^15

Shape make_shape(const TexelMask& mask, std::uint32_t turns, double fill) {
  Shape shape{mask.width(), mask.height(), turns, 0, 0, {}};
  for (std::uint32_t y = 0; y < mask.height(); ++y) {
    for (std::uint32_t x = 0; x < mask.width();) {
      if (!mask.at(x, y)) {
        ++x;
        continue;
      }
      const std::uint32_t first = x;
      while (x < mask.width() && mask.at(x, y)) ++x;
      shape.spans.push_back({y, first, x - first});
    }
  }
  for (const Span& span : shape.spans) shape.centre += static_cast<double>(span.row) * span.length;
  shape.centre /= static_cast<double>(mask.count());
  std::stable_sort(shape.spans.begin(), shape.spans.end(),
                   [](const Span& a, const Span& b) { return a.length > b.length; });
  const auto fill_class = std::min(kFillSteps - 1, static_cast<std::uint32_t>(fill * kFillSteps));
  const std::uint32_t size = size_class(shape.width) * kSizeClasses + size_class(shape.height);
  shape.cursor = (size * kFillSteps + fill_class) * 2 + turns / 2;  // turned by half, it may fit where it did not
  return shape;
}

// The ways to lay a chart down that differ: two for a full rectangle, else four.
std::vector<Shape> make_shapes(const TexelMask& mask) {
  std::vector<Shape> shapes;
  const double box = static_cast<double>(mask.width()) * mask.height();
  const auto texels = static_cast<double>(mask.count());
  const std::uint32_t kinds = texels < box ? 4 : mask.width() != mask.height() ? 2 : 1;
  TexelMask turned = mask;
  for (std::uint32_t turns = 0; turns < kinds; ++turns) {
    if (turns > 0) turned = turned.turned();
    shapes.push_back(make_shape(turned, turns, texels / box));
  }
  return shapes;
}

// to |= from shifted down by `shift` columns, over `words` words; `from` has a word more, and may be `to`.
void or_shifted(std::uint64_t* to, const std::uint64_t* from, std::size_t words, std::uint32_t shift) {
  const std::size_t skip = shift / 64;
  const std::uint32_t bits = shift % 64;
  if (skip >= words) return;
  if (bits == 0) {
    for (std::size_t i = 0; i + skip < words; ++i) to[i] |= from[i + skip];
  } else {
    for (std::size_t i = 0; i + skip < words; ++i) to[i] |= from[i + skip] >> bits | from[i + skip + 1] << (64 - bits);
  }
}

// One page while it is filled: bits of texels that are taken, or too near to taken ones.
class Page {
 public:
  Page(std::uint32_t width, std::uint32_t height, std::uint32_t padding)
      : width_(width),
        height_(height),
        padding_(padding),
        words_((width + 63) / 64),
        stride_(words_ + 1),
        run_(stride_),
        blocked_(stride_),
        cursors_(std::size_t{kSizeClasses} * kSizeClasses * kFillSteps * 2, 0) {}

  // False where it does not fit.
  bool insert(std::span<const Shape> shapes, PackedChart& chart) {
    const Shape* best = nullptr;
    double best_height = std::numeric_limits<double>::max();  // of the chart's centre
    for (const Shape& shape : shapes) {
      if (shape.width > width_ || shape.height > height_) continue;
      const double better = std::ceil(best_height - shape.centre);  // rows below would be
      if (better <= 0) continue;
      std::uint32_t end = height_ - shape.height + 1;
      if (better < end) end = static_cast<std::uint32_t>(better);
      std::uint32_t& row = cursors_[shape.cursor];
      std::uint32_t x = kNone;
      for (; row < end && x == kNone; ++row) x = place_in_row(shape, row);
      if (x == kNone) continue;
      --row;
      best = &shape;
      best_height = row + shape.centre;
      chart.x = x, chart.y = row, chart.turns = shape.turns;
    }
    if (best == nullptr) return false;
    take(*best, chart.x, chart.y);
    return true;
  }

  PackedPage used() const { return used_; }

 private:
  // The lowest x at which the shape fits with its lowest row at y, or kNone.
  std::uint32_t place_in_row(const Shape& shape, std::uint32_t y) {
    std::fill(blocked_.begin(), blocked_.end(), 0);
    const std::uint32_t places = width_ - shape.width + 1;
    const std::size_t words = (places + 63) / 64;
    std::size_t seen = 0;
    for (const Span& span : shape.spans) {
      const std::size_t row = std::size_t{y} + span.row;
      if (row >= rows_) continue;
      block(&bits_[row * stride_], span);
      if (++seen % 4 == 1 && free_place(words, places) == kNone) return kNone;
    }
    return free_place(words, places);
  }

  // Marks the places at which the span would meet taken texels of a row.
  void block(const std::uint64_t* row, const Span& span) {
    std::copy(row, row + stride_, run_.begin());
    std::uint32_t length = 1;  // run_: places at which a span so long would meet any
    for (; 2 * length <= span.length; length *= 2) or_shifted(run_.data(), run_.data(), words_, length);
    if (length < span.length) or_shifted(run_.data(), run_.data(), words_, span.length - length);
    or_shifted(blocked_.data(), run_.data(), words_, span.first);
  }

  std::uint32_t free_place(std::size_t words, std::uint32_t places) const {
    for (std::size_t i = 0; i < words; ++i) {
      if (~blocked_[i] == 0) continue;
      const auto x = static_cast<std::uint32_t>(64 * i) + static_cast<std::uint32_t>(std::countr_one(blocked_[i]));
      return x < places ? x : kNone;
    }
    return kNone;
  }

  void take(const Shape& shape, std::uint32_t x, std::uint32_t y) {
    const auto below = [&](std::uint32_t n) { return n > padding_ ? n - padding_ : 0; };
    rows_ = std::max(rows_, std::min<std::size_t>(height_, std::size_t{y} + shape.height + padding_));
    bits_.resize(rows_ * stride_, 0);
    for (const Span& span : shape.spans) {
      const std::uint32_t first = below(x + span.first);
      const std::uint32_t end = std::min(width_, x + span.first + span.length + padding_);
      const std::uint32_t last_row = std::min(height_ - 1, y + span.row + padding_);
      for (std::uint32_t row = below(y + span.row); row <= last_row; ++row) fill(row, first, end);
    }
    used_.width = std::max(used_.width, x + shape.width);
    used_.height = std::max(used_.height, y + shape.height);
  }

  void fill(std::uint32_t row, std::uint32_t first, std::uint32_t end) {
    std::uint64_t* words = &bits_[row * stride_];
    for (std::uint32_t x = first; x < end;) {
      const std::uint32_t bits = std::min(64 - x % 64, end - x);
      words[x / 64] |= (bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1) << (x % 64);
      x += bits;
    }
  }

  std::uint32_t width_, height_, padding_;
  std::size_t words_, stride_;  // of a row; the last word stays empty
  std::size_t rows_ = 0;        // in bits_; those above are empty
  std::vector<std::uint64_t> bits_, run_, blocked_;
  std::vector<std::uint32_t> cursors_;  // by class: its shapes fit in no row below
  PackedPage used_;
};

// Charts in the order in which they are packed.
std::vector<std::uint32_t> packing_order(std::span<const TexelMask> masks) {
  std::vector<std::uint32_t> order(masks.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const std::uint32_t w = masks[i].width(), h = masks[i].height();
    return std::array<std::uint32_t, 2>{w + h, std::max(w, h)};
  };
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) > key(b); });
  return order;
}

struct Packing {
  std::span<const TexelMask> masks;
  PackLimits limits;
  std::span<PackedChart> charts;  // where each mask lies
};

// Fills one page; what did not fit stays in `order`. With `all`, gives up at the first that does not.
PackedPage fill_page(const Packing& packing, std::uint32_t index, bool all, std::vector<std::uint32_t>& order) {
  const auto& [masks, limits, charts] = packing;
  Page page(limits.width, limits.height, limits.padding);
  std::vector<std::uint32_t> left;
  for (const std::uint32_t i : order) {
    charts[i].page = index;
    if (page.insert(make_shapes(masks[i]), charts[i])) continue;
    left.push_back(i);
    if (all) break;
  }
  order.swap(left);
  return page.used();
}

double area_of(std::span<const TexelMask> masks, std::span<const std::uint32_t> which, std::uint32_t padding) {
  double sum = 0;
  for (const std::uint32_t i : which)
    sum +=
        static_cast<double>(masks[i].count()) + static_cast<double>(padding) * (masks[i].width() + masks[i].height());
  return sum;
}

std::uint32_t rounded(std::uint32_t n) {
  return (n + 3) / 4;
}

// The best filled page of several widths, all charts of `order` on it; none where they do not fit on one.
std::vector<PackedPage> pack_last(const Packing& packing, std::uint32_t index, std::span<const std::uint32_t> order) {
  const auto& [masks, limits, charts] = packing;
  std::uint32_t widest = 0;
  for (const std::uint32_t i : order) widest = std::max(widest, std::min(masks[i].width(), masks[i].height()));
  const double side = std::sqrt(area_of(masks, order, limits.padding));
  std::vector<PackedPage> best;
  std::vector<PackedChart> trial(charts.begin(), charts.end());
  for (const double factor : {1.06, 0.98, 1.02, 1.1, 1.15, 1.22}) {
    if (side * factor > limits.width || (order.size() > kManyCharts && !best.empty())) continue;
    Packing narrow{masks, limits, trial};
    narrow.limits.width = std::max(static_cast<std::uint32_t>(std::ceil(side * factor)), widest);
    std::vector<std::uint32_t> rest(order.begin(), order.end());
    const PackedPage page = fill_page(narrow, index, true, rest);
    const auto texels = [](const PackedPage& p) { return std::size_t{rounded(p.width)} * rounded(p.height); };
    if (!rest.empty() || (!best.empty() && texels(page) >= texels(best[0]))) continue;
    best = {page};
    std::copy(trial.begin(), trial.end(), charts.begin());
  }
  return best;
}

std::vector<PackedPage> pack(const Packing& packing, bool compact) {
  const auto& [masks, limits, charts] = packing;
  std::vector<std::uint32_t> order = packing_order(masks);
  std::vector<PackedPage> pages;
  while (!order.empty()) {
    if (pages.size() == limits.max_pages) return {};
    const auto index = static_cast<std::uint32_t>(pages.size());
    if (compact && area_of(masks, order, limits.padding) < static_cast<double>(limits.width) * limits.height) {
      if (const auto last = pack_last(packing, index, order); !last.empty()) {
        pages.push_back(last[0]);
        return pages;
      }
    }
    const std::size_t before = order.size();
    pages.push_back(fill_page(packing, index, !compact && index + 1 == limits.max_pages, order));
    if (order.size() == before) return {};  // a mask larger than a page
  }
  return pages;
}

}  // namespace

void TexelMask::set_span(std::uint32_t first, std::uint32_t last, std::uint32_t y) {
  for (std::uint32_t x = first; x <= last; ++x) set(x, y);
}

std::size_t TexelMask::count() const {
  std::size_t sum = 0;
  for (const std::uint64_t word : bits_) sum += static_cast<std::size_t>(std::popcount(word));
  return sum;
}

TexelMask TexelMask::turned() const {
  TexelMask out(height_, width_);
  for (std::uint32_t y = 0; y < height_; ++y)
    for (std::uint32_t x = 0; x < width_; ++x)
      if (at(x, y)) out.set(height_ - 1 - y, x);
  return out;
}

double padded_area(std::span<const TexelMask> masks, std::uint32_t padding) {
  std::vector<std::uint32_t> all(masks.size());
  std::iota(all.begin(), all.end(), 0u);
  return area_of(masks, all, padding);
}

std::vector<PackedPage> pack_masks(std::span<const TexelMask> masks, const PackLimits& limits,
                                   std::span<PackedChart> charts) {
  return pack({masks, limits, charts}, false);
}

std::vector<PackedPage> pack_compact(std::span<const TexelMask> masks, const PackLimits& limits,
                                     std::span<PackedChart> charts) {
  return pack({masks, limits, charts}, true);
}

}  // namespace oriel
