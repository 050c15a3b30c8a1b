#include "player/scene/live_page.h"

#include <algorithm>

#include "formats/core/color.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 128;  // points that a thread takes at once
constexpr float kNone = -1;        // of what is kept: not known
constexpr int kFarthest = 8;       // texels, that one is asked for it

// What is added where the bake has `own` of the lamp.
Vec3 added_light(const LiveSum& sum, LiveMode mode, float kept, const Vec3& own) {
  switch (mode) {
    case LiveMode::kDifferential:
      return sum.now - sum.baked;
    case LiveMode::kOnly:
      return sum.now - own;
    case LiveMode::kFitted:
      break;
  }
  return sum.now - kept * sum.baked - (1 - kept) * own;
}

class Work {
 public:
  explicit Work(const LivePage& in)
      : in_(in),
        direct_(in.page.irradiance.size()),
        indirect_(in.page.irradiance.size()),
        known_(in.page.irradiance.size(), 0),
        kept_(in.page.irradiance.size(), kNone),
        change_{std::vector<Vec3>(in.page.irradiance.size(), Vec3(0)),
                std::vector<Vec3>(in.page.detail.size(), Vec3(0))} {}

  LiveTotals run() {
    const std::span<const PagePoint> points(in_.points);
    const std::size_t texels = in_.page.irradiance.size();
    const auto first_finer = std::ranges::lower_bound(points, texels, {}, &PagePoint::index) - points.begin();
    const auto of_texels = points.first(static_cast<std::size_t>(first_finer)),
               finer = points.subspan(static_cast<std::size_t>(first_finer));
    LiveTotals totals = each(of_texels, [&](const PagePoint& point, LiveSums& live, LiveTotals&) { ask(point, live); });
    for (const PagePoint& point : of_texels) known_[point.index] = 1;
    keep_from_neighbours(of_texels);
    for (const PagePoint& point : of_texels)
      change_.light[point.index] = settle(direct_[point.index], indirect_[point.index], kept_[point.index],
                                          in_.own.empty() ? Vec3(0) : in_.own.light[point.index], totals);
    totals +=
        each(finer, [&](const PagePoint& point, LiveSums& live, LiveTotals& sums) { at_finer(point, live, sums); });
    fill_from_neighbours(in_.page, known_, change_.light);
    return totals;
  }
  PageChange take() { return std::move(change_); }

 private:
  template <class At>
  LiveTotals each(std::span<const PagePoint> points, const At& at) const {
    std::vector<LiveTotals> runs((points.size() + kRun - 1) / kRun);
    for_each_parallel(runs.size(), core_count(), [&](std::size_t run) {
      if (in_.stop != nullptr && *in_.stop) return;
      LiveSums live(in_.scene, in_.lights);
      for (const PagePoint& point : points.subspan(run * kRun, std::min(kRun, points.size() - run * kRun)))
        at(point, live, runs[run]);
    });
    LiveTotals totals;
    for (const LiveTotals& sums : runs) totals += sums;
    return totals;
  }

  // around: what is kept where the sums do not say.
  Vec3 settle(const LiveSum& direct, const LiveSum& indirect, float around, const Vec3& own, LiveTotals& sums) const {
    LiveSum both = direct;
    both += indirect;
    const float kept = both.kept().value_or(around);
    sums.now += double{luminance(both.now)}, sums.missing += double{luminance(both.missing)};
    sums.kept += in_.mode == LiveMode::kFitted ? double{kept} : in_.mode == LiveMode::kOnly ? 0.0 : 1.0;
    sums.points += 1;
    return added_light(both, in_.mode, kept, own);
  }

  void ask(const PagePoint& point, LiveSums& live) {
    LiveSum &direct = direct_[point.index], &indirect = indirect_[point.index];
    direct = live.at(LivePart::kDirect, point.position, point.normal),
    indirect = live.at(LivePart::kIndirect, point.position, point.normal);
    LiveSum both = direct;
    both += indirect;
    kept_[point.index] = both.kept().value_or(kNone);
  }

