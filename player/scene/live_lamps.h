// The light of lamps that are not where they were baked, as what it changes in the lightmap: so all that reads the
// lightmap shows it, from everywhere, and while nothing moves it costs nothing.
#pragma once

#include <map>
#include <memory>

#include "formats/pack/pack.h"
#include "formats/query/live_sums.h"
#include "formats/query/page_points.h"
#include "player/images/image_source.h"
#include "player/navigation/lamps.h"
#include "player/scene/frame_options.h"

namespace oriel {

// Of a lamp that was moved.
struct LiveReport {
  std::string lamp;
  std::size_t lights = 0, direct = 0, points = 0;
  double seconds = 0;
  float missing = 0;        // over the light that it gives: what lights' extent takes of it near them
  float left = 0;           // of its flux, what walks did not follow
  float kept = 0;           // mean share of what the bake knows of it that still counts
  std::string through;      // the part that it goes through; empty: none
  bool reaches_nothing = false;
};
std::string text_of(const LiveReport& report);

class LiveLamps {
 public:
  // Of a pack as it was baked, which outlives it; its lamps may then shine otherwise.
  LiveLamps() = default;
  explicit LiveLamps(const Pack& pack);

  // Lamps as FrameOptions has them. Whether anything is otherwise than at the last call. Takes seconds for a lamp that
  // moved. Errors of images.
  Result<bool> place(const Pack& pack, const ImageSource& images, std::span<const MoverPose> poses,
                     const LiveSettings& settings);
  // What is added to pages where each group's lamps shine so many times as they were baked; null: nothing.
  std::shared_ptr<const PageChanges> changes(std::span<const Vec3> factors) const;
  // Of lamps that were computed since the last call.
  std::vector<LiveReport> take_reports() { return std::exchange(reports_, {}); }

 private:
  struct Lamp {
    std::unique_ptr<LiveScene> scene;
    std::vector<std::vector<PagePoint>> points;  // by page
    std::vector<LightmapPage> pages;             // what fill_from_neighbours() wants of them
    MoverPose pose;
    PageChanges added;  // with its light as it was baked
  };
  Result<std::unique_ptr<Lamp>> begin(const Pack& pack, const ImageSource& images, std::size_t group) const;
  Status compute(const ImageSource& images, std::size_t group, const LiveSettings& settings, Lamp& lamp,
                 LiveReport& report) const;

  std::vector<Vec3> emission_;        // by material
  std::vector<BrightLight> lights_;   // of the light field
  std::map<std::size_t, std::unique_ptr<Lamp>> lamps_;  // that were ever moved, by group
  LiveSettings settings_;
  std::vector<LiveReport> reports_;
};

}  // namespace oriel
