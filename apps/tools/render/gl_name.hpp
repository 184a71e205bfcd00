// SPDX-License-Identifier: Apache-2.0
// GlName owns an OpenGL object and deletes it.
#pragma once

#include <GLES3/gl3.h>

namespace tetrakis::tools {

/// One object of a glGen*/glDelete* pair; its context must be current when it comes and goes.
template <void(GL_APIENTRY* Generate)(GLsizei, GLuint*),
          void(GL_APIENTRY* Delete)(GLsizei, const GLuint*)>
class GlName {
 public:
  GlName() { Generate(1, &name_); }
  ~GlName() { Delete(1, &name_); }
  GlName(const GlName&) = delete;
  GlName& operator=(const GlName&) = delete;
  operator GLuint() const { return name_; }

 private:
  GLuint name_ = 0;
};

using GlBuffer = GlName<glGenBuffers, glDeleteBuffers>;
using GlTexture = GlName<glGenTextures, glDeleteTextures>;
using GlVertexArray = GlName<glGenVertexArrays, glDeleteVertexArrays>;
using GlFramebuffer = GlName<glGenFramebuffers, glDeleteFramebuffers>;
using GlRenderbuffer = GlName<glGenRenderbuffers, glDeleteRenderbuffers>;

}  // namespace tetrakis::tools
