// What the current context can do.
#pragma once

#include <string>

#include "formats/core/result.h"

namespace oriel::gpu {

// The GLSL that shaders are given a prefix for.
enum class Dialect { kDesktop330, kEs300 };

struct Device {
  Dialect dialect = Dialect::kDesktop330;
  std::string vendor, renderer, version;
  int texture_size = 0;      // largest width or height of a texture and of a viewport
  int array_layers = 0;      // of a texture array
  int samples = 1;           // of a pixel that can be drawn and read: 1 where it has no multisample textures
  float point_size_max = 1;  // pixels
  // Whether timer queries tell passes apart: OpenGL 3.3 has them, but a rasteriser that draws tile by tile (llvmpipe)
  // draws passes into one framebuffer together, and each one's time is that of all.
  bool pass_timers = false;
  // Whether it shades what is hidden like what is seen wherever a pixel has several samples, as llvmpipe does, and can
  // tell which triangles are seen (shaders/passes/seen.frag).
  bool shades_hidden = false;
};

// Reads the current context and sets the state that all passes assume. Error kRuntime where there is none, or less than
// OpenGL 3.3 core (or OpenGL ES 3.0).
Result<Device> open_device();

// The first OpenGL error since the last call as a Status naming `where`; clears all of them.
Status check_gl(const char* where);

}  // namespace oriel::gpu
