// The scene as all stages see it: what a bake and its plan begin with.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "bake/import/movers.h"
#include "bake/radiosity/lit_sides.h"
#include "bake/run/options.h"
#include "bake/run/stopwatch.h"
#include "bake/run/view_demand.h"

namespace oriel {

struct PreparedScene {
  std::unique_ptr<ImportedScene> imported;  // at one place: accel refers to it
  std::vector<TakenMover> movers;           // apart from the scene; empty where they stand still in it
  SidesReport sides;
  std::optional<Accel> accel;  // never empty
  bool unit_guessed = false;   // the file's numbers could not be metres
  WalkOptions walk;            // of people as tall as the scene is made for
  EyeRegion region;            // where people can be
  TexelDemand demand;          // what they want of the lightmap; empty before it is laid out
  Atlas atlas;
  std::vector<TexelMapPage> texel_map;
  std::vector<Warning> omissions;

  const Scene& scene() const { return imported->scene; }
  double texels() const;
  // Movers meet it, and the player knows of it where points and spots are that it moves.
  bool wants_light_field() const;
};

// Metres that a unit of the file is taken to be, where its rooms tell that it is not unit_m: as high as a tower, or as
// a matchbox. Warns then.
std::optional<double> guessed_unit(const Accel& accel, double unit_m, Context& context);

// Imports the scene (again, where its numbers cannot be metres), takes the movers out of it, finds how tall people are
// and where they can be, cuts what is near and far at once, splits the double-sided surfaces by the light on their
// sides. Errors as those stages give them.
Result<PreparedScene> prepare_scene(const BakeOptions& options, Stopwatch& timed, Context& context);
// Lays out the lightmap for what people see. With choose_texel no more texels than a first estimate of their light can
// do in a part of `seconds`, those that the bake has left; infinite: as many as are wanted. Errors as build_atlas.
Status lay_out_lightmap(const BakeOptions& options, Stopwatch& timed, Context& context, PreparedScene& prepared,
                        double seconds = std::numeric_limits<double>::infinity());

// By which the lightmap's error is told, and as many that verify it.
inline constexpr std::uint32_t kLightmapEyes = 1024;

PathOptions path_options(const BakeOptions& options);
// Kernels may differ by the error that the bake may have.
MaterialOptions material_options(const BakeOptions& options);
// Whether the lightmap is to hold directions; why not is noted.
bool choose_directional(const Scene& scene, Directional wanted, std::vector<Warning>& omissions);

// Warns where a scene has no light at all.
// Something that shines of itself, darker than white paint is on the mean under the lamps' direct light: it looks dead.
struct Outshone {
  std::string lamp, found, expected, fix;  // lamp: the strongest point or spot light
};
std::optional<Outshone> find_outshone(const Scene& scene, double area_m2);
// Tells of it, and of a scene without light.
void warn_about_light(const Scene& scene, const LightSet& lights, Context& context);

}  // namespace oriel
