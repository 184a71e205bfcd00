// SPDX-License-Identifier: Apache-2.0
// PrefixErrors measures the pictures of prefixes of a selection, and mapsPay() compares the
// pictures of a selection with maps of priorities to those of a selection without them.
#include "encoder/views/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/portable_math.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "encoder/views/view_inputs.hpp"

namespace tetrakis::inline views {

namespace {

/// Pixels that are looked at for whole streams, which differ by less than pairs of prefixes do.
/// More pixels tell closer streams apart, and take time.
constexpr size_t kPrefixPixels = 4 * kViewPixels;

/// The points of a component's curve at prefixes of a stream: one for each. With priorities errors
/// count as viewers see them.
template <class Coded>
ComponentCurve curveOfPrefixes(const Coded& coded, const std::vector<Packet>& packets,
                               std::span<const uint64_t> lengths) {
  const CodedTracks tracks = coded.accounted();
  ComponentCurve curve;
  curve.packets = packets;
  for (const uint64_t length : lengths) {
    uint64_t left = length, bytes = 0;
    for (const Packet& packet : packets) {
      const uint64_t head = overheadOf(packet), payload = packet.length();
      if (left <= head) break;
      const uint64_t taken = std::min(left - head, payload);
      left -= head + taken;
      if (packet.component == tracks.component && (!packet.whole || taken == payload))
        bytes += taken;
    }
    double squares = 0;
    const Codewords prefix = prefixAfter(tracks, packets, bytes);
    for (size_t i = 0; i < prefix.size(); ++i)
      squares += distortionAt(coded.tracks[i].points, prefix[i].size());
    curve.points.push_back({bytes, squares / coded.counted()});
  }
  return curve;
}

}  // namespace

PrefixErrors::PrefixErrors(const EncodeInputs& inputs, const Selection& any) : inputs_(inputs) {
  const tks_heights& heights = *inputs.heights;
  const GroundRays ground(reliefOf(heights, heights.data, any.heights->quantised->steps.valid));
  const std::vector<Camera> cameras = camerasOf(inputs.options, ground.bounds());
  if (!cameras.empty())
    pictures_.emplace(cameras, kPrefixPixels, ground, any.texture->source->texels);
}

std::vector<double> PrefixErrors::of(const Selection& selection,
                                     std::span<const uint64_t> lengths) const {
  if (!pictures_) return {};
  const CodedHeights& heights = *selection.heights;
  const CodedTexture& texture = *selection.texture;
  const ComponentCurve of_heights = curveOfPrefixes(heights, selection.packets, lengths);
  const ComponentCurve of_texture = curveOfPrefixes(texture, selection.packets, lengths);
  DecodedNodes decoded(inputs_, {heights, of_heights}, {texture, of_texture});
  std::vector<double> errors;
  std::optional<PictureErrors::Surface> surface;
  for (size_t i = 0; i < lengths.size(); ++i) {
    const std::vector<RatePoint>& points = of_heights.points;
    if (i == 0 || points[i].bytes > points[i - 1].bytes)
      surface = pictures_->surfaceOf(GroundRays(decoded.shownAt(points[i].bytes)));
    const ScreenTexture shown = decoded.textureAt(of_texture.points[i].bytes);
    errors.push_back(pictures_->errorInside(*surface, shown) + surface->outlines);
  }
  return errors;
}

namespace {

/// The budget over this number is the earlier of the two lengths at which maps are judged. A larger
/// number counts earlier prefixes, of which the map takes more.
constexpr uint64_t kEarlyPart = 2;
/// Errors below this count as this, in squared parts of 255: no picture is judged by less. A larger
/// number lets nearly exact pictures decide nothing.
constexpr double kNone = 1e-6;

}  // namespace

uint64_t bytesOfMaps(const Selection& selection) {
  const auto bytes = [](const PriorityHeader& map) {
    return map.none() ? size_t{0} : map.code.size() + 2;  // the size of tiles, and the length
  };
  return bytes(selection.heights->header.priorities) + bytes(selection.texture->header.priorities);
}

bool mapsPay(const EncodeInputs& inputs, const Selection& with, const Selection& without) {
  const uint64_t header = headerBytesOf(inputs, without), map = bytesOfMaps(with);
  const uint64_t room = inputs.options.bytes - std::min(inputs.options.bytes, header);
  std::vector<uint64_t> lengths, behind_map;
  for (const uint64_t length : {room / kEarlyPart, room}) {
    lengths.push_back(length);
    behind_map.push_back(lengths.back() - std::min(lengths.back(), map));
  }
  const PrefixErrors errors(inputs, with);
  const std::vector<double> mapped = errors.of(with, behind_map);
  const std::vector<double> plain = errors.of(without, lengths);
  double logarithms = 0;
  for (size_t i = 0; i < mapped.size(); ++i)
    logarithms += portable::log(std::max(mapped[i], kNone) / std::max(plain[i], kNone));
  return logarithms < 0;
}

}  // namespace tetrakis::inline views
