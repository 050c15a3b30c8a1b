// What a lamp that has moved changes on one page of the lightmap.
#pragma once

#include <atomic>
#include <span>

#include "formats/query/live_bounces.h"
#include "formats/query/page_points.h"
#include "player/images/image_data.h"
#include "player/scene/frame_options.h"

namespace oriel {

// Sums over points.
struct LiveTotals {
  double now = 0, kept = 0;        // the lamp's light, lux; as LiveSum
  double points = 0, between = 0;  // the latter: without rays of their own
  void operator+=(const LiveTotals& o) { now += o.now, kept += o.kept, points += o.points, between += o.between; }
};

// What the bake knows of the lamp on a page; either may be empty.
struct BakedShare {
  const PageChange& own;        // in the page's light
  std::span<const Vec3> sharp;  // beside it, by point
};

// A lamp's light at one pose.
struct LiveWork {
  const LampScene& scene;
  LightPair lights;
  bool coarse = false;                      // finer points lie between texels
  const std::atomic<bool>* stop = nullptr;  // ends it early: what it gives is of no use then
};

// In all threads. Texels come first; finer points take from them what is smooth in between: bounced light, and direct
// light where the texels around see the whole lamp, or nothing of it.
class LivePage {
 public:
  // Of page `number`: its state and finer cells, and its points. All outlive it.
  LivePage(const LiveWork& work, std::uint32_t number, const LightmapPage& page, const std::vector<PagePoint>& points);
  // What lights give texels without what they bring of other surfaces, by texel. Moved away: change() has no need of
  // it.
  std::vector<LiveSum> direct() const;
  // Light that is to be added where the lamp's sharp light is left out. bounced: light that comes by way of texels;
  // null: none.
  PageChange change(std::vector<LiveSum> direct, const BakedShare& baked, const BouncedLight* bounced,
                    LiveTotals& totals) const;

 private:
  const LiveWork& work_;
  std::uint32_t number_;
  const LightmapPage& page_;
  const std::vector<PagePoint>& points_;
};

}  // namespace oriel
