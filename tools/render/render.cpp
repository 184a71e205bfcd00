// SPDX-License-Identifier: Apache-2.0
// Draws a mesh into a framebuffer object at twice the picture's size and averages 2 x 2 samples:
// unlike multisampling, the same sum on every driver.
#include "tools/render/render.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "ground/sky.hpp"
#include "tools/render/egl_context.hpp"
#include "tools/render/gl_name.hpp"
#include "tools/render/gl_program.hpp"
#include "tools/render/projection.hpp"
#include "tools/render/texture_pyramid.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint32_t kSamples = 2;  // along each side of a pixel

/// Largest sizes of the driver.
struct GlLimits {
  uint32_t texture = 0, target = 0;

  static GlLimits query() {
    GLint texture = 0, renderbuffer = 0, viewport[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return {static_cast<uint32_t>(texture),
            static_cast<uint32_t>(std::min({renderbuffer, viewport[0], viewport[1]}))};
  }
};

Status checkGl(const char* what) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return Status();
  if (error == GL_OUT_OF_MEMORY)
    return Status(TKS_NO_MEMORY, std::string("cannot draw: no graphics memory for ") + what);
  return Status(TKS_UNSUPPORTED, std::string("cannot draw: OpenGL error ") + std::to_string(error) +
                                     " with " + what);
}

Status checkTexture(const ImageFile& image) {
  const size_t samples = size_t{image.width} * image.height * image.channels;
  const size_t bytes = image.sample == TKS_U8 ? 1 : image.sample == TKS_U16 ? 2 : 0;
  if (samples > 0 && bytes > 0 && image.data.size() == samples * bytes) return Status();
  return Status(TKS_USAGE,
                "cannot draw a texture whose samples are not 8 or 16 bits each, or do not fill it");
}

/// textured: it will have a texture.
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

/// A texture on the GPU.
class Texture {
 public:
  Texture(const ImageFile& image, const GlLimits& limits) : opaque_(!image.hasAlpha()) {
    const std::vector<TextureLevel> levels = texturePyramid(image, limits.texture);
    bind();
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    for (size_t i = 0; i < levels.size(); ++i)
      glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGBA8,
                   static_cast<GLsizei>(levels[i].width), static_cast<GLsizei>(levels[i].height), 0,
                   GL_RGBA, GL_UNSIGNED_BYTE, levels[i].rgba.data());
  }
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
class Scene {
 public:
  Status upload(const MeshFile& mesh, Paint paint) {
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

  const Bounds& box() const { return box_; }

  /// With the texture that is bound, if it has coordinates.
  void draw() const {
    if (index_count_ == 0) return;
    glBindVertexArray(array_);
    glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
  }

 private:
  template <class T>
  static void fill(GLenum target, GLuint buffer, const std::vector<T>& values) {
    glBindBuffer(target, buffer);
    glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
                 GL_STATIC_DRAW);
  }

  static void fillAttribute(GLuint location, GLuint buffer, const std::vector<float>& values,
                            GLint components) {
    fill(GL_ARRAY_BUFFER, buffer, values);
    glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(location);
  }

  GlVertexArray array_;
  GlBuffer indices_, positions_, attributes_;
  GLsizei index_count_ = 0;
  Bounds box_;
};

/// Colours of one picture or several, and depth, to draw into; read back row by row from the
/// bottom.
class Target {
 public:
  Target(uint32_t width, uint32_t height, GLuint pictures) : width_(width), height_(height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    std::vector<GLenum> outputs;
    for (GLuint i = 0; i < pictures; ++i) {
      outputs.push_back(GL_COLOR_ATTACHMENT0 + i);
      attach(colours_[i], GL_RGBA8, outputs.back());
    }
    attach(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
    glDrawBuffers(static_cast<GLsizei>(outputs.size()), outputs.data());
  }

  Status begin() const {
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

  std::vector<uint8_t> read(GLuint picture) const {
    glReadBuffer(GL_COLOR_ATTACHMENT0 + picture);
    std::vector<uint8_t> rgba(size_t{4} * width_ * height_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_), GL_RGBA,
                 GL_UNSIGNED_BYTE, rgba.data());
    return rgba;
  }

 private:
  void attach(GLuint buffer, GLenum format, GLenum attachment) const {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, static_cast<GLsizei>(width_),
                          static_cast<GLsizei>(height_));
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  }

