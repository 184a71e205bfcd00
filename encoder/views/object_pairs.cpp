// SPDX-License-Identifier: Apache-2.0
// objectErrors() draws surfaces over a base mesh for cameras, with the textures of their patches.

#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/samples.hpp"
#include "codec/remesh/cast_heights.hpp"
#include "encoder/views/pairs.hpp"
#include "encoder/views/view_inputs.hpp"
#include "ratecontrol/pictures/patch_texture.hpp"
#include "ratecontrol/pictures/triangle_pictures.hpp"

namespace tetrakis::inline views {

namespace {

/// A surface as the cameras see it.
struct DrawnSurface {
  std::vector<SeenTriangle> seen;
  std::vector<PatchPlace> places;  ///< of the samples that show it
};

/// Triangles that are drawn of a surface, at most, unless its patches are more. Pictures of several
/// hundred pixels a side show no smaller ones, and drawing all would take most of the time.
constexpr uint64_t kMostTriangles = 1 << 18;

/// The places of every 2^skipped-th sample of patches of (2^depth + 1)^2, in both directions, and
/// the triangles between them, as of meshOfSamples().
TriangleMesh thinned(const TriangleMesh& mesh, uint32_t patches, int depth, int skipped) {
  const uint32_t side = (1u << depth) + 1, step = 1u << skipped, n = 1u << (depth - skipped);
  TriangleMesh thin;
  for (uint32_t patch = 0; patch < patches; ++patch) {
    const auto first = static_cast<uint32_t>(thin.points.size());
    for (uint32_t y = 0; y < side; y += step)
      for (uint32_t x = 0; x < side; x += step)
        thin.points.push_back(mesh.points[(size_t{patch} * side + y) * side + x]);
    for (uint32_t square = 0; square < n * n; ++square) {
      const uint32_t nw = first + square / n * (n + 1) + square % n, sw = nw + n + 1;
      thin.triangles.push_back({nw, sw, sw + 1});
      thin.triangles.push_back({nw, sw + 1, nw + 1});
    }
  }
  return thin;
}

/// Heights on patches, drawn with the textures of patches.
class SurfacePictures {
 public:
  SurfacePictures(std::vector<Camera> cameras, BaseMesh base, int texture_depth)
      : pictures_(std::move(cameras)), base_(std::move(base)), texture_depth_(texture_depth) {
    while (drawnDepth() > 0 &&
           uint64_t{2} * base_.forest->patches() << 2 * drawnDepth() > kMostTriangles)
      ++skipped_;
  }

  DrawnSurface drawn(const std::vector<float>& heights) const {
    const TriangleMesh mesh = thinned(meshOfSamples(base_, heights), base_.forest->patches(),
                                      base_.forest->depth(), skipped_);
    DrawnSurface surface{pictures_.seenOf({mesh.points, mesh.triangles}), {}};
    for (const SeenTriangle& sample : surface.seen)
      surface.places.push_back(sample.triangle == SeenTriangle::kSky
                                   ? PatchPlace()
                                   : patchPlaceOf(sample, drawnDepth(), texture_depth_));
    return surface;
  }
  std::vector<Colour> colours(const DrawnSurface& surface, const PatchTexture& texture) const {
    return pictures_.coloursOf(surface.seen,
                               [&](size_t sample) { return texture.at(surface.places[sample]); });
  }
  const TrianglePictures& pictures() const { return pictures_; }

 private:
  int drawnDepth() const { return base_.forest->depth() - skipped_; }

  TrianglePictures pictures_;
  BaseMesh base_;
  int texture_depth_, skipped_ = 0;
};

/// Samples of the inputs in the unit of the surface.
std::vector<float> heightsOf(const tks_heights& like, const void* samples) {
  std::vector<float> heights(size_t{like.width} * like.height);
  withSampleType(like.sample, [&](auto type) {
    const auto* from = static_cast<const decltype(type)*>(samples);
    for (size_t i = 0; i < heights.size(); ++i)
      heights[i] = static_cast<float>(static_cast<double>(from[i]) * like.scale + like.offset);
  });
  return heights;
}

/// The given cameras, or those all around the surface.
std::vector<Camera> camerasOf(const tks_encode_options& options, const BaseMesh& base,
                              const std::vector<float>& heights) {
  if (options.camera_count > 0) return givenCameras(options);
  const Box box = boxAround(meshOfSamples(base, heights).points);
  const Result<std::vector<Camera>> cameras = camerasAround({box.low, box.high});
  return cameras.ok() ? *cameras : std::vector<Camera>();
}

}  // namespace

std::vector<double> objectErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                 const Nodes& nodes) {
  const tks_heights& whole = *inputs.heights;
  if (whole.base_mesh.position_bits == 0) return {};  // a globe lies at no place
  const BaseMesh base = baseMeshOf(whole);
  const int texture_depth = static_cast<int>(inputs.image->forest.depth);
  const std::vector<float> original = heightsOf(whole, whole.data);
  std::vector<Camera> cameras = camerasOf(inputs.options, base, original);
  if (cameras.empty()) return {};
  const SurfacePictures pictures(std::move(cameras), base, texture_depth);
  std::vector<DrawnSurface> surfaces;
  for (const RatePoint& node : nodes.heights)
    surfaces.push_back(
        pictures.drawn(heightsOf(whole, decoded.heightsAt(node.bytes, {}).data.data())));
  surfaces.push_back(pictures.drawn(original));
  const PatchTexture true_texture(decoded.originalTexels(), texture_depth);
  const std::vector<Colour> truth = pictures.colours(surfaces.back(), true_texture);
  const size_t columns = nodes.textures.size() + 1;
  std::vector<double> errors(surfaces.size() * columns);
  const auto look = [&](const PatchTexture& texture, size_t column) {
    for (size_t g = 0; g < surfaces.size(); ++g)
      errors[g * columns + column] = pictures.pictures().errorBetween(
          {surfaces.back().seen, truth},
          {surfaces[g].seen, pictures.colours(surfaces[g], texture)});
  };
  for (size_t t = 0; t + 1 < columns; ++t)
    look(PatchTexture(decoded.texelsAt(nodes.textures[t].bytes, {}), texture_depth), t);
  look(true_texture, columns - 1);
  return errors;
}

}  // namespace tetrakis::inline views
