// An OpenGL context without a window or a display server (EGL): of a device where there is one, else of a software
// rasteriser. Draw into framebuffers only.
#pragma once

#include <memory>

#include "formats/core/result.h"
#include "player/gpu/device.h"

namespace oriel::gpu {

class HeadlessContext {
 public:
  // OpenGL 3.3 core, or OpenGL ES 3.0, current on this thread. Error kRuntime names what EGL refused.
  static Result<std::unique_ptr<HeadlessContext>> create(Dialect dialect = Dialect::kDesktop330);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  HeadlessContext() = default;
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace oriel::gpu
