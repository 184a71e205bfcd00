// SPDX-License-Identifier: Apache-2.0
// SceneTexture and GlScene hold a texture and a mesh on the GPU.
#pragma once

#include <GLES3/gl3.h>

#include "apps/tools/render/gl_limits.hpp"
#include "apps/tools/render/gl_name.hpp"
#include "apps/tools/render/gl_program.hpp"
#include "apps/tools/render/render.hpp"

namespace tetrakis::tools {

Status checkTexture(const ImageFile& image);

/// textured: it will have a texture.
Status checkMesh(const MeshFile& mesh, bool textured);

/// A texture on the GPU.
class SceneTexture {
 public:
  /// repeats: beyond its edges, where else they go on.
  SceneTexture(const ImageFile& image, const GlLimits& limits, bool repeats = false);
  void bind(GLuint unit = 0) const {
    glActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(GL_TEXTURE_2D, name_);
  }
  bool opaque() const { return opaque_; }

 private:
  GlTexture name_;
  bool opaque_;
};

/// A mesh on the GPU, with texture coordinates or normals.
class GlScene {
 public:
  Status upload(const MeshFile& mesh, Paint paint);

  const Bounds& box() const { return box_; }

  /// With the texture that is bound, if it has coordinates.
  void draw() const;

 private:
  GlVertexArray array_;
  GlBuffer indices_, positions_, attributes_;
  GLsizei index_count_ = 0;
  Bounds box_;
};

}  // namespace tetrakis::tools
