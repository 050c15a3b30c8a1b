// What a scene has, and which parts of a bake each of it asks for: "model only what the scene requires".
#pragma once

#include "bake/run/options.h"
#include "bake/run/prepare.h"
#include "bake/run/reflections.h"
#include "bake/run/visibility.h"

namespace oriel {

struct LightCensus {
  std::size_t points = 0, spots = 0, directionals = 0;  // punctual
  std::size_t profiles = 0;                             // measured (IES)
  std::size_t emitting_surfaces = 0, emitting_triangles = 0;
  enum class Sky { kNone, kConstant, kImage } sky = Sky::kNone;
  double power_lm = 0;  // luminance; of triangles, point and spot lights
  bool dark = false;    // no light at all
};

// What a material's lobe asks for, by its width.
enum class LobeKind {
  kUnlit,   // shown as it is
  kMatte,   // no specular lobe
  kMirror,  // α < 1e-5
  kGlossy,  // narrow or bright enough to show highlights: has a kernel
  kBroad,   // wider: what it reflects is shown as if it were diffuse
};

const char* name_of(LobeKind lobe);  // "unlit", "matte", "mirror", "glossy", "broad"

struct MaterialCensus {
  std::string name;
  LobeKind lobe = LobeKind::kMatte;
  float alpha = 1;        // GGX width of the lobe that shows an image
  float reflectance = 0;  // R at 60°, largest channel, [0,1]
  float transmission = 0;
  bool textured = false, normal_map = false, emits = false;
  double area_m2 = 0;
  double seen = 0;  // share of what eyes see, [0,1]
  // At most this share of the light that eyes see is reflected by it without an image: R times the share of the view
  // that is this material but no reflector, [0,1]. Exact for an even surrounding.
  double left_out = 0;
  std::int32_t kernel = -1;
};

struct ReflectorCensus {
  std::string name;
  bool planar = true;
  double area_m2 = 0;
  float reflectance = 0, alpha = 0;
};

// A part of the bake: whether it runs, and on how much.
struct StageCensus {
  std::string name;  // "radiosity", "sharp light", "directional", "radiance", "surround", "kernels", "fresnel",
                     // "movers", "visibility"
  bool runs = false;
  std::string why;                                             // one sentence
  std::vector<std::pair<std::string, std::uint64_t>> amounts;  // "texels", …
};

struct Census {
  std::size_t triangles = 0, surfaces = 0;
  Vec3 size_m{0};
  double area_m2 = 0;
  double walkable_m2 = 0;
  LightCensus lights;
  std::vector<MaterialCensus> materials;  // those that cover anything
  std::vector<ReflectorCensus> reflectors;
  std::vector<StageCensus> stages;
  std::vector<Warning> omissions;  // what is left out and why, as a bake would say
};

// What the census is taken of: stages' own findings, the same that a bake acts upon.
struct CensusInput {
  const BakeOptions& options;
  const PreparedScene& prepared;
  const LightSet& lights;
  const MaterialMaps& materials;
  const FoundReflections& reflections;
  const std::vector<double>& seen;  // ViewShares::front
};

Census take_census(const CensusInput& in);

}  // namespace oriel
