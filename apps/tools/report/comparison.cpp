// SPDX-License-Identifier: Apache-2.0
// How far a stream is from what was encoded, in the samples and on the screen.
#include "apps/tools/report/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/plain_heights.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/viewed_mesh.hpp"

namespace tetrakis::tools {
namespace {

double psnr(double peak, double mean_squared_error) {
  if (mean_squared_error == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(peak * peak / mean_squared_error);
}

/// Samples that are void (NaN) on either side are left out.
HeightErrors heightErrors(const Surface& reference, const Surface& test) {
  HeightErrors errors;
  double sum = 0, low = std::numeric_limits<double>::infinity(), high = -low;
  size_t count = 0;
  for (size_t i = 0; i < reference.values.size(); ++i) {
    if (std::isnan(reference.values[i]) || std::isnan(test.values[i])) continue;
    const double error = std::abs(test.values[i] - reference.values[i]);
    sum += error * error;
    errors.max_error = std::max(errors.max_error, error);
    low = std::min(low, reference.values[i]);
    high = std::max(high, reference.values[i]);
    ++count;
  }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
  errors.rmse = std::sqrt(mean);
  // Scale and offset round twice on either side.
  const double largest = count > 0 ? std::max(std::abs(low), std::abs(high)) : 0;
  errors.rounding = 4 * std::numeric_limits<double>::epsilon() * largest;
  errors.psnr = psnr(count > 0 ? high - low : 0, mean);
  return errors;
}

/// Whether colours count only where alpha is not 0: streams are free to hold others there, unless
/// they hold those of a cut-out.
bool hidesColours(const ImageFile& reference, const tks_info& info) {
  return reference.channels % 2 == 0 && !reference.opaque && info.texture_cutout != 1;
}

/// hidden: colours count where the reference's alpha is not 0.
double imagePsnr(const ImageFile& reference, const ImageFile& test, bool hidden) {
  const uint32_t row = reference.width * reference.channels;
  const Surface a = samplesOf(row, reference.height, reference.sample, reference.data);
  const Surface b = samplesOf(row, test.height, test.sample, test.data);
  const size_t channels = reference.channels;
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < a.values.size(); ++i) {
    const size_t alpha = i - i % channels + channels - 1;
    if (hidden && i != alpha && a.values[alpha] == 0) continue;
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
    ++count;
  }
  return psnr(reference.white(), sum / static_cast<double>(count));
}

std::string shape(uint32_t width, uint32_t height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

Status checkHeights(const HeightFile& heights, const tks_info& header) {
  if (!header.has_heights) return Status(TKS_USAGE, "the stream has no heights to compare");
  const Extent shown = shownHeights(header);
  if (heights.width == shown.width && heights.height == shown.height &&
      heights.sample == header.sample)
    return Status();
  const auto describe = [](uint32_t width, uint32_t height, tks_sample sample) {
    return shape(width, height) + " heights of " + sampleName(sample);
  };
  return Status(TKS_MISMATCH,
                "the stream has " + describe(shown.width, shown.height, header.sample) +
                    ", the reference " + describe(heights.width, heights.height, heights.sample));
}

Status checkImage(const ImageFile& image, const tks_info& header) {
  if (!header.has_texture) return Status(TKS_USAGE, "the stream has no texture to compare");
  if (image.width == header.texture_width && image.height == header.texture_height &&
      image.channels == header.texture_channels && image.sample == header.texture_sample)
    return Status();
  const auto describe = [](uint32_t width, uint32_t height, uint32_t channels, tks_sample sample) {
    return shape(width, height) + " texels of " + std::to_string(channels) +
           (channels == 1 ? " channel, " : " channels, ") +
           std::to_string(8 * tks_sample_bytes(sample)) + " bits";
  };
  return Status(TKS_MISMATCH,
                "the stream has " +
                    describe(header.texture_width, header.texture_height, header.texture_channels,
                             header.texture_sample) +
                    ", the reference " +
                    describe(image.width, image.height, image.channels, image.sample));
}

/// Bytes of what is made of heights: of a sample two surfaces of doubles, a grid of triangles, the
/// reference.
uint64_t copiesOf(const tks_info& info) {
  return 72 * shownHeights(info).samples();
}

/// The reference with the metadata that the encoder was told. Of heights on a cube the spacing is
/// that of the grid that they were made of.
HeightFile asEncoded(const HeightFile& heights, const tks_info& header) {
  HeightFile result = heights;
  result.scale = header.scale;
  result.offset = header.offset;
  if (!isGridOnCube(header)) {
    const auto [spacing_x, spacing_y] = spacingOf(header);
    result.spacing_x = spacing_x;
    result.spacing_y = spacing_y;
  }
  result.unit = header.unit;
  if (header.has_nodata) result.nodata = header.nodata;
  return result;
}

}  // namespace

Result<Comparer> Comparer::create(const Reference& reference, const tks_info& header) {
  if (reference.heights)
    if (Status status = checkHeights(*reference.heights, header); !status.ok()) return status;
  if (reference.image)
    if (Status status = checkImage(*reference.image, header); !status.ok()) return status;
  Comparer comparer(reference);
  if (reference.heights) {
    const HeightFile heights = asEncoded(*reference.heights, header);
    comparer.frame_ = frameOf(heights);
    comparer.surface_ = heightsOf(heights);
  } else {
    comparer.frame_ = frameOf(*reference.image);
    comparer.surface_ = Surface{2, 2, std::vector<double>(4)};
  }
  return comparer;
}

Status Comparer::look(const CameraChoice& choice) {
  Result<std::vector<Camera>> cameras = chooseCameras(choice, boundsOf(surface_, frame_));
  if (!cameras.ok()) return cameras.status();
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create();
  if (!renderer.ok()) return renderer.status();
  const auto counts = [](const Camera& camera) { return camera.weight > 0; };
  if (std::none_of(cameras->begin(), cameras->end(), counts))
    return Status(TKS_USAGE, "no camera has a weight above 0");
  choice_ = choice;
  cameras_ = std::move(*cameras);
  renderer_ = std::move(*renderer);
  MeshFile mesh = fullGrid(surface_, frame_);
  mesh.texture = reference_->image ? &*reference_->image : nullptr;
  Result<std::vector<Picture>> pictures = renderer_->draw(mesh, cameras_);
  if (!pictures.ok()) return pictures.status();
  pictures_ = std::move(*pictures);
  return Status();
}

Result<MeshFile> Comparer::measureSurface(Decoder& decoder, Measurement& result) const {
  const Result<HeightFile> heights = decodeHeights(decoder, {}, copiesOf(decoder.info()));
  if (!heights.ok()) return heights.status();
  const Surface surface = heightsOf(*heights);
  result.heights = heightErrors(surface_, surface);
  MeshFile mesh = fullGrid(surface, frame_);
  result.triangles = static_cast<uint32_t>(mesh.triangles.size() / 3);
  return mesh;
}

Result<MeshFile> Comparer::measureMesh(Decoder& decoder, uint32_t triangles,
                                       const ImageFile* texture, Measurement& result) const {
  if (isGridOnCube(decoder.info()))
    return Status(TKS_USAGE, "a mesh of heights on a cube is a globe, which is not compared");
  const Result<uint64_t> fits =
      decoder.checkMemory(TKS_PART_BUDGET_MESH, nullptr, triangles, copiesOf(decoder.info()));
  if (!fits) return fits.status();
  const Result<Mesh> mesh = choice_.isDefault()
                                ? decoder.budgetMesh(triangles)
                                : meshForCameras(decoder, triangles, choice_, texture);
  if (!mesh) return mesh.status();
  result.triangles = mesh->triangleCount();
  result.heights = heightErrors(surface_, rasterize(*mesh, frame_.width, frame_.height));
  return placeMesh(*mesh, frame_);
}

Status Comparer::drawAndScore(MeshFile& mesh, const ImageFile* texture, Measurement& result) {
  mesh.texture = texture;
  Result<std::vector<Picture>> pictures = renderer_->draw(mesh, cameras_);
  if (!pictures.ok()) return pictures.status();
  result.pictures = std::move(*pictures);
  for (size_t i = 0; i < pictures_.size(); ++i)
    result.camera_psnr.push_back(screenPsnr({pictures_[i]}, {result.pictures[i]}));
  result.screen_psnr = screenPsnr(pictures_, result.pictures, weights());
  return Status();
}

std::vector<double> Comparer::weights() const {
  std::vector<double> weights;
  for (const Camera& camera : cameras_) weights.push_back(camera.weight);
  return weights;
}

Result<std::vector<double>> Comparer::psnrWithEach(Decoder& stream, uint32_t triangles) {
  Measurement of_heights;
  const Result<MeshFile> mesh = triangles > 0 ? measureMesh(stream, triangles, nullptr, of_heights)
                                              : measureSurface(stream, of_heights);
  if (!mesh.ok()) return mesh.status();
  std::vector<double> psnr;
  const auto score = [&](const std::vector<Picture>& pictures) {
    psnr.push_back(screenPsnr(pictures_, pictures, weights()));
  };
  if (Status status = renderer_->drawWithEach(*mesh, cameras_, score); !status.ok()) return status;
  return psnr;
}

Result<Measurement> Comparer::measure(std::span<const uint8_t> stream, uint32_t triangles) {
  Result<Decoder> decoder = openDecoder(stream);
  if (!decoder) return decoder.status();
  return measure(*decoder, triangles);
}

Result<Measurement> Comparer::measure(Decoder& decoder, uint32_t triangles) {
  Measurement result;
  result.bytes = decoder.info().available_bytes;
  result.geometry_bytes = decoder.info().geometry_bytes;
  result.texture_bytes = decoder.info().texture_bytes;
  const bool makes_mesh = reference_->heights && triangles > 0;
  const bool shows_texture = decoder.info().has_texture && makes_mesh && !choice_.isDefault();
  std::optional<ImageFile> texture;
  if (reference_->image || shows_texture) {
    // Both as doubles, and the reference.
    const uint64_t copies = imageBytes(decoder.info()) * (1 + 2 * sizeof(double));
    Result<ImageFile> decoded = decodeImage(decoder, {}, copies);
    if (!decoded.ok()) return decoded.status();
    texture = std::move(*decoded);
  }
  if (reference_->image)
    result.texture_psnr =
        imagePsnr(*reference_->image, *texture, hidesColours(*reference_->image, decoder.info()));
  const ImageFile* const texels = texture ? &*texture : nullptr;
  Result<MeshFile> mesh = makes_mesh            ? measureMesh(decoder, triangles, texels, result)
                          : reference_->heights ? measureSurface(decoder, result)
                                                : fullGrid(surface_, frame_);
  if (!mesh.ok()) return mesh.status();
  if (renderer_)
    if (Status status = drawAndScore(*mesh, reference_->image ? texels : nullptr, result);
        !status.ok())
      return status;
  return result;
}

}  // namespace tetrakis::tools
