// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/pairs.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "encoder/views/modelled_pairs.hpp"
#include "encoder/views/nodes.hpp"
#include "encoder/views/rendered_pairs.hpp"
#include "ratecontrol/allocation/corrected_errors.hpp"

namespace tetrakis::inline views {

namespace {

/// Bytes behind the opening of the first prefix that is looked at. A smaller number takes time for
/// prefixes that show little.
constexpr double kFirstNode = 64;
/// The bytes of one prefix that is looked at over those of the one before; with meshes, which take
/// long, and without them. Ratios of 3.5 lose 0.33 dB where 2 loses 0.12; smaller ones take time.
constexpr double kMeshRatio = 4, kRatio = 2;
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
  const double ratio = meshes_for_cameras ? kMeshRatio : kRatio;
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
