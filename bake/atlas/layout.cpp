#include "bake/atlas/layout.h"

#include <cmath>
#include <tuple>

#include "bake/atlas/chart_turn.h"
#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr std::uint32_t kMaxPages = 4096;
constexpr double kSnapTexels = 1e-3;   // a chart so little longer than whole texels is fitted into them
constexpr double kLeastTexels = 0.25;  // a chart is drawn at least so long: thinner, floats would lose its shape

// A texel of a curved chart turns by no more than kTurn along either axis, as long as it need not be drawn kFinest
// times finer for it: a moulding whose front and reveal shared a texel would show each side the light of the other.
constexpr double kTurn = 30 * kPi / 180;
constexpr double kFinest = 4;

constexpr double kMargins = 1.3;  // covered texels, over the charts' area in texels: borders are covered in part

// How a chart's axis is drawn: texel = metres * scale + offset, within a row of `size` texels.
struct Axis {
  std::uint32_t size = 1;
  double scale = 0, offset = 0;
};

// A chart lies in the middle of the whole texels that hold it, so that a border texel is covered for more than half of
// its width, and a wall whose sides are whole texels covers exactly these. `inset` keeps float rounding of page
// coordinates from reaching into the next texel.
Axis fit_axis(double metres, double texel_m, double inset) {
  Axis axis;
  const double texels = metres / texel_m;
  axis.size = static_cast<std::uint32_t>(std::max(1.0, std::ceil(texels - kSnapTexels)));
  const double drawn = std::min(std::max(texels, kLeastTexels), axis.size - 2 * inset);
  axis.scale = metres > 0 ? drawn / metres : 0;
  axis.offset = 0.5 * (axis.size - (metres > 0 ? drawn : 0));
  return axis;
}

struct Frame {
  Axis x, y;
  DVec2 to_texels(const DVec2& metres) const { return {metres.x * x.scale + x.offset, metres.y * y.scale + y.offset}; }
};

// The texels that a triangle touches, or would if each corner were moved by `slack`.
void draw(const Triangle2& t, double slack, TexelMask& mask) {
  const ConvexPolygon whole(t);
  const Interval y = extent(whole, 1);
  const int width = static_cast<int>(mask.width()), height = static_cast<int>(mask.height());
  const CellRange rows = touched_cells(y.lo - slack, y.hi + slack, height);
  for (int row = rows.first; row <= rows.last; ++row) {
    ConvexPolygon part = clip_axis(clip_axis(whole, 1, row - slack, 1), 1, row + 1 + slack, -1);
    if (part.count == 0) part = whole;
    const Interval x = extent(part, 0);
    const CellRange columns = touched_cells(x.lo - slack, x.hi + slack, width);
    mask.set_span(static_cast<std::uint32_t>(columns.first), static_cast<std::uint32_t>(columns.last),
                  static_cast<std::uint32_t>(row));
  }
}

// A point of a mask of the given size, turned with it.
DVec2 turned(const DVec2& p, std::uint32_t turns, std::uint32_t width, std::uint32_t height) {
  switch (turns) {
    case 1:
      return {height - p.y, p.x};
    case 2:
      return {width - p.x, height - p.y};
    case 3:
      return {p.y, width - p.x};
    default:
      return p;
  }
}

class Layout {
 public:
  Layout(const Scene& scene, std::span<const ChartSet> sets, const LayoutOptions& options, Context& context)
      : options_(options), context_(context), inset_(options.side * 0x1p-24) {
    std::size_t texels = 0;
    for (const ChartSet& set : sets) texels += set.one_texel ? 1 : set.charts.size();
    texels_.reserve(texels);  // entries point there
    for (const ChartSet& set : sets) add(scene, set);
    if (options.demand != nullptr) even_out(free_);
  }

  Status pack() { return options_.one_page ? pack_one_page() : pack_at(options_.texel_m); }
  void warn_coarsened() const;
  void write(Atlas& atlas) const;
  void measure(const Scene& scene, AtlasReport& report) const;

 private:
  struct Entry {
    const ChartSet* set;
    const Chart* chart;
    DVec2 turn;        // turn_of
    double area_m2;    // its own
    double longest_m;  // of what shares its texel
    ChartTexel* own;   // that eyes want, or the set asks for
  };

