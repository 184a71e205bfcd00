// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/render/gl_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "apps/tools/render/texture_pyramid.hpp"

namespace tetrakis::tools {

namespace {

/// The triangles whose corners are all finite.
std::vector<uint32_t> finiteTriangles(const MeshFile& mesh) {
  const auto finite = [&](uint32_t v) {
    const float* p = &mesh.positions[size_t{3} * v];
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  };
  std::vector<uint32_t> kept;
  kept.reserve(mesh.triangles.size());
  for (size_t i = 0; i + 3 <= mesh.triangles.size(); i += 3) {
    const uint32_t* t = &mesh.triangles[i];
    if (finite(t[0]) && finite(t[1]) && finite(t[2])) kept.insert(kept.end(), t, t + 3);
  }
  return kept;
}

Bounds boundsOf(const MeshFile& mesh, const std::vector<uint32_t>& triangles) {
  Bounds box;
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (const uint32_t v : triangles) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const double value = mesh.positions[size_t{3} * v + axis];
      box.low[axis] = std::min(box.low[axis], value);
      box.high[axis] = std::max(box.high[axis], value);
    }
  }
  return box;
}

/// Per vertex, weighted by area: half the cross product of two sides of a triangle is its area
/// along its normal.
std::vector<float> normalsOf(const MeshFile& mesh, const std::vector<uint32_t>& triangles) {
  std::vector<float> normals(mesh.positions.size());
  for (size_t i = 0; i < triangles.size(); i += 3) {
    const float* p[3];
    for (size_t k = 0; k < 3; ++k) p[k] = &mesh.positions[size_t{3} * triangles[i + k]];
    float a[3], b[3];
    for (size_t k = 0; k < 3; ++k) {
      a[k] = p[1][k] - p[0][k];
      b[k] = p[2][k] - p[0][k];
    }
    const float n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                        a[0] * b[1] - a[1] * b[0]};
    for (size_t k = 0; k < 3; ++k)
      for (size_t axis = 0; axis < 3; ++axis)
        normals[size_t{3} * triangles[i + k] + axis] += n[axis];
  }
  return normals;
}

template <class T>
void fill(GLenum target, GLuint buffer, const std::vector<T>& values) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
               GL_STATIC_DRAW);
}

void fillAttribute(GLuint location, GLuint buffer, const std::vector<float>& values,
                   GLint components) {
  fill(GL_ARRAY_BUFFER, buffer, values);
  glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(location);
}

}  // namespace

Status checkTexture(const ImageFile& image) {
  const size_t samples = size_t{image.width} * image.height * image.channels;
  const size_t bytes = image.sample == TKS_U8 ? 1 : image.sample == TKS_U16 ? 2 : 0;
  if (samples > 0 && bytes > 0 && image.data.size() == samples * bytes) return Status();
  return Status(TKS_USAGE,
                "cannot draw a texture whose samples are not 8 or 16 bits each, or do not fill it");
}

Status checkMesh(const MeshFile& mesh, bool textured) {
  const size_t vertices = mesh.positions.size() / 3;
  for (const uint32_t index : mesh.triangles)
    if (index >= vertices) return Status(TKS_USAGE, "cannot draw: a triangle has no such vertex");
  if (mesh.triangles.size() / 3 > std::numeric_limits<GLsizei>::max() / 3)
    return Status(TKS_LIMIT, "cannot draw more than 715827882 triangles at once");
  if (textured && mesh.texcoords.size() != 2 * vertices)
    return Status(TKS_USAGE, "cannot draw a texture on a mesh without texture coordinates");
  return mesh.texture ? checkTexture(*mesh.texture) : Status();
}

SceneTexture::SceneTexture(const ImageFile& image, const GlLimits& limits, bool repeats)
    : opaque_(!image.hasAlpha()) {
  const std::vector<TextureLevel> levels = texturePyramid(image, limits.texture);
  bind();
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  const GLint beyond = repeats ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, beyond);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, beyond);
  for (size_t i = 0; i < levels.size(); ++i)
    glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGBA8,
                 static_cast<GLsizei>(levels[i].width), static_cast<GLsizei>(levels[i].height), 0,
                 GL_RGBA, GL_UNSIGNED_BYTE, levels[i].rgba.data());
}

Status GlScene::upload(const MeshFile& mesh, Paint paint) {
  const std::vector<uint32_t> triangles = finiteTriangles(mesh);
  box_ = boundsOf(mesh, triangles);
  index_count_ = static_cast<GLsizei>(triangles.size());
  if (triangles.empty()) return Status();
  glBindVertexArray(array_);
  fill(GL_ELEMENT_ARRAY_BUFFER, indices_, triangles);
  fillAttribute(0, positions_, mesh.positions, 3);
  if (paint == Paint::kHillshade)
    fillAttribute(1, attributes_, normalsOf(mesh, triangles), 3);
  else
    fillAttribute(1, attributes_, mesh.texcoords, 2);
  return checkGl("the mesh");
}

void GlScene::draw() const {
  if (index_count_ == 0) return;
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace tetrakis::tools
