// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/render/gl_limits.hpp"

#include <GLES3/gl3.h>

#include <algorithm>
#include <string>

namespace tetrakis::tools {

GlLimits GlLimits::query() {
  GLint texture = 0, renderbuffer = 0, viewport[2] = {};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  return {static_cast<uint32_t>(texture),
          static_cast<uint32_t>(std::min({renderbuffer, viewport[0], viewport[1]}))};
}

Status checkGl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return Status();
  if (error == GL_OUT_OF_MEMORY)
    return Status(TKS_NO_MEMORY, std::string("cannot draw: no graphics memory for ") + what);
  return Status(TKS_UNSUPPORTED, std::string("cannot draw: OpenGL error ") + std::to_string(error) +
                                     " with " + what);
}

}  // namespace tetrakis::tools