  void add(const Scene& scene, const ChartSet& set) {
    const std::span triangles(set.triangles);
    const std::size_t first = charts_.size();
    double area = 0, longest = 0;
    for (const Chart& chart : set.charts) {
      charts_.push_back({&set, &chart, turn_of(scene, set, chart), area_of(set, chart), chart.size.x, nullptr});
      area += charts_.back().area_m2;
      longest = std::max(longest, chart.size.x);
    }
    const std::span added = std::span(charts_).subspan(first);
    for (Entry& e : added) {
      if (set.one_texel)
        e.longest_m = longest;
      else
        e.own = add_texel(set, triangles.subspan(e.chart->first, e.chart->count), e.area_m2);
    }
    if (!set.one_texel || added.empty()) return;
    ChartTexel* const all = add_texel(set, triangles, area);
    for (Entry& e : added) e.own = all;
    share_turns(added);
  }

  ChartTexel* add_texel(const ChartSet& set, std::span<const std::uint32_t> triangles, double area_m2) {
    ChartTexel& texel = texels_.emplace_back(ChartTexel{.texel_m = options_.texel_m, .area_m2 = area_m2});
    if (options_.demand != nullptr) texel = texel_for(*options_.demand, triangles, area_m2, options_.texel_m);
    if (set.texel_m > 0 && !options_.one_page)
      texel.texel_m = set.texel_m;
    else
      free_.push_back(&texel);
    return &texel;
  }

  // Charts of one texel get that which makes as many texels as if each were drawn finer for its own turn.
  static void share_turns(std::span<Entry> charts) {
    ChartTexel& own = *charts[0].own;
    double texels = 0;
    for (Entry& e : charts) {
      double more = e.area_m2;
      for (int k = 0; k < 2; ++k)
        if (e.turn[k] > 0) more *= std::clamp(e.turn[k] / kTurn * own.texel_m / e.chart->size[k], 1.0, kFinest);
      texels += more;
      e.turn = DVec2(0);
    }
    if (own.area_m2 > 0 && charts[0].set->texel_m == 0) own.texel_m /= std::sqrt(texels / own.area_m2);
  }

  static double area_of(const ChartSet& set, const Chart& chart) {
    double sum = 0;
    for (std::uint32_t i = chart.first; i < chart.first + chart.count; ++i) sum += std::abs(signed_area(set.points[i]));
    return sum;
  }

  // The texel of a chart: its own, or at least a coarser one that is tried, or as much coarser as the page needs.
  double chart_texel(const Entry& e, double texel_m) const {
    const double own = options_.one_page            ? texel_m
                       : e.set->texel_m > 0         ? e.own->texel_m
                       : texel_m > options_.texel_m ? std::max(texel_m, e.own->texel_m)
                                                    : e.own->texel_m;
    return std::max(own, e.longest_m / (options_.side - 2 * inset_));
  }
  Frame plain_frame(const Entry& e, double texel_m) const {
    const double texel = chart_texel(e, texel_m);
    return {fit_axis(e.chart->size.x, texel, inset_), fit_axis(e.chart->size.y, texel, inset_)};
  }
  // The same with the texels that the chart's turn asks for.
  Frame frame(const Entry& entry, double texel_m) const {
    const double texel = chart_texel(entry, texel_m), side = options_.side - 2 * inset_;
    const auto axis = [&](double metres, double turn) {
      const double texels = std::min(std::max(metres / texel, std::min(turn / kTurn, kFinest * metres / texel)), side);
      return fit_axis(metres, texels > 0 ? metres / texels : texel, inset_);
    };
    return {axis(entry.chart->size.x, entry.turn.x), axis(entry.chart->size.y, entry.turn.y)};
  }
  // Texels of all charts' boxes and their padding.
  double box_area(double texel_m) const {
    double sum = 0;
    for (const Entry& e : charts_) {
      const Frame f = frame(e, texel_m);
      sum += static_cast<double>(f.x.size + options_.padding) * (f.y.size + options_.padding);
    }
    return sum;
  }
  double surface_area() const {
    double sum = 0;
    for (const Entry& e : charts_) sum += e.area_m2;
    return sum;
  }
  // Texels that charts cover, at least: their area.
  double least_texels(double texel_m) const {
    double sum = 0;
    for (const Entry& e : charts_) sum += e.area_m2 / (chart_texel(e, texel_m) * chart_texel(e, texel_m));
    return sum;
  }
  void fit_limits();
  double covered_texels() const {
    double sum = 0;
    for (const TexelMask& mask : masks_) sum += static_cast<double>(mask.count());
    return sum;
  }
  Status draw_masks(double texel_m) {
    masks_.assign(charts_.size(), {});
    return parallel_for(context_, "", charts_.size(), [&](std::size_t i) {
      const Entry& e = charts_[i];
      const Frame f = frame(e, texel_m);
      masks_[i] = TexelMask(f.x.size, f.y.size);
      for (std::uint32_t k = e.chart->first; k < e.chart->first + e.chart->count; ++k) {
        const Triangle2& t = e.set->points[k];
        draw({f.to_texels(t[0]), f.to_texels(t[1]), f.to_texels(t[2])}, inset_, masks_[i]);
      }
    });
  }
  Status pack_at(double texel_m);
  Status pack_one_page();
  Status check_memory(double texel_m, double texels) const;

