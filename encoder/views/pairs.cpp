// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/pairs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/samples.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "encoder/views/view_inputs.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis::inline views {

namespace {

using Surfaces = std::vector<PictureErrors::Surface>;

/// Prefixes of the heights as viewers see them, and at last all heights, of which they may see a
/// mesh.
Surfaces surfacesOf(const PictureErrors& pictures, DecodedNodes& decoded,
                    const std::vector<RatePoint>& nodes) {
  Surfaces surfaces;
  for (const RatePoint& node : nodes)
    surfaces.push_back(pictures.surfaceOf(GroundRays(decoded.shownAt(node.bytes))));
  std::optional<Relief> mesh = decoded.meshOfAll();
  surfaces.push_back(mesh ? pictures.surfaceOf(GroundRays(*std::move(mesh)))
                          : pictures.trueSurface());
  return surfaces;
}

std::vector<double> withTrueTexture(const PictureErrors& pictures, const Surfaces& surfaces) {
  std::vector<double> errors;
  for (const auto& surface : surfaces)
    errors.push_back(pictures.errorInside(surface, pictures.trueTexture()));
  return errors;
}

/// The error that a texture adds to a picture changes little from one surface to the next. So every
/// other surface is not looked at through each texture, except the last prefix and the original.
/// count: of all surfaces, the original last.
bool isLookedAt(size_t surface, size_t count) {
  return surface % 2 == 0 || surface + 2 >= count;
}

/// Interpolates the errors of the other surfaces between their neighbours. A shift of the ground
/// changes the picture, and changes how much of a texture's errors one sees; both effects grow with
/// its square as long as it is small. errors: with a texture, whole: with the original one, by
/// surfaces.
void fillBetween(const std::vector<double>& whole, std::vector<double>& errors) {
  for (size_t g = 1; g + 1 < errors.size(); ++g) {
    if (isLookedAt(g, errors.size())) continue;
    const double before = whole[g - 1], here = whole[g], after = whole[g + 1];
    const bool falls = before >= here && here >= after && before > after;
    const double rest = falls ? (before - here) / (before - after) : 0.5;
    const double from = errors[g - 1] - before, to = errors[g + 1] - after;
    errors[g] = std::max(here + from + (to - from) * rest, 0.0);
  }
}

/// whole: the errors with the original texture.
std::vector<double> withTexture(const PictureErrors& pictures, const Surfaces& surfaces,
                                const ScreenTexture& texture, const std::vector<double>& whole) {
  std::vector<double> errors(surfaces.size());
  for (size_t g = 0; g < surfaces.size(); ++g)
    if (isLookedAt(g, surfaces.size())) errors[g] = pictures.errorInside(surfaces[g], texture);
  fillBetween(whole, errors);
  return errors;
}

// modelledErrors() is the modelled engine: rays of the cameras (ratecontrol/pictures/) look at all
// pairs of a prefix of the heights with a prefix of the texture, and give the error of each
// picture.

/// Errors of the pictures of all pairs, in the order that PairErrors takes; none if nobody can look
/// at the terrain.
std::vector<double> modelledErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                   const Nodes& nodes) {
  if (inputs.heights->domain == TKS_DOMAIN_FOREST) return objectErrors(inputs, decoded, nodes);
  const GroundRays ground(decoded.original());
  const std::vector<Camera> cameras = camerasOf(inputs.options, ground.bounds());
  if (cameras.empty()) return {};
  const PictureErrors pictures(cameras, kViewPixels, ground, decoded.originalTexels());
  const Surfaces surfaces = surfacesOf(pictures, decoded, nodes.heights);
  const std::vector<double> whole = withTrueTexture(pictures, surfaces);
  std::vector<std::vector<double>> columns;
  for (const RatePoint& node : nodes.textures)
    columns.push_back(withTexture(pictures, surfaces, decoded.textureAt(node.bytes), whole));
  columns.push_back(whole);
  std::vector<double> errors;
  for (size_t g = 0; g < surfaces.size(); ++g)
    for (const std::vector<double>& column : columns)
      errors.push_back(column[g] + surfaces[g].outlines);
  return errors;
}

std::vector<std::byte> bytesOfTexels(const Texels& texels, tks_sample sample) {
  std::vector<std::byte> bytes(texels.samples.size() * tks_sample_bytes(sample));
  withSampleType(sample, [&](auto type) {
    auto* to = reinterpret_cast<decltype(type)*>(bytes.data());
    std::transform(texels.samples.begin(), texels.samples.end(), to,
                   [](uint16_t v) { return static_cast<decltype(type)>(v); });
  });
  return bytes;
}

// renderedErrors() is the rendered engine: a renderer of the caller's (tks_picture_error) draws
// every other prefix of either component, and its errors correct those of the modelled engine for
// all pairs (ratecontrol/allocation/allocation.hpp).