  uint32_t width_, height_;
  GlFramebuffer framebuffer_;
  std::array<GlRenderbuffer, kTexturesAtOnce> colours_;
  GlRenderbuffer depth_;
};

/// Averages kSamples x kSamples samples, the sky where nothing was drawn.
Picture resolve(const std::vector<uint8_t>& samples, const Camera& camera) {
  Picture picture{camera.width, camera.height, {}};
  picture.rgba.reserve(size_t{4} * camera.width * camera.height);
  constexpr uint32_t kCount = kSamples * kSamples;
  for (uint32_t y = 0; y < camera.height; ++y) {
    const std::array<uint32_t, 3> sky = skyAt(y, camera.height);
    for (uint32_t x = 0; x < camera.width; ++x) {
      uint32_t sum[4] = {};
      for (uint32_t s = 0; s < kCount; ++s) {
        const size_t row = size_t{camera.height - 1 - y} * kSamples + s / kSamples;
        const size_t column = size_t{x} * kSamples + s % kSamples;
        const uint8_t* sample = &samples[4 * (row * camera.width * kSamples + column)];
        for (size_t c = 0; c < 3; ++c) sum[c] += sample[3] != 0 ? sample[c] : sky[c];
        sum[3] += sample[3];
      }
      for (const uint32_t value : sum)
        picture.rgba.push_back(static_cast<uint8_t>((value + kCount / 2) / kCount));
    }
  }
  return picture;
}

class GlesRenderer final : public Renderer {
 public:
  explicit GlesRenderer(EglContext context) : context_(std::move(context)) {}
  ~GlesRenderer() override { static_cast<void>(context_.makeCurrent().ok()); }

  Status build() {
    limits_ = GlLimits::query();
    if (Status status = textured_.build(Paint::kTexture); !status.ok()) return status;
    for (size_t i = 0; i < many_.size(); ++i)
      if (Status status = many_[i].buildMany(static_cast<GLuint>(i + 2)); !status.ok())
        return status;
    return hillshaded_.build(Paint::kHillshade);
  }

  Result<std::vector<Picture>> draw(const MeshFile& mesh,
                                    const std::vector<Camera>& cameras) override {
    std::vector<Picture> pictures;
    Status status = guarded([&]() -> Status {
      const bool textured = mesh.texture != nullptr;
      if (Status sound = checkMesh(mesh, textured); !sound.ok()) return sound;
      if (Status current = context_.makeCurrent(); !current.ok()) return current;
      Scene scene;
      std::optional<Texture> texture;
      if (textured) texture.emplace(*mesh.texture, limits_);
      const Paint paint = textured ? Paint::kTexture : Paint::kHillshade;
      if (Status uploaded = scene.upload(mesh, paint); !uploaded.ok()) return uploaded;
      if (texture) texture->bind();
      std::vector<std::vector<Picture>> drawn(1);
      const GlProgram& program = textured ? textured_ : hillshaded_;
      if (Status done = draw(scene, cameras, program, drawn); !done.ok()) return done;
      pictures = std::move(drawn.front());
      return Status();
    });
    if (!status.ok()) return status;
    return pictures;
  }

  Status takeTextures(std::span<const ImageFile> textures) override {
    return guarded([&]() -> Status {
      if (Status current = context_.makeCurrent(); !current.ok()) return current;
      textures_.clear();
      for (const ImageFile& image : textures) {
        if (Status sound = checkTexture(image); !sound.ok()) return sound;
        textures_.push_back(std::make_unique<const Texture>(image, limits_));
      }
      return checkGl("the textures");
    });
  }

