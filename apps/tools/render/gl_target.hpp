// SPDX-License-Identifier: Apache-2.0
// GlTarget is a buffer off the screen that pictures are drawn into.
#pragma once

#include <GLES3/gl3.h>

#include <array>
#include <cstdint>
#include <vector>

#include "apps/tools/render/gl_name.hpp"
#include "apps/tools/render/gl_program.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Colours of one picture or several, and depth, to draw into; read back row by row from the
/// bottom.
class GlTarget {
 public:
  GlTarget(uint32_t width, uint32_t height, GLuint pictures);

  /// Ready to draw into, and empty.
  Status begin() const;
  std::vector<uint8_t> read(GLuint picture) const;

 private:
  void attach(GLuint buffer, GLenum format, GLenum attachment) const;

  uint32_t width_, height_;
  GlFramebuffer framebuffer_;
  std::array<GlRenderbuffer, kTexturesAtOnce> colours_;
  GlRenderbuffer depth_;
};

}  // namespace tetrakis::tools
