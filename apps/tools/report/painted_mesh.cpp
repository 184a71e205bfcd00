// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/painted_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/object_mesh.hpp"
#include "codec/remesh/mesh_distance.hpp"

namespace tetrakis::tools {
namespace {

using Colour = std::array<double, 3>;

/// Of 255.
double valueAt(const ImageFile& image, size_t sample) {
  constexpr double kWhite = 255;
  if (image.sample == TKS_U8)
    return kWhite * static_cast<uint8_t>(image.data[sample]) / image.white();
  uint16_t value = 0;
  std::memcpy(&value, image.data.data() + 2 * sample, sizeof value);
  return std::min(kWhite, kWhite * value / image.white());
}

Colour texelAt(const ImageFile& image, double x, double y) {
  const auto inside = [](double at, uint32_t side) {  // the image repeats
    return static_cast<size_t>(std::min(at - std::floor(at / side) * side, side - 1.0));
  };
  const size_t texel = inside(y, image.height) * image.width + inside(x, image.width);
  const size_t colours = image.channels < 3 ? 1 : 3;
  Colour colour{};
  for (size_t c = 0; c < 3; ++c)
    colour[c] = valueAt(image, texel * image.channels + std::min(c, colours - 1));
  return colour;
}

/// Bilinear between the middles of texels.
Colour colourAt(const PaintedMesh& painted, const ImageFile& image, const SurfacePoint& place) {
  double x = -0.5, y = -0.5;
  for (size_t k = 0; k < 3; ++k) {
    const auto& corner = painted.texcoords[3 * size_t{place.triangle} + k];
    x += place.weights[k] * double{corner[0]} * image.width;
    y += place.weights[k] * double{corner[1]} * image.height;
  }
  const double left = std::floor(x), top = std::floor(y);
  Colour colour{};
  for (const int down : {0, 1}) {
    for (const int right : {0, 1}) {
      const double weight = std::abs(1 - right - (x - left)) * std::abs(1 - down - (y - top));
      const Colour texel = texelAt(image, left + right, top + down);
      for (size_t c = 0; c < 3; ++c) colour[c] += weight * texel[c];
    }
  }
  return colour;
}

double squaredDifference(const Colour& a, const Colour& b) {
  double squares = 0;
  for (size_t c = 0; c < 3; ++c) squares += (a[c] - b[c]) * (a[c] - b[c]);
  return squares;
}

}  // namespace

double colourError(const PaintedMesh& from, const PaintedMesh& to, const TriangleTree& tree) {
  double squares = 0;
  const std::vector<SurfacePoint> places = evenPlaces(from.mesh, kDistanceSamples);
  for (const SurfacePoint& place : places)
    squares +=
        squaredDifference(colourAt(from, *from.image, place),
                          colourAt(to, *to.image, tree.closest(at(from.mesh, place))->place));
  return squares / (3 * static_cast<double>(places.size()));
}

double colourError(const PaintedMesh& painted, const ImageFile& other) {
  double squares = 0;
  const std::vector<SurfacePoint> places = evenPlaces(painted.mesh, kDistanceSamples);
  for (const SurfacePoint& place : places)
    squares += squaredDifference(colourAt(painted, *painted.image, place),
                                 colourAt(painted, other, place));
  return squares / (3 * static_cast<double>(places.size()));
}

double colourPsnr(double error) {
  constexpr double kWhite = 255;
  return error > 0 ? 10 * std::log10(kWhite * kWhite / error)
                   : std::numeric_limits<double>::infinity();
}

Result<PaintedMesh> decodedMesh(Decoder& decoder, uint32_t max_triangles) {
  const Result<ObjectMesh> mesh = decoder.objectMesh(TKS_MESH_BUDGET, max_triangles);
  if (!mesh.ok()) return mesh.status();
  PaintedMesh painted;
  for (size_t i = 0; i < mesh->positions().size(); i += 3) {
    const auto point = mesh->positions().subspan(i, 3);
    painted.mesh.points.push_back({point[0], point[1], point[2]});
  }
  for (size_t i = 0; i < mesh->triangles().size(); i += 3) {
    const auto corners = mesh->triangles().subspan(i, 3);
    painted.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  const std::vector<float> places = objectTexcoords(decoder.info(), *mesh);
  if (places.empty()) return painted;
  const Result<ImageFile> raster = decodeImage(decoder);
  if (!raster.ok()) return raster.status();
  painted.image = hasAtlas(decoder.info()) ? atlasOf(decoder.info()).pictureOf(*raster) : *raster;
  for (const uint32_t corner : mesh->triangles())
    painted.texcoords.push_back({places[2 * size_t{corner}], places[2 * size_t{corner} + 1]});
  return painted;
}

}  // namespace tetrakis::tools