  Status drawWithEach(const MeshFile& mesh, const std::vector<Camera>& cameras,
                      const TakePictures& take) override {
    return guarded([&]() -> Status {
      if (Status sound = checkMesh(mesh, true); !sound.ok()) return sound;
      if (Status current = context_.makeCurrent(); !current.ok()) return current;
      Scene scene;
      if (Status uploaded = scene.upload(mesh, Paint::kTexture); !uploaded.ok()) return uploaded;
      const bool opaque = std::all_of(textures_.begin(), textures_.end(),
                                      [](const auto& texture) { return texture->opaque(); });
      // Holes are those of one texture, and what lies behind them is seen.
      const size_t all = textures_.size(), most = opaque ? kTexturesAtOnce : 1;
      const size_t batches = (all + most - 1) / most;
      for (size_t batch = 0; batch < batches; ++batch) {
        const size_t first = all * batch / batches, count = all * (batch + 1) / batches - first;
        for (size_t i = 0; i < count; ++i) textures_[first + i]->bind(static_cast<GLuint>(i));
        std::vector<std::vector<Picture>> drawn(count);
        const GlProgram& program = count == 1 ? textured_ : many_[count - 2];
        if (Status done = draw(scene, cameras, program, drawn); !done.ok()) return done;
        for (std::vector<Picture>& pictures : drawn) take(std::move(pictures));
      }
      return Status();
    });
  }

 private:
  template <class Work>
  static Status guarded(const Work& work) {
    try {
      return work();
    } catch (const std::bad_alloc&) {
      return Status(TKS_NO_MEMORY, "cannot draw: out of memory");
    }
  }

  /// pictures: of each camera one is added for each of the program's outputs.
  Status draw(const Scene& scene, const std::vector<Camera>& cameras, const GlProgram& program,
              std::vector<std::vector<Picture>>& pictures) const {
    for (const Camera& camera : cameras)
      if (Status status = draw(scene, camera, program, pictures); !status.ok()) return status;
    return Status();
  }

  Status draw(const Scene& scene, const Camera& camera, const GlProgram& program,
              std::vector<std::vector<Picture>>& pictures) const {
    const uint32_t largest = limits_.target / kSamples;
    if (camera.width == 0 || camera.height == 0 || camera.width > largest ||
        camera.height > largest)
      return Status(TKS_LIMIT, "cannot draw a picture of " + std::to_string(camera.width) + " x " +
                                   std::to_string(camera.height) +
                                   " pixels: this driver allows 1 to " + std::to_string(largest) +
                                   " a side");
    const auto count = static_cast<GLuint>(pictures.size());
    const Target target(kSamples * camera.width, kSamples * camera.height, count);
    if (Status status = target.begin(); !status.ok()) return status;
    program.use(projectionOf(camera, scene.box()));
    scene.draw();
    for (GLuint i = 0; i < count; ++i) {
      const std::vector<uint8_t> samples = target.read(i);
      if (Status status = checkGl("the triangles"); !status.ok()) return status;
      pictures[i].push_back(resolve(samples, camera));
    }
    return Status();
  }

  EglContext context_;
  GlLimits limits_;
  GlProgram textured_, hillshaded_;
  std::array<GlProgram, kTexturesAtOnce - 1> many_;  ///< for two textures and more
  std::vector<std::unique_ptr<const Texture>> textures_;
};

}  // namespace

ImageFile imageOf(const Picture& picture) {
  ImageFile image{picture.width, picture.height, 3, TKS_U8, {}};
  image.data.reserve(picture.rgba.size() / 4 * 3);
  for (size_t i = 0; i < picture.rgba.size(); i += 4)
    for (size_t channel = 0; channel < 3; ++channel)
      image.data.push_back(std::byte{picture.rgba[i + channel]});
  return image;
}

Result<std::unique_ptr<Renderer>> Renderer::create() {
  Result<EglContext> context = EglContext::create();
  if (!context.ok()) return context.status();
  auto renderer = std::make_unique<GlesRenderer>(std::move(*context));
  if (Status status = renderer->build(); !status.ok()) return status;
  return std::unique_ptr<Renderer>(std::move(renderer));
}

Result<Picture> Renderer::draw(const MeshFile& mesh, const Camera& camera) {
  Result<std::vector<Picture>> pictures = draw(mesh, std::vector{camera});
  if (!pictures.ok()) return pictures.status();
  return std::move(pictures->front());
}

}  // namespace tetrakis::tools
