// What a lamp that has moved changes on one page of the lightmap.
#pragma once

#include <atomic>

#include "formats/query/live_sums.h"
#include "formats/query/page_points.h"
#include "player/images/image_data.h"
#include "player/scene/frame_options.h"

namespace oriel {

// Sums over points.
struct LiveTotals {
  double now = 0, missing = 0, kept = 0;  // the lamp's light, lux; as LiveSum
  double points = 0, between = 0;         // the latter: without rays of their own
  void operator+=(const LiveTotals& o) {
    now += o.now, missing += o.missing, kept += o.kept, points += o.points, between += o.between;
  }
};

struct LivePage {
  const LampScene& scene;
  LightPair lights;
  LiveMode mode = LiveMode::kFitted;
  const LightmapPage& page;                 // its state and finer cells
  const std::vector<PagePoint>& points;     // of it
  const PageChange& own;                    // what the bake knows of the lamp there; may be empty for kDifferential
  bool coarse = false;                      // finer points lie between texels
  const std::atomic<bool>* stop = nullptr;  // ends it early: what it gives is of no use then
};
// Light that is to be added, in all threads. Texels come first; finer points take from them what is smooth in between:
// bounced light, and direct light where the texels around see the whole lamp, or nothing of it.
PageChange live_change(const LivePage& page, LiveTotals& totals);

}  // namespace oriel
