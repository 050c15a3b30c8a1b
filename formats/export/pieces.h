// A pack in pieces for a browser, in the order in which they are wanted. Each is a file of the pack's own format with
// some of its sections (docs/notes/web.md), so that one specification and one reader serve both.
#pragma once

#include <functional>
#include <string>

#include "formats/core/result.h"
#include "formats/pack/pack.h"

namespace oriel {

struct WebPiece {
  std::string kind;  // "scene", "sharp", "light", "texture", "normal", "sky", "field", "mover", "surround" or "lamps"
  std::size_t index = 0;  // of the pack's pages or textures; 0 for the scene
  Bytes bytes;
};

// What of a pack the viewer has no use for, or does not show: a line each, for people.
std::vector<std::string> left_out_of_pieces(const Pack& pack);

// Irradiance of a page at a quarter of its texels a side, of what is lit alone: what is shown until the page is there.
LightmapPage coarse_page(const LightmapPage& page);

// take is called for each piece; the first is the scene: all but images, with light at a quarter of its texels a side.
// Reflectors are written as ones without maps: the viewer draws the mirrored scene. Errors: those of take; kRuntime.
Status make_pieces(const Pack& pack, const std::function<Status(WebPiece)>& take);

}  // namespace oriel
