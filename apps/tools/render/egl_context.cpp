// SPDX-License-Identifier: Apache-2.0
// Platforms: EGL_MESA_platform_surfaceless, EGL_EXT_platform_device, EGL_KHR_surfaceless_context.
#include "apps/tools/render/egl_context.hpp"

#include <EGL/eglext.h>

#include <array>
#include <string_view>
#include <vector>

namespace tetrakis::tools {
namespace {

/// Extension lists are names between blanks; `display` may be EGL_NO_DISPLAY for the client's.
bool hasExtension(EGLDisplay display, std::string_view name) {
  const char* text = eglQueryString(display, EGL_EXTENSIONS);
  std::string_view list = text ? text : "";
  while (!list.empty()) {
    const size_t blank = list.find(' ');
    if (list.substr(0, blank) == name) return true;
    if (blank == std::string_view::npos) break;
    list.remove_prefix(blank + 1);
  }
  return false;
}

template <class Function>
Function load(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

void appendDevices(std::vector<EGLDisplay>& displays) {
  if (!hasExtension(EGL_NO_DISPLAY, "EGL_EXT_platform_device")) return;
  const auto query = load<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto open = load<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  std::array<EGLDeviceEXT, 16> devices;
  EGLint count = 0;
  if (!query || !open || !query(EGLint{devices.size()}, devices.data(), &count)) return;
  for (size_t i = 0; i < static_cast<size_t>(count); ++i)
    displays.push_back(open(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
}

std::vector<EGLDisplay> candidateDisplays() {
  std::vector<EGLDisplay> displays;
  const auto open = load<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (open && hasExtension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    displays.push_back(open(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  appendDevices(displays);
  displays.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
  return displays;
}

EGLContext createContext(EGLDisplay display) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return EGL_NO_CONTEXT;
  if (!hasExtension(display, "EGL_KHR_surfaceless_context") || !eglBindAPI(EGL_OPENGL_ES_API))
    return EGL_NO_CONTEXT;
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT,
                           EGL_NONE};
  EGLConfig config;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) return EGL_NO_CONTEXT;
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, version);
}

}  // namespace

Result<EglContext> EglContext::create() {
  for (const EGLDisplay display : candidateDisplays()) {
    const EGLContext handle = createContext(display);
    if (handle == EGL_NO_CONTEXT) continue;
    EglContext context(display, handle);
    if (context.makeCurrent().ok()) return context;
  }
  return Status(
      TKS_UNSUPPORTED,
      "cannot draw: no EGL driver with OpenGL ES 3 was found (on Debian install libegl1 and "
      "libgl1-mesa-dri)");
}

// The display is shared by all contexts of the process and not counted by EGL: eglTerminate here
// would end the others', so it stays open until the process ends.
EglContext::~EglContext() {
  if (context_ == EGL_NO_CONTEXT) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

Status EglContext::makeCurrent() const {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) return Status();
  return Status(TKS_UNSUPPORTED, "cannot draw: the EGL driver refuses a context without a surface");
}

}  // namespace tetrakis::tools
