// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/modelled_pairs.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "encoder/views/view_inputs.hpp"
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

}  // namespace

std::vector<double> modelledErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                   const Nodes& nodes) {
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

}  // namespace tetrakis::inline views
