#include "player/gpu/device.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "player/gpu/texture.h"

namespace oriel::gpu {
namespace {

std::string gl_text(GLenum what) {
  const auto* text = reinterpret_cast<const char*>(glGetString(what));
  return text != nullptr ? text : "unknown";
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "unknown error";
  }
}

}  // namespace

Result<Device> open_device() {
  const int version = epoxy_gl_version();
  if (version == 0) return fail(ErrorCode::kRuntime, "OpenGL", "found no current context");
  Device device;
  device.vendor = gl_text(GL_VENDOR);
  device.renderer = gl_text(GL_RENDERER);
  device.version = gl_text(GL_VERSION);
  const bool desktop = epoxy_is_desktop_gl();
  if (version < (desktop ? 33 : 30)) {
    return fail(ErrorCode::kRuntime, "OpenGL", "found {} on {}, expected OpenGL 3.3 core or OpenGL ES 3.0",
                device.version, device.renderer);
  }
  if (!desktop && !epoxy_has_gl_extension("GL_EXT_texture_norm16"))
    return fail(ErrorCode::kRuntime, "OpenGL ES", "found {} on {}, expected GL_EXT_texture_norm16", device.version,
                device.renderer);
  device.dialect = desktop ? Dialect::kDesktop330 : Dialect::kEs300;
  GLint texture_size = 0;
  GLint layers = 0;
  GLint viewport[2] = {0, 0};
  GLfloat points[2] = {1, 1};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture_size);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  glGetFloatv(desktop ? GL_POINT_SIZE_RANGE : GL_ALIASED_POINT_SIZE_RANGE, points);
  device.texture_size = std::min({texture_size, viewport[0], viewport[1]});
  device.array_layers = layers;
  if (desktop) {
    GLint colors = 1, depths = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colors);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depths);
    for (const GLenum format : {GLenum{GL_RGBA32F}, kDepthStencil.internal}) {
      GLint most = 0;  // of this format, the first that is told
      if (epoxy_gl_version() >= 42 || epoxy_has_gl_extension("GL_ARB_internalformat_query"))
        glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, format, GL_SAMPLES, 1, &most);
      if (most > 0) colors = std::min(colors, most);
    }
    device.samples = std::max(1, std::min(colors, depths));
  }
  device.point_size_max = std::max(1.0f, points[1]);
  const bool llvmpipe = device.renderer.find("llvmpipe") != std::string::npos;
  device.pass_timers = desktop && !llvmpipe;
  device.shades_hidden = desktop && llvmpipe && epoxy_has_gl_extension("GL_ARB_shader_storage_buffer_object") &&
                         epoxy_has_gl_extension("GL_ARB_shader_image_load_store");
  if (desktop) {
    glEnable(GL_PROGRAM_POINT_SIZE);  // always on in OpenGL ES
    glDisable(GL_FRAMEBUFFER_SRGB);   // shaders encode
  }
  glDisable(GL_DITHER);
  return device;
}

Status check_gl(const char* where) {
  const GLenum first = glGetError();
  if (first == GL_NO_ERROR) return {};
  for (int i = 0; i < 64 && glGetError() != GL_NO_ERROR; ++i) {
  }
  return fail(ErrorCode::kRuntime, where, "found {} (0x{:04x}), expected no OpenGL error", error_name(first), first);
}

}  // namespace oriel::gpu
