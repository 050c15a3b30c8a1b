// Two-dimensional textures.
#pragma once

#include <algorithm>

#include "formats/core/result.h"
#include "formats/core/vec.h"
#include "player/gpu/handle.h"

namespace oriel::gpu {

struct TextureFormat {
  GLenum internal = GL_RGBA8;
  GLenum format = GL_RGBA;
  GLenum type = GL_UNSIGNED_BYTE;
  int bytes_per_texel = 4;
};

// All of them exist in OpenGL ES 3.0 too. Filtering or drawing to the 32-bit float one needs extensions there
// (OES_texture_float_linear, EXT_color_buffer_float).
inline constexpr TextureFormat kSrgbAlpha8{GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
inline constexpr TextureFormat kRgba8{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
inline constexpr TextureFormat kRgba16f{GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8};
inline constexpr TextureFormat kRgba32f{GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
inline constexpr TextureFormat kRgba16i{GL_RGBA16I, GL_RGBA_INTEGER, GL_SHORT, 8};
inline constexpr TextureFormat kRgba32ui{GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 16};
inline constexpr TextureFormat kR8{GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1};
inline constexpr TextureFormat kR32ui{GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
inline constexpr TextureFormat kRgb9e5{GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, 4};
inline constexpr TextureFormat kR32f{GL_R32F, GL_RED, GL_FLOAT, 4};
// These two are extensions there (EXT_texture_norm16).
inline constexpr TextureFormat kR16{GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2};
// In perspective as fine as a float for what is farther than twice the near plane, and half its bytes.
inline constexpr TextureFormat kDepthStencil{GL_DEPTH24_STENCIL8, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 4};
inline constexpr TextureFormat kDepth32f{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, 4};

struct TextureOptions {
  GLenum min_filter = GL_NEAREST;
  GLenum mag_filter = GL_NEAREST;
  GLenum wrap_s = GL_CLAMP_TO_EDGE;
  GLenum wrap_t = GL_CLAMP_TO_EDGE;
  int levels = 1;             // mip levels that are allocated
  bool compare = false;       // depth: a lookup says whether its reference is nearer or as near
  bool make_mipmaps = false;  // fill the levels from level 0
};

class Texture2d {
 public:
  Texture2d() = default;
  // pixels: rows of width texels, row 0 first (v = 0), or nullptr for undefined contents. The caller keeps width and
  // height in [1, limits().texture_size].
  Texture2d(const TextureFormat& format, int width, int height, const void* pixels, const TextureOptions& options = {});

  // All of a level; some of its rows; a rectangle of it.
  void upload(int level, const void* pixels) const { upload(level, 0, std::max(1, height_ >> level), pixels); }
  void upload(int level, int row, int rows, const void* pixels) const;
  void upload(int level, const IVec2& at, const IVec2& size, const void* pixels) const;
  void bind(int unit) const;
  // Fills the coarser levels from the finest.
  void make_mipmaps() const;
  GLuint name() const { return handle_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }
  int levels() const { return levels_; }
  std::size_t bytes() const { return bytes_; }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<ObjectKind::kTexture> handle_;
  TextureFormat format_;
  int width_ = 0, height_ = 0, levels_ = 1;
  std::size_t bytes_ = 0;
};

// Several samples a pixel, to be drawn into and read sample by sample. Desktop OpenGL only.
class MultisampleTexture {
 public:
  MultisampleTexture() = default;
  // The caller keeps samples within the device's, which may give more than are asked for. Contents are undefined.
  MultisampleTexture(const TextureFormat& format, int width, int height, int samples);
  void bind(int unit) const;
  GLuint name() const { return handle_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<ObjectKind::kTexture> handle_;
  int width_ = 0, height_ = 0, samples_ = 0;
};

// Layers of one size and format.
class TextureArray {
 public:
  TextureArray() = default;
  // Contents are undefined. The caller keeps the layers within the device's.
  TextureArray(const TextureFormat& format, int width, int height, int layers, const TextureOptions& options = {});

  // Rows at the left edge of a layer's level, from `row` on.
  void upload(int level, int layer, int row, const IVec2& size, const void* pixels) const;
  void bind(int unit) const;
  GLuint name() const { return handle_.name(); }
  std::size_t bytes() const { return bytes_; }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<ObjectKind::kTexture> handle_;
  TextureFormat format_;
  std::size_t bytes_ = 0;
};

// Six square faces, which look along +x, -x, +y, -y, +z, -z as OpenGL has it; filtered across their edges.
class CubeTexture {
 public:
  CubeTexture() = default;
  // Contents are undefined. The caller keeps size within the device's.
  CubeTexture(const TextureFormat& format, int size, int levels);
  void bind(int unit) const;
  // Fills the coarser levels from the finest.
  void make_mipmaps() const;
  GLuint name() const { return handle_.name(); }
  int size() const { return size_; }
  std::size_t bytes() const { return bytes_; }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  Handle<ObjectKind::kTexture> handle_;
  int size_ = 0;
  std::size_t bytes_ = 0;
};

// Levels of a full mip chain of that size.
int mip_levels(int width, int height);
// Size of a level: halves, rounded up.
inline int level_size(int size, int level) {
  return (size + (1 << level) - 1) >> level;
}

}  // namespace oriel::gpu