  const LayoutOptions& options_;
  Context& context_;
  double inset_;
  std::vector<ChartTexel> texels_;
  std::vector<ChartTexel*> free_;  // of those, what nobody asked for
  std::vector<Entry> charts_;
  double texel_m_ = 0;  // of what follows
  std::vector<TexelMask> masks_;
  std::vector<PackedChart> placed_;
  std::vector<PackedPage> pages_;
};

std::uint32_t round_up_4(std::uint32_t n) {
  return (n + 3) / 4 * 4;
}

Status Layout::check_memory(double texel_m, double texels) const {
  const double bytes = texels * kBakeTexelBytes;
  if (options_.memory_bytes == 0 || bytes <= static_cast<double>(options_.memory_bytes)) return {};
  constexpr double kMiB = 1048576;
  const double limit = static_cast<double>(options_.memory_bytes);
  double fits = texel_m;
  for (int i = 0; i < 400 && least_texels(fits) * kMargins * kBakeTexelBytes > limit; ++i) fits *= 1.1;
  return fail(
      ErrorCode::kRuntime, "atlas",
      "a texel of {:.4g} m makes a lightmap of about {:.0f} texels, which take {:.1f} MiB to bake; found a limit "
      "of {:.1f} MiB, expected at least that (--texel {:.3g}m fits)",
      texel_m, texels, bytes / kMiB, limit / kMiB, fits);
}

void Layout::fit_limits() {
  const auto fit = [&](double most, const std::string& why) {
    const std::size_t larger = coarsen(free_, [&] { return kMargins * least_texels(texel_m_) > most; });
    if (larger > 0)
      context_.warning("coarser-texels",
                       fmt::format("atlas: texels of {:.3g} m {}: {} of {} charts, those seen least, get larger ones",
                                   texel_m_, why, larger, free_.size()));
  };
  if (options_.memory_bytes > 0)
    fit(static_cast<double>(options_.memory_bytes) / kBakeTexelBytes,
        fmt::format("would take more memory to bake than the {:.0f} MiB there are for them (--memory-limit)",
                    static_cast<double>(options_.memory_bytes) / 1048576));
  if (options_.texels_in_time > 0)
    fit(static_cast<double>(options_.texels_in_time),
        fmt::format("would be more than the {} that --time leaves time for", options_.texels_in_time));
}

Status Layout::pack_at(double texel_m) {
  texel_m_ = texel_m;
  const std::uint32_t side = options_.side, padding = options_.padding;
  const double room = static_cast<double>(kMaxPages) * side * side;
  // Charts alone are at least their area: refused before their masks need memory, too.
  if (options_.coarsen && options_.demand != nullptr) fit_limits();
  ORIEL_TRY_VOID(check_memory(texel_m, least_texels(texel_m)));
  if (box_area(texel_m) <= 4 * room) {
    ORIEL_TRY_VOID(draw_masks(texel_m));
    placed_.resize(charts_.size());
    if (padded_area(masks_, padding) <= 2 * room)
      pages_ = pack_compact(masks_, {side, side, padding, kMaxPages}, placed_);
  }
  if (pages_.empty() && !charts_.empty()) {
    double fits = texel_m * 1.1;
    for (int i = 0; i < 400 && box_area(fits) > 0.8 * room; ++i) fits *= 1.1;
    return fail(ErrorCode::kRuntime, "atlas",
                "a texel of {:.4g} m needs more than {} pages of {}x{} texels; a texel of {:.3g} m fits", texel_m,
                kMaxPages, side, side, fits);
  }
  for (PackedPage& page : pages_) page = {round_up_4(page.width), round_up_4(page.height)};
  return check_memory(texel_m, covered_texels());
}

