// What is asked of a frame, and what it cost.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "formats/assets/mover.h"
#include "formats/query/live_options.h"

namespace oriel {

// The stages of Bastos et al. 1999: what reflectors see (M), blurred (MK), modulated (MKR); the diffuse part (D); the
// frame. After those what the bake knows of texels, as colours: illuminance, its standard error, the texels themselves,
// the charts that they lie in.
enum class Show { kAll, kM, kMK, kMKR, kD, kLux, kError, kTexels, kCharts };
inline constexpr int kShows = 9;
inline bool is_survey(Show show) {
  return show >= Show::kLux;
}
// How M is made: as the bake chose, which is by the meshes of radiance maps where a reflector has maps; by drawing the
// mirrored scene; or not at all.
enum class Reflections { kChosen, kGeometry, kOff };
// How wide K is: by the distance of what is reflected, or a mirror's.
enum class Blur { kDistance, kOff };

// How movers meet bright lights: with shadows of their own, without any, or as harmonics like all other light.
enum class MoverLights { kShadowed, kUnshadowed, kHarmonics };

// The shade of movers in the light from everywhere.
struct ShadeSettings {
  std::uint32_t lights = 128;    // that stand for what surfaces and the sky send out; 0: no such shade
  bool every_pixel = false;      // of the frame, else of one of half its size
  std::uint32_t map_side = 128;  // texels of a light's map of the movers
  // Maps that are drawn in a frame, at most, while movers move; 0: all that are late.
  std::uint32_t maps_a_frame = 0;

  bool operator==(const ShadeSettings&) const = default;
};
inline constexpr std::uint32_t kMostShadeLights = 1024;

// Light of lamps that have moved.
struct LiveSettings {
  LiveOptions lights;
  bool in_background = false;  // light of lamps that moved comes later, coarse before fine; else a frame waits for it

  bool operator==(const LiveSettings&) const = default;
};

inline constexpr float kBudgetOfDevice = -1;

struct FrameOptions {
  Show show = Show::kAll;
  Reflections reflections = Reflections::kChosen;
  // Reflectors on the way of a reflection; none: two, and on while all of them are mirrors that keep half of the light.
  std::optional<int> orders = {};
  // Foretold time of planar reflectors' images: those that show most for their price are drawn (passes/image_budget.h).
  // At 1280 x 720; kBudgetOfDevice: what suits the device.
  float image_budget_ms = std::numeric_limits<float>::infinity();
  int maps_per_element = 2;  // radiance maps drawn for each reflector element in view, others in their holes; 0: none
  Blur blur = Blur::kDistance;
  bool visible_sets = true;  // draws only what the eye's place may see, where the pack knows
  int samples = 1;           // of a pixel at edges, as many as the device has
  bool halves = false;       // light in half floats where the scene is dark enough for them: frames are drawn sooner
  bool coarse = false;       // less work by pixel, for frames while something moves
  bool timed = false;        // each pass, which costs a little itself
  // Fills FrameStats::reflected_pixels to sharp: reads images back, which is slow.
  bool count_holes = false;
  std::vector<MoverPose> poses{};  // by Pack::movers; empty: all at rest
  std::vector<Vec3> lights{};      // by Pack::light_groups, times what was baked; empty: as baked
  std::vector<MoverPose> lamps{};  // by Pack::light_groups, from where they were baked; empty: all are there
  LiveSettings live{};             // of lamps that are not
  MoverLights mover_lights = MoverLights::kShadowed;
  ShadeSettings shade{};
  int light_points = 16;  // of each bright light, that movers' shadows are taken from: 1 to 16
  // Which it is of frames that are added up: lights' points and rays of frosted glass are others in each, even over
  // all.
  std::uint32_t look = 0;

  bool operator==(const FrameOptions&) const = default;
};

enum class Pass {
  kDepth,
  kMask,
  kReflect,
  kFill,
  kConvolve,
  kCompose,
  kEmitters,
  kCurved,
  kScene,
  kTransparent,
  kMovers
};
inline constexpr std::array<const char*, 11> kPassNames{
    "depth", "mask", "reflect", "fill", "convolve", "compose", "emitters", "curved", "scene", "transparent", "movers"};
using PassTimes = std::array<double, kPassNames.size()>;  // milliseconds

// Of the shade of movers in the light from everywhere.
struct ShadeStats {
  std::uint32_t lights = 0;           // of the scene
  std::uint32_t cells = 0;            // in view in which movers may block some of them
  std::uint64_t pairs = 0;            // of these cells and lights
  std::uint32_t maps = 0, faces = 0;  // drawn; the latter mover by mover
  std::uint32_t late = 0;             // maps that are still to be drawn
  double prepare_s = 0;               // for the scene, once
  // Milliseconds, where a frame is timed: what movers may block, maps, light.
  double cells_ms = 0, maps_ms = 0, light_ms = 0;
};

struct FrameStats {
  std::uint32_t draws = 0;
  std::uint64_t triangles = 0;
  // Groups of opaque triangles that may be seen from the eye's place, of how many; 0 where the pack does not know.
  std::uint32_t groups_seen = 0, groups = 0;
  std::uint32_t reflectors = 0;  // that had pixels in view
  // Bodies of glass and frosted panes that were drawn as such, in the frame and in images of reflectors.
  std::uint32_t glass = 0, mirrored_glass = 0;
  std::uint32_t maps = 0;          // radiance and surround maps chosen
  std::uint64_t image_pixels = 0;  // of planar reflectors' images, with their margins
  std::uint64_t map_bytes = 0;     // of all radiance and surround maps on the device so far
  // All images on the device; the most they ever were; how many are coarser than the pack's, or left out, for the
  // limit.
  std::uint64_t image_bytes = 0, most_image_bytes = 0;
  std::uint32_t coarser_images = 0, missing_images = 0;
  // Of opaque reflectors, where they are counted; of the pixels those of reflectors without a kernel.
  std::uint64_t reflected_pixels = 0, mirror_pixels = 0, holes = 0;
  ShadeStats shade;
  PassTimes ms{};  // by pass, where asked for
};

}  // namespace oriel
