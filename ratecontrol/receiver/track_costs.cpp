// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/receiver/placed_packets.hpp"

#include <algorithm>
#include <cmath>

#include "base/coordinates.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/track.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::inline receiver {

namespace {

/// The grid that the columns and rows of views count.
Extent gridOf(const StreamHeader& header) {
  return header.geometry ? header.geometry->shown() : header.texture->shown();
}

/// Pixels of a texel for a point with so many of a sample.
double texelsPixels(const StreamHeader& header, double pixels) {
  if (!header.texture) return pixels;
  return pixels * static_cast<double>(gridOf(header).samples()) /
         static_cast<double>(header.texture->shown().samples());
}

/// What height errors cost at a point. They move the texture by their parallax, and the texture's
/// slope is the smaller the larger a texel appears. A picture's error grows with the square of that
/// shift while details are wider, and hardly more when they are not: over the errors that prefixes
/// have, with the shift itself (docs/EXPERIMENTS.md).
double heightsCost(const StreamHeader& header, const GroundPoint& point) {
  const double slope = std::max(1.0, texelsPixels(header, point.pixels));
  return point.pixels * std::sqrt(point.parallax / slope);
}

/// A picture that the encoder reckons with where it knows no cameras, of flat ground.
struct UsualView {
  double seen;    ///< share of the ground
  double filled;  ///< share of the picture
  double sine;    ///< of the angle between the lines of sight and the horizon
};

/// From afar, from near and from above (unknownViewer() in codec/ground/camera.hpp).
constexpr std::array<UsualView, 3> kUsualViews = {{{1, 0.5, 0.574}, {0.1, 0.8, 0.2}, {1, 0.67, 1}}};

/// The mean point of the ground that the view shows.
GroundPoint meanPoint(const StreamHeader& header, const UsualView& view) {
  constexpr double kPixels = 768 * 512;
  const double samples = view.seen * static_cast<double>(gridOf(header).samples());
  const double pixels = view.filled * kPixels / samples;
  const Metadata& m = header.metadata;
  const GroundFrame frame = knownFrame({.spacing_x = m.spacing_x, .spacing_y = m.spacing_y});
  const double metres = metresPerUnit(m.unit).value_or(1);
  const double area = frame.spacing_x * frame.spacing_y;
  const double leaning = (1 - view.sine * view.sine) / view.sine;
  return {pixels, pixels * leaning / area * metres * metres};
}

/// The mean of a cost over all ground and the usual views; cost: of a point.
template <class Cost>
double usualCost(const StreamHeader& header, Cost&& cost) {
  double sum = 0;
  for (const UsualView& view : kUsualViews) sum += view.seen * cost(meanPoint(header, view));
  return sum / static_cast<double>(kUsualViews.size());
}

/// By log10(), which decoders need as well: the tables of std::log2() are one part in 80 of a
/// WebAssembly module.
double log4(double value) {
  return std::log10(value) / 0.6020599913279624;
}

/// The share of a region's levels that a picture with so many pixels a sample shows: a level's
/// finest waves are 2^level samples long, and take two pixels. coarsest_unseen: finer levels than
/// the next are not decoded.
double shownShare(const Region& region, double pixels, int coarsest_unseen) {
  const int last = region.isBase() ? region.first_level + kRegionLevels - 1 : region.last_level;
  const double finest = std::max<double>(1 - log4(pixels), coarsest_unseen + 1);
  return std::clamp((last + 1 - finest) / (last + 1 - region.first_level), 0.0, 1.0);
}

/// Heights finer than a mip level with 20 samples a triangle are not decoded for a budget mesh.
int levelBelowMesh(const StreamHeader& header, uint32_t triangles) {
  if (triangles == 0) return 0;
  constexpr double kSamples = 20;
  const double most = static_cast<double>(gridOf(header).samples()) / (kSamples * triangles);
  return most < 4 ? 0 : std::ilogb(most) / 2;
}

/// Ground of absurd spacing costs nothing.
double finite(double cost) {
  return std::isfinite(cost) ? cost : 0;
}

std::vector<Region> regionsIn(const auto& component) {
  return regionsOf(component.width, component.height, component.regions.side_log2,
                   component.wavelet.patches());
}

/// A stream as one sighting shows it.
class SightedStream {
 public:
  SightedStream(const StreamHeader& header, const Sighting& sighting)
      : header_(header),
        sighting_(sighting),
        usual_of_heights_(usualCost(
            header, [&](const GroundPoint& point) { return heightsCost(header, point); })),
        usual_texel_(texelsPixels(
            header, usualCost(header, [](const GroundPoint& point) { return point.pixels; }))),
        unseen_(levelBelowMesh(header, sighting.triangles)) {}