/// Errors of the pictures of all pairs, in the order that PairErrors takes; none if the renderer
/// failed. inputs: with a renderer.
std::vector<double> renderedErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                   const Nodes& nodes) {
  const tks_encode_options& options = inputs.options;
  std::vector<DecodedNodes::Samples> surfaces;
  for (const RatePoint& node : nodes.heights) surfaces.push_back(decoded.heightsAt(node.bytes, {}));
  const size_t rows = nodes.heights.size() + 1, columns = nodes.textures.size() + 1;
  std::vector<double> errors(rows * columns);
  for (size_t t = 0; t < columns; ++t) {
    std::vector<std::byte> texels;
    if (t + 1 < columns)
      texels = bytesOfTexels(decoded.texelsAt(nodes.textures[t].bytes, {}), inputs.image->sample);
    for (size_t g = 0; g < rows; ++g) {
      if (g + 1 == rows && t + 1 == columns) continue;  // the originals themselves
      const void* heights = g + 1 < rows ? surfaces[g].data.data() : inputs.heights->data;
      const void* texture = t + 1 < columns ? texels.data() : inputs.image->data;
      double squares = 0, values = 0;
      const int failed =
          options.picture_error(options.picture_user, heights, texture, &squares, &values);
      if (failed != 0 || !(squares >= 0) || !(values > 0)) return {};
      errors[g * columns + t] = squares / values;
    }
  }
  return errors;
}

/// Bytes behind the opening of the first prefix that is looked at. A smaller number takes time for
/// prefixes that show little.
constexpr double kFirstNode = 64;
/// The ratio of the bytes of two prefixes that are looked at one after the other: with meshes and
/// forests, which take long, and without them. Ratios of 3.5 lose 0.33 dB where 2 loses 0.12;
/// smaller ones take time.
constexpr double kSlowRatio = 4, kRatio = 2;
/// Prefixes are looked at up to this part of the budget. Up to a third joint encoding takes 0.8 of
/// the time, with losses within 0.03 dB; a smaller number looks at longer prefixes.
constexpr uint64_t kPartWithNodes = 3;

/// The prefixes of a component that are looked at: points of its curve, from the opening on, each
/// of `ratio` times the bytes of the one before, up to the first point beyond a part of the
/// budget. Behind that point errors go on to fall as they did (PairErrors), and the last nodes take
/// most time.
template <class Coded>
std::vector<RatePoint> nodesOf(const Rated<Coded>& rated, double ratio, uint64_t budget) {
  const ComponentCurve& curve = rated.curve;
  const std::span<const RatePoint> points = endsWithPasses(rated)
                                                ? std::span(curve.passes)
                                                : std::span(curve.points).subspan(curve.opened);
  std::vector<RatePoint> nodes = {points.front()};
  double next = kFirstNode;
  for (size_t i = 1; i < points.size(); ++i) {
    const auto bytes = static_cast<double>(points[i].bytes - points.front().bytes);
    const bool last = i + 1 == points.size();
    if (bytes < next && !last) continue;
    if (!(points[i].distortion > 0 && points[i].distortion < nodes.back().distortion)) continue;
    nodes.push_back(points[i]);
    next = std::max(bytes, next) * ratio;
    if (points[i].bytes >= budget / kPartWithNodes) break;
  }
  return nodes;
}

std::vector<double> squaresAt(const std::vector<RatePoint>& nodes) {
  std::vector<double> squares;
  for (const RatePoint& node : nodes) squares.push_back(node.distortion);
  return squares;
}

/// The prefixes that a renderer draws.
std::vector<RatePoint> drawnOf(const std::vector<RatePoint>& nodes) {
  std::vector<RatePoint> drawn;
  for (const size_t place : measuredPlaces(nodes.size()))
    if (place < nodes.size()) drawn.push_back(nodes[place]);
  return drawn;
}

/// Errors without pictures: the squared errors of each component relative to its first one, which
/// add.
PairErrors relativeErrors(const ComponentCurve& heights, const ComponentCurve& texture) {
  const auto first = [](const ComponentCurve& curve) {
    const double square = curve.points[curve.opened].distortion;
    return std::vector<double>{square > 0 ? square : 1};
  };
  return {{first(heights), first(texture)}, {2, 1, 1, 0}};
}

}  // namespace

PairErrors pairErrorsOf(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                        const Rated<CodedTexture>& texture) {
  const bool meshes_for_cameras =
      inputs.options.camera_count > 0 && looksAtMeshes(inputs, *heights.coded.quantised);
  const bool on_forest = inputs.heights->domain == TKS_DOMAIN_FOREST;
  const double ratio = meshes_for_cameras || on_forest ? kSlowRatio : kRatio;
  const uint64_t budget = inputs.budgeted() ? inputs.options.bytes : UINT64_MAX;
  const Nodes nodes = {nodesOf(heights, ratio, budget), nodesOf(texture, ratio, budget)};
  PairNodes squares = {squaresAt(nodes.heights), squaresAt(nodes.textures)};
  const bool exact = squares.heights.front() <= 0 || squares.textures.front() <= 0;
  if (exact) return relativeErrors(heights.curve, texture.curve);
  DecodedNodes decoded(inputs, heights, texture);
  std::vector<double> errors = modelledErrors(inputs, decoded, nodes);
  if (!errors.empty() && inputs.options.picture_error != nullptr) {
    DecodedNodes shown(inputs, heights, texture);
    const std::vector<double> drawn =
        renderedErrors(inputs, shown, {drawnOf(nodes.heights), drawnOf(nodes.textures)});
    if (!drawn.empty())
      errors = correctedErrors({nodes.heights.size(), nodes.textures.size(), errors}, drawn);
  }
  if (errors.empty() || !(errors.front() > 0)) return relativeErrors(heights.curve, texture.curve);
  return {std::move(squares), std::move(errors)};
}

}  // namespace tetrakis::inline views
