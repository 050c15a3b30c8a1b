#include "player/scene/live_page.h"

#include <algorithm>

#include "formats/core/color.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 128;  // points that a thread takes at once
constexpr float kNone = -1;        // of what is kept: not known
constexpr int kFarthest = 8;       // texels, that one is asked for it

// Of points that lie one after the other: at(number of the point, sums for its thread, totals).
template <class At>
LiveTotals each(const LiveWork& work, std::size_t first, std::size_t end, const At& at) {
  std::vector<LiveTotals> runs((end - first + kRun - 1) / kRun);
  for_each_parallel(runs.size(), core_count(), [&](std::size_t run) {
    if (work.stop != nullptr && *work.stop) return;
    LiveSums live(work.scene, work.lights);
    const std::size_t begin = first + run * kRun;
    for (std::size_t k = begin; k < std::min(begin + kRun, end); ++k) at(k, live, runs[run]);
  });
  LiveTotals totals;
  for (const LiveTotals& sums : runs) totals += sums;
  return totals;
}

std::size_t first_finer(const LightmapPage& page, const std::vector<PagePoint>& points) {
  const auto at = std::ranges::lower_bound(points, page.irradiance.size(), {}, &PagePoint::index);
  return static_cast<std::size_t>(at - points.begin());
}

class Change {
 public:
  struct From {
    const LiveWork& work;
    std::uint32_t number;
    const LightmapPage& page;
    const std::vector<PagePoint>& points;
    const BakedShare& baked;
    const BouncedLight* bounced;
  };
  Change(const From& from, std::vector<LiveSum> direct)
      : in_(from),
        direct_(std::move(direct)),
        indirect_(from.page.irradiance.size()),
        known_(from.page.irradiance.size(), 0),
        kept_(from.page.irradiance.size(), kNone),
        change_{std::vector<Vec3>(from.page.irradiance.size(), Vec3(0)),
                std::vector<Vec3>(from.page.detail.size(), Vec3(0))} {}

  LiveTotals run() {
    const std::vector<PagePoint>& points = in_.points;
    const std::size_t finer = first_finer(in_.page, points);
    LiveTotals totals;
    const std::span<const PagePoint> texels(points.data(), finer);
    for (std::size_t k = 0; k < finer; ++k) at_texel(k), known_[points[k].index] = 1;
    keep_from_neighbours(texels);
    for (std::size_t k = 0; k < finer; ++k) {
      const std::uint32_t i = points[k].index;
      change_.light[i] = settle(k, direct_[i], indirect_[i], kept_[i], totals);
    }
    totals += each(in_.work, finer, points.size(),
                   [&](std::size_t k, LiveSums& live, LiveTotals& sums) { at_finer(k, live, sums); });
    fill_from_neighbours(in_.page, known_, change_.light);
    return totals;
  }
  PageChange take() { return std::move(change_); }

 private:
  // What is added at point k. around: what is kept of the bake's where the sums do not say.
  Vec3 settle(std::size_t k, const LiveSum& direct, const LiveSum& indirect, float around, LiveTotals& sums) const {
    LiveSum both = direct;
    both += indirect;
    const float kept = both.kept().value_or(around);
    sums.now += double{luminance(both.now)};
    sums.kept += double{kept};
    sums.points += 1;
    const Vec3 sharp = in_.baked.sharp.empty() ? Vec3(0) : in_.baked.sharp[k];
    return both.now - kept * both.baked - (1 - kept) * (own_at(in_.points[k].index) + sharp) + sharp;
  }

  Vec3 own_at(std::size_t index) const {
    const PageChange& own = in_.baked.own;
    if (own.empty()) return Vec3(0);
    const std::size_t texels = in_.page.irradiance.size();
    return index < texels ? own.light[index] : own.detail[index - texels];
  }

  LiveSum indirect(std::size_t k) const { return in_.bounced != nullptr ? in_.bounced->at(in_.number, k) : LiveSum(); }

  void at_texel(std::size_t k) {
    const std::uint32_t index = in_.points[k].index;
    indirect_[index] = indirect(k);
    LiveSum both = direct_[index];
    both += indirect_[index];
    kept_[index] = both.kept().value_or(kNone);
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

  // What the four texels around have; null: the bake has none there.
  std::array<const LiveSum*, 4> corners_of(const TexelsAround& around, const std::vector<LiveSum>& sums_of) const {
    std::array<const LiveSum*, 4> corners{};
    for (std::size_t c = 0; c < 4; ++c)
      if (known_[around.texel[c]] != 0) corners[c] = &sums_of[around.texel[c]];
    return corners;
  }

  // Bounced light is smooth between texels. So is direct light where all four see all of the lamp, or nothing
  // (Barczak's classes of patches); elsewhere a finer point has rays of its own.
  void at_finer(std::size_t k, LiveSums& live, LiveTotals& sums) {
    const PagePoint& point = in_.points[k];
    const TexelsAround around = texels_around(in_.page, point);
    const auto bounced_at = corners_of(around, indirect_), direct_at = corners_of(around, direct_);
    const bool alone = std::ranges::all_of(direct_at, [](const LiveSum* corner) { return corner == nullptr; });
    const LiveSum bounced = alone ? indirect(k) : mix_sums(bounced_at, around.weight);
    const bool smooth = !alone && (in_.work.coarse || is_smooth(direct_at));
    const LiveSum direct = smooth ? mix_sums(direct_at, around.weight) : live.at(point.position, point.normal);
    if (smooth) sums.between += 1;
    const std::size_t i = point.index - in_.page.irradiance.size();
    change_.detail[i] = settle(k, direct, bounced, kept_around(direct_at), sums);
  }

  static bool is_smooth(const std::array<const LiveSum*, 4>& corners) {
    return std::ranges::all_of(corners, [&](const LiveSum* corner) {
      return corner != nullptr && corners[0] != nullptr && corner->sees_now != SeenLights::kSome &&
             corner->sees_baked != SeenLights::kSome && corner->sees_now == corners[0]->sees_now &&
             corner->sees_baked == corners[0]->sees_baked;
    });
  }

  float kept_around(const std::array<const LiveSum*, 4>& direct_at) const {
    float sum = 0, count = 0;
    for (const LiveSum* corner : direct_at)
      if (corner != nullptr) sum += kept_[static_cast<std::size_t>(corner - direct_.data())], ++count;
    return count > 0 ? sum / count : whole_;
  }

  const From in_;
  std::vector<LiveSum> direct_, indirect_;  // by texel
  std::vector<std::uint8_t> known_;
  std::vector<float> kept_;  // by texel
  float whole_ = 1;          // on the page as a whole
  PageChange change_;
};

}  // namespace

LivePage::LivePage(const LiveWork& work, std::uint32_t number, const LightmapPage& page,
                   const std::vector<PagePoint>& points)
    : work_(work), number_(number), page_(page), points_(points) {}

std::vector<LiveSum> LivePage::direct() const {
  std::vector<LiveSum> sums(page_.irradiance.size());
  each(work_, 0, first_finer(page_, points_), [&](std::size_t k, LiveSums& live, LiveTotals&) {
    sums[points_[k].index] = live.at(points_[k].position, points_[k].normal);
  });
  return sums;
}

PageChange LivePage::change(std::vector<LiveSum> direct, const BakedShare& baked, const BouncedLight* bounced,
                            LiveTotals& totals) const {
  Change change({work_, number_, page_, points_, baked, bounced}, std::move(direct));
  totals += change.run();
  return change.take();
}

}  // namespace oriel
