// SPDX-License-Identifier: Apache-2.0
#include "api/object_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "base/portable_math.hpp"
#include "base/watch.hpp"

namespace tetrakis::inline api {
namespace {

constexpr uint32_t kMostElements = 1u << 26;  ///< points, and triangles

/// Powers of distances beyond these are infinite or 0, so that no tree of triangles tells places
/// apart, and searches would look at all of them.
constexpr double kFarthest = 1e30, kSmallest = 1e-30;

}  // namespace

Status misusedObject(const std::string& sentence) {
  return {TKS_USAGE, sentence};
}

Result<TriangleMesh> meshOf(const tks_triangle_mesh& given) {
  if (given.vertex_count > kMostElements || given.triangle_count > kMostElements)
    return misusedObject("A mesh has at most 67108864 vertices and triangles.");
  if (given.triangle_count == 0 || given.positions == nullptr || given.triangles == nullptr)
    return misusedObject("The mesh has no triangles.");
  TriangleMesh mesh;
  mesh.points.resize(given.vertex_count);
  for (uint32_t v = 0; v < given.vertex_count; ++v) {
    std::copy_n(given.positions + 3 * size_t{v}, 3, mesh.points[v].begin());
    for (const double value : mesh.points[v]) {
      if (!(std::abs(value) <= kFarthest))
        return misusedObject("Vertex " + std::to_string(v) +
                             " of the mesh lies at no finite place.");
    }
  }
  const Box box = boxAround(mesh.points);
  const Point extent = box.high - box.low;
  const double longest = std::max({extent[0], extent[1], extent[2]});
  if (longest > 0 && longest < kSmallest)
    return misusedObject("The mesh is smaller than 1e-30 of its unit: take a smaller unit.");
  mesh.triangles.resize(given.triangle_count);
  for (uint32_t t = 0; t < given.triangle_count; ++t) {
    std::copy_n(given.triangles + 3 * size_t{t}, 3, mesh.triangles[t].begin());
    for (const uint32_t corner : mesh.triangles[t]) {
      if (corner >= given.vertex_count)
        return misusedObject("Triangle " + std::to_string(t) + " of the mesh names vertex " +
                             std::to_string(corner) + ", which is not there.");
    }
  }
  return mesh;
}

Status checkMeshImage(const tks_triangle_mesh& mesh, const tks_image* image) {
  if (image == nullptr) return {};
  if (mesh.texcoords == nullptr)
    return misusedObject("The mesh has no texture coordinates for its image.");
  const bool sound = image->data != nullptr && image->channels >= 1 && image->channels <= 4 &&
                     image->width >= 1 && image->height >= 1 &&
                     (image->sample == TKS_U8 || image->sample == TKS_U16) &&
                     image->domain == TKS_DOMAIN_PLANE;
  return sound ? Status()
               : misusedObject("The image of a mesh has 8 or 16 bits and 1 to 4 channels.");
}

Status checkObjectOptions(const tks_encode_options& o) {
  if (o.lossless != 0)
    return misusedObject(
        "An object is resampled, so that it cannot be lossless: give a number of bytes, "
        "a PSNR or a largest error.");
  if (!std::isfinite(o.psnr) || o.psnr < 0 || !std::isfinite(o.max_error) || o.max_error < 0 ||
      (o.bytes != 0) + (o.psnr != 0) + (o.max_error != 0) != 1)
    return misusedObject("Give exactly one of bytes, psnr and max-error.");
  if (o.triangles > 0 || o.picture_error != nullptr || o.regions > 1)
    return misusedObject(
        "Of an object there are no regions, budgets of triangles and errors of a caller's "
        "pictures.");
  if (o.camera_count > 0 && o.cameras == nullptr) return misusedObject("The cameras are missing.");
  return {};
}

double GivenObject::wantedError() const {
  return options.max_error > 0 ? options.max_error
                               : source.diagonal() * portable::pow(10.0, -options.psnr / 20);
}

MeshColours GivenObject::coloursOf(const tks_image& of) const {
  const size_t values = size_t{of.width} * of.height * of.channels;
  MeshImage texels{of.width, of.height, of.channels, {}, {}};
  if (of.sample == TKS_U8)
    texels.bytes = {static_cast<const uint8_t*>(of.data), values};
  else
    texels.shorts = {static_cast<const uint16_t*>(of.data), values};
  return {source.cleaned(), {mesh.texcoords, 6 * size_t{mesh.triangle_count}}, texels};
}

Result<std::vector<uint8_t>> encodedTrial(GivenObject& given, tks_encode_options options,
                                          const tks_heights* heights, const tks_image* image) {
  options.explain = nullptr;
  given.progress.attend(options);
  tks_buffer buffer{};
  std::string message(300, '\0');
  const tks_status status =
      tks_encode(heights, image, &options, &buffer, message.data(), message.size());
  if (given.progress.isStopped()) throw Stopped();
  if (status != TKS_OK) return Status(status, message.c_str());
  const std::unique_ptr<tks_buffer, decltype(&tks_free_buffer)> held(&buffer, tks_free_buffer);
  return std::vector<uint8_t>(buffer.data, buffer.data + buffer.size);
}

Result<std::vector<uint16_t>> decodedTexels(const std::vector<uint8_t>& stream) {
  tks_decoder* opened = nullptr;
  const tks_status status = tks_open(stream.data(), stream.size(), nullptr, &opened, nullptr, 0);
  const OwnDecoder decoder(opened);
  tks_info info{};
  info.size = sizeof info;
  if (status != TKS_OK || tks_get_info(decoder.get(), &info) != TKS_OK)
    return Status(TKS_MISMATCH, "The stream of the object is not sound.");
  const size_t count = size_t{info.texture_width} * info.texture_height * info.texture_channels;
  std::vector<uint16_t> texels(count);
  std::vector<uint8_t> bytes(info.texture_sample == TKS_U8 ? count : 0);
  void* const out = bytes.empty() ? static_cast<void*>(texels.data()) : bytes.data();
  const size_t size = bytes.empty() ? 2 * count : count;
  if (tks_decode_texture(decoder.get(), out, size) != TKS_OK)
    return Status(TKS_MISMATCH, "The texture of the object is not sound.");
  if (!bytes.empty()) texels.assign(bytes.begin(), bytes.end());
  return texels;
}

}  // namespace tetrakis::inline api
