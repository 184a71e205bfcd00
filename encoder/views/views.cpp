// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/views.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/samples.hpp"
#include "encoder/views/view_inputs.hpp"
#include "ground/camera.hpp"
#include "ratecontrol/pictures/outlines.hpp"
#include "ratecontrol/pictures/screen_points.hpp"

namespace tetrakis::inline views {

namespace {

/// Pixels for whole streams, which differ by less than pairs of prefixes do.
constexpr size_t kPrefixPixels = 4 * kViewPixels;
/// Columns in which outlines are followed, over all cameras.
constexpr size_t kOutlineColumns = 256;

/// The cameras of the options, or those for any viewer; none if the terrain has no bounds.
std::vector<Camera> camerasOf(const EncodeInputs& inputs, const GroundRays& ground) {
  if (inputs.options.camera_count > 0) return givenCameras(inputs.options);
  const Result<std::vector<Camera>> cameras = unknownViewer(ground.bounds());
  return cameras.ok() ? *cameras : std::vector<Camera>();
}

/// Prefixes of a component that are looked at: points of its curve, from the opening on, each of
/// `ratio` times the bytes of the one before, up to the first beyond a third of the budget: behind
/// that errors fall as they did (PairErrors), and the last nodes take most time.
template <class Coded>
std::vector<RatePoint> nodesOf(const Rated<Coded>& rated, double ratio, uint64_t budget) {
  constexpr double kFirst = 64;  // bytes
  const ComponentCurve& curve = rated.curve;
  const std::span<const RatePoint> points = endsWithPasses(rated)
                                                ? std::span(curve.passes)
                                                : std::span(curve.points).subspan(curve.opened);
  std::vector<RatePoint> nodes = {points.front()};
  double next = kFirst;
  for (size_t i = 1; i < points.size(); ++i) {
    const auto bytes = static_cast<double>(points[i].bytes - points.front().bytes);
    const bool last = i + 1 == points.size();
    if (bytes < next && !last) continue;
    if (!(points[i].distortion > 0 && points[i].distortion < nodes.back().distortion)) continue;
    nodes.push_back(points[i]);
    next = std::max(bytes, next) * ratio;
    if (points[i].bytes >= budget / 3) break;
  }
  return nodes;
}

/// The pairs that are looked at: points of either curve.
struct Nodes {
  std::vector<RatePoint> heights, textures;
};

std::vector<double> squaresAt(const std::vector<RatePoint>& nodes) {
  std::vector<double> squares;
  for (const RatePoint& node : nodes) squares.push_back(node.distortion);
  return squares;
}

/// What surfaces look like with one texture.
using SeenColours = std::vector<std::vector<Colour>>;

SeenColours coloursOf(const ScreenPoints& points, const std::vector<std::vector<SeenPoint>>& seen,
                      const ScreenTexture& texture) {
  SeenColours colours;
  colours.reserve(seen.size());
  for (const auto& surface : seen) colours.push_back(points.coloursOf(surface, texture));
  return colours;
}

/// Prefixes of the heights as viewers see them, and at last all heights.
struct Surfaces {
  std::vector<std::vector<SeenPoint>> seen;
  std::vector<double> outlines;  ///< their errors
};

/// truth: the ground of all heights, of which viewers may see a mesh.
Surfaces surfacesOf(const ScreenPoints& points, const Outlines& outlines, const GroundRays& truth,
                    DecodedNodes& decoded, const Nodes& nodes, Extent texels) {
  Surfaces surfaces;
  const auto add = [&](const GroundRays& ground) {
    surfaces.outlines.push_back(outlines.errorOf(ground));
    surfaces.seen.push_back(points.seenOf(ground, texels));
  };
  for (const RatePoint& node : nodes.heights) add(GroundRays(decoded.shownAt(node.bytes)));
  if (std::optional<Relief> mesh = decoded.meshOfAll()) {
    add(GroundRays(*std::move(mesh)));
  } else {
    surfaces.seen.push_back(points.seenOf(truth, texels));
    surfaces.outlines.push_back(0);
  }
  return surfaces;
}

/// What a texture adds to the error of a picture changes little from one surface to the next. So
/// every other surface is not looked at through each texture, but for the last prefix and the
/// original. count: of all surfaces, the original last.
bool isLookedAt(size_t surface, size_t count) {
  return surface % 2 == 0 || surface + 2 >= count;
}

/// Gives the other surfaces what their neighbours have: of what a shift of the ground does to a
/// picture and of what it does to a texture's errors, both grow with its square as long as it is
/// small. errors: with a texture, whole: with the original one, by surfaces.
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

/// Errors of all pairs of nodes by the modelled engine: all surfaces are traced first, then each
/// texture is looked at through them.
std::vector<double> modelledErrors(const std::vector<Camera>& cameras, const GroundRays& ground,
                                   DecodedNodes& decoded, const Nodes& nodes,
                                   const Texels& texels) {
  const ScreenPoints points(cameras, kViewPixels);
  const Extent extent = texels.extent();
  const ScreenTexture original(texels, extent);
  const Outlines outlines(cameras, kOutlineColumns, ground, original, extent);
  const Surfaces surfaces = surfacesOf(points, outlines, ground, decoded, nodes, extent);
  const std::vector<std::vector<SeenPoint>>& seen = surfaces.seen;
  const SeenColours whole = coloursOf(points, seen, original);
  const bool of_mesh = decoded.showsMeshes();
  const std::vector<SeenPoint> in_truth = of_mesh ? points.seenOf(ground, extent) : seen.back();
  const std::vector<Colour> true_colours =
      of_mesh ? points.coloursOf(in_truth, original) : whole.back();
  const ScreenPoints::Pictures truth{in_truth, true_colours};
  std::vector<double> inside;
  for (size_t g = 0; g < seen.size(); ++g)
    inside.push_back(points.errorInside(truth, {seen[g], whole[g]}));
  const size_t columns = nodes.textures.size() + 1;
  std::vector<double> errors(seen.size() * columns);
  for (size_t t = 0; t < columns; ++t) {
    std::vector<double> column = inside;
    if (t + 1 < columns) {
      const ScreenTexture texture = decoded.textureAt(nodes.textures[t].bytes);
      for (size_t g = 0; g < seen.size(); ++g) {
        if (!isLookedAt(g, seen.size())) continue;
        const std::vector<Colour> colours = points.coloursOf(seen[g], texture);
        column[g] = points.errorInside(truth, {seen[g], colours});
      }
      fillBetween(inside, column);
    }
    for (size_t g = 0; g < seen.size(); ++g) {
      errors[g * columns + t] = column[g] + surfaces.outlines[g];
    }
  }
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

/// Errors of all pairs of nodes by the caller's renderer; none if it failed.
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

/// A component's part of some prefixes of a stream, as points of a curve: one for each. With
/// priorities errors count by what viewers see of them.
template <class Coded>
ComponentCurve curveOfPrefixes(const Coded& coded, const std::vector<Packet>& packets,
                               std::span<const uint64_t> lengths) {
  const CodedTracks rated = coded.rated();
  ComponentCurve curve;
  curve.packets = packets;
  for (const uint64_t length : lengths) {
    uint64_t left = length, bytes = 0;
    for (const Packet& packet : packets) {
      const uint64_t head = overheadOf(packet), payload = packet.end - packet.begin;
      if (left <= head) break;
      const uint64_t taken = std::min(left - head, payload);
      left -= head + taken;
      if (packet.component == rated.component && (!packet.whole || taken == payload))
        bytes += taken;
    }
    double squares = 0;
    const Codewords prefix = prefixAfter(rated, packets, bytes);
    for (size_t i = 0; i < prefix.size(); ++i)
      squares += distortionAt(rated.tracks[i].points, prefix[i].size());
    curve.points.push_back({bytes, squares / coded.counted()});
  }
  return curve;
}

/// Errors as if those of both components were seen as large as they are at first, and added.
PairErrors unseen(const ComponentCurve& heights, const ComponentCurve& texture) {
  const auto first = [](const ComponentCurve& curve) {
    const double square = curve.points[curve.opened].distortion;
    return std::vector<double>{square > 0 ? square : 1};
  };
  return {{first(heights), first(texture)}, {2, 1, 1, 0}};
}

}  // namespace

PairErrors pairErrorsOf(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                        const Rated<CodedTexture>& texture) {
  // Pictures that are drawn take long, and meshes for cameras: fewer of them.
  const bool meshes_for_cameras =
      inputs.options.camera_count > 0 && looksAtMeshes(inputs, *heights.coded.of);
  const double ratio = inputs.options.picture_error != nullptr || meshes_for_cameras ? 4 : 2;
  const uint64_t budget = inputs.budgeted() ? inputs.options.bytes : UINT64_MAX;
  DecodedNodes decoded(inputs, heights, texture);
  const GroundRays ground(decoded.original());
  const std::vector<Camera> cameras = camerasOf(inputs, ground);
  const Nodes nodes = {nodesOf(heights, ratio, budget), nodesOf(texture, ratio, budget)};
  PairNodes squares = {squaresAt(nodes.heights), squaresAt(nodes.textures)};
  const bool exact = squares.heights.front() <= 0 || squares.textures.front() <= 0;
  if (exact) return unseen(heights.curve, texture.curve);
  std::vector<double> errors;
  if (inputs.options.picture_error != nullptr) {
    DecodedNodes for_renderer(inputs, heights, texture);
    errors = renderedErrors(inputs, for_renderer, nodes);
  }
  if (errors.empty() && !cameras.empty())
    errors = modelledErrors(cameras, ground, decoded, nodes, texture.coded.of->texels);
  if (errors.empty() || !(errors.front() > 0)) return unseen(heights.curve, texture.curve);
  return {std::move(squares), std::move(errors)};
}

std::vector<double> errorsOfPrefixes(const EncodeInputs& inputs, const Selection& selection,
                                     std::span<const uint64_t> lengths) {
  const CodedHeights& heights = *selection.heights;
  const CodedTexture& texture = *selection.texture;
  const ComponentCurve of_heights = curveOfPrefixes(heights, selection.packets, lengths);
  const ComponentCurve of_texture = curveOfPrefixes(texture, selection.packets, lengths);
  DecodedNodes decoded(inputs, {heights, of_heights}, {texture, of_texture});
  const GroundRays ground(decoded.original());
  const std::vector<Camera> cameras = camerasOf(inputs, ground);
  if (cameras.empty()) return {};
  const Texels& texels = texture.of->texels;
  const ScreenTexture original(texels, texels.extent());
  const ScreenPoints points(cameras, kPrefixPixels);
  const Outlines outlines(cameras, kOutlineColumns, ground, original, texels.extent());
  const std::vector<SeenPoint> in_truth = points.seenOf(ground, texels.extent());
  const std::vector<Colour> true_colours = points.coloursOf(in_truth, original);
  const ScreenPoints::Pictures truth{in_truth, true_colours};
  std::vector<double> errors;
  for (size_t i = 0; i < lengths.size(); ++i) {
    const GroundRays shown(decoded.shownAt(of_heights.points[i].bytes));
    const std::vector<SeenPoint> seen = points.seenOf(shown, texels.extent());
    const std::vector<Colour> colours =
        points.coloursOf(seen, decoded.textureAt(of_texture.points[i].bytes));
    errors.push_back(points.errorInside(truth, {seen, colours}) + outlines.errorOf(shown));
  }
  return errors;
}

}  // namespace tetrakis::inline views