  // Where no light of the lamp was asked to come, as around; far from all that know as the page on the whole.
  void keep_from_neighbours(std::span<const PagePoint> texels) {
    double products = 0, squares = 0;
    for (const PagePoint& t : texels)
      for (const LiveSum* sum : {&direct_[t.index], &indirect_[t.index]})
        products += sum->products, squares += sum->squares;
    const float whole = squares > 0 ? static_cast<float>(std::clamp(products / squares, 0.0, 1.0)) : 1.0f;
    const std::vector<float> known = kept_;
    const int width = static_cast<int>(in_.page.width), height = static_cast<int>(in_.page.height);
    for (const PagePoint& t : texels) {
      const int x = static_cast<int>(t.index) % width, y = static_cast<int>(t.index) / width;
      for (int far = 1; kept_[t.index] == kNone && far <= kFarthest; ++far) {
        float sum = 0, count = 0;
        for (int v = std::max(y - far, 0); v <= std::min(y + far, height - 1); ++v)
          for (int u = std::max(x - far, 0); u <= std::min(x + far, width - 1); ++u)
            if (const float kept = known[static_cast<std::size_t>(v * width + u)]; kept != kNone) sum += kept, ++count;
        if (count > 0) kept_[t.index] = sum / count;
      }
      if (kept_[t.index] == kNone) kept_[t.index] = whole;
    }
    whole_ = whole;
  }

  // The four texels around; null: the bake has none there.
  void around(const PagePoint& point, const std::vector<LiveSum>& sums_of, const LiveSum* (&corners)[4],
              Vec2& shares) const {
    const IVec2 last(static_cast<int>(in_.page.width) - 1, static_cast<int>(in_.page.height) - 1);
    const IVec2 first = glm::clamp(IVec2(glm::floor(point.at)), IVec2(0), last);
    shares = glm::clamp(point.at - Vec2(first), 0.0f, 1.0f);
    for (int c = 0; c < 4; ++c) {
      const IVec2 t = glm::min(first + IVec2(c & 1, c >> 1), last);
      const auto texel = static_cast<std::size_t>(t.y) * in_.page.width + static_cast<std::size_t>(t.x);
      corners[c] = known_[texel] != 0 ? &sums_of[texel] : nullptr;
    }
  }

  // Bounced light is smooth between texels. So is direct light where all four see all of the lamp, or nothing
  // (Barczak's classes of patches); elsewhere a finer point has rays of its own.
  void at_finer(const PagePoint& point, LiveSums& live, LiveTotals& sums) {
    const LiveSum* corners[4];
    Vec2 shares;
    around(point, indirect_, corners, shares);
    const bool surrounded = std::ranges::find(corners, nullptr) == std::end(corners);
    const LiveSum indirect =
        surrounded ? mix_sums(corners, shares) : live.at(LivePart::kIndirect, point.position, point.normal);
    bool smooth = surrounded;
    around(point, direct_, corners, shares);
    for (int c = 0; c < 4 && smooth; ++c)
      smooth = corners[c]->sees_now != SeenLights::kSome && corners[c]->sees_baked != SeenLights::kSome &&
               corners[c]->sees_now == corners[0]->sees_now && corners[c]->sees_baked == corners[0]->sees_baked;
    smooth = smooth || (in_.coarse && surrounded);
    const LiveSum direct =
        smooth ? mix_sums(corners, shares) : live.at(LivePart::kDirect, point.position, point.normal);
    if (smooth) sums.between += 1;
    const std::size_t i = point.index - in_.page.irradiance.size();
    change_.detail[i] =
        settle(direct, indirect, kept_around(point), in_.own.empty() ? Vec3(0) : in_.own.detail[i], sums);
  }

  float kept_around(const PagePoint& point) const {
    const LiveSum* corners[4];
    Vec2 shares;
    around(point, direct_, corners, shares);
    float sum = 0, count = 0;
    for (const LiveSum* corner : corners)
      if (corner != nullptr) sum += kept_[static_cast<std::size_t>(corner - direct_.data())], ++count;
    return count > 0 ? sum / count : whole_;
  }

  const LivePage& in_;
  std::vector<LiveSum> direct_, indirect_;  // by texel
  std::vector<std::uint8_t> known_;
  std::vector<float> kept_;  // by texel
  float whole_ = 1;          // on the page as a whole
  PageChange change_;
};

}  // namespace

PageChange live_change(const LivePage& page, LiveTotals& totals) {
  Work work(page);
  totals += work.run();
  return work.take();
}

}  // namespace oriel
