// A pack as one page to look at: it needs neither network nor scripts.
#pragma once

#include <string>

#include "formats/pack/index.h"
#include "formats/pack/pack.h"

namespace oriel::report {

// What is left out beyond these is said in the page.
struct Limits {
  std::size_t surfaces = 200;         // those that receive most light first
  std::size_t pages = 12;             // lightmap pages
  std::size_t maps = 24;              // radiance maps, and as many surround maps
  std::size_t materials = 24;         // kernels, and as many Fresnel maps
  std::size_t lines = 400;            // of provenance, of the plan, of omissions
  std::uint32_t page_side = 512;      // pixels of the longer side of a lightmap page's pictures
  std::uint32_t map_side = 160;       // of a radiance or surround map's
  std::size_t surface_points = 4096;  // light is taken at so many points of a surface
};

// An HTML document about a pack that validate() finds no error in; name: what it is called, index: of its file. Its
// size is bounded by the limits.
std::string page_html(const Pack& pack, const PackIndex& index, const std::string& name, const Limits& limits = {});

}  // namespace oriel::report
