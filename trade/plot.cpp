#include "trade/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "formats/core/text.h"

namespace oriel::trade {
namespace {

constexpr double kWidth = 560, kHeight = 400, kLeft = 58, kRight = 16, kTop = 34, kBottom = 44;
constexpr double kLetter = 6.1, kLine = 13;  // pixels of a label's letter and line, about

// A logarithmic axis over the values above 0, with room on both sides.
class Axis {
 public:
  Axis(const std::vector<double>& values, double from, double to) : from_(from), to_(to) {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    for (const double v : values)
      if (v > 0 && std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    if (high == 0) low = high = 1;
    const double room = std::max(0.08 * std::log10(high / low), 0.12);
    low_ = std::log10(low) - room;
    high_ = std::log10(high) + room;
  }

  double at(double value) const {
    const double t = value > 0 ? (std::log10(value) - low_) / (high_ - low_) : 0;
    return from_ + std::clamp(t, 0.0, 1.0) * (to_ - from_);
  }

  // 1, 2 and 5 times powers of ten; powers alone where those would crowd.
  std::vector<double> ticks() const {
    std::vector<double> out;
    for (int decade = static_cast<int>(std::floor(low_)); decade <= static_cast<int>(std::ceil(high_)); ++decade)
      for (const double step : {1.0, 2.0, 5.0}) {
        const double log = decade + std::log10(step);
        if ((step == 1 || high_ - low_ < 2.5) && log >= low_ && log <= high_)
          out.push_back(step * std::pow(10, decade));
      }
    return out;
  }

 private:
  double from_, to_, low_ = 0, high_ = 1;
};

struct Box {
  double x, y, width, height;
  bool meets(const Box& o) const {
    return x < o.x + o.width && o.x < x + width && y < o.y + o.height && o.y < y + height;
  }
};

// Beside its dot where it is free: right, left, above, below; nothing where it is nowhere.
std::string placed_label(const Dot& dot, double x, double y, std::vector<Box>& taken) {
  const double width = kLetter * static_cast<double>(dot.label.size());
  const std::array<Box, 6> places = {{{x + 7, y - 7, width, kLine},
                                      {x - 7 - width, y - 7, width, kLine},
                                      {x + 4, y - 19, width, kLine},
                                      {x + 4, y + 5, width, kLine},
                                      {x - 4 - width, y - 19, width, kLine},
                                      {x - 4 - width, y + 5, width, kLine}}};
  for (const Box& place : places) {
    const bool inside =
        place.x > kLeft && place.x + width < kWidth && place.y > kTop && place.y + kLine < kHeight - kBottom;
    if (!inside || std::any_of(taken.begin(), taken.end(), [&](const Box& b) { return b.meets(place); })) continue;
    taken.push_back(place);
    return fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", place.x, place.y + 10.5,
                       escaped(dot.label));
  }
  return {};
}

std::string frame_svg(const Plot& plot, const Axis& x, const Axis& y) {
  std::string svg = fmt::format("<text class=\"title\" x=\"{}\" y=\"18\">{}</text>\n", kLeft, escaped(plot.title));
  for (const double tick : x.ticks())
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">{4:g}</text>\n",
        x.at(tick), kTop, kHeight - kBottom, kHeight - kBottom + 15, tick);
  for (const double tick : y.ticks())
    svg += fmt::format(
        "<line class=\"grid\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" x1=\"{1}\" x2=\"{2}\"/><text x=\"{3}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:g}</text>\n",
        y.at(tick), kLeft, kWidth - kRight, kLeft - 6, y.at(tick) + 4, tick);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", kWidth - kRight, kHeight - 8,
                     escaped(plot.x_label));
  svg += fmt::format("<text transform=\"translate(14 {}) rotate(-90)\" text-anchor=\"end\">{}</text>\n", kTop,
                     escaped(plot.y_label));
  return svg;
}

}  // namespace

std::string plot_svg(const Plot& plot) {
  std::vector<double> xs, ys;
  for (const Dot& dot : plot.dots) xs.push_back(dot.x), ys.push_back(dot.y);
  const Axis x(xs, kLeft, kWidth - kRight), y(ys, kHeight - kBottom, kTop);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", kWidth, kHeight,
                                escaped(plot.title)) +
                    frame_svg(plot, x, y);
  std::vector<const Dot*> front;
  std::vector<Box> taken;
  for (const Dot& dot : plot.dots) {
    if (dot.on_front) front.push_back(&dot);
    taken.push_back({x.at(dot.x) - 4, y.at(dot.y) - 4, 8, 8});
  }
  std::sort(front.begin(), front.end(), [](const Dot* a, const Dot* b) { return a->x < b->x; });
  std::string path;
  for (const Dot* dot : front)
    path += path.empty() ? fmt::format("M{:.1f} {:.1f}", x.at(dot->x), y.at(dot->y))
                         : fmt::format("H{:.1f}V{:.1f}", x.at(dot->x), y.at(dot->y));
  if (!path.empty()) svg += fmt::format("<path class=\"front\" d=\"{}\"/>\n", path);
  const auto& colours = plot_colours();
  for (const Dot& dot : plot.dots)
    svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"{}><title>{}</title></circle>\n",
                       x.at(dot.x), y.at(dot.y), dot.on_front ? "5.5" : "4",
                       colours[static_cast<std::size_t>(dot.group) % colours.size()],
                       dot.on_front ? " class=\"best\"" : "", escaped(dot.tip));
  for (const Dot* dot : front) svg += placed_label(*dot, x.at(dot->x), y.at(dot->y), taken);
  return svg + "</svg>\n";
}

// Told apart by people of any colour vision, as far as so many can be (after Okabe and Ito 2008, and darker ones).
const std::vector<std::string>& plot_colours() {
  static const std::vector<std::string> kColours = {"#1a1a1a", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                                    "#56b4e9", "#7a5195", "#8c6d31", "#b2182b", "#5e7d1e", "#6b7280"};
  return kColours;
}

}  // namespace oriel::trade