Status Layout::pack_one_page() {
  const std::uint32_t side = options_.side, padding = options_.padding;
  const PackLimits limits{side, side, padding, 1};
  std::vector<PackedChart> trial(charts_.size());
  const auto attempt = [&](double texel_m) -> Status {
    ORIEL_TRY_VOID(draw_masks(texel_m));
    // A little over half of the padding lies outside the page or is shared by more than two charts.
    if (padded_area(masks_, 0) > static_cast<double>(side) * side) return {};
    const auto pages = pack_masks(masks_, limits, trial);
    if (!pages.empty()) pages_ = pages, placed_ = trial, texel_m_ = texel_m;
    return {};
  };
  double longest = 0;
  for (const Entry& e : charts_) longest = std::max(longest, e.chart->size.x);
  double too_fine = std::max(std::sqrt(surface_area()), longest) / side * 0.999;
  ORIEL_TRY_VOID(attempt(std::max(longest, too_fine)));
  if (pages_.empty()) {
    const double least = std::ceil(std::sqrt(static_cast<double>(charts_.size())) * (1 + padding) * 1.05);
    return fail(ErrorCode::kRuntime, "atlas",
                "{} charts do not fit into one page of {}x{} texels; about {:.0f}x{:.0f} are needed", charts_.size(),
                side, side, least, least);
  }
  double guess = std::min(too_fine * 1.2, texel_m_);  // four fifths full at once, as most are
  while (texel_m_ > too_fine * 1.005) {
    ORIEL_TRY_VOID(attempt(guess));
    if (texel_m_ != guess) too_fine = guess;
    guess = std::min(std::sqrt(texel_m_ * too_fine), too_fine * 1.2);
  }
  pages_[0] = {side, side};
  return check_memory(texel_m_, covered_texels());
}

void Layout::warn_coarsened() const {
  std::size_t count = 0;
  double worst = texel_m_;
  for (const Entry& e : charts_) {
    const double texel = chart_texel(e, texel_m_);
    if (texel <= (options_.one_page ? texel_m_ : e.own->texel_m) * (1 + 1e-3)) continue;
    ++count;
    worst = std::max(worst, texel);
  }
  if (count > 0)
    context_.warning(
        "coarser-texels",
        fmt::format(
            "atlas: {} of {} charts are longer than a page of {} texels at {:.4g} m a texel; theirs are up to {:.4g} m",
            count, charts_.size(), options_.side, texel_m_, worst));
}

void Layout::write(Atlas& atlas) const {
  atlas.texel_m = static_cast<float>(texel_m_);
  const auto first_page = static_cast<std::uint32_t>(atlas.pages.size());
  for (const PackedPage& page : pages_) atlas.pages.push_back({page.width, page.height, false});
  for (std::size_t c = 0; c < charts_.size(); ++c) {
    const auto& [set, chart] = std::tie(charts_[c].set, charts_[c].chart);
    const PackedChart& at = placed_[c];
    const Frame f = frame(charts_[c], texel_m_);
    const DVec2 page_size(pages_[at.page].width, pages_[at.page].height);
    for (std::uint32_t i = chart->first; i < chart->first + chart->count; ++i) {
      const std::uint32_t t = set->triangles[i];
      atlas.page[t] = static_cast<std::int32_t>(first_page + at.page);
      atlas.chart[t] = atlas.chart_count;
      for (std::size_t k = 0; k < 3; ++k) {
        const DVec2 p = turned(f.to_texels(set->points[i][k]), at.turns, f.x.size, f.y.size);
        atlas.uv[t][k] = Vec2((p + DVec2(at.x, at.y)) / page_size);
      }
    }
    ++atlas.chart_count;
  }
}

// As if no chart were drawn finer for its turn: what is measured is how charts were laid flat. In double and before
// coordinates are rounded to the page's floats, which would be most of what is seen of triangles much smaller than a
// texel.
void Layout::measure(const Scene& scene, AtlasReport& report) const {
  StretchSum sum;
  for (const Entry& e : charts_) {
    const auto& [set, chart] = std::tie(e.set, e.chart);
    const Frame f = plain_frame(e, texel_m_);
    for (std::uint32_t i = chart->first; i < chart->first + chart->count; ++i) {
      const Triangle2& t = set->points[i];
      sum.add(triangle_corners(scene, set->triangles[i]), {f.to_texels(t[0]), f.to_texels(t[1]), f.to_texels(t[2])});
    }
  }
  for (const Entry& e : charts_) report.unseen_m2 += options_.demand != nullptr && e.own->pixels == 0 ? e.area_m2 : 0;
  report_stretch(sum, report);
}

}  // namespace

void report_stretch(const StretchSum& sum, AtlasReport& report) {
  report.l2_stretch = sum.l2();
  report.linf_stretch = sum.linf();
  report.angle_distortion = sum.angle();
  report.area_distortion = sum.area();
}

Status lay_out(const Scene& scene, std::span<const ChartSet> sets, const LayoutOptions& options, Context& context,
               Atlas& atlas) {
  Layout layout(scene, sets, options, context);
  ORIEL_TRY_VOID(layout.pack());
  if (context.stopped()) return fail(ErrorCode::kStopped, "atlas", "stopped");
  layout.warn_coarsened();
  layout.write(atlas);
  layout.measure(scene, atlas.report);
  return {};
}

}  // namespace oriel
