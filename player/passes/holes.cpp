#include "player/passes/holes.h"

#include <algorithm>

#include "player/passes/scene_pass.h"

namespace oriel {

HoleCount count_holes(const FrameTarget& frame, GLint value, const ImageTarget& image, const ImageRect& rect) {
  const int width = frame.light.width(), height = frame.light.height();
  std::vector<Vec4> reflected(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  std::vector<std::uint8_t> stencil(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  image.sharp_framebuffer.bind();
  glReadPixels(0, 0, rect.width, rect.height, GL_RGBA, GL_FLOAT, reflected.data());
  frame.framebuffer.bind();
  glReadPixels(0, 0, width, height, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
  HoleCount count;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (static_cast<GLint>(stencil[static_cast<std::size_t>(y * width + x)] & kReflectorBits) != value) continue;
      const Vec2 at = Vec2(x, y) + 0.5f - rect.origin;
      const int column = std::clamp(static_cast<int>(at.x), 0, rect.width - 1);
      const int row = std::clamp(static_cast<int>(at.y), 0, rect.height - 1);
      ++count.pixels;
      count.holes += reflected[static_cast<std::size_t>(row * rect.width + column)].a == 0;
    }
  return count;
}

}  // namespace oriel
