// Everything an .oriel pack holds, in memory. docs/notes/format.md is the specification of the file.
#pragma once

#include <string>
#include <vector>

#include "formats/assets/brdf_kernel.h"
#include "formats/assets/camera.h"
#include "formats/assets/day.h"
#include "formats/assets/emitter.h"
#include "formats/assets/fresnel_map.h"
#include "formats/assets/light_field.h"
#include "formats/assets/light_group.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/map_mesh.h"
#include "formats/assets/material.h"
#include "formats/assets/mesh.h"
#include "formats/assets/mover.h"
#include "formats/assets/radiance_map.h"
#include "formats/assets/sharp_light.h"
#include "formats/assets/sky_map.h"
#include "formats/assets/surround_map.h"
#include "formats/assets/walk_grid.h"
#include "formats/core/bytes.h"
#include "formats/query/visible_sets.h"

namespace oriel {

// An optional section that this version does not know, kept as it lies in the file so that rewriting a pack loses
// nothing.
struct UnknownSection {
  std::uint32_t kind = 0;
  std::uint32_t codec = 0;
  std::uint64_t raw_bytes = 0;
  std::uint64_t count = 0;  // elements, as its section's record says
  Bytes stored;
};

struct Pack {
  // In pack.cpp, so that not every file compiles them.
  Pack();
  ~Pack();
  Pack(const Pack&);
  Pack(Pack&&) noexcept;
  Pack& operator=(const Pack&);
  Pack& operator=(Pack&&) noexcept;

  // JSON: tool, version, every option, seed, hashes of the inputs.
  std::string provenance;
  // JSON: what was modelled, what was omitted and why, errors and costs per stage.
  std::string plan;
  Mesh mesh;
  Vec3 sky{0};     // mean radiance of the sky, cd/m²
  SkyMap sky_map;  // how it differs by direction
  std::vector<Material> materials;
  std::vector<SolidGlass> solids;                  // by rising material
  std::vector<EmissionTexture> emission_textures;  // by rising material
  std::vector<Metalness> metalness;                // by rising material
  std::vector<Texture> textures;
  std::vector<Texture> normal_textures;
  std::vector<LightmapPage> lightmaps;
  SharpLight sharp_light;  // of lightmaps
  std::vector<Reflector> reflectors;
  std::vector<RadianceMap> radiance_maps;
  std::vector<MapMesh> map_meshes;  // of each radiance map, or none
  std::vector<Emitter> emitters;    // that reflectors show in closed form
  // Lit sides of flat frosted panes, z towards the light: their emitters are what shines on them, which eyes behind see
  // spread. Without maps.
  std::vector<Reflector> frosted_panes;
  std::vector<CurvedReflector> curved_reflectors;
  std::vector<SurroundMap> surround_maps;
  std::vector<BrdfKernel> kernels;
  std::vector<FresnelMap> fresnel_maps;
  std::vector<Camera> cameras;
  std::vector<CameraPath> paths;
  std::vector<WalkGrid> walk_grids;  // by storey
  VisibleSets visible_sets;          // of mesh and walk grids; empty: all is drawn from everywhere
  ReflectedSets reflected_sets;      // of reflectors, in the groups of visible_sets; empty: all is drawn in each
  std::vector<Mover> movers;
  std::vector<LightGroup> light_groups;  // none: lamps shine as they were baked
  std::vector<PageGroups> page_groups;   // of each lightmap page at most one
  Day day;                               // whose hours are light groups; none where it is empty
  LightField light_field;                // that movers are lit by; none where bands is 0
  std::vector<UnknownSection> unknown;
};

}  // namespace oriel
