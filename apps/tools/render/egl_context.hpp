// SPDX-License-Identifier: Apache-2.0
// EglContext is an OpenGL ES 3 context that needs no window, no display server and no GPU.
#pragma once

#include <EGL/egl.h>

#include <utility>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Owns a context without a surface: draw into framebuffer objects.
class EglContext {
 public:
  /// Tries Mesa's surfaceless platform, then the devices of the drivers, then the default display.
  /// TKS_UNSUPPORTED when none has OpenGL ES 3.
  static Result<EglContext> create();

  EglContext(EglContext&& other) noexcept
      : display_(other.display_), context_(std::exchange(other.context_, EGL_NO_CONTEXT)) {}
  EglContext& operator=(EglContext&&) = delete;
  ~EglContext();

  Status makeCurrent() const;

 private:
  EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}

  EGLDisplay display_;
  EGLContext context_;
};

}  // namespace tetrakis::tools
