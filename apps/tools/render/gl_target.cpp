// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/render/gl_target.hpp"

#include "apps/tools/render/gl_limits.hpp"

namespace tetrakis::tools {

GlTarget::GlTarget(uint32_t width, uint32_t height, GLuint pictures)
    : width_(width), height_(height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  std::vector<GLenum> outputs;
  for (GLuint i = 0; i < pictures; ++i) {
    outputs.push_back(GL_COLOR_ATTACHMENT0 + i);
    attach(colours_[i], GL_RGBA8, outputs.back());
  }
  attach(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
}

Status GlTarget::begin() const {
  if (Status status = checkGl("the picture"); !status.ok()) return status;
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    return Status(TKS_UNSUPPORTED, "cannot draw: the driver refuses to draw off the screen");
  glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
  glClearColor(0, 0, 0, 0);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_DITHER);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  return Status();
}

std::vector<uint8_t> GlTarget::read(GLuint picture) const {
  glReadBuffer(GL_COLOR_ATTACHMENT0 + picture);
  std::vector<uint8_t> rgba(size_t{4} * width_ * height_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_), GL_RGBA,
               GL_UNSIGNED_BYTE, rgba.data());
  return rgba;
}

void GlTarget::attach(GLuint buffer, GLenum format, GLenum attachment) const {
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorage(GL_RENDERBUFFER, format, static_cast<GLsizei>(width_),
                        static_cast<GLsizei>(height_));
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
}

}  // namespace tetrakis::tools
