#include "player/gpu/headless.h"

#include <epoxy/egl.h>

namespace oriel::gpu {
namespace {

EGLDisplay open_display() {
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
    return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (eglQueryDevicesEXT(1, &device, &count) && count > 0) {
      return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    }
  }
  return EGL_NO_DISPLAY;
}

tl::unexpected<Error> egl_failed(const char* what) {
  return fail(ErrorCode::kRuntime, "EGL", "{} failed with 0x{:04x}, expected a context without a display", what,
              eglGetError());
}

EGLContext make_context(EGLDisplay display, Dialect dialect) {
  const bool desktop = dialect == Dialect::kDesktop330;
  if (!eglBindAPI(desktop ? EGL_OPENGL_API : EGL_OPENGL_ES_API)) return EGL_NO_CONTEXT;
  const EGLint desktop_attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLint es_attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, desktop ? desktop_attributes : es_attributes);
}

}  // namespace

Result<std::unique_ptr<HeadlessContext>> HeadlessContext::create(Dialect dialect) {
  const EGLDisplay display = open_display();
  if (display == EGL_NO_DISPLAY) return egl_failed("finding a surfaceless platform");
  EGLint major = 0, minor = 0;
  if (!eglInitialize(display, &major, &minor)) return egl_failed("eglInitialize");
  std::unique_ptr<HeadlessContext> context(new HeadlessContext);
  context->display_ = display;
  context->context_ = make_context(display, dialect);
  if (context->context_ == EGL_NO_CONTEXT) {
    return egl_failed(dialect == Dialect::kDesktop330 ? "creating an OpenGL 3.3 core context"
                                                      : "creating an OpenGL ES 3.0 context");
  }
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context_)) return egl_failed("eglMakeCurrent");
  return context;
}

HeadlessContext::~HeadlessContext() {
  // The display stays initialised: EGL hands the same one to every caller of a process.
  if (context_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace oriel::gpu
