// SPDX-License-Identifier: Apache-2.0
// Draws a mesh into a framebuffer object at twice the picture's size and averages 2 x 2 samples:
// unlike multisampling, the same sum on every driver.
#include "apps/tools/render/render.hpp"

#include <algorithm>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "apps/tools/render/egl_context.hpp"
#include "apps/tools/render/gl_limits.hpp"
#include "apps/tools/render/gl_program.hpp"
#include "apps/tools/render/gl_scene.hpp"
#include "apps/tools/render/gl_target.hpp"
#include "apps/tools/render/projection.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint32_t kSamples = 2;  // along each side of a pixel

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
      GlScene scene;
      std::optional<SceneTexture> texture;
      if (textured) texture.emplace(*mesh.texture, limits_, mesh.texture_repeats);
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
        textures_.push_back(std::make_unique<const SceneTexture>(image, limits_));
      }
      return checkGl("the textures");
    });
  }

  Status drawWithEach(const MeshFile& mesh, const std::vector<Camera>& cameras,
                      const TakePictures& take) override {
    return guarded([&]() -> Status {
      if (Status sound = checkMesh(mesh, true); !sound.ok()) return sound;
      if (Status current = context_.makeCurrent(); !current.ok()) return current;
      GlScene scene;
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
  Status draw(const GlScene& scene, const std::vector<Camera>& cameras, const GlProgram& program,
              std::vector<std::vector<Picture>>& pictures) const {
    for (const Camera& camera : cameras)
      if (Status status = draw(scene, camera, program, pictures); !status.ok()) return status;
    return Status();
  }

  Status draw(const GlScene& scene, const Camera& camera, const GlProgram& program,
              std::vector<std::vector<Picture>>& pictures) const {
    const uint32_t largest = limits_.target / kSamples;
    if (camera.width == 0 || camera.height == 0 || camera.width > largest ||
        camera.height > largest)
      return Status(TKS_LIMIT, "cannot draw a picture of " + std::to_string(camera.width) + " x " +
                                   std::to_string(camera.height) +
                                   " pixels: this driver allows 1 to " + std::to_string(largest) +
                                   " a side");
    const auto count = static_cast<GLuint>(pictures.size());
    const GlTarget target(kSamples * camera.width, kSamples * camera.height, count);
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
  std::vector<std::unique_ptr<const SceneTexture>> textures_;
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
