// SPDX-License-Identifier: Apache-2.0
// The two ways to paint a terrain: its texture, or light on bare ground.
#pragma once

#include <GLES3/gl3.h>

#include <array>

#include "base/status.hpp"

namespace tetrakis::tools {

enum class Paint { kTexture, kHillshade };

/// Attribute 0: position (3 floats). Attribute 1: texture coordinates (2) or normal (3). The
/// texture is at unit 0, its colours multiplied by alpha.
class GlProgram {
 public:
  GlProgram() = default;
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// TKS_UNSUPPORTED with the driver's log.
  Status build(Paint paint);
  /// transform: column by column, to clip space.
  void use(const std::array<float, 16>& transform) const;

 private:
  GLuint program_ = 0;
  GLint transform_ = -1;
};

}  // namespace tetrakis::tools
