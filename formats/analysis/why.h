// Why a place of a scene is lit as it is: what hides it, what it coincides with, which lights reach it and which do
// not.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/pack/pack.h"
#include "formats/query/mesh_rays.h"

namespace oriel {

enum class Cause {
  kUnlit,       // nothing was baked for it: it shows its colour
  kBlack,       // nothing was baked for it: it has no diffuse reflection
  kCoincident,  // another surface lies in the same place
  kInside,      // inside other geometry
  kCovered,     // something lies on it
  kFilled,      // its texel holds its neighbours' light
  kSeenBehind,  // the eye sees the back of a one-sided surface
  kNoLight,     // the scene has none
  kFacesAway,   // all lights are behind it
  kShadow,      // all lights are hidden from it
  kSeesBacks,   // it sees backs of one-sided surfaces, which reflect nothing
  kIndirect,    // no light reaches it but by reflection
};
const char* name_of(Cause cause);  // "unlit", "coincident", …

// What, by whom, so what, and what to do.
struct Reason {
  Cause cause = Cause::kUnlit;
  std::string object;  // the surface, material or light that does it; may be empty
  std::string text, fix;
};

// What a light of the scene does there.
struct LightVerdict {
  enum class Kind { kLights, kFacesAway, kTurnedAway, kHidden };
  std::string light;
  Kind kind = Kind::kLights;
  std::string by;        // kHidden: the surface that is met first
  float share = 0;       // of the light's points that are in sight
  float distance_m = 0;  // to the nearest of them; 0 for the sky and suns
};

struct Why {
  std::string surface, material;
  DVec3 at{0};             // on the surface, world metres
  float off_m = 0;         // from what was asked for
  Vec3 normal{0, 1, 0};    // of the front
  std::int32_t page = -1;  // of its texel; -1: none
  IVec2 texel{0};
  TexelState state = TexelState::kEmpty;
  float side_m = 0;  // of the texel, on the surface
  double lux = 0, lux_error = 0;
  std::optional<double> sharp_lux{};  // of lamps that shine by the pixel: at this very place, whatever its texel has
  bool dark = false;                  // less than a thousandth of its page's mean
  std::vector<Reason> reasons;        // those that weigh most first; never empty where it is dark
  std::vector<LightVerdict> lights;
  std::size_t lights_left_out = 0;  // beyond the first ones
  float near_share = 0;             // of what it sees that is nearer than a texel, and what that is
  std::string near_by;
};

struct WhyOptions {
  float reach_m = 0.5f;       // from the place to the nearest surface
  std::optional<Vec3> eye{};  // pack space: who asks, seeing its side of the surface
};

// A page of the lightmap; null: not there.
using WhyPage = std::function<const LightmapPage*(std::uint32_t page)>;

// Of the surface nearest to a place, pack space; nothing where none is in reach. Some hundred rays. rays: of
// the pack's mesh.
std::optional<Why> why_at(const Pack& pack, const MeshRays& rays, const Vec3& place, const WhyOptions& options,
                          const WhyPage& page_of);
inline std::optional<Why> why_at(const Pack& pack, const Vec3& place, const WhyOptions& options = {}) {
  return why_at(pack, MeshRays(pack.mesh), place, options, [&](std::uint32_t page) { return &pack.lightmaps[page]; });
}

// "'lamp' is hidden by 'screen'".
std::string verdict_text(const LightVerdict& light);
// For people, some lines; and for programs.
std::string why_text(const Why& why);
std::string why_json(const Why& why);

}  // namespace oriel
