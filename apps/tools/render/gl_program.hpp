// SPDX-License-Identifier: Apache-2.0
// GlProgram paints a terrain in one of these ways: with its texture, with light on bare ground, or
// with several textures at once, each in a picture of its own.
#pragma once

#include <GLES3/gl3.h>

#include <array>

#include "tetrakis/result.hpp"

namespace tetrakis::tools {

enum class Paint { kTexture, kHillshade };

/// Textures that every driver draws at once.
inline constexpr GLuint kTexturesAtOnce = 4;

/// Attribute 0: position (3 floats). Attribute 1: texture coordinates (2) or normal (3). The
/// texture is at unit 0, its colours multiplied by alpha; several are at the units from 0 on.
class GlProgram {
 public:
  GlProgram() = default;
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  /// TKS_UNSUPPORTED with the driver's log.
  Status build(Paint paint);
  /// For so many textures without alpha, at most kTexturesAtOnce.
  Status buildMany(GLuint textures);
  /// transform: column by column, to clip space.
  void use(const std::array<float, 16>& transform) const;

 private:
  Status buildWith(const char* fragment_shader);

  GLuint program_ = 0;
  GLint transform_ = -1;
};

}  // namespace tetrakis::tools
