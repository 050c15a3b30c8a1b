// The light of lamps that are not where they were baked, as what it changes in the lightmap: so all that reads the
// lightmap shows it, from everywhere, and while nothing moves it costs nothing.
#pragma once

#include <map>
#include <memory>

#include "formats/pack/pack.h"
#include "formats/query/emitter_views.h"
#include "formats/query/live_sums.h"
#include "formats/query/page_points.h"
#include "player/images/image_source.h"
#include "player/navigation/lamps.h"
#include "player/scene/frame_options.h"

namespace oriel {

// Of a lamp that was moved.
struct LiveReport {
  std::string lamp;
  std::size_t lights = 0;
  std::size_t points = 0, between = 0;  // the latter without rays of their own
  double seconds = 0;
  std::uint32_t rays = 0;  // a texel, that bring bounced light
  float last = 0;          // of its light, what one bounce more would add
  float kept = 0;          // mean share of what the bake knows of it that still counts
  std::string through;     // the part that it goes through; empty: none
  bool reaches_nothing = false;
  bool outside = false;  // its centre is outside of the box around all that was baked
};
std::string text_of(const LiveReport& report);

class LiveLamps {
 public:
  // Of a pack as it was baked: its lamps may then shine otherwise. Both outlive it.
  LiveLamps(const Pack& pack, const ImageSource& images);
  ~LiveLamps();

  // By light group; with as many poses. Whether light is otherwise than at the last call. What is not in the background
  // takes seconds for each lamp that moved. In the background light follows in two steps, of few lights and of all, one
  // lamp after the other: the one of most flux, times the calls since it was last told, first. Errors of images.
  Result<bool> place(std::span<const MoverPose> poses, const LiveSettings& settings);
  // The pack's textures have texels that they had not: what their colours reflect is followed anew.
  void look_again();
  // Whether the next place() in the background has more to show, or to begin.
  bool ready() const;
  // What is added to pages where each group's lamps shine so many times as they were baked; null: nothing.
  std::shared_ptr<const PageChanges> changes(std::span<const Vec3> factors) const;
  // Whether changes() has something of a group: then all of its direct light, sharp light too.
  bool has_changed(std::size_t group) const;
  // Which planar reflectors show a group's lamp in closed form, and what of it they see, polygons by LightGroup's
  // emitters. Of a lamp that was moved, and of none before all of its light is there.
  std::span<const EmitterView> views(std::size_t group) const;
  // Of lamps whose light is all there, each once.
  std::vector<LiveReport> take_reports() { return std::exchange(reports_, {}); }

 private:
  struct Lamp;
  struct Job;
  Result<Lamp*> lamp_of(std::size_t group);
  std::unique_ptr<LampScene> scene_of(std::size_t group) const;
  LiveLight point_of(const LightGroup& group, const Vec3& baked, const Mat4& pack_from_lamp) const;
  std::unique_ptr<Job> begin(std::size_t group, const LiveSettings& settings, bool coarse);
  bool finish(Job& job);
  Result<bool> step_in_background(const LiveSettings& settings);

  const Pack& pack_;
  const ImageSource& images_;
  std::vector<Vec3> emission_;       // by material
  std::vector<BrightLight> lights_;  // of the light field
  std::vector<Emitter> emitters_;
  std::vector<std::int64_t> shown_by_;                  // as EmitterQuestion::of, by emitter
  std::vector<float> alphas_;                           // of lobes, by reflector
  Vec3 least_, most_;                                   // of all that was baked
  std::map<std::size_t, std::unique_ptr<Lamp>> lamps_;  // that were ever moved, by group
  LiveSettings settings_;
  std::vector<LiveReport> reports_;
  std::unique_ptr<Job> job_;  // in the background
};

}  // namespace oriel
