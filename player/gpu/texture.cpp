#include "player/gpu/texture.h"

namespace oriel::gpu {

int mip_levels(int width, int height) {
  int levels = 1;
  for (int size = std::max(width, height); size > 1; size /= 2) ++levels;
  return levels;
}

namespace {

// Whether a texture can be allocated with all its levels at once: a driver that gets them one by one may guess wrong
// and copy them later, in the middle of a frame.
bool has_storage() {
  return !epoxy_is_desktop_gl() || epoxy_gl_version() >= 42 || epoxy_has_gl_extension("GL_ARB_texture_storage");
}

void set_sampling(GLenum target, const TextureOptions& options) {
  glTexParameteri(target, GL_TEXTURE_BASE_LEVEL, 0);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, options.levels - 1);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(options.min_filter));
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(options.mag_filter));
  if (options.compare) glTexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, static_cast<GLint>(options.wrap_s));
  glTexParameteri(target, GL_TEXTURE_WRAP_T, static_cast<GLint>(options.wrap_t));
}

}  // namespace

Texture2d::Texture2d(const TextureFormat& format, int width, int height, const void* pixels,
                     const TextureOptions& options)
    : format_(format), width_(width), height_(height), levels_(options.levels) {
  GLuint name = 0;
  glGenTextures(1, &name);
  handle_ = Handle<ObjectKind::kTexture>(name);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const bool at_once = pixels == nullptr && levels_ > 1 && has_storage();
  if (at_once) glTexStorage2D(GL_TEXTURE_2D, levels_, format.internal, width, height);
  for (int level = 0; level < levels_; ++level) {
    const int w = std::max(1, width >> level), h = std::max(1, height >> level);
    if (!at_once)
      glTexImage2D(GL_TEXTURE_2D, level, static_cast<GLint>(format.internal), w, h, 0, format.format, format.type,
                   level == 0 ? pixels : nullptr);
    bytes_ += static_cast<std::size_t>(w) * h * format.bytes_per_texel;
  }
  set_sampling(GL_TEXTURE_2D, options);
  if (options.make_mipmaps && levels_ > 1) glGenerateMipmap(GL_TEXTURE_2D);
}

void Texture2d::upload(int level, int row, int rows, const void* pixels) const {
  upload(level, {0, row}, {std::max(1, width_ >> level), rows}, pixels);
}

void Texture2d::upload(int level, const IVec2& at, const IVec2& size, const void* pixels) const {
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage2D(GL_TEXTURE_2D, level, at.x, at.y, size.x, size.y, format_.format, format_.type, pixels);
}

void Texture2d::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, handle_.name());
}

MultisampleTexture::MultisampleTexture(const TextureFormat& format, int width, int height, int samples)
    : width_(width), height_(height), samples_(samples) {
  GLuint name = 0;
  glGenTextures(1, &name);
  handle_ = Handle<ObjectKind::kTexture>(name);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, name);
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, samples, format.internal, width, height, GL_TRUE);
  GLint given = samples;
  glGetTexLevelParameteriv(GL_TEXTURE_2D_MULTISAMPLE, 0, GL_TEXTURE_SAMPLES, &given);
  samples_ = given;
}

void MultisampleTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, handle_.name());
}

TextureArray::TextureArray(const TextureFormat& format, int width, int height, int layers,
                           const TextureOptions& options)
    : format_(format) {
  GLuint name = 0;
  glGenTextures(1, &name);
  handle_ = Handle<ObjectKind::kTexture>(name);
  glBindTexture(GL_TEXTURE_2D_ARRAY, name);
  const bool at_once = has_storage();
  if (at_once) glTexStorage3D(GL_TEXTURE_2D_ARRAY, options.levels, format.internal, width, height, layers);
  for (int level = 0; level < options.levels; ++level) {
    const int w = std::max(1, width >> level), h = std::max(1, height >> level);
    if (!at_once)
      glTexImage3D(GL_TEXTURE_2D_ARRAY, level, static_cast<GLint>(format.internal), w, h, layers, 0, format.format,
                   format.type, nullptr);
    bytes_ += static_cast<std::size_t>(w) * h * layers * format.bytes_per_texel;
  }
  set_sampling(GL_TEXTURE_2D_ARRAY, options);
}

void TextureArray::upload(int level, int layer, int row, const IVec2& size, const void* pixels) const {
  glBindTexture(GL_TEXTURE_2D_ARRAY, handle_.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, row, layer, size.x, size.y, 1, format_.format, format_.type, pixels);
}

void TextureArray::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D_ARRAY, handle_.name());
}

void Texture2d::make_mipmaps() const {
  glBindTexture(GL_TEXTURE_2D, handle_.name());
  glGenerateMipmap(GL_TEXTURE_2D);
}

CubeTexture::CubeTexture(const TextureFormat& format, int size, int levels) : size_(size) {
  GLuint name = 0;
  glGenTextures(1, &name);
  handle_ = Handle<ObjectKind::kTexture>(name);
  glBindTexture(GL_TEXTURE_CUBE_MAP, name);
  for (int level = 0; level < levels; ++level) {
    const int side = std::max(1, size >> level);
    for (GLenum face = 0; face < 6; ++face)
      glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, static_cast<GLint>(format.internal), side, side, 0,
                   format.format, format.type, nullptr);
    bytes_ += std::size_t{6} * side * side * format.bytes_per_texel;
  }
  TextureOptions options;
  options.levels = levels;
  options.mag_filter = GL_LINEAR;
  options.min_filter = levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR;
  set_sampling(GL_TEXTURE_CUBE_MAP, options);
  if (epoxy_is_desktop_gl()) glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);  // OpenGL ES always is
}

void CubeTexture::bind(int unit) const {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_CUBE_MAP, handle_.name());
}

void CubeTexture::make_mipmaps() const {
  glBindTexture(GL_TEXTURE_CUBE_MAP, handle_.name());
  glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
}

}  // namespace oriel::gpu