  double costOfHeights(const Region& region) const {
    if (sighting_.ground.points.empty()) return shownShare(region, 1, unseen_);
    return meanOver(region, *header_.geometry, sighting_.ground,
                    [&](const GroundPoint& point) {
                      return heightsCost(header_, point) *
                             shownShare(region, point.pixels, unseen_);
                    }) /
           usual_of_heights_;
  }

  double costOfTexture(const Region& region) const {
    if (sighting_.ground.points.empty()) return 1;
    const bool is_own = !sighting_.texture.points.empty();
    return meanOver(region, *header_.texture, is_own ? sighting_.texture : sighting_.ground,
                    [&](const GroundPoint& point) {
                      const double pixels =
                          is_own ? point.pixels : texelsPixels(header_, point.pixels);
                      return pixels * shownShare(region, pixels, 0);
                    }) /
           usual_texel_;
  }

 private:
  /// The mean cost of the points that a region of a plane reaches, as its waves end beyond it;
  /// hidden points count as 0.
  template <class Cost>
  static double meanOver(const Region& region, const auto& component, const SeenRaster& seen,
                         Cost&& cost) {
    const Extent plane = component.extent();
    const SharedForest& forest = component.wavelet.forest;
    if (forest != nullptr && !region.isBase()) return meanOnForest(region, *forest, seen, cost);
    const auto first = [](uint32_t begin, uint32_t side, uint32_t points) {
      return static_cast<uint32_t>(uint64_t{begin} * points / side);
    };
    const auto behind = [](uint32_t end, uint32_t side, uint32_t points) {
      return static_cast<uint32_t>((uint64_t{end} * points + side - 1) / side);
    };
    const auto& [columns, rows, points] = seen;
    double sum = 0;
    size_t count = 0;
    const uint32_t reach = region.isBase() ? 0 : uint32_t{1} << std::min(region.last_level, 24);
    const uint32_t x0 = first(region.x0 - std::min(reach, region.x0), plane.width, columns);
    const uint32_t y0 = first(region.y0 - std::min(reach, region.y0), plane.height, rows);
    const uint32_t x1 = behind(std::min(region.x1 + reach, plane.width), plane.width, columns);
    const uint32_t y1 = behind(std::min(region.y1 + reach, plane.height), plane.height, rows);
    for (uint32_t y = y0; y < y1; ++y) {
      for (uint32_t x = x0; x < x1; ++x, ++count) {
        const GroundPoint& point = points[size_t{y} * columns + x];
        if (point.pixels > 0) sum += cost(point);
      }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

  /// The same on a forest, where a region's waves end beyond the sides of its patch.
  template <class Cost>
  static double meanOnForest(const Region& region, const Forest& forest, const SeenRaster& seen,
                             Cost&& cost) {
    const int64_t most = forest.side() - 1, n = seen.columns - 1;
    const uint32_t patch = region.y0 / forest.side(), above = patch * forest.side();
    const int64_t reach = int64_t{1} << std::min(region.last_level, 24);
    const auto first = [&](int64_t begin) { return std::max((begin - reach) * n / most - 1, -n); };
    const auto last = [&](int64_t end) { return std::min((end + reach) * n / most + 1, 2 * n); };
    double sum = 0;
    size_t count = 0;
    for (int64_t y = first(region.y0 - above); y <= last(region.y1 - above); ++y) {
      for (int64_t x = first(region.x0); x <= last(region.x1); ++x, ++count) {
        const Forest::Place at = forest.locate(n, {patch, x, y});
        const auto row = static_cast<size_t>(at.patch * (n + 1) + at.y);
        const GroundPoint& point = seen.points[row * seen.columns + static_cast<size_t>(at.x)];
        if (point.pixels > 0) sum += cost(point);
      }
    }
    return count > 0 ? sum / static_cast<double>(count) : 0;
  }

  const StreamHeader& header_;
  const Sighting& sighting_;
  double usual_of_heights_, usual_texel_;  ///< what errors cost the encoder's viewers
  int unseen_;
};

}  // namespace

TrackCosts::TrackCosts(const StreamHeader& header, const Sighting& sighting) {
  const SightedStream sighted(header, sighting);
  if (header.geometry) {
    for (const Region& region : regionsIn(*header.geometry))
      costs_[0].push_back(finite(sighted.costOfHeights(region)));
    const size_t coefficients = costs_[0].size(),
                 corrections = correctionTracks(*header.geometry, header.layers);
    for (size_t i = coefficients - corrections; i < coefficients; ++i)  // those of the same ground
      costs_[0].push_back(costs_[0][i]);
  }
  if (header.texture) {
    for (const Region& region : regionsIn(*header.texture))
      costs_[1].push_back(finite(sighted.costOfTexture(region)));
  }
}

}  // namespace tetrakis::inline receiver
