#include "player/gpu/headless.h"

#include <epoxy/egl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

namespace oriel::gpu {
namespace {

// In the order to try them: a device that draws by itself, then whatever the platform without surfaces takes, which may
// be a software rasteriser beside the driver of a device, then software.
std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> hardware, software;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) {
    const bool asked_for_software = std::getenv("LIBGL_ALWAYS_SOFTWARE") != nullptr;  // as Mesa takes it
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(EGLint{devices.size()}, devices.data(), &count)) count = 0;
    for (const EGLDeviceEXT device : std::span(devices).first(std::size_t(count))) {
      const char* says = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
      const bool rasterises = says != nullptr && epoxy_extension_in_string(says, "EGL_MESA_device_software");
      (rasterises || asked_for_software ? software : hardware)
          .push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
  }
  std::vector<EGLDisplay> all = std::move(hardware);
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    all.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  all.insert(all.end(), software.begin(), software.end());
  std::erase(all, EGL_NO_DISPLAY);
  return all;
}

std::string egl_failed(const char* what) {
  return fmt::format("{} failed with 0x{:04x}", what, eglGetError());
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
  const std::vector<EGLDisplay> all = displays();
  std::string why = all.empty() ? egl_failed("finding a device or a surfaceless platform") : "";
  const auto note = [&](const char* what) { why += (why.empty() ? "" : ", ") + egl_failed(what); };
  for (const EGLDisplay display : all) {
    std::unique_ptr<HeadlessContext> context(new HeadlessContext);
    context->display_ = display;
    if (!eglInitialize(display, nullptr, nullptr)) {
      note("eglInitialize");
    } else if (context->context_ = make_context(display, dialect); context->context_ == EGL_NO_CONTEXT) {
      note(dialect == Dialect::kDesktop330 ? "creating an OpenGL 3.3 core context"
                                           : "creating an OpenGL ES 3.0 context");
    } else if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context->context_)) {
      note("eglMakeCurrent");
    } else {
      return context;
    }
  }
  return fail(ErrorCode::kRuntime, "EGL", "{}, expected a context without a display", why);
}

HeadlessContext::~HeadlessContext() {
  // The display stays initialised: EGL hands the same one to every caller of a process.
  if (context_ == nullptr) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace oriel::gpu
